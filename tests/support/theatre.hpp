// The whole reference system, operated as a person does: the console in this process, the devices in processes of their own.
#pragma once

#include "app/cockpit_application.hpp"
#include "child_process.hpp"
#include "model/preferences.hpp"
#include "test_system.hpp"
#include "widgets/cockpit_window.hpp"

#include <QAbstractButton>
#include <QSize>
#include <QString>
#include <QStringList>

#include <functional>
#include <memory>
#include <string>

namespace console::test {

/// What a console is started with as the cockpit of that system: its files, and nothing else.
Options cockpitOptions(liena::test::TestSystem& files);

/// Robot, arm and X-ray system over TLS on loopback, and the console's window with its links to them. What waits gives up after
/// `patience`, and says so by false.
class Theatre {
public:
    static constexpr int patience = 30000;    ///< milliseconds
    static constexpr int twiceArmHold = 3200; ///< milliseconds; who looks for an arming that must not come need look no longer

    struct Wishes {
        QSize window{1366, 768};
        int pictureSize = 256; ///< rows and columns: sanitizers are slow
        MasterKind master = MasterKind::Keyboard;
        PictureProfile profile = PictureProfile::Coronary;
        bool devices = true;                          ///< as processes; otherwise the test brings its own
        bool arm = true;                              ///< the robotic arm is part of the system
        bool rival = false;                           ///< a second cockpit has a link to the robot: `cockpit-2`
        bool secondXray = false;                      ///< the cockpit has a link to another one, which it does not work with: `xray-2`
        std::string title = "Surgeon's cockpit";      ///< of the console, in the topology
        std::string robotHost = "127.0.0.1";          ///< in the topology
        liena::test::TestSystem::Options system = {}; ///< timing, for one
        std::string pictureTiming = {};               ///< of the link to the X-ray system, when it is another
        QString user;
        QString watchdog;    ///< program; empty: none
        QString player;      ///< program; empty: none, as on a computer without sound
        QString remoteInput; ///< the way by which keys and mouse come from elsewhere; empty: they do not
        SeatBuses seat = {}; ///< where it is asked whether somebody sees the screen; empty: nowhere
        Preferences preferences = {};
        bool listens = false;        ///< to the whole of each alarm self-test; it takes 7 s, and after the first 4
        AlarmVoice* voice = nullptr; ///< in place of the loudspeaker; outlives the theatre
    };

    /// Throws when a device does not start or the console refuses.
    Theatre() : Theatre(Wishes()) {}
    explicit Theatre(const Wishes& wishes);

    std::unique_ptr<liena::test::ChildProcess> start(const std::string& role, const QStringList& options = {});

    CockpitWindow& window() { return cockpit->window(); }
    const ConsoleModels& models() const { return cockpit->models(); }
    PermitPhase phase() const { return models().permit.phase(); }
    LinkState link(const std::string& name) const { return models().sessions.state(files.idOf(name).value()); }
    const RobotStatus& robotStatus() const { return models().instrument.robot().value; }

    /// Visible, and its text begins so; null when there is none.
    QAbstractButton* button(const QString& text, const QWidget* within = nullptr) const;

    /// Once it is there and enabled.
    bool click(const QString& text, const QWidget* within = nullptr);

    /// By the topology view, and back to the cockpit.
    bool openAll();

    /// Where a key that is pressed now goes: to whatever has the focus. Without one, in another window's time, to the cockpit.
    QWidget* keyTarget();

    void hold(int key);
    void release(int key);
    void strike(int key); ///< pressed and released
    void releaseAll();

    /// Within `time` milliseconds.
    bool reaches(PermitPhase wanted, int time = 6000);

    /// The console ends and starts again; its links are closed then. Throws when it refuses.
    void restartConsole();

    /// Everything that a person does until only ARM is left to be held, as often as a condition fails on the way.
    bool makeReady();

    /// Everything that a person does until the robot is armed, as often as a condition fails on the way: a busy computer paints too late,
    /// say.
    bool arm();

    /// What presses the dead-man, what then moves, and what lets both go again.
    struct Hand {
        std::function<void()> press, move, letGo;
    };
    Hand keyboardHand();

    /// Arms, and ends with the robot moving forward.
    bool armAndMove(const Hand& hand);
    bool armAndMove() { return armAndMove(keyboardHand()); }

    bool mayMove() const { return phase() == PermitPhase::Armed || phase() == PermitPhase::Engaged; }

    /// Motion has ended by nothing but what a busy computer does: this console stood still, pictures or the robot's reports were late.
    bool heldByThisComputer() const;

    /// Looks at the colours, listens when that was wished, and says so. A high alarm that comes between ends the test.
    void testAlarms();

    /// What happened while the system stood by, once it can be read.
    void readAccount();

    void acknowledgeAlarms();

    /// What the console shows and noted last, for a failing test's output.
    QString story() const;

    liena::test::TestSystem files;
    std::unique_ptr<liena::test::ChildProcess> robot;
    std::unique_ptr<liena::test::ChildProcess> armDevice;
    std::unique_ptr<liena::test::ChildProcess> xray;
    std::unique_ptr<CockpitApplication> cockpit;

private:
    void startConsole();
    bool readyOnce(const Hand& hand);
    bool armOnce(const Hand& hand);

    Wishes m_wishes;
};

} // namespace console::test
