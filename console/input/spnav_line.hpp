// The line to spacenavd, the daemon of 3-D mice, by libspnav.
#pragma once

#include <QFutureWatcher>
#include <QObject>
#include <QTimer>

#include <array>
#include <chrono>
#include <memory>

class QSocketNotifier;

namespace console {

/// Left to right, up, away from the person; turns in the same order.
using PuckDeflection = std::array<int, 6>;

/// GUI thread only, and one at a time in a program: libspnav has one connection. To open it can take the library 0.4 s and more when the
/// daemon hangs, so that happens on a thread of its own; afterwards nothing blocks. The daemon's socket is the library's affair:
/// $SPNAV_SOCKET, /etc/spnavrc, or /var/run/spnav.sock.
class SpnavLine : public QObject {
    Q_OBJECT
public:
    explicit SpnavLine(QObject* parent = nullptr);
    ~SpnavLine() override;

    /// Looks for the daemon now, and again every two seconds while there is no mouse.
    void start();

    /// Why there is no mouse, when that is more than a daemon that does not run; else empty.
    const QString& trouble() const { return m_trouble; }

Q_SIGNALS:
    void came();
    void went();
    void deflected(const console::PuckDeflection& deflection);
    void buttonChanged(int button, bool pressed);

private:
    enum class Opened { NoDaemon, TooOld, NoMouse, Mouse };
    struct Attempt;

    static Opened openNow();
    void attempt();
    void finishAttempt();
    void listen();
    void take();
    bool takeOne();
    void close();

    static constexpr std::chrono::seconds retry{2};
    static constexpr std::chrono::milliseconds soon{100};
    static constexpr int mostAtOnce = 64; ///< events taken before others get their turn

    QTimer m_retry;
    QTimer m_soon;
    QFutureWatcher<Opened> m_opening;
    std::shared_ptr<Attempt> m_attempt;
    std::unique_ptr<QSocketNotifier> m_notifier;
    QString m_trouble;
    bool m_open = false;  ///< the library's connection is this thread's
    bool m_mouse = false; ///< came() was told
};

} // namespace console
