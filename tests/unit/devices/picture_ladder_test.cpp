// The picture ladder's rules, one update after the other.
#include "picture_ladder.hpp"

#include <QTest>

using namespace liena::devices;
using namespace std::chrono_literals;

namespace {

/// One update after the other, by hand.
struct Hand {
    explicit Hand(PictureLadder made) : ladder(std::move(made))
    {
        ladder.measured(now, ladder.rung(), 100'000, 100'000);
        ladder.update(now, 15, {});
    }
    Hand() : Hand(PictureLadder(Encoding::Raw, 0, Reduction::Lossy)) {}

    bool see(std::vector<PathReading> viewers, double askedRate = 15)
    {
        now += 60ms;
        return ladder.update(now, askedRate, viewers);
    }

    /// For `patience`, or until a rung is taken or left.
    bool keepSeeing(const std::vector<PathReading>& viewers)
    {
        const auto from = now + 60ms;
        while (!see(viewers))
            if (now - from >= PictureLadder::patience)
                return false;
        return true;
    }

    SteadyTime now{1h};
    PictureLadder ladder;
};

std::vector<std::string> declared(const PictureLadder& ladder)
{
    std::vector<std::string> names;
    for (const PictureRung& rung : ladder.rungs())
        names.push_back(describe(rung, 30));
    return names;
}

} // namespace

class PictureLadderTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void declaresRateBeforeEncoding()
    {
        const std::vector<std::string> expected{"30 of 30 /s, raw",      "15 of 30 /s, raw",      "30 of 30 /s, lossless",
                                                "15 of 30 /s, lossless", "30 of 30 /s, lossy 90", "15 of 30 /s, lossy 90",
                                                "30 of 30 /s, lossy 75", "15 of 30 /s, lossy 75", "30 of 30 /s, lossy 50",
                                                "15 of 30 /s, lossy 50", "10 of 30 /s, lossy 50", "7.5 of 30 /s, lossy 50"};
        QCOMPARE(declared(PictureLadder(Encoding::Raw, 0, Reduction::Lossy)), expected);
    }

    void endsWithLosslessWhereLossyIsNotPermitted()
    {
        const std::vector<std::string> expected{"30 of 30 /s, raw",      "15 of 30 /s, raw",      "30 of 30 /s, lossless",
                                                "15 of 30 /s, lossless", "10 of 30 /s, lossless", "7.5 of 30 /s, lossless"};
        QCOMPARE(declared(PictureLadder(Encoding::Raw, 0, Reduction::Lossless)), expected);
    }

    void beginsWithWhatIsAskedFor()
    {
        QCOMPARE(describe(PictureLadder(Encoding::JpegLs, 0, Reduction::Lossy).rungs()[2], 15), std::string("15 of 15 /s, lossy 90"));
        QCOMPARE(describe(PictureLadder(Encoding::Jpeg, 80, Reduction::Lossy).rungs()[2], 15), std::string("15 of 15 /s, lossy 75"));
        QCOMPARE(declared(PictureLadder(Encoding::Jpeg, 80, Reduction::Lossless)).back(), std::string("7.5 of 30 /s, lossy 80"));
        QCOMPARE(PictureLadder(Encoding::Raw, 0, Reduction::None).rungs().size(), std::size_t(1));
    }

    void leavesOutAnEncodingThatFails()
    {
        Hand hand;
        hand.ladder.failed(hand.now, {1, Encoding::JpegLs, 0});
        QVERIFY(hand.keepSeeing({{0.6e6, 0}})); // lossless at half the rate is assumed to need 0.45 MB/s
        QCOMPARE(describe(hand.ladder.rung(), 15), std::string("15 of 15 /s, lossy 90"));
        hand.ladder.failed(hand.now, hand.ladder.rung());
        QVERIFY(hand.see({}));
        QCOMPARE(describe(hand.ladder.rung(), 15), std::string("15 of 15 /s, lossy 75"));
        QVERIFY(hand.ladder.works());
    }

    void triesAnEncodingThatFailedAgain()
    {
        Hand hand(PictureLadder(Encoding::JpegLs, 0, Reduction::Lossy));
        const PictureRung asked = hand.ladder.rung();
        for (const unsigned quality : {90U, 75U, 50U})
            hand.ladder.measured(hand.now, {1, Encoding::Jpeg, quality}, 10'000, 100'000);
        hand.ladder.failed(hand.now, asked);
        QVERIFY(hand.see({{1e9, 0}}));
        QCOMPARE(hand.ladder.step(), std::size_t(2));
        QVERIFY(!hand.ladder.toMeasure(hand.now));
        for (int count = 0; count < 60; ++count)
            QVERIFY(!hand.see({{1e9, 0}})); // however much the way carries
        QVERIFY(hand.ladder.toMeasure(hand.now) == asked);
        hand.ladder.measured(hand.now, asked, 60'000, 100'000);
        for (int count = 0; count < 20; ++count)
            hand.see({{1e9, 0}});
        QCOMPARE(hand.ladder.step(), std::size_t(0));
    }

    void triesRawPicturesThatWereTooLargeAgain()
    {
        Hand hand(PictureLadder(Encoding::Raw, 0, Reduction::Lossless));
        hand.ladder.failed(hand.now, hand.ladder.rung());
        hand.ladder.measured(hand.now, {1, Encoding::JpegLs, 0}, 60'000, 100'000);
        QVERIFY(hand.see({{1e9, 0}}));
        QCOMPARE(describe(hand.ladder.rung(), 15), std::string("15 of 15 /s, lossless"));
        QVERIFY(!hand.ladder.toMeasure(hand.now));
        for (int count = 0; count < 60; ++count)
            hand.see({{1e9, 0}});
        QVERIFY(hand.ladder.toMeasure(hand.now) == hand.ladder.rungs().front());
        hand.ladder.measured(hand.now, hand.ladder.rungs().front(), 100'000, 100'000);
        QVERIFY(!hand.ladder.toMeasure(hand.now));
        for (int count = 0; count < 20; ++count)
            hand.see({{1e9, 0}});
        QCOMPARE(hand.ladder.step(), std::size_t(0));
    }

    void staysWhereNoEncodingWorks()
    {
        Hand hand(PictureLadder(Encoding::JpegLs, 200, Reduction::Lossless));
        hand.ladder.failed(hand.now, hand.ladder.rung());
        QVERIFY(!hand.ladder.works());
        for (int count = 0; count < 60; ++count)
            hand.see({{count < 30 ? 1.0 : 1e9, 0}});
        QCOMPARE(hand.ladder.step(), std::size_t(0));
        hand.ladder.measured(hand.now, hand.ladder.rung(), 60'000, 100'000);
        QVERIFY(hand.ladder.works());
    }

    void goesDownWhenKnownRateSaysSo()
    {
        Hand hand;
        QVERIFY(!hand.see({{2e6, 0}}));
        const auto from = hand.now + 60ms;
        QVERIFY(hand.keepSeeing({{1e6, 0}})); // 1.5 MB/s were asked for; 0.9 MB/s may be used: half the rate
        QVERIFY(hand.now - from >= PictureLadder::patience);
        QCOMPARE(hand.ladder.step(), std::size_t(1));
        QVERIFY(hand.keepSeeing({{0.45e6, 0}}));
        QCOMPARE(describe(hand.ladder.rung(), 15), std::string("15 of 15 /s, lossy 90"));
    }

    /// A computer that stands still for some milliseconds looks like a way that carries less.
    void forgivesAMomentOfALowerRate()
    {
        Hand hand;
        for (int i = 0; i < 600; ++i)
            QVERIFY(!hand.see({{i % 6 == 0 ? 2e6 : 0.2e6, 0}}));
    }

    void goesDownWithinTwoWithheldPictures()
    {
        Hand hand;
        QVERIFY(!hand.see({{std::nullopt, 0}}));
        QVERIFY(!hand.see({{std::nullopt, 1}}));
        QVERIFY(hand.see({{std::nullopt, 1}}));
        QCOMPARE(hand.ladder.step(), std::size_t(1));
        hand.now += 500ms;             // what was under way has left
        QVERIFY(hand.see({{1e9, 2}})); // whatever the known rate says
        QCOMPARE(hand.ladder.step(), std::size_t(3));
    }

    void forgivesOneWithheldPictureNowAndThen()
    {
        Hand hand;
        for (int minute = 0; minute < 600; ++minute)
            QVERIFY(!hand.see({{std::nullopt, minute % 20 == 0 ? 1U : 0U}}));
    }

    void worstViewerDecides()
    {
        Hand hand;
        QVERIFY(!hand.see({{2e6, 0}, {std::nullopt, 0}}));
        QVERIFY(hand.keepSeeing({{2e6, 0}, {1e6, 0}, {std::nullopt, 0}}));
        Hand other;
        QVERIFY(!other.see({{2e6, 0}, {2e6, 1}}));
        QVERIFY(other.see({{2e6, 0}, {2e6, 1}}));
    }

    /// 2 kB a picture on a way that carried 1 MB/s when it was known last: nothing is learnt from them, and the way may have healed.
    void triesNextRungWherePicturesAreTooLightToTell()
    {
        Hand hand;
        for (const PictureRung& rung : hand.ladder.rungs())
            hand.ladder.measured(hand.now, rung, rung.encoding == Encoding::Jpeg ? 2'000 : 100'000, 100'000);
        QVERIFY(hand.keepSeeing({{0.3e6, 0}}));
        QCOMPARE(describe(hand.ladder.rung(), 15), std::string("15 of 15 /s, lossy 90"));
        const auto untilItMoves = [&hand](double rate) {
            const auto from = hand.now;
            while (!hand.see({{rate, 0}}) && hand.now - from < 60s)
                continue;
            return hand.now - from;
        };
        QVERIFY(untilItMoves(0.4e6) < 1s);
        QCOMPARE(describe(hand.ladder.rung(), 15), std::string("7.5 of 15 /s, lossless")); // 0.75 MB/s
        auto tried = untilItMoves(0.4e6);
        QVERIFY(tried >= PictureLadder::trial && tried < PictureLadder::trial + 200ms); // the way is as narrow as before
        QCOMPARE(describe(hand.ladder.rung(), 15), std::string("15 of 15 /s, lossy 90"));
        for (auto wait = std::chrono::nanoseconds(PictureLadder::firstWait); wait <= 4 * PictureLadder::firstWait; wait *= 2) {
            const auto waited = untilItMoves(0.4e6);
            QVERIFY(waited >= wait && waited < wait + 1s);
            untilItMoves(0.4e6);
        }
        untilItMoves(0.4e6);
        QCOMPARE(describe(hand.ladder.rung(), 15), std::string("7.5 of 15 /s, lossless"));
        QVERIFY(untilItMoves(4e6) < 1s); // it has healed, and the heavier pictures show it
        QCOMPARE(hand.ladder.step(), std::size_t(0));
    }

    void endsATrialAtOnceWhenPicturesAreWithheld()
    {
        Hand hand;
        for (const PictureRung& rung : hand.ladder.rungs())
            hand.ladder.measured(hand.now, rung, rung.encoding == Encoding::Jpeg ? 2'000 : 100'000, 100'000);
        QVERIFY(hand.keepSeeing({{0.3e6, 0}}));
        while (!hand.see({{0.4e6, 0}}))
            continue;
        QCOMPARE(describe(hand.ladder.rung(), 15), std::string("7.5 of 15 /s, lossless"));
        hand.see({{0.4e6, 1}});
        QVERIFY(hand.see({{0.4e6, 1}}));
        QCOMPARE(describe(hand.ladder.rung(), 15), std::string("15 of 15 /s, lossy 90"));
    }

    /// As of a way that fills for a moment with each picture. Whichever of the readings knows it: the watch must not end with that one
    /// alone.
    void climbsThoughRateIsKnownOnlyNowAndThen_data()
    {
        QTest::addColumn<int>("every");
        for (const int every : {2, 3, 4, 5, 6, 7, 12})
            QTest::addRow("one reading in %d", every) << every;
    }

    void climbsThoughRateIsKnownOnlyNowAndThen()
    {
        QFETCH(int, every);
        for (int first = 0; first < every; ++first) {
            Hand hand;
            QVERIFY(hand.keepSeeing({{0.45e6, 0}}));
            QVERIFY(hand.ladder.step() > 1);
            for (int i = 0; i < 80; ++i) // 4.8 s
                hand.see({{(first + i) % every == 0 ? std::optional(2e6) : std::nullopt, 0}});
            QVERIFY2(hand.ladder.step() == 0, qPrintable(QString::number(first)));
        }
    }

    /// What was known for some of the time, and does not carry the next rung, is not passed over.
    void doesNotClimbAboveWhatWasKnownForSomeOfTheTime()
    {
        Hand hand;
        QVERIFY(hand.keepSeeing({{0.9e6, 0}}));
        QCOMPARE(hand.ladder.step(), std::size_t(1));
        for (int i = 0; i < 80; ++i)
            hand.see({{i % 3 == 0 ? std::optional(1.5e6) : std::nullopt, 0}}); // as much as was asked for: nothing to spare
        QCOMPARE(hand.ladder.step(), std::size_t(1));
    }

    void forgivesWhatWaitsBehindHeavierPicture()
    {
        Hand hand;
        QVERIFY(hand.keepSeeing({{1e6, 0}}));
        QVERIFY(!hand.see({{1e6, 2}}));
        hand.now += 500ms;
        QVERIFY(!hand.see({{1e6, 1}}));
        QVERIFY(hand.see({{1e6, 1}}));
    }

    void waitsAfterFailureUnlessRateIsFarAbove()
    {
        Hand hand;
        const auto seeFor = [&hand](int count, double rate) {
            for (; count > 0; --count)
                hand.see({{rate, 0}});
            return hand.ladder.step();
        };
        hand.ladder.measured(hand.now, {1, Encoding::JpegLs, 0}, 40'000, 100'000);
        QCOMPARE(seeFor(7, 0.5e6), std::size_t(3));
        QCOMPARE(seeFor(14, 0.8e6), std::size_t(2));
        QCOMPARE(seeFor(7, 0.5e6), std::size_t(3)); // it did not last
        QCOMPARE(seeFor(14, 0.8e6), std::size_t(3));
        QCOMPARE(seeFor(14, 1.25e6), std::size_t(1));
    }

    void leavesOutRungsThatAreNoLighter()
    {
        Hand hand;
        QVERIFY(hand.see({{std::nullopt, 2}}));
        QVERIFY(hand.see({{std::nullopt, 2}}));
        QCOMPARE(hand.ladder.step(), std::size_t(3)); // lossless at the full rate is assumed to be heavier than raw at half of it
        hand.ladder.measured(hand.now, hand.ladder.rung(), 90'000, 100'000); // and so it is
        QVERIFY(hand.see({{std::nullopt, 2}}));
        QCOMPARE(describe(hand.ladder.rung(), 15), std::string("15 of 15 /s, lossy 90"));
    }

    void measuresEachEncodingOnceAndBetterOnesAgain()
    {
        Hand hand;
        std::vector<std::string> asked;
        const auto measure = [&] {
            asked.clear();
            while (const auto rung = hand.ladder.toMeasure(hand.now)) {
                asked.push_back(describe(*rung, 15));
                hand.ladder.measured(hand.now, *rung, rung->quality == 0 ? 40'000 : rung->quality * 100, 100'000);
            }
        };
        measure();
        const std::vector<std::string> all{"15 of 15 /s, lossless", "15 of 15 /s, lossy 90", "15 of 15 /s, lossy 75",
                                           "15 of 15 /s, lossy 50"};
        QCOMPARE(asked, all);
        hand.now += 1min;
        measure();
        QVERIFY(asked.empty()); // nothing is better than what is sent
        for (int count = 0; count < 20 && hand.ladder.rung().quality != 75; ++count)
            hand.see({{std::nullopt, 2}});
        measure();
        const std::vector<std::string> better{"15 of 15 /s, lossless", "15 of 15 /s, lossy 90"};
        QCOMPARE(asked, better);
        hand.now += 1s;
        measure();
        QVERIFY(asked.empty());
    }

    void neverLowersRateBelowFiveASecond()
    {
        Hand hand;
        for (int count = 0; count < 20; ++count) {
            hand.see({{1.0, 2}}, 7.5);
            QCOMPARE(hand.ladder.rung().divisor, 1U);
        }
        QCOMPARE(describe(hand.ladder.rung(), 7.5), std::string("7.5 of 7.5 /s, lossy 50"));
        for (int count = 0; count < 20; ++count)
            hand.see({{1.0, 2}}, 30);
        QCOMPARE(hand.ladder.rung().divisor, 4U);
        hand.see({{1.0, 0}}, 15); // what is asked for is less now
        QCOMPARE(hand.ladder.rung().divisor, 3U);
    }

    void knowsNothingOfPauses()
    {
        Hand hand;
        hand.see({{std::nullopt, 0}});
        hand.see({{std::nullopt, 2}});
        QCOMPARE(hand.ladder.step(), std::size_t(1));
        hand.now += 1min; // the beam was off
        QVERIFY(!hand.see({{std::nullopt, 9}}));
        QCOMPARE(hand.ladder.step(), std::size_t(1));
        for (int count = 0; count < 6; ++count)
            hand.see({{std::nullopt, 0}});
        QCOMPARE(hand.ladder.step(), std::size_t(0));
    }
};

QTEST_GUILESS_MAIN(PictureLadderTest)
#include "picture_ladder_test.moc"
