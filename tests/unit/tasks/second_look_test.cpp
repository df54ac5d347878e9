// Which queues are looked at a second time, and when that is over.
#include "tasks/second_look.hpp"

#include <QTest>

using namespace liena::tasks;
using namespace std::chrono_literals;

namespace {

constexpr double rate = 10e6; // bytes per second
constexpr auto longEnough = 5ms;
constexpr auto atOnce = 200us;
const SecondLook::Instant start{1h};

/// At `rate`, which has passed since the start.
SecondLook held()
{
    SecondLook look;
    look.passed(rate, 100us, start);
    look.passed(rate, 100us, start + 2ms);
    return look;
}

SecondLook::Seen queue(std::chrono::nanoseconds after, double underWay = 40e3, std::chrono::nanoseconds waiting = 1ms, double at = rate)
{
    return {start + after, at, underWay, waiting};
}

bool begins(SecondLook look, const SecondLook::Seen& seen) { return look.begins(seen, atOnce, longEnough); }

} // namespace

class SecondLookTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void whatCameAtOnceAtARateThatPassedIsLookedAtAgain()
    {
        auto look = held();
        QVERIFY(!look.isOn(start + 5ms));
        QVERIFY(look.begins(queue(5ms), atOnce, longEnough));
        QVERIFY(look.isOn(start + 5ms));
        QVERIFY(look.isOn(start + 2004ms));
        QVERIFY2(!look.isOn(start + 2005ms), "what is met then is another one");
    }

    void whatGrewIsNot()
    {
        auto look = held();
        QVERIFY(!begins(look, queue(5ms, 40e3, 299us)));
        QVERIFY(begins(look, queue(5ms, 40e3, 300us)));
        look.passed(rate, 250us, start + 4ms);
        QVERIFY2(begins(look, queue(5ms, 40e3, 300us)), "one window may have ended in the middle of it");
        look.passed(rate, 250us, start + 6ms);
        QVERIFY(!begins(look, queue(8ms, 40e3, 300us)));
    }

    void aRateThatHasNotPassedForLongIsNotHeld()
    {
        QVERIFY(!begins(SecondLook(), queue(5ms)));
        auto look = held();
        QVERIFY(!begins(look, queue(4ms)));
        QVERIFY(begins(look, queue(5ms, 40e3, 1ms, rate * 1.02)));
        QVERIFY(!begins(look, queue(5ms, 40e3, 1ms, rate * 1.04)));
        look.passed(rate * 1.25, 100us, start + 6ms);
        QVERIFY(!begins(look, queue(7ms, 40e3, 1ms, rate * 1.25)));
        QVERIFY(begins(look, queue(11ms, 40e3, 1ms, rate * 1.25)));
    }

    /// In steps of one in a hundred it would never be held otherwise.
    void aRateThatGrowsGentlyIsHeldAllTheWhile()
    {
        auto look = held();
        double grown = rate;
        for (int step = 1; step <= 10; ++step)
            look.passed(grown *= 1.01, 100us, start + step * 20ms);
        QVERIFY(begins(look, queue(201ms, 40e3, 1ms, grown)));
    }

    void afterAFallNothingIsHeld()
    {
        auto look = held();
        look.forget();
        QVERIFY(!begins(look, queue(5ms)));
    }

    void itGoesOnWhileTheQueueDrainsAtAFourthOfTheRate()
    {
        auto look = held();
        QVERIFY(look.begins(queue(5ms, 40e3), atOnce, longEnough));
        QVERIFY(look.goesOn(queue(7ms, 34e3))); // 5e3 are a fourth of what the rate is in 2 ms
        QVERIFY(look.goesOn(queue(9ms, 29e3)));
        QVERIFY(!look.goesOn(queue(11ms, 26e3)));
        QVERIFY(!look.isOn(start + 11ms));
    }

    void whatComesSoonAfterIsNotLookedAtAgain()
    {
        auto look = held();
        QVERIFY(look.begins(queue(5ms), atOnce, longEnough));
        look.drained(start + 9ms);
        QVERIFY(!look.isOn(start + 9ms));
        QVERIFY2(!begins(look, queue(17ms)), "the look took 4 ms");
        QVERIFY(begins(look, queue(18ms)));
    }

    /// A path that fell would leave a queue in each frame otherwise, and each would be looked at again.
    void inAPauseNoRatePasses()
    {
        auto look = held();
        look.pause(start + 3ms);
        look.pause(start + 4ms); // it goes on
        look.resume(start + 50ms);
        look.resume(start + 51ms);
        QVERIFY(!begins(look, queue(51ms)));
        QVERIFY(begins(look, queue(52ms)));
        QVERIFY(look.begins(queue(52ms), atOnce, longEnough));
        look.drained(start + 56ms);
        look.pause(start + 57ms);
        look.resume(start + 100ms);
        QVERIFY(!begins(look, queue(107ms)));
        QVERIFY(begins(look, queue(108ms)));
    }

    /// Until the next fall: what is under way is compared with it.
    void whatDrainedIsKnown()
    {
        auto look = held();
        QVERIFY(!look.drainedFrom());
        QVERIFY(look.begins(queue(5ms, 40e3), atOnce, longEnough));
        QVERIFY(!look.drainedFrom());
        look.drained(start + 9ms);
        QCOMPARE(look.drainedFrom().value(), 40e3);
        look.forget();
        QVERIFY(!look.drainedFrom());
    }

    /// Then each frame leaves one that drains before the next, which no standstill does.
    void whatIsMetAgainAfterAPauseIsBelieved()
    {
        auto look = held();
        QVERIFY(look.begins(queue(5ms), atOnce, longEnough));
        QVERIFY(!look.goesOn(queue(70ms)));
    }

    /// It is smoothed over many acknowledgements, of which a small frame has few.
    void aRoundTripThatForgetsSlowlyIsNoQueue()
    {
        auto look = held();
        QVERIFY(look.begins(queue(5ms, 0), atOnce, longEnough));
        QVERIFY(look.goesOn(queue(70ms, 0, 799us)));
        QVERIFY(!look.goesOn(queue(135ms, 0, 800us)));
    }

    void aVerdictWithoutAQueueEndsIt()
    {
        auto look = held();
        QVERIFY(look.begins(queue(5ms), atOnce, longEnough));
        look.passed(rate, 100us, start + 70ms);
        QVERIFY(!look.isOn(start + 70ms));
        QVERIFY(begins(look, queue(140ms)));
    }

    void itCanBeStopped()
    {
        auto look = held();
        QVERIFY(look.begins(queue(5ms), atOnce, longEnough));
        look.stop();
        QVERIFY(!look.isOn(start + 5ms));
        QVERIFY(begins(look, queue(6ms)));
    }
};

QTEST_APPLESS_MAIN(SecondLookTest)
#include "second_look_test.moc"
