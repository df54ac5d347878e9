// The picture ladder before paths of virtual time: full quality within five seconds of healing, and never to and fro.
#include "picture_costs.hpp"

#include <QTest>

#include <random>

using namespace liena::devices;
using liena::test::shareOf;
using namespace std::chrono_literals;

namespace {

constexpr double rawBytes = 512 * 512 * 2;

/// What the source is told of its path.
enum class Told {
    Exactly,  ///< the true rate, at once
    Groping,  ///< down at once, up by a quarter with each picture that arrives
    Unsurely, ///< the true rate, off by up to a tenth
    Nothing,
};

/// A path that carries one picture at a time, lets one wait, and withholds the older of two that wait.
class Path {
public:
    double capacity = 0; ///< bytes per second

    explicit Path(Told told) : m_told(told) {}

    void send(double seconds, double bytes)
    {
        advance(seconds);
        m_withheld += m_waiting > 0 ? 1 : 0;
        m_waiting = bytes;
        advance(seconds);
    }

    PathReading read(double seconds)
    {
        advance(seconds);
        return {rate(), std::exchange(m_withheld, 0)};
    }

private:
    void advance(double seconds)
    {
        m_sent += (seconds - m_now) * capacity;
        m_now = seconds;
        while (m_underWay > 0 && m_sent >= m_underWay) {
            m_sent -= m_underWay;
            m_underWay = std::exchange(m_waiting, 0);
            m_groped *= 1.25;
        }
        if (m_underWay <= 0) {
            m_sent = 0;
            m_underWay = std::exchange(m_waiting, 0);
        }
        m_groped = m_groped <= 0 ? capacity : std::min(m_groped, capacity);
    }

    std::optional<double> rate()
    {
        if (m_told == Told::Nothing)
            return std::nullopt;
        if (m_told == Told::Groping)
            return m_groped;
        return capacity * (m_told == Told::Unsurely ? std::uniform_real_distribution(0.9, 1.1)(m_random) : 1.0);
    }

    Told m_told;
    double m_now = 0;
    double m_underWay = 0;
    double m_sent = 0; ///< of the picture under way
    double m_waiting = 0;
    double m_groped = 0;
    std::uint64_t m_withheld = 0;
    std::mt19937 m_random{7};
};

/// A source with its ladder before a path.
struct Rig {
    PictureLadder ladder{Encoding::Raw, 0, Reduction::Lossy};
    Path path;
    double askedRate = 15;
    double seconds = 0;
    double next = 0;
    int changes = 0;
    std::uint64_t withheld = 0;
    std::optional<double> fullSince;

    explicit Rig(Told told) : path(told) {}

    double fullLoad() const { return rawBytes * askedRate; }

    void run(double duration)
    {
        changes = 0;
        withheld = 0;
        const double end = seconds + duration;
        while (next < end) {
            seconds = next;
            pulse();
            next = seconds + ladder.rung().divisor / askedRate;
        }
        seconds = end;
    }

    void measure(SteadyTime now, const PictureRung& rung)
    {
        ladder.measured(now, rung, static_cast<std::size_t>(rawBytes * shareOf(rung)), static_cast<std::size_t>(rawBytes));
    }

    void pulse()
    {
        const PathReading reading = path.read(seconds);
        withheld += reading.withheld;
        const auto now = SteadyTime(std::chrono::nanoseconds(static_cast<std::int64_t>((1000 + seconds) * 1e9)));
        changes += ladder.update(now, askedRate, {&reading, 1}) ? 1 : 0;
        if (ladder.step() > 0)
            fullSince.reset();
        else if (!fullSince)
            fullSince = seconds;
        measure(now, ladder.rung());
        if (const auto other = ladder.toMeasure(now))
            measure(now, *other);
        path.send(seconds, rawBytes * shareOf(ladder.rung()));
    }
};

} // namespace

Q_DECLARE_METATYPE(Told)

class PictureLadderPathsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void staysAtFullQualityOnPathThatCarriesIt_data()
    {
        QTest::addColumn<Told>("told");
        QTest::newRow("rate known") << Told::Exactly;
        QTest::newRow("rate groped for") << Told::Groping;
        QTest::newRow("rate uncertain") << Told::Unsurely;
        QTest::newRow("rate unknown") << Told::Nothing;
    }

    void staysAtFullQualityOnPathThatCarriesIt()
    {
        QFETCH(Told, told);
        Rig rig(told);
        rig.path.capacity = rig.fullLoad() * 1.2;
        rig.run(60);
        QCOMPARE(rig.changes, 0);
        QCOMPARE(rig.ladder.step(), std::size_t(0));
    }

    void collapseToTenthAndHealing_data()
    {
        QTest::addColumn<Told>("told");
        QTest::addColumn<double>("askedRate");
        QTest::addColumn<bool>("lossy");
        QTest::addColumn<double>("share");
        for (const bool lossy : {true, false})
            for (const double rate : {30.0, 15.0, 10.0, 7.5})
                for (const auto& [told, name] : {std::pair(Told::Exactly, "known"), std::pair(Told::Groping, "groped for"),
                                                 std::pair(Told::Unsurely, "uncertain"), std::pair(Told::Nothing, "unknown")})
                    for (const double share : {1.2, 2.0})
                        QTest::addRow("%g of %g /s, rate %s%s", share, rate, name, lossy ? "" : ", no lossy")
                            << told << rate << lossy << share;
    }

    void collapseToTenthAndHealing()
    {
        QFETCH(Told, told);
        QFETCH(double, askedRate);
        QFETCH(bool, lossy);
        QFETCH(double, share);
        Rig rig(told);
        rig.ladder = PictureLadder(Encoding::Raw, 0, lossy ? Reduction::Lossy : Reduction::Lossless);
        rig.askedRate = askedRate;
        rig.path.capacity = rig.fullLoad() * share;
        rig.run(20);
        QCOMPARE(rig.ladder.step(), std::size_t(0));
        rig.path.capacity /= 10;
        rig.run(2);
        QVERIFY(rig.changes > 0);
        rig.run(20);
        QVERIFY(lossy || rig.ladder.rung().encoding != Encoding::Jpeg);
        if (lossy && told != Told::Nothing)
            QVERIFY2(rig.withheld == 0, qPrintable(QString::number(rig.withheld))); // what is sent fits
        rig.path.capacity *= 10;
        const double healed = rig.seconds;
        rig.run(told == Told::Nothing ? 40 : 10); // trials that failed have made it wait
        QVERIFY(rig.fullSince);
        QVERIFY2(told == Told::Nothing || *rig.fullSince - healed < 5, qPrintable(QString::number(*rig.fullSince - healed)));
        rig.run(20);
        QCOMPARE(rig.changes, 0);
    }

    // Where no rate is known, waits after failed trials add to this; a path that was filled has a known one.
    void wholeWayUpTakesLessThanFiveSecondsWithoutKnownRate_data()
    {
        QTest::addColumn<double>("askedRate");
        QTest::newRow("30 /s") << 30.0;
        QTest::newRow("15 /s") << 15.0;
    }

    void wholeWayUpTakesLessThanFiveSecondsWithoutKnownRate()
    {
        QFETCH(double, askedRate);
        Rig rig(Told::Nothing);
        rig.askedRate = askedRate;
        rig.path.capacity = rig.fullLoad() * 1.3;
        rig.run(5);
        rig.path.capacity = rig.fullLoad() / 1000;
        rig.run(5);
        const std::size_t last = askedRate > 20 ? 11 : 10; // 1/4 of 15 /s is too few
        QCOMPARE(rig.ladder.step(), last);
        rig.path.capacity = rig.fullLoad() * 1000;
        const double healed = rig.seconds;
        rig.run(10);
        QVERIFY(rig.fullSince);
        QVERIFY2(*rig.fullSince - healed < 5, qPrintable(QString::number(*rig.fullSince - healed)));
    }

    void doesNotGoToAndFroAtBoundary_data()
    {
        QTest::addColumn<Told>("told");
        QTest::addColumn<double>("share");
        QTest::addColumn<int>("first");
        QTest::addColumn<int>("later");
        for (const double share : {0.95, 0.85, 0.55, 0.5, 0.3, 0.13, 0.12, 0.1, 0.062}) {
            QTest::addRow("known, %g", share) << Told::Exactly << share << 3 << 0;
            QTest::addRow("groped for, %g", share) << Told::Groping << share << 3 << 0;
            QTest::addRow("uncertain, %g", share) << Told::Unsurely << share << 6 << 2;
            QTest::addRow("unknown, %g", share) << Told::Nothing << share << 36 << 12;
        }
    }

    void doesNotGoToAndFroAtBoundary()
    {
        QFETCH(Told, told);
        QFETCH(double, share);
        QFETCH(int, first);
        QFETCH(int, later);
        Rig rig(told);
        rig.path.capacity = rig.fullLoad() * share;
        rig.run(60);
        QVERIFY2(rig.changes <= first, qPrintable(QString::number(rig.changes)));
        for (int minute = 0; minute < 5; ++minute) {
            rig.run(60);
            QVERIFY2(rig.changes <= later, qPrintable(QString::number(rig.changes)));
        }
    }

    void losesTrustInPathThatComesAndGoes()
    {
        Rig rig(Told::Exactly);
        const double good = rig.fullLoad() * 1.3;
        std::vector<int> changes;
        for (int minute = 0; minute < 3; ++minute) {
            int sum = 0;
            for (int turn = 0; turn < 10; ++turn) {
                for (const double capacity : {good, good / 10}) {
                    rig.path.capacity = capacity;
                    rig.run(3);
                    sum += rig.changes;
                }
            }
            changes.push_back(sum);
        }
        QVERIFY2(changes[0] <= 16, qPrintable(QString::number(changes[0])));
        QVERIFY2(changes[1] <= 4 && changes[2] <= 4, qPrintable(QString::number(changes[1]) + ' ' + QString::number(changes[2])));
    }

    void trustsPathAgainThatHasHeld()
    {
        Rig rig(Told::Exactly);
        const double good = rig.fullLoad() * 2;
        const auto comeAndGo = [&](int turns) {
            for (int turn = 0; turn < turns; ++turn)
                for (const double capacity : {good, good / 20}) {
                    rig.path.capacity = capacity;
                    rig.run(3);
                }
        };
        comeAndGo(10);
        rig.path.capacity = good;
        rig.run(60);
        comeAndGo(2); // fails once, and so the wait is the first one again
        rig.path.capacity = good;
        const double healed = rig.seconds;
        rig.run(60);
        QVERIFY(rig.fullSince);
        QVERIFY2(*rig.fullSince - healed < 5, qPrintable(QString::number(*rig.fullSince - healed)));
    }

    void findsTheBestRungThatIsCarried()
    {
        Rig rig(Told::Exactly);
        rig.path.capacity = rig.fullLoad() * 2;
        rig.run(5);
        rig.path.capacity = rig.fullLoad() * 0.2;
        rig.run(10);
        QCOMPARE(describe(rig.ladder.rung(), 15), std::string("7.5 of 15 /s, lossless")); // 0.14 of the full load
        QCOMPARE(rig.changes, 1);
        rig.path.capacity = rig.fullLoad() * 0.1;
        rig.run(10);
        QCOMPARE(describe(rig.ladder.rung(), 15), std::string("15 of 15 /s, lossy 90"));
        QCOMPARE(rig.changes, 1);
    }
};

QTEST_GUILESS_MAIN(PictureLadderPathsTest)
#include "picture_ladder_paths_test.moc"
