// How quiet a long path is by itself, from how late acknowledgements come while bulk leaves slower, or meets no queue.
#include "tasks/path_calm.hpp"

#include <QTest>

#include <array>

using liena::tasks::PathCalm;
using namespace std::chrono_literals;
using Nanoseconds = std::chrono::nanoseconds;
using Heard = PathCalm::Heard;

namespace {

constexpr int verdicts = 6;
constexpr Nanoseconds usual = 500us; ///< of a path that was not heard
constexpr Nanoseconds calmly = 100us;
constexpr Nanoseconds unquietly = 1ms;
const PathCalm::Instant start{1h};

/// Each verdict as late as the others.
Heard hear(PathCalm& calm, Nanoseconds late, PathCalm::Instant now = start)
{
    calm.begin();
    for (int i = 1; i < verdicts; ++i)
        calm.hear(late, now);
    return calm.hear(late, now);
}

void overhear(PathCalm& calm, Nanoseconds late, int times = verdicts)
{
    for (int i = 0; i < times; ++i)
        calm.overhear(late);
}

bool isDueIn(const PathCalm& calm, Nanoseconds pause, PathCalm::Instant now = start)
{
    return !calm.isDue(now + pause - 1ns) && calm.isDue(now + pause);
}

} // namespace

class PathCalmTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void aPathThatWasNotHeardIsNotCalm()
    {
        const PathCalm calm;
        QVERIFY(!calm.isCalm());
        QVERIFY(!calm.listens());
        QVERIFY(calm.isDue(start));
        QCOMPARE(calm.unrest(), usual);
    }

    void itListensForSixVerdicts()
    {
        PathCalm calm;
        calm.begin();
        for (int i = 1; i < verdicts; ++i) {
            QVERIFY(calm.listens());
            QCOMPARE(calm.hear(calmly, start), Heard::NotAll);
            QVERIFY2(!calm.isCalm(), "not all was heard");
        }
        QVERIFY(calm.listens());
        QCOMPARE(calm.hear(calmly, start), Heard::Calm);
        QVERIFY(!calm.listens());
        QVERIFY(calm.isCalm());
    }

    void aQuarterIsAddedToWhatWasHeard()
    {
        PathCalm calm;
        hear(calm, 200us);
        QCOMPARE(calm.heard(), Nanoseconds(250us));
        QCOMPARE(calm.unrest(), Nanoseconds(250us));
    }

    void upToTwoHundredAndEightyMicrosecondsAreCalm()
    {
        PathCalm calm;
        QCOMPARE(hear(calm, 280us), Heard::Calm);
        QVERIFY(calm.isCalm());
        QCOMPARE(calm.unrest(), Nanoseconds(350us));
        QVERIFY(hear(calm, 280us + 4ns) != Heard::Calm);
        QVERIFY(!calm.isCalm());
    }

    void aPathThatDoesNotVaryIsTakenToDoSoALittle()
    {
        PathCalm calm;
        QCOMPARE(hear(calm, 0ns), Heard::Calm);
        QCOMPARE(calm.unrest(), Nanoseconds(50us));
        QCOMPARE(hear(calm, -1ms), Heard::Calm); // a piece took less than was assumed
        QCOMPARE(calm.unrest(), Nanoseconds(50us));
    }

    /// How much it was is known all the same.
    void ofAPathThatIsNotCalmTheUsualIsAssumed()
    {
        PathCalm calm;
        hear(calm, calmly);
        hear(calm, 2ms);
        QVERIFY(!calm.isCalm());
        QCOMPARE(calm.unrest(), usual);
        QCOMPARE(calm.heard(), Nanoseconds(2500us));
    }

    void theLatestIsLeftOut_data()
    {
        QTest::addColumn<std::size_t>("place");
        for (std::size_t place = 0; place < verdicts; ++place)
            QTest::addRow("%d", static_cast<int>(place + 1)) << place;
    }
    void theLatestIsLeftOut()
    {
        QFETCH(std::size_t, place);
        std::array<Nanoseconds, verdicts> late{120us, 80us, 200us, 160us, 200us, 40us};
        late.at(place) = 30ms; // a computer stood still
        PathCalm calm;
        calm.begin();
        for (const auto each : late)
            calm.hear(each, start);
        QVERIFY(calm.isCalm());
        QCOMPARE(calm.heard(), Nanoseconds(250us));
    }

    void twoLateOnesAreThePaths()
    {
        PathCalm calm;
        calm.begin();
        for (const Nanoseconds each : {10us, 900us, 10us, 10us, 800us, 10us})
            calm.hear(each, start);
        QVERIFY(!calm.isCalm());
        QCOMPARE(calm.heard(), Nanoseconds(1ms));
    }

    /// What still stood of a queue may have been heard then.
    void theFirstHearingIsDoubtfulIfItWasUnquiet()
    {
        PathCalm calm;
        QCOMPARE(hear(calm, unquietly), Heard::Doubtful);
        for (int i = 0; i < 10; ++i)
            QCOMPARE(hear(calm, unquietly), Heard::Unquiet);
        QCOMPARE(hear(calm, calmly), Heard::Calm);
        QCOMPARE(hear(calm, unquietly), Heard::Unquiet);
    }

    void afterACalmHearingNoneIsDoubtful()
    {
        PathCalm calm;
        QCOMPARE(hear(calm, calmly), Heard::Calm);
        QCOMPARE(hear(calm, unquietly), Heard::Unquiet);
    }

    void anUnquietPathIsHeardAgainSoonAndThenLessOften()
    {
        PathCalm calm;
        auto now = start;
        for (const Nanoseconds pause : {500ms, 1000ms, 2000ms, 4000ms, 8000ms, 10000ms, 10000ms}) {
            hear(calm, unquietly, now);
            QVERIFY(isDueIn(calm, pause, now));
            now += pause;
        }
    }

    void aCalmPathIsHeardAgainAfterTenSeconds()
    {
        PathCalm calm;
        hear(calm, calmly);
        QVERIFY(isDueIn(calm, 10s));
        PathCalm wasUnquiet;
        hear(wasUnquiet, unquietly);
        hear(wasUnquiet, calmly);
        QVERIFY(isDueIn(wasUnquiet, 10s));
    }

    /// It may be begun anew before all was heard.
    void whatWasHeardBeforeItBeganDoesNotCount()
    {
        PathCalm calm;
        calm.begin();
        for (int i = 1; i < verdicts; ++i)
            calm.hear(unquietly, start);
        QCOMPARE(hear(calm, calmly), Heard::Calm);
        hear(calm, unquietly);
        calm.begin();
        calm.hear(unquietly, start); // the latest, left out
        for (int i = 1; i < verdicts; ++i)
            calm.hear(calmly, start);
        QCOMPARE(calm.heard(), Nanoseconds(125us));
    }

    void itCanBeStopped()
    {
        PathCalm calm;
        calm.begin();
        calm.hear(calmly, start);
        calm.stop();
        QVERIFY(!calm.listens());
        QVERIFY2(calm.isDue(start), "nothing was found out");
        QVERIFY(!calm.isCalm());
    }

    void asManyAreOverheardAsAreHeard()
    {
        PathCalm calm;
        overhear(calm, calmly, verdicts - 1);
        QVERIFY(!calm.isCalm());
        QCOMPARE(calm.unrest(), usual);
        calm.overhear(calmly);
        QVERIFY(calm.isCalm());
        QCOMPARE(calm.unrest(), Nanoseconds(125us));
    }

    void upToTwoHundredAndEightyMicrosecondsAreOverheard()
    {
        PathCalm calm;
        overhear(calm, 280us + 4ns);
        QVERIFY(!calm.isCalm());
        overhear(calm, 280us);
        QVERIFY(calm.isCalm());
    }

    /// How late they come may be a queue that is not long enough to be met.
    void whatIsLateTellsNothingWhileItIsOnlyOverheard()
    {
        PathCalm calm;
        overhear(calm, unquietly);
        QCOMPARE(calm.unrest(), usual);
        hear(calm, calmly);
        overhear(calm, unquietly);
        QVERIFY(calm.isCalm());
        QCOMPARE(calm.unrest(), Nanoseconds(125us));
    }

    void oneThatIsLateSpoilsTheSixThatAreOverheard()
    {
        for (int place = 0; place < verdicts; ++place) {
            PathCalm calm;
            for (int i = 0; i < verdicts; ++i)
                calm.overhear(i == place ? unquietly : calmly);
            QVERIFY(!calm.isCalm());
            overhear(calm, calmly); // the next six know nothing of it
            QCOMPARE(calm.unrest(), Nanoseconds(125us));
        }
    }

    void anUnquietPathMayBeOverheardToBeCalm()
    {
        PathCalm calm;
        hear(calm, unquietly);
        overhear(calm, calmly);
        QVERIFY(calm.isCalm());
        QVERIFY2(isDueIn(calm, 500ms), "that is no hearing");
        QCOMPARE(calm.heard(), Nanoseconds(1250us)); // last
    }

    void onceItListensWhatWasOverheardIsForgotten()
    {
        PathCalm calm;
        overhear(calm, calmly, verdicts - 1);
        calm.begin();
        calm.stop();
        overhear(calm, calmly, verdicts - 1);
        QVERIFY(!calm.isCalm());
        calm.overhear(calmly);
        QVERIFY(calm.isCalm());
    }

    void whatWasOverheardIsNoPartOfAHearing()
    {
        PathCalm calm;
        overhear(calm, unquietly, 2);
        QCOMPARE(hear(calm, calmly), Heard::Calm);
        QCOMPARE(calm.heard(), Nanoseconds(125us));
    }
};

QTEST_APPLESS_MAIN(PathCalmTest)
#include "path_calm_test.moc"
