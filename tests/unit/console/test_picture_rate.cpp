// What of the pictures that are asked for is shown: their rate, and what a slow line takes from them.
#include "picture_stamps.hpp"

#include <QSignalSpy>
#include <QTest>

using namespace console;
using namespace console::test;
using namespace std::chrono_literals;

class TestPictureRate : public QObject {
    Q_OBJECT

private Q_SLOTS:
    /// What the X-ray system says that it sends is what is owed; more than it sends cannot be shown.
    void rateIsHeldAgainstWhatIsSent()
    {
        PictureState state;
        state.setLinkUp(true);
        state.expect(30, start);
        const auto last = play(state, start, 2s); // fifteen a second
        QVERIFY(!state.reading(last).atRate);
        QCOMPARE(state.reading(last).liveFor, Duration::zero());
        auto reduced = stamp(1000, last + 66ms);
        reduced.reduction = {1, 15, 30, PixelEncoding::Raw, 0};
        state.notePainted(reduced);
        const auto reading = state.reading(last + 66ms);
        QCOMPARE(reading.expectedPerSecond, 15.0);
        QVERIFY(reading.atRate);
        QVERIFY(reading.liveFor > 1s);
    }

    /// What is shown is counted over a second: for so long a doubled rate is not a lack of pictures, and afterwards half of it is.
    void rateThatRoseIsAskedForASecondLater()
    {
        PictureState state;
        state.setLinkUp(true);
        state.expect(7.5, start);
        quint32 frame = 0;
        auto at = start;
        for (; at < start + 3s; at += 133ms)
            state.notePainted(stamp(++frame, at));
        state.expect(15, at);
        const auto rose = at;
        for (; at < rose + 3s; at += 66ms) {
            state.notePainted(stamp(++frame, at));
            QVERIFY2(state.reading(at).keepsRate, qPrintable(QString::number(milliseconds(at - rose))));
            QCOMPARE(state.reading(at).atRate, state.reading(at).shownPerSecond > 10); // arming waits until it is there
        }
        const auto fell = at;
        bool told = false;
        for (; at < fell + 1s; at += 133ms) {
            state.notePainted(stamp(++frame, at));
            told = told || !state.reading(at).keepsRate;
        }
        QVERIFY(told);
    }

    void twoThirdsOfTheRateAreNotEnoughAndLittleMoreIsCaution_data()
    {
        QTest::addColumn<double>("expected");
        QTest::addColumn<int>("shown");
        QTest::addColumn<bool>("keeps");
        QTest::addColumn<bool>("slow");
        QTest::newRow("all") << 15.0 << 15 << true << false;
        QTest::newRow("one less") << 15.0 << 14 << true << false;
        QTest::newRow("two less") << 15.0 << 13 << true << true;
        QTest::newRow("little more than two thirds") << 15.0 << 11 << true << true;
        QTest::newRow("two thirds") << 15.0 << 10 << false << true;
        QTest::newRow("slow pulses") << 7.5 << 7 << true << false;
        QTest::newRow("slow pulses, two thirds") << 7.5 << 5 << false << true;
        QTest::newRow("quick pulses, a tenth less") << 30.0 << 27 << true << false;
        QTest::newRow("quick pulses, two thirds") << 30.0 << 20 << false << true;
    }

    void twoThirdsOfTheRateAreNotEnoughAndLittleMoreIsCaution()
    {
        QFETCH(double, expected);
        QFETCH(int, shown);
        QFETCH(bool, keeps);
        QFETCH(bool, slow);
        PictureState state;
        state.setLinkUp(true);
        state.expect(expected, start);
        const auto now = start + 5s;
        for (int i = shown; i > 0; --i)
            state.notePainted(stamp(quint32(shown - i + 1), now - (i - 1) * (Duration(1s) / shown)));
        const auto reading = state.reading(now);
        QCOMPARE(int(reading.shownPerSecond), shown);
        QCOMPARE(reading.keepsRate, keeps);
        QCOMPARE(reading.atRate, keeps);
        QCOMPARE(reading.slow, slow);
    }

    /// Within the second it is held against the lowest, and the second is not begun anew.
    void rateThatRisesAgainAtOnceIsHeldAgainstItsLowest()
    {
        PictureState state;
        state.setLinkUp(true);
        state.expect(7.5, start);
        quint32 frame = 0;
        auto at = start;
        const auto playUntil = [&](Instant until) { // 7.5 a second
            for (; at < until; at += 133ms)
                state.notePainted(stamp(++frame, at));
        };
        playUntil(start + 3s);
        const auto rose = at;
        state.expect(15, rose);
        playUntil(rose + 400ms);
        state.expect(30, at);
        playUntil(rose + 900ms);
        QVERIFY(state.reading(rose + 900ms).keepsRate);
        playUntil(rose + 1100ms);
        QVERIFY(!state.reading(rose + 1100ms).keepsRate);
    }

    void tellsEachReductionOnce()
    {
        PictureState state;
        QSignalSpy changes(&state, &PictureState::reductionChanged);
        auto one = stamp(1, start);
        state.notePainted(one);
        QCOMPARE(changes.count(), 0);
        one = stamp(2, start + 66ms);
        one.reduction = {1, 7.5, 15, PixelEncoding::Raw, 0};
        state.notePainted(one);
        one.frame = 3;
        state.notePainted(one);
        QCOMPARE(changes.count(), 1);
        QCOMPARE(state.reading(start + 66ms).reduction, one.reduction);
        one.frame = 4;
        one.reduction.rate = 5;
        state.notePainted(one);
        QCOMPARE(changes.count(), 2);
        state.notePainted(stamp(5, start + 132ms));
        QCOMPARE(changes.count(), 3);
        QVERIFY(!changes.back().at(0).value<PictureReduction>().stands());
    }

    void readsReductionFromItsFrame()
    {
        XrayFrame frame;
        frame.rate = frame.askedRate = 15;
        frame.encoding = PixelEncoding::Jpeg;
        frame.quality = 90;
        QCOMPARE(reductionOf(frame), PictureReduction()); // lossy because that is asked for
        frame.rung = 6;
        QCOMPARE(reductionOf(frame), (PictureReduction{6, 15, 15, PixelEncoding::Jpeg, 90}));
    }

    void putsReductionIntoWords_data()
    {
        QTest::addColumn<PictureReduction>("reduction");
        QTest::addColumn<QString>("words");
        QTest::addColumn<bool>("loses");
        const auto raw = PixelEncoding::Raw, jpegLs = PixelEncoding::JpegLs, jpeg = PixelEncoding::Jpeg;
        QTest::newRow("none") << PictureReduction{0, 15, 15, jpeg, 50} << QString() << false;
        QTest::newRow("rate") << PictureReduction{1, 7.5, 15, raw, 0} << QStringLiteral("REDUCED 7.5 of 15 /s, raw") << true;
        QTest::newRow("encoding") << PictureReduction{2, 15, 15, jpegLs, 0} << QStringLiteral("RE-ENCODED 15 of 15 /s, lossless") << false;
        QTest::newRow("both") << PictureReduction{7, 7.5, 15, jpeg, 75} << QStringLiteral("REDUCED 7.5 of 15 /s, lossy 75") << true;
        QTest::newRow("quality") << PictureReduction{8, 30, 30, jpeg, 50} << QStringLiteral("REDUCED 30 of 30 /s, lossy 50") << true;
        QTest::newRow("near") << PictureReduction{1, 7.5, 15, jpegLs, 2} << QStringLiteral("REDUCED 7.5 of 15 /s, lossy by at most 2")
                              << true;
        QTest::newRow("thirds") << PictureReduction{3, 10.0 / 3, 10, raw, 0} << QStringLiteral("REDUCED 3.3 of 10 /s, raw") << true;
        QTest::newRow("rates not said") << PictureReduction{4, 0, 0, jpeg, 90} << QStringLiteral("REDUCED, lossy 90") << true;
    }

    void putsReductionIntoWords()
    {
        QFETCH(PictureReduction, reduction);
        QFETCH(QString, words);
        QFETCH(bool, loses);
        QCOMPARE(line(reduction), words);
        QCOMPARE(reduction.losesInformation(), loses);
    }
};

QTEST_GUILESS_MAIN(TestPictureRate)
#include "test_picture_rate.moc"
