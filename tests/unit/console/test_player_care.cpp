// How long a burst is kept for a player that cannot play it, and when a player that cannot is replaced.
#include "sound/kept_burst.hpp"
#include "sound/replacement_plan.hpp"

#include <QTest>

using namespace console;
using namespace std::chrono_literals;

namespace {

constexpr Instant start = Instant{} + 1h;

} // namespace

class TestPlayerCare : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void theNewestBurstIsKeptForHalfAMinute()
    {
        KeptBurst burst;
        QVERIFY(!burst.at(start));
        QVERIFY(!burst.isTooOld(start + 24h));
        burst.keep(PlayerOrder::Low, start);
        burst.keep(PlayerOrder::High, start + 20s);
        QVERIFY(burst.at(start + 50s) == PlayerOrder::High);
        QVERIFY(!burst.isTooOld(start + 50s));
        QVERIFY(burst.isTooOld(start + 50s + 1ms));
        QVERIFY(!burst.at(start + 50s + 1ms));
    }

    void whatHasSoundedIsNotKept()
    {
        KeptBurst burst;
        burst.keep(PlayerOrder::High, start);
        burst.forget();
        QVERIFY(!burst.at(start));
        QVERIFY(!burst.isTooOld(start + 24h));
    }

    void playersAreReplacedEverMoreRarely()
    {
        ReplacementPlan plan;
        Instant started = start;
        for (const auto patience : {10s, 20s, 40s, 60s, 60s}) {
            plan.noteStarted(started);
            QVERIFY(!plan.isDue(started + patience - 1ms));
            QVERIFY(plan.isDue(started + patience));
            QVERIFY(!plan.isDue(started + patience + 1ms)); // it is said once
            started += patience + 300ms;
        }
    }

    void oneThatPlaysIsGivenItsTimeAnew()
    {
        ReplacementPlan plan;
        plan.noteStarted(start);
        QVERIFY(plan.isDue(start + 10s));
        plan.noteStarted(start + 11s);
        plan.noteWell(start + 12s);
        QVERIFY(!plan.isDue(start + 22s - 1ms));
        QVERIFY(plan.isDue(start + 22s));
    }
};

QTEST_GUILESS_MAIN(TestPlayerCare)
#include "test_player_care.moc"
