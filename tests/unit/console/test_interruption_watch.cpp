// The account of an interruption from what the link room tells: when it begins, when it ends, and that the permit waits for it.
#include "app/interruption_watch.hpp"
#include "invented_cockpit.hpp"
#include "model/present_readings.hpp"

#include <QTest>

using namespace console;
using namespace console::test;
using namespace std::chrono_literals;
using Stage = InterruptionAccount::Stage;

namespace {

struct Watched {
    InventedCockpit cockpit;
    quint64 pictures = 100;
    InterruptionWatch watch{cockpit.models, [this] { return pictures; }};

    Watched()
    {
        cockpit.openAll();
        watch.update(cockpit.now);
    }

    ConsoleModels& models() { return cockpit.models; }
    const InterruptionAccount& account() const { return cockpit.models.interruption; }

    void lose(quint64 id, quint32 a, quint32 b, Duration silence = 110ms)
    {
        IncidentRecord record;
        record.id = id;
        record.a = a;
        record.b = b;
        record.peer = a == cockpitId ? b : b == cockpitId ? a : 0;
        record.since = std::chrono::steady_clock::now();
        record.diagnosis = LinkDiagnosis{};
        record.diagnosis->silence = silence;
        models().incidents.raise(record, record.since);
        models().sessions.setStandBy(true);
    }

    void reopen(quint64 id)
    {
        models().incidents.end(id);
        models().sessions.setStandBy(!models().incidents.empty());
    }

    bool guardMet()
    {
        return metGuards(checkGuards(guardReadings(models(), robotId, true, cockpit.now))).test(std::size_t(Guard::InterruptionRead));
    }
};

} // namespace

class TestInterruptionWatch : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void aLossThatIsReopenedIsUnreadUntilAPersonReadIt()
    {
        Watched w;
        QVERIFY(w.guardMet());
        w.lose(1, cockpitId, robotId, 5s);
        QCOMPARE(w.account().stage(), Stage::Running);
        QVERIFY(!w.guardMet());
        w.reopen(1);
        QCOMPARE(w.account().stage(), Stage::Unread);
        QVERIFY(!w.guardMet());
        QVERIFY(w.account().lasted() >= 5s); // from the last moment at which it was heard
        QCOMPARE(w.account().losses(), 1);
        QCOMPARE(w.account().lost(), QStringList{QStringLiteral("Vascular robot link")});
        w.watch.acknowledge(QStringLiteral("Dr Wu"), std::chrono::steady_clock::now());
        QVERIFY(!w.guardMet()); // the click that re-opened cannot have read it
        w.watch.acknowledge(QStringLiteral("Dr Wu"), std::chrono::steady_clock::now() + 1s);
        QVERIFY(w.guardMet());
        const auto& last = w.models().log.lines().back();
        QCOMPARE(last.kind, LogKind::Operator);
        QVERIFY2(last.text.startsWith(QStringLiteral("account of the interruption read by Dr Wu: Interrupted for ")),
                 qPrintable(last.text));
    }

    /// Nobody watched meanwhile, however short it was.
    void anInterruptionThatHealsByItselfIsReadTooAndCountsOnce()
    {
        Watched w;
        w.models().sessions.setLinkState(armId, LinkState::Reconnecting, w.cockpit.now);
        QCOMPARE(w.account().stage(), Stage::Running);
        QVERIFY(!w.guardMet());
        w.models().sessions.setLinkState(armId, LinkState::Open, w.cockpit.now);
        QCOMPARE(w.account().stage(), Stage::Unread);
        QCOMPARE(w.account().losses(), 1);
        QCOMPARE(w.account().lost(), QStringList{QStringLiteral("Robotic arm link")});
        w.watch.acknowledge({}, std::chrono::steady_clock::now() + 1s);
        QVERIFY(w.guardMet());
    }

    void anInterruptionThatDoesNotHealIsOneLoss()
    {
        Watched w;
        w.models().sessions.setLinkState(robotId, LinkState::Reconnecting, w.cockpit.now);
        w.lose(1, cockpitId, robotId);
        w.models().sessions.setLinkState(robotId, LinkState::StandBy, w.cockpit.now);
        w.reopen(1);
        w.models().sessions.setLinkState(robotId, LinkState::Open, w.cockpit.now);
        QCOMPARE(w.account().stage(), Stage::Unread);
        QCOMPARE(w.account().losses(), 1);
    }

    /// A peer that was started anew, say: the link stands by without having been interrupted, and its incident is told after that.
    void aLinkThatIsGivenUpAtOnceIsOneLossFromWhenItWasHeard()
    {
        Watched w;
        w.models().sessions.setLinkState(robotId, LinkState::StandBy, w.cockpit.now);
        w.lose(1, cockpitId, robotId, 5s);
        QCOMPARE(w.account().stage(), Stage::Running);
        w.reopen(1);
        w.models().sessions.setLinkState(robotId, LinkState::Open, w.cockpit.now);
        QCOMPARE(w.account().stage(), Stage::Unread);
        QCOMPARE(w.account().losses(), 1);
        QVERIFY(w.account().lasted() >= 5s);
        QCOMPARE(w.account().lost(), QStringList{QStringLiteral("Vascular robot link")});
    }

    void aLinkInStandByOfWhichNothingIsToldIsAnAccountAllTheSame()
    {
        Watched w;
        w.models().sessions.setLinkState(robotId, LinkState::StandBy, w.cockpit.now);
        w.watch.update(w.cockpit.now);
        QCOMPARE(w.account().stage(), Stage::Running);
        w.models().sessions.setLinkState(robotId, LinkState::Open, w.cockpit.now);
        QVERIFY(!w.guardMet());
    }

    void endsOnlyWhenNoIncidentIsLeft()
    {
        Watched w;
        w.lose(1, cockpitId, robotId);
        w.lose(2, cockpitId, xrayId);
        w.reopen(1);
        QCOMPARE(w.account().stage(), Stage::Running);
        w.reopen(2);
        QCOMPARE(w.account().stage(), Stage::Unread);
        QCOMPARE(w.account().losses(), 2);
    }

    void othersLossCountsToo()
    {
        Watched w;
        w.lose(1, armId, robotId);
        w.reopen(1);
        QVERIFY(!w.guardMet());
        QCOMPARE(w.account().lost(), QStringList{QStringLiteral("link Robotic arm \u2013 Vascular robot")});
    }

    void aStandByWithoutAnIncidentIsAnAccount()
    {
        Watched w;
        w.models().sessions.setStandBy(true);
        QCOMPARE(w.account().stage(), Stage::Running);
        w.models().sessions.setStandBy(false);
        QVERIFY(!w.guardMet());
    }

    void picturesAreCountedWhereTheXraySystemReports()
    {
        Watched w;
        auto xray = w.models().xray.status().value;
        w.models().xray.receive(xray, w.cockpit.now);
        w.watch.update(w.cockpit.now);
        w.lose(1, cockpitId, xrayId);
        w.reopen(1);
        w.pictures += 6;
        xray.framesAcquired += 48;
        w.models().xray.receive(xray, w.cockpit.now);
        w.pictures += 5; // after that report
        w.watch.update(w.cockpit.now);
        bool found = false;
        for (const auto& line : accountLines(w.account()))
            found = found || line.text.contains(QStringLiteral("48 taken, 42 of them"));
        QVERIFY(found);
    }
};

QTEST_GUILESS_MAIN(TestInterruptionWatch)
#include "test_interruption_watch.moc"
