// The picture ladder where a computer takes long to make pictures.
#include "picture_ladder.hpp"

#include <QTest>

#include <functional>
#include <string>

using namespace liena::devices;
using namespace std::chrono_literals;

namespace {

constexpr std::size_t rawBytes = 2'000'000;
constexpr double asked = 30; // a second: 33 ms from pulse to pulse

/// Pulses at the ladder's rate over a way that carries so much, on a computer that takes so long for a picture in each encoding.
struct Computer {
    explicit Computer(Reduction permitted = Reduction::Lossy, Encoding encoding = Encoding::Raw) : ladder(encoding, 0, permitted) {}

    void run(int pictures)
    {
        for (int i = 0; i < pictures; ++i) {
            left += ladder.update(now, asked, {{{carried, 0}}}) && ladder.tookTooLong() ? 1 : 0;
            ladder.taken(taking(made++));
            make(ladder.rung());
            if (const auto other = ladder.toMeasure(now))
                make(*other);
            now += std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(ladder.rung().divisor / asked));
        }
    }
    void make(const PictureRung& rung)
    {
        const double share = rung.encoding == Encoding::Raw ? 1 : rung.encoding == Encoding::JpegLs ? 0.3 : 0.05;
        ladder.measured(now, rung, static_cast<std::size_t>(share * rawBytes), rawBytes, encodes(rung.encoding));
    }
    std::string rung() const { return describe(ladder.rung(), asked); }

    std::function<std::chrono::nanoseconds(int)> taking = [](int) { return 5ms; }; ///< of each picture
    std::function<std::chrono::nanoseconds(Encoding)> encodes = [](Encoding) { return 1ms; };
    double carried = 1e9;
    PictureLadder ladder;
    SteadyTime now{1h};
    int made = 0;
    int left = 0; ///< rungs, for time
};

} // namespace

class PictureLadderTimeTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    /// A rate that is told and not kept is none.
    void takesHalfTheRateWhereAPictureTakesLongerThanAPulse()
    {
        Computer computer;
        computer.taking = [](int) { return 40ms; };
        computer.run(10);
        QCOMPARE(computer.rung(), std::string("15 of 30 /s, raw"));
        QCOMPARE(computer.left, 1);
    }

    void staysWhileThereIsJustTime()
    {
        Computer computer;
        computer.taking = [](int) { return 33ms; };
        computer.run(300);
        QCOMPARE(computer.ladder.step(), 0U);
        QCOMPARE(computer.left, 0);
    }

    /// The computer stands still now and then: three pictures of four are late.
    void fewQuickPicturesSuffice()
    {
        Computer computer;
        computer.taking = [](int made) { return made % 4 == 0 ? 10ms : 100ms; };
        computer.run(300);
        QCOMPARE(computer.ladder.step(), 0U);
    }

    /// Lossless would use the least of the way at the full rate, and takes too long for that.
    void onANarrowWayAnEncodingHasTheRateForWhichThereIsTime()
    {
        Computer computer;
        computer.encodes = [](Encoding encoding) { return encoding == Encoding::JpegLs ? 40ms : 1ms; };
        computer.carried = 0.4 * rawBytes * asked;
        computer.run(90);
        QCOMPARE(computer.rung(), std::string("15 of 30 /s, lossless"));
        computer.run(900);
        QCOMPARE(computer.rung(), std::string("15 of 30 /s, lossless")); // and no rung above is tried in vain
        QCOMPARE(computer.left, 0);
    }

    void isBackWhenThereIsTimeAgainAndSomeIsLeft()
    {
        Computer computer;
        std::chrono::nanoseconds takes = 40ms;
        computer.taking = [&](int) { return takes; };
        computer.run(30);
        takes = 28ms; // 27 are a fifth less than a pulse
        computer.run(300);
        QCOMPARE(computer.ladder.step(), 1U);
        takes = 25ms;
        computer.run(60);
        QCOMPARE(computer.ladder.step(), 0U);
    }

    /// Quick enough at half the rate, never at the whole one: it is tried less and less often.
    void triesLessOftenWhatDidNotLast()
    {
        Computer computer;
        computer.taking = [&](int) { return computer.ladder.step() == 0 ? 40ms : 20ms; };
        computer.run(60 * 15);
        QVERIFY2(computer.left >= 3 && computer.left <= 6, std::to_string(computer.left).c_str());
    }

    /// That the way is wider now than when it broke a climb says nothing of the time.
    void aWiderWayIsNoReasonToTryAgainWhatTakesTooLong()
    {
        Computer computer;
        for (const double share : {2.0, 0.7, 1.4, 0.7}) { // the way narrows, widens, and breaks the climb
            computer.carried = share * rawBytes * asked;
            computer.run(60);
        }
        QVERIFY(computer.ladder.step() > 0 && computer.left == 0);
        computer.taking = [&](int) { return computer.ladder.step() == 0 ? 40ms : 20ms; };
        computer.carried = 1e9;
        computer.run(60 * 15);
        QVERIFY2(computer.left >= 2 && computer.left <= 6, std::to_string(computer.left).c_str());
    }

    /// A busy minute: what it made slow then is asked for again after it, also raw pictures, of which none is made meanwhile.
    void whatWasSlowInABusyMinuteIsBack()
    {
        Computer computer;
        computer.carried = 0.4 * rawBytes * asked;
        computer.taking = [](int) { return 70ms; };
        computer.run(300);
        QVERIFY(computer.ladder.step() > 1);
        computer.taking = [](int) { return 5ms; };
        computer.carried = 1e9;
        computer.run(300);
        QCOMPARE(computer.ladder.step(), 0U);
    }

    /// So that nobody is told a rate for the moment in which it is found out.
    void noRungIsTriedForWhichThereIsNoTime()
    {
        Computer computer;
        computer.taking = [](int) { return 70ms; }; // 67 are two pulses
        for (int i = 0; i < 40; ++i) {
            computer.run(1);
            QVERIFY2(computer.ladder.step() == 0 || computer.ladder.rung().divisor > 2, computer.rung().c_str());
        }
        QCOMPARE(computer.left, 1);
    }

    void hasNoLowerRungWhereNothingLessIsPermitted()
    {
        Computer computer(Reduction::None);
        computer.taking = [](int) { return 40ms; };
        computer.run(30);
        QCOMPARE(computer.ladder.step(), 0U);
        QVERIFY(computer.ladder.tookTooLong());
    }
};

QTEST_APPLESS_MAIN(PictureLadderTimeTest)
#include "picture_ladder_time_test.moc"
