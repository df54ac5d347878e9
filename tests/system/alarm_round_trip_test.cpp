// Alarms of commands that take long: between the console and a robot that can be armed, over a line as slow as the test says. That of one
// that cannot be armed at all is tried by system.alarm_lines.
#include "puppet_theatre.hpp"
#include "shown_alarms.hpp"
#include "slow_line.hpp"
#include "widgets/theme.hpp"

#include <QApplication>
#include <QTest>

#include <stdexcept>
#include <string_view>

#include <dlfcn.h>
#include <netdb.h>

using namespace console;
using console::test::isPresent;
using console::test::present;
using console::test::PuppetTheatre;
using console::test::puppetWishes;
using console::test::Theatre;
using namespace std::chrono_literals;
using C = AlarmCondition;

namespace {

constexpr int patience = Theatre::patience;
constexpr const char* host = "robot.liena.test";
constexpr const char* listening = "127.0.0.2"; ///< where the robot does
constexpr const char* found = "127.0.0.3";     ///< where everybody else finds it, which is the line

// Caution from 150 ms on, the limit at 250 ms, and motion goes on up to 450 ms: each as far from the next as a computer may be late.
constexpr auto slow = 170ms;
constexpr auto tooSlow = 300ms;

Theatre::Wishes wishes()
{
    auto all = puppetWishes();
    all.robotHost = host;
    all.profile = PictureProfile::Neuro;
    all.system.lateCommands = true; // the reference robot takes none that is older than 50 ms
    return all;
}

struct Stage {
    liena::test::SlowLine line{QHostAddress(QString::fromLatin1(found)), QHostAddress(QString::fromLatin1(listening))};
    PuppetTheatre devices{wishes()};
    Theatre& theatre = devices.theatre;

    Stage()
    {
        if (!line.open(theatre.files.portOf("robot")))
            throw std::runtime_error("the line has no place of its own");
    }

    bool takesLongerThan(Duration time) const
    {
        const auto usual = [this] {
            return theatre.models().sessions.linkTo(theatre.files.idOf("robot").value())->usualRoundTrip().value_or(0ms);
        };
        return QTest::qWaitFor([&] { return usual() > time; }, patience);
    }

    /// While it is armed.
    bool tells(AlarmPriority priority) const
    {
        const auto told = [&] { return isPresent(theatre, C::CommandRoundTrip, priority); };
        return QTest::qWaitFor([&] { return told() || !theatre.mayMove(); }, patience) && told() && theatre.mayMove();
    }

    bool ends() const
    {
        return QTest::qWaitFor([&] { return present(theatre, C::CommandRoundTrip) == nullptr; }, patience);
    }
};

} // namespace

// Stands before the C library's, which Asio asks: by name the line is found, and only the robot itself listens elsewhere.
extern "C" int getaddrinfo(const char* node, const char* service, const addrinfo* hints, addrinfo** result)
{
    using Ask = int (*)(const char*, const char*, const addrinfo*, addrinfo**);
    static const auto ask = reinterpret_cast<Ask>(::dlsym(RTLD_NEXT, "getaddrinfo"));
    if (node == nullptr || std::string_view(node) != host)
        return ask(node, service, hints, result);
    const bool listens = hints != nullptr && (hints->ai_flags & AI_PASSIVE) != 0;
    return ask(listens ? listening : found, service, hints, result);
}

class AlarmRoundTripTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase() { theme::apply(*qobject_cast<QApplication*>(QCoreApplication::instance())); }

    /// 8. The robot takes each command that late, and is armed all the same.
    void commandsThatTakeLongAreMoreUrgentWhileArmed()
    {
        Stage stage;
        auto& theatre = stage.theatre;
        QVERIFY2(theatre.openAll(), qPrintable(theatre.story()));
        stage.line.setDelay(slow);
        QVERIFY2(stage.takesLongerThan(150ms), qPrintable(theatre.story()));
        const auto before = stage.devices.robot.turns();
        QTRY_VERIFY_WITH_TIMEOUT(stage.devices.robot.turns() > before + 50, patience); // alarms are looked for several times between
        QVERIFY2(present(theatre, C::CommandRoundTrip) == nullptr, qPrintable(theatre.story())); // nothing is armed
        constexpr int tries = 5; // a computer that stands still ends motion, and what comes of the robot does not pass the slow line
        bool told = false;
        for (int i = 0; i < tries && !told; ++i) {
            stage.line.setDelay(0ms);
            QVERIFY2(theatre.arm(), qPrintable(theatre.story()));
            QVERIFY2(stage.ends(), qPrintable(theatre.story()));
            stage.line.setDelay(slow);
            told = stage.tells(AlarmPriority::Low);
            stage.line.setDelay(tooSlow);
            told = told && stage.tells(AlarmPriority::Medium);
            QVERIFY2(told || theatre.heldByThisComputer(), qPrintable(theatre.story())); // it is told, and ends nothing
        }
        QVERIFY2(told, qPrintable(theatre.story()));
        stage.line.setDelay(0ms);
        QVERIFY2(stage.ends(), qPrintable(theatre.story()));
        theatre.releaseAll();
    }
};

QTEST_MAIN(AlarmRoundTripTest)
#include "alarm_round_trip_test.moc"
