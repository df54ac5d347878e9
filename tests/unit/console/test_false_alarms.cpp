// What looks like an alarm for a moment and is none, or one and not many: one late heartbeat, a value at its limit.
#include "watched_cockpit.hpp"

#include <QTest>

#include <algorithm>

using namespace console;
using namespace console::test;
using namespace std::chrono_literals;
using C = AlarmCondition;

namespace {

/// Lines of the alarm log, raised or ended.
int told(Watched& w, const QString& words)
{
    const auto& log = w.models().alarms.log();
    return int(std::count_if(log.begin(), log.end(), [&words](const AlarmLogEntry& entry) { return entry.text.contains(words); }));
}

void measure(Watched& w, Duration roundTrip)
{
    w.now += 100ms;
    w.figuresOf(robotId, [roundTrip](auto& figures) { figures.roundTrip = roundTrip; });
}

} // namespace

class TestFalseAlarms : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void oneLateHeartbeatIsNoRoundTrip()
    {
        Watched w;
        measure(w, 900ms);
        QVERIFY(!w.priorityOf(C::CommandRoundTrip));
        measure(w, 901ms);
        QCOMPARE(w.priorityOf(C::CommandRoundTrip), std::optional(AlarmPriority::Low));
    }

    void aRoundTripAtItsLimitIsOneAlarm()
    {
        Watched w;
        for (int i = 0; i < 50; ++i) {
            measure(w, 248ms);
            w.look();
            measure(w, 252ms);
            w.look();
        }
        QVERIFY(w.priorityOf(C::CommandRoundTrip));
        QCOMPARE(told(w, QStringLiteral("there and back")), 1);
    }

    void aForceAtItsLimitIsOneAlarm()
    {
        Watched w;
        w.cockpit.arm();
        for (int i = 0; i < 100; ++i) {
            w.now += 100ms;
            auto status = w.robot();
            status.guidewireForce = i % 2 == 0 ? 1.02 : 0.98;
            w.receive(status);
            w.look();
        }
        QCOMPARE(told(w, QStringLiteral("Guidewire force")), 1);
    }
};

QTEST_GUILESS_MAIN(TestFalseAlarms)
#include "test_false_alarms.moc"
