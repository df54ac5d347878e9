// When the alarm began to sound, told from samples: never too early, and never of a burst of lower priority.
#include "heard_sound.hpp"
#include "model/alarm_burst.hpp"
#include "sound/burst_samples.hpp"

#include <QTest>

#include <cstring>

using namespace console;
using namespace console::test;

namespace {

constexpr Instant start{};
constexpr int stride = 13; ///< ms, through all phases of 523 Hz
constexpr std::size_t millisecond = sampleRate / 1000;
constexpr std::size_t blockLength = 10 * millisecond;
constexpr Duration blockTime{std::chrono::milliseconds(10)}; ///< one block comes after the other
constexpr Duration mostDoubt{std::chrono::milliseconds(30)}; ///< of an onset that touches what it cuts short

/// What is played one after the other.
class Tape {
public:
    Tape& silence(int ms)
    {
        m_samples.resize(m_samples.size() + std::size_t(ms) * millisecond);
        return *this;
    }

    /// Its first `ms`.
    Tape& burst(AlarmPriority priority, int ms)
    {
        const auto bytes = burstSamples(priority);
        const auto before = m_samples.size();
        m_samples.resize(before + std::size_t(ms) * millisecond);
        std::memcpy(m_samples.data() + before, bytes.constData(), (m_samples.size() - before) * sizeof(std::int16_t));
        return *this;
    }

    /// When the block has come in which it goes on now.
    Instant now() const { return start + blockTime * (1 + m_samples.size() / blockLength); }

    void playTo(HeardSound& heard) const
    {
        for (std::size_t at = 0; at + blockLength <= m_samples.size(); at += blockLength)
            heard.add({m_samples.data() + at, blockLength}, start + blockTime * (1 + at / blockLength));
    }

    Onsets heard() const
    {
        HeardSound heard;
        playTo(heard);
        return heard.onsets();
    }

private:
    std::vector<std::int16_t> m_samples;
};

} // namespace

class HeardSoundTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void anOnsetHasTheTimeOfItsBlock()
    {
        for (int quiet = 0; quiet < 40; quiet += 3) {
            Tape tape;
            const auto begins = tape.silence(quiet).now();
            const auto onsets = tape.burst(AlarmPriority::High, 100).heard();
            QCOMPARE(onsets.first.value(), begins);
            QVERIFY(onsets.high.value() == begins || quiet == 0); // before it there was no silence, as far as is known
        }
    }

    void silenceIsNoOnset()
    {
        const auto onsets = Tape().silence(5000).heard();
        QVERIFY(!onsets.first);
        QVERIFY(!onsets.high);
    }

    void aLowerBurstIsNoHighOne_data()
    {
        QTest::addColumn<AlarmPriority>("priority");
        QTest::newRow("medium") << AlarmPriority::Medium;
        QTest::newRow("low") << AlarmPriority::Low;
    }

    void aLowerBurstIsNoHighOne()
    {
        QFETCH(AlarmPriority, priority);
        for (int cut = 1; cut < 200; cut += stride) {
            Tape tape;
            const auto begins = tape.silence(50).now();
            tape.burst(priority, cut).silence(cut % 30).burst(AlarmPriority::Medium, 200).silence(50);
            const auto onsets = tape.heard();
            QCOMPARE(onsets.first.value(), begins);
            QVERIFY2(!onsets.high, qPrintable(QStringLiteral("cut short after %1 ms").arg(cut)));
        }
    }

    void aHighBurstIsHeardInPlaceOfALowerOne()
    {
        for (const int gap : {0, 3, 25})
            for (int cut = 1; cut < 200; cut += stride) {
                Tape tape;
                const auto begins = tape.silence(50).burst(AlarmPriority::Medium, cut).silence(gap).now();
                const auto high = tape.burst(AlarmPriority::High, 100).heard().high;
                const auto where = QStringLiteral("cut short after %1 ms, then %2 ms of silence").arg(cut).arg(gap);
                QVERIFY2(high >= begins, qPrintable(where)); // no instant at all is less
                QVERIFY2(*high <= begins + mostDoubt, qPrintable(where));
            }
    }

    void whatWasForgottenIsNoOnset()
    {
        HeardSound heard;
        Tape().burst(AlarmPriority::High, 100).silence(900).playTo(heard);
        heard.forget();
        QVERIFY(!heard.onsets().first);
        QVERIFY(!heard.onsets().high);
        Tape().silence(100).playTo(heard);
        QVERIFY(!heard.onsets().first);
        Tape().silence(20).burst(AlarmPriority::High, 100).playTo(heard);
        QVERIFY(heard.onsets().high);
    }

    void silenceIsKnownOfWhenTheRestIsForgotten()
    {
        HeardSound heard;
        Tape().silence(20).playTo(heard);
        heard.forget();
        const Tape tape;
        Tape(tape).burst(AlarmPriority::High, 100).playTo(heard);
        QCOMPARE(heard.onsets().first.value(), tape.now());
        QCOMPARE(heard.onsets().high.value(), tape.now());
    }

    void silenceIsOfWhatHasCome()
    {
        HeardSound heard;
        QCOMPARE(heard.silence(), Duration::zero());
        Tape().silence(500).playTo(heard);
        QVERIFY(std::abs(milliseconds(heard.silence()) - 500) < 2);
        Tape().burst(AlarmPriority::High, 100).playTo(heard);
        QVERIFY(milliseconds(heard.silence()) < 2);
        Tape().silence(300).playTo(heard);
        heard.forget();
        Tape().silence(600).playTo(heard);
        QVERIFY(std::abs(milliseconds(heard.silence()) - 900) < 5);
    }
};

QTEST_APPLESS_MAIN(HeardSoundTest)
#include "heard_sound_test.moc"
