// Game pads through SDL itself, without hardware: SDL's virtual joysticks.
#include "input/game_pad_master.hpp"
#include "input/sdl_pads.hpp"
#include "virtual_pad.hpp"

#include <QTest>

#include <array>
#include <csignal>

using namespace console;
using namespace console::test;
using namespace std::chrono_literals;

namespace {

struct Heard {
    SdlPads* source = new SdlPads;
    GamePadMaster master{std::unique_ptr<PadSource>(source)};
    Instant now = Instant{} + 1h;

    Heard() { master.setListening(true); }

    MasterReading turn()
    {
        now += 10ms;
        master.poll(now);
        return master.read(now);
    }

    MasterLife life() const { return master.life(now); }
};

} // namespace

class TestSdlPads : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void withoutAPadThereIsNone()
    {
        Heard heard;
        QVERIFY(!heard.turn().alive);
        QCOMPARE(heard.life(), MasterLife::Gone);
        QVERIFY2(heard.source->trouble().isEmpty(), qPrintable(heard.source->trouble()));
    }

    void takesNoSignalAndOpensNoWindow()
    {
        constexpr std::array numbers{SIGINT, SIGTERM};
        std::array<struct sigaction, 2> before{};
        for (std::size_t i = 0; i < numbers.size(); ++i)
            QCOMPARE(sigaction(numbers[i], nullptr, &before[i]), 0);
        qputenv("SDL_NO_SIGNAL_HANDLERS", "0"); // SDL itself would heed it
        const Heard heard;
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            struct sigaction after {};
            QCOMPARE(sigaction(numbers[i], nullptr, &after), 0);
            QVERIFY(after.sa_sigaction == before[i].sa_sigaction);
        }
        QCOMPARE(SDL_WasInit(SDL_INIT_VIDEO), 0U);
    }

    void aPadComesMovesAndGoes()
    {
        Heard heard;
        heard.turn();
        VirtualPad pad;
        QVERIFY(pad.sound());
        QVERIFY(heard.turn().alive);
        QVERIFY2(heard.master.name().contains(QStringLiteral("Virtual pad")), qPrintable(heard.master.name()));
        pad.trigger(1);
        QVERIFY(heard.turn().deadMan);
        pad.stick(SDL_CONTROLLER_AXIS_LEFTY, -1);
        QVERIFY(heard.turn().motion.guidewireVelocity > 0);
        pad.stick(SDL_CONTROLLER_AXIS_LEFTY, 0);
        pad.stick(SDL_CONTROLLER_AXIS_RIGHTX, 1);
        const auto motion = heard.turn().motion;
        QVERIFY(motion.guidewireVelocity == 0 && motion.catheterRotation > 0);
        pad.button(SDL_CONTROLLER_BUTTON_RIGHTSHOULDER, true);
        QVERIFY(heard.turn().clutch);
        pad.unplug();
        const auto reading = heard.turn();
        QVERIFY(!reading.alive && !reading.deadMan && reading.motion.isZero());
        QCOMPARE(heard.life(), MasterLife::Gone);
    }

    void aPadThatComesHeldDoesNotCount()
    {
        Heard heard;
        heard.turn();
        VirtualPad pad;
        pad.trigger(1);
        pad.stick(SDL_CONTROLLER_AXIS_LEFTY, -1);
        for (int i = 0; i < 5; ++i) {
            const auto reading = heard.turn();
            QVERIFY(!reading.alive && !reading.deadMan && reading.motion.isZero());
        }
        QCOMPARE(heard.life(), MasterLife::Unreleased);
        pad.trigger(0);
        QVERIFY(!heard.turn().alive); // the stick is still stuck
        pad.stick(SDL_CONTROLLER_AXIS_LEFTY, 0);
        QVERIFY(heard.turn().alive);
    }

    void aPadThatGoesIsNotLetGo()
    {
        Heard heard;
        heard.turn();
        VirtualPad pad;
        heard.turn();
        pad.trigger(1);
        pad.stick(SDL_CONTROLLER_AXIS_LEFTY, -1);
        QVERIFY(heard.turn().deadMan);
        QStringList told;
        QObject::connect(&heard.master, &MasterDevice::lifeChanged, [&told] { told << QStringLiteral("life"); });
        QObject::connect(&heard.master, &MasterDevice::deadManChanged, [&told] { told << QStringLiteral("dead-man"); });
        pad.unplug();
        heard.turn();
        QCOMPARE(told, QStringList({QStringLiteral("life"), QStringLiteral("dead-man")}));
    }

    void theFirstOfSeveralIsHeardAndTheNextAfterIt()
    {
        Heard heard;
        heard.turn();
        VirtualPad first("First");
        heard.turn();
        VirtualPad second("Second");
        heard.turn();
        QVERIFY2(heard.master.name().contains(QStringLiteral("First (+1)")), qPrintable(heard.master.name()));
        QVERIFY(heard.master.note().contains(QStringLiteral("Second")));
        second.trigger(1);
        QVERIFY(!heard.turn().deadMan);
        first.trigger(1);
        QVERIFY(heard.turn().deadMan);
        first.unplug();
        const auto reading = heard.turn(); // the second is held
        QVERIFY(!reading.alive && !reading.deadMan);
        QVERIFY2(heard.master.name().contains(QStringLiteral("Second")), qPrintable(heard.master.name()));
        second.trigger(0);
        QVERIFY(heard.turn().alive);
    }
};

QTEST_GUILESS_MAIN(TestSdlPads)
#include "test_sdl_pads.moc"
