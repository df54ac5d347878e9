// The flash clock: it keeps its rate by itself, and the band that is shown follows it.
#include "painted_band.hpp"

#include <QApplication>
#include <QPaintEvent>
#include <QSignalSpy>
#include <QTest>
#include <QTimer>

#include <cmath>

using namespace console;
using namespace console::test;
using namespace std::chrono_literals;

namespace {

/// What a running clock showed, at moments at which only one colour is right.
struct Look {
    AlarmPriority priority;
    double rate; ///< flashes a second, half on and half off
    int lit = 0;
    int dim = 0;
    int wrong = 0;

    bool shouldBeLit(Duration phase) const { return std::fmod(seconds(phase) * rate, 1.0) < 0.5; }
    bool isEnough() const { return lit >= 100 && dim >= 100; }

    /// The clock has had its turn at `from` or later, and not after `to`.
    void judge(const FlashClock& clock, Duration from, Duration to)
    {
        if (from < 0ms || to - from > 200ms || shouldBeLit(from) != shouldBeLit(to))
            return;
        ++(shouldBeLit(to) ? lit : dim);
        wrong += clock.isLit(priority) != shouldBeLit(to) ? 1 : 0;
    }
};

/// How often a band painted its badge for the screen: a picture that a test asks for is none of these.
class Paints : public QObject {
public:
    explicit Paints(AlarmBand& band) : m_band(band) { band.installEventFilter(this); }

    bool eventFilter(QObject* watched, QEvent* event) override
    {
        if (event->type() == QEvent::Paint && static_cast<QPaintEvent*>(event)->region().contains(QPoint(12, tall / 2)))
            ++(m_band.flashClock().isLit(AlarmPriority::High) ? lit : dim);
        return QObject::eventFilter(watched, event);
    }

    int lit = 0;
    int dim = 0;

private:
    AlarmBand& m_band;
};

} // namespace

class TestFlashClock : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase() { theme::apply(*qApp); }

    void twoBandsFlashTogether()
    {
        QVERIFY(FlashClock::litAt(AlarmPriority::High, 0ms) && FlashClock::litAt(AlarmPriority::Medium, 0ms));
        QVERIFY(!FlashClock::litAt(AlarmPriority::High, 250ms) && FlashClock::litAt(AlarmPriority::Medium, 833ms));
        QVERIFY(FlashClock::litAt(AlarmPriority::High, 500ms) && !FlashClock::litAt(AlarmPriority::Medium, 834ms));
    }

    void clockRunsByItself()
    {
        FlashClock clock;
        QSignalSpy ticked(&clock, &FlashClock::ticked);
        const bool before = clock.isLit(AlarmPriority::High);
        QTRY_VERIFY(clock.isLit(AlarmPriority::High) != before);
        QVERIFY(!ticked.isEmpty());
    }

    /// Against the time that passes. A timer beside it tells how far the event loop came: however late the computer is, the clock had its
    /// turn before. Where an edge is so near that either colour may stand there, nothing is judged.
    void clockKeepsItsRateByItself()
    {
        const auto before = std::chrono::steady_clock::now();
        FlashClock clock;
        const auto after = std::chrono::steady_clock::now();
        Look high{AlarmPriority::High, 2.0};
        Look medium{AlarmPriority::Medium, 0.6};
        QTimer timer;
        timer.setTimerType(Qt::PreciseTimer);
        timer.setSingleShot(true);
        Instant due;
        const auto lookAgain = [&timer, &due] {
            due = std::chrono::steady_clock::now() + 10ms;
            timer.start(10ms);
        };
        connect(&timer, &QTimer::timeout, this, [&] {
            const auto now = std::chrono::steady_clock::now();
            for (Look* look : {&high, &medium})
                look->judge(clock, due - 15ms - after, now - before);
            lookAgain();
        });
        lookAgain();
        QTRY_VERIFY_WITH_TIMEOUT(high.isEnough() && medium.isEnough(), 60000); // some three seconds
        for (const Look* look : {&high, &medium})
            QVERIFY2(
                look->wrong <= (look->lit + look->dim) / 50,
                qPrintable(QStringLiteral("%1 Hz: wrong in %2 of %3 looks").arg(look->rate).arg(look->wrong).arg(look->lit + look->dim)));
    }

    void aShownBandFlashesByItself_data()
    {
        QTest::addColumn<bool>("selfTest");
        QTest::newRow("a high alarm") << false;
        QTest::newRow("the self-test's signal") << true;
    }

    void aShownBandFlashesByItself()
    {
        QFETCH(bool, selfTest);
        Band room(AlarmPriority::High);
        if (selfTest) {
            room.band.setAlarms({});
            room.band.setSelfTest(AlarmSelfTest::Step::High, AlarmPriority::High);
        }
        QVERIFY(QTest::qWaitForWindowExposed(&room.band));
        Paints paints(room.band);
        QTRY_VERIFY_WITH_TIMEOUT(paints.lit >= 2 && paints.dim >= 2, 30000); // some two seconds
    }
};

QTEST_MAIN(TestFlashClock)
#include "test_flash_clock.moc"
