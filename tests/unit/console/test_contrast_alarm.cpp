// The alarm of an injector that runs dry, from what a robot tells: how much is left, and what becomes of the injection.
#include "watched_cockpit.hpp"

#include <QTest>

using namespace console;
using namespace console::test;
using namespace std::chrono_literals;
using C = AlarmCondition;
using Progress = InjectionProgress;

namespace {

struct Injecting : Watched {
    Injecting()
    {
        left(5);
        tell(Progress::Accepted);
        left(4.98);
        tell(Progress::Running);
    }

    void left(double millilitres)
    {
        now += 10ms;
        auto status = robot();
        status.contrastRemaining = millilitres;
        receive(status);
    }

    void tell(Progress progress, quint32 number = 9) { models().instrument.receiveInjection({number, 2, progress, {}}, now); }

    std::optional<AlarmPriority> empty() { return priorityOf(C::ContrastEmpty); }
};

} // namespace

class TestContrastAlarm : public QObject {
    Q_OBJECT

private Q_SLOTS:
    /// It never runs with nothing left: the look that comes after it finds a stopped injection.
    void anInjectorThatStopsBecauseNothingIsLeftRanDry()
    {
        for (const bool levelFirst : {false, true}) {
            Injecting w;
            w.left(0.1);
            if (levelFirst)
                w.left(0.04);
            QVERIFY(!w.empty());
            w.tell(Progress::Stopped);
            if (!levelFirst)
                w.left(0.04);
            QCOMPARE(w.empty(), std::optional(AlarmPriority::Low)); // nothing is armed
            for (int i = 0; i < 100; ++i)
                w.left(0);
            QVERIFY(w.empty());
            w.left(100); // refilled
            QVERIFY(w.empty());
            w.now += AlarmList::longestEndDelay;
            w.left(100);
            QVERIFY(!w.empty());
        }
    }

    void anInjectorThatGivesTheLastOfItIsLow()
    {
        Injecting w;
        w.left(0.02);
        w.tell(Progress::Done);
        w.left(0);
        QVERIFY(!w.empty());
        QCOMPARE(w.priorityOf(C::ContrastLow), std::optional(AlarmPriority::Low));
    }

    void whatIsLeftWhenAnInjectionIsStoppedIsNotNothing()
    {
        Injecting w;
        w.left(0.06);
        w.tell(Progress::Stopped);
        QVERIFY(!w.empty());
        w.now += InstrumentState::contrastSettles;
        w.tell(Progress::Stopped); // told again
        w.left(0);                 // emptied by a person
        QVERIFY(!w.empty());
    }

    void aRefusedInjectionDoesNotEndIt()
    {
        Injecting w;
        w.tell(Progress::Stopped);
        w.left(0);
        w.tell(Progress::Refused, 10);
        w.left(0);
        QVERIFY(w.empty());
    }
};

QTEST_GUILESS_MAIN(TestContrastAlarm)
#include "test_contrast_alarm.moc"
