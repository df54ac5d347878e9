// The picture ladder and the rate of its lane together, on one path of virtual time: what the one sends is all that the other learns from.
#include "picture_costs.hpp"
#include "support/virtual_path.hpp"

#include <QTest>

#include <random>

using namespace liena::devices;
using namespace liena::test;
using namespace std::chrono_literals;
using Nanoseconds = std::chrono::nanoseconds;

namespace {

constexpr Nanoseconds lifespan = 500ms; // of XrayFrame
constexpr Nanoseconds step = 250us;

/// An X-ray system whose lane keeps the newest of two that wait, and gives up a picture that is too old.
class Source {
public:
    /// `share`: of the path, that the pictures take at 15 /s.
    Source(double bytesPerSecond, Nanoseconds roundTrip, double picturesPerSecond, double share = 0.25)
        : path(bytesPerSecond, roundTrip), m_asked(picturesPerSecond), m_rawBytes(bytesPerSecond * share / 15)
    {}

    void run(Nanoseconds time)
    {
        for (const auto end = m_now + time; m_now < end; m_now += step) {
            if (m_now >= m_nextPulse)
                pulse();
            send();
            if (stallsPerSecond > 0 && m_random() % (1s / step) < stallsPerSecond)
                standStill();
        }
    }

    PictureLadder ladder{Encoding::Raw, 0, Reduction::Lossy};
    VirtualPath path;
    std::uint64_t stallsPerSecond = 0; ///< of the computer it runs on, each of 2 to 9 ms
    int changes = 0;
    std::optional<Nanoseconds> fullSince;

    Nanoseconds now() const { return m_now; }

private:
    struct Picture {
        double bytes = 0;
        Nanoseconds taken{};
    };

    void pulse()
    {
        const PathReading reading{path.rate.known(), std::exchange(m_withheld, 0)};
        const SteadyTime time(1h + m_now);
        changes += ladder.update(time, m_asked, {&reading, 1}) ? 1 : 0;
        if (ladder.step() > 0)
            fullSince.reset();
        else if (!fullSince)
            fullSince = m_now;
        measure(time, ladder.rung());
        if (const auto other = ladder.toMeasure(time))
            measure(time, *other);
        if (m_waiting)
            ++m_withheld;
        m_waiting = Picture{m_rawBytes * shareOf(ladder.rung()), m_now};
        m_nextPulse = m_now + std::chrono::duration_cast<Nanoseconds>(std::chrono::duration<double>(ladder.rung().divisor / m_asked));
    }

    void measure(SteadyTime time, const PictureRung& rung)
    {
        ladder.measured(time, rung, static_cast<std::size_t>(m_rawBytes * shareOf(rung)), static_cast<std::size_t>(m_rawBytes));
    }

    void send()
    {
        if (path.unwritten() > 0 && m_now - m_taken > lifespan) {
            path.drop();
            ++m_withheld;
        }
        if (m_waiting && path.unwritten() <= 0) {
            path.give(m_waiting->bytes);
            m_taken = m_waiting->taken;
            m_waiting.reset();
        }
        path.goOn(step);
    }

    void standStill()
    {
        const auto time = 2ms + (m_random() % 29) * step;
        path.standStill(time);
        m_now += time;
    }

    double m_asked;
    double m_rawBytes;
    std::mt19937_64 m_random{1};
    Nanoseconds m_now{};
    Nanoseconds m_nextPulse{};
    Nanoseconds m_taken{}; ///< what is leaving
    std::optional<Picture> m_waiting;
    std::uint64_t m_withheld = 0;
};

/// The path falls to a tenth for so long, and pictures are reduced; whether they are as asked for soon after its healing.
bool isBackInTime(Source& source, Nanoseconds narrow, Nanoseconds inTime = 5s)
{
    source.path.capacity /= 10;
    source.run(narrow);
    const bool isReduced = source.ladder.step() > 0;
    source.path.capacity *= 10;
    const auto healed = source.now();
    source.run(inTime);
    return isReduced && source.fullSince && *source.fullSince > healed;
}

} // namespace

class PictureLadderRateTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void fullQualityIsBackWithinFiveSecondsOfHealing_data()
    {
        QTest::addColumn<double>("megabits");
        QTest::addColumn<int>("roundTripUs");
        QTest::addColumn<double>("rate");
        for (const double megabits : {100.0, 400.0, 1000.0})
            for (const int roundTrip : {200, 2000, 40000})
                for (const double rate : {15.0, 30.0})
                    QTest::addRow("%g Mbit/s, %d us, %g /s", megabits, roundTrip, rate) << megabits << roundTrip << rate;
    }

    void fullQualityIsBackWithinFiveSecondsOfHealing()
    {
        QFETCH(double, megabits);
        QFETCH(int, roundTripUs);
        QFETCH(double, rate);
        Source source(megabits * 125'000, std::chrono::microseconds(roundTripUs), rate);
        source.run(20s);
        source.changes = 0;
        source.run(20s);
        QCOMPARE(source.changes, 0);
        QCOMPARE(source.ladder.step(), std::size_t(0));

        source.path.capacity /= 10;
        source.run(2s);
        QVERIFY(source.ladder.step() > 0);
        source.run(8s);
        source.path.forget();
        source.path.tooLong = 4ms + std::chrono::microseconds(roundTripUs / 4);
        source.run(10s);
        // No queue stands on the narrow path, behind which commands would wait as well.
        QVERIFY2(source.path.late < 100ms, qPrintable(QString::number(double(source.path.late.count()) / 1e6)));

        source.path.capacity *= 10;
        const auto healed = source.now();
        source.run(10s);
        QVERIFY2(source.fullSince, qPrintable(QString::number(source.ladder.step())));
        QVERIFY2(*source.fullSince - healed < (roundTripUs < 10'000 ? 5s : 6s),
                 qPrintable(QString::number(double((*source.fullSince - healed).count()) / 1e9)));
        source.changes = 0;
        source.run(20s);
        QCOMPARE(source.changes, 0);
    }

    /// A computer that stands still for moments looks like a way that carries less, and pictures are as asked for all the same.
    void aRestlessComputerCostsNoQuality_data()
    {
        QTest::addColumn<int>("roundTripUs");
        QTest::addColumn<int>("stallsPerSecond");
        for (const int roundTrip : {500, 1000})
            for (const int stalls : {1, 3, 6})
                QTest::addRow("%d us, %d stalls /s", roundTrip, stalls) << roundTrip << stalls;
    }

    void aRestlessComputerCostsNoQuality()
    {
        QFETCH(int, roundTripUs);
        QFETCH(int, stallsPerSecond);
        Source source(12'500'000, std::chrono::microseconds(roundTripUs), 15, 0.63);
        source.run(6s);
        source.stallsPerSecond = static_cast<std::uint64_t>(stallsPerSecond);
        source.changes = 0;
        source.run(30s);
        QCOMPARE(source.changes, 0);
        QCOMPARE(source.ladder.step(), std::size_t(0));
        QVERIFY(isBackInTime(source, 6s));
    }

    /// The moment of the healing is anywhere between two tries to pass what the narrow path carried, and a burst's first acknowledgements
    /// come anywhere between two decisions. What a piece takes on a slow path is gone at once: until that was heard, it took 2 to 4 s.
    void fullQualityIsBackWheneverThePathHeals_data()
    {
        QTest::addColumn<double>("megabits");
        QTest::addColumn<int>("roundTripUs");
        QTest::addColumn<double>("share");
        QTest::addColumn<int>("mostMs");
        for (const double megabits : {50.0, 100.0, 400.0})
            for (const int roundTrip : {200, 1000, 1500, 1900, 2000})
                for (const double share : {0.25, 0.4, 0.63})
                    QTest::addRow("%g Mbit/s, %d us, %g of it", megabits, roundTrip, share)
                        << megabits << roundTrip << share << (megabits > 100 ? 5000 : 1900);
    }

    void fullQualityIsBackWheneverThePathHeals()
    {
        QFETCH(double, megabits);
        QFETCH(int, roundTripUs);
        QFETCH(double, share);
        QFETCH(int, mostMs);
        for (const auto narrow : {4000ms, 4700ms, 5400ms, 6100ms, 6800ms}) {
            Source source(megabits * 125'000, std::chrono::microseconds(roundTripUs), 15, share);
            source.run(6s);
            QVERIFY2(isBackInTime(source, narrow, std::chrono::milliseconds(mostMs)),
                     qPrintable(QStringLiteral("narrow for %1 ms").arg(narrow.count())));
        }
    }
};

QTEST_GUILESS_MAIN(PictureLadderRateTest)
#include "picture_ladder_rate_test.moc"
