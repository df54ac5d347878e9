// Hears on both buses whether a person can see the screen.
#pragma once

#include "seat/login_session.hpp"
#include "seat/screen_saver.hpp"
#include "seat/seat_watch.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace console {

/// Lives on the thread of SeatWatch: to open a bus may take long.
class SeatListener : public QObject {
    Q_OBJECT
public:
    explicit SeatListener(SeatBuses buses);
    ~SeatListener() override;

    void begin();

Q_SIGNALS:
    void told(const QString& why); ///< why nobody sees it; empty: somebody may
    void remarked(const QString& remark);

private Q_SLOTS:
    void endSystem();
    void endSession();

private:
    struct Line {
        QString name;     ///< of the connection
        const char* slot; ///< told when it ends
    };

    std::optional<QDBusConnection> open(const QString& address, const char* slot);
    void look();
    void beginSavers();
    void remark(const QString& why);
    QString reason() const;
    void tell();

    SeatBuses m_buses;
    std::vector<Line> m_lines;
    std::unique_ptr<LoginSession> m_login;
    std::vector<std::unique_ptr<ScreenSaver>> m_savers;
    bool m_systemEnded = false;
    bool m_sessionEnded = false;
    bool m_saversBegun = false;
    bool m_remarked = false;
    QString m_told;
};

} // namespace console
