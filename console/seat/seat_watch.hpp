// Whether a person can see this computer's screen, as far as its session tells: a window stays active for Qt behind a lock, and while
// another session is on the screen, and game pads and 3-D mice are heard all the same.
#pragma once

#include <QObject>
#include <QProcessEnvironment>
#include <QString>

#include <memory>

class QThread;

namespace console {

class SeatListener;

/// Where to ask: addresses of D-Bus's buses. Nobody is asked on one that is empty.
struct SeatBuses {
    QString system;       ///< logind's
    QString session;      ///< the screen saver's
    QString display = {}; ///< the X server that the window is on, as `:0`; empty: not known, or another platform
};

/// Those of this program's session; none on a platform without a screen. `platform`: QGuiApplication::platformName(). A bus that would
/// have to be started is none.
SeatBuses seatBusesOf(const QString& platform, const QProcessEnvironment& environment);

/// GUI thread only. Asks and hears on a thread of its own, so that no bus and no service can make the console wait, and starts no service.
///
/// Asked are logind (the session's LockedHint, Active, Lock and Unlock) and the screen savers of the desktops. Who is not there, does not
/// answer or makes no sense has said nothing, and a screen of which nothing is said counts as seen. What was said stands until it is taken
/// back: when a bus ends while the screen is hidden, it stays so.
class SeatWatch : public QObject {
    Q_OBJECT
public:
    explicit SeatWatch(const SeatBuses& buses, QObject* parent = nullptr);
    ~SeatWatch() override;

    void start();

Q_SIGNALS:
    void notSeen(const QString& why);     ///< by nobody; again when the reason is another
    void seen();                          ///< by somebody, as far as it is known; only after that
    void remarked(const QString& remark); ///< that logind tells nothing, and why; at most once

private:
    std::unique_ptr<QThread> m_thread;
    SeatListener* m_listener; ///< lives on the thread, and ends with it
    bool m_asks;              ///< there is somebody to ask
};

} // namespace console
