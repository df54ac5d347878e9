// A thread of real-time priority leaves the kernel no cause to stop it.
#include "system/processor_share.hpp"

#include <QTest>

using namespace std::chrono_literals;
using liena::system::ProcessorShare;
using Instant = ProcessorShare::Instant;

namespace {

/// A thread that looks for work whenever it may, and else sleeps until the next message, in steps of 10 us.
struct Thread {
    ProcessorShare share{0.9};
    Instant now{1h};
    std::chrono::nanoseconds used{};

    /// Tells how much of the time it took.
    double run(std::chrono::nanoseconds time, std::chrono::nanoseconds between)
    {
        const auto usedBefore = used;
        const auto end = now + time;
        for (auto next = now + between; now < end;) {
            if (share.isSpent(now, used)) {
                now = std::max(now, next);
                used += 2us; // what the message takes
                now += 2us;
                next = now + between;
                continue;
            }
            now += 10us;
            used += 10us;
            if (now >= next)
                next = now + between;
        }
        return std::chrono::duration<double>(used - usedBefore) / std::chrono::duration<double>(now - end + time);
    }
};

} // namespace

class ProcessorShareTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void whoeverLooksAllTheTimeTakesItsShareAndNoMore_data()
    {
        QTest::addColumn<int>("betweenUs");
        QTest::newRow("messages every 30 us") << 30;
        QTest::newRow("messages every millisecond") << 1000;
        QTest::newRow("messages every 20 ms") << 20'000;
    }

    void whoeverLooksAllTheTimeTakesItsShareAndNoMore()
    {
        QFETCH(const int, betweenUs);
        Thread thread;
        for (int second = 0; second < 5; ++second) {
            const auto share = thread.run(1s, std::chrono::microseconds(betweenUs));
            QVERIFY2(share < 0.93, qPrintable(QString::number(share)));
            QVERIFY2(betweenUs > 1000 || share > 0.85, qPrintable(QString::number(share)));
        }
    }

    void whoeverWorksHalfTheTimeMayAlwaysLook()
    {
        ProcessorShare share(0.9);
        auto now = Instant(1h);
        auto used = 0ns;
        for (int step = 0; step < 10'000; ++step) {
            now += 200us;
            used += 100us;
            QVERIFY(!share.isSpent(now, used));
        }
    }

    void whoeverWasQuietMayNotTakeMoreThanTheShareAfterwards()
    {
        Thread thread;
        (void)thread.share.isSpent(thread.now, thread.used);
        thread.now += 99ms;
        const auto share = thread.run(1s, 30us);
        QVERIFY2(share < 0.93, qPrintable(QString::number(share)));
    }
};

QTEST_GUILESS_MAIN(ProcessorShareTest)
#include "processor_share_test.moc"
