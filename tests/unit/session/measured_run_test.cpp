// What a device grants to whom, and that it takes no more.
#include "session/measured_run.hpp"

#include <QTest>

using namespace liena;
using namespace liena::protocol;
using namespace liena::session;
using namespace std::chrono_literals;

namespace {

constexpr Instant start{1h};

DatagramHeader header(std::uint64_t stamp, std::uint16_t length = 100, bool more = false)
{
    return {{DeviceId(0x40018208U), Probe::number}, DeviceId(0x00008208U), Timestamp{stamp}, length, more};
}

constexpr MeasureRequest request(std::uint32_t run, std::uint32_t durationMs, std::uint32_t probes = 0, std::uint64_t bulk = 0)
{
    return {run, durationMs, probes, bulk};
}

} // namespace

class MeasuredRunTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void atRestItGrantsWhatIsAsked()
    {
        MeasuredRun run;
        const auto answer = run.answer(request(7, 20000), MeasuringBudget(), false, start);
        QVERIFY(answer.verdict == MeasureVerdict::Granted && !answer.inUse);
        QCOMPARE(answer.run, 7U);
        QCOMPARE(answer.durationMs, 20000U);
        QCOMPARE(answer.probesPerSecond, 0U);
        QCOMPARE(answer.bulkBytesPerSecond, std::uint64_t{0});
    }

    void inUseItGrantsItsBudget()
    {
        MeasuredRun run;
        const auto answer = run.answer(request(7, 600'000, 1000, 60'000'000), MeasuringBudget(), true, start);
        QVERIFY(answer.verdict == MeasureVerdict::Granted && answer.inUse);
        QCOMPARE(answer.durationMs, 120'000U);
        QCOMPARE(answer.probesPerSecond, 200U);
        QCOMPARE(answer.bulkBytesPerSecond, std::uint64_t{4'000'000});
    }

    void takesATenthOfThePath()
    {
        const MeasuringBudget budget;
        constexpr std::uint64_t agreed = 4'000'000;
        QCOMPARE(shareOfPath(agreed, budget, 12'500'000.0), std::uint64_t{1'250'000});
        QCOMPARE(shareOfPath(agreed, budget, 1e9), agreed);
        QCOMPARE(shareOfPath(0, budget, 1e9), std::uint64_t{100'000'000});           // 0 is no limit
        QCOMPARE(shareOfPath(agreed, budget, 0.0), std::uint64_t{1});                // and is not come to by dividing
        QCOMPARE(shareOfPath(agreed, budget, std::nullopt), std::uint64_t{250'000}); // of what is assumed
    }

    void refusesWhereItIsNotAllowed()
    {
        MeasuringBudget budget;
        budget.allowed = false;
        MeasuredRun run;
        const auto answer = run.answer(request(7, 1000), budget, false, start);
        QVERIFY(answer.verdict == MeasureVerdict::NotAllowed && !answer.detail.value.empty());
        QVERIFY(!run.isRunning() && !run.admits(0, header(1), start));
    }

    void runsOneAtATimeUntilItsTimeIsOver()
    {
        MeasuredRun run;
        QVERIFY(run.answer(request(7, 1000), {}, false, start).verdict == MeasureVerdict::Granted);
        QVERIFY(run.answer(request(8, 1000), {}, false, start + 500ms).verdict == MeasureVerdict::Busy);
        QVERIFY(run.answer(request(8, 0), {}, false, start + 500ms).verdict == MeasureVerdict::Ended); // not its run
        QVERIFY(run.admits(0, header(1), start + 1500ms));                                             // on the way at its end
        QVERIFY(!run.admits(0, header(2), start + 2s));
        QVERIFY(run.answer(request(8, 1000), {}, false, start + 2s).verdict == MeasureVerdict::Granted);
        QVERIFY(run.answer(request(8, 0), {}, false, start + 2s).verdict == MeasureVerdict::Ended);
        QVERIFY(!run.isRunning() && !run.admits(0, header(3), start + 2s));
    }

    void inUseOneLineIsMeasuredAtATime()
    {
        MeasuredRun run;
        const auto busy = run.answer(request(7, 1000), {}, true, start, "arm");
        QVERIFY(busy.verdict == MeasureVerdict::Busy && busy.inUse && busy.run == 7);
        QVERIFY2(busy.detail.value.find("its line to arm is being measured") != std::string::npos, busy.detail.value.c_str());
        QVERIFY(!run.isRunning() && !run.isRunningAt(start) && !run.admits(0, header(1), start));
        QVERIFY(run.answer(request(7, 0), {}, true, start, "arm").verdict == MeasureVerdict::Ended);
        QVERIFY(run.answer(request(8, 1000), {}, false, start, "arm").verdict == MeasureVerdict::Granted); // at rest there is no such limit
        QVERIFY(run.isRunningAt(start + 1500ms) && !run.isRunningAt(start + 2s));
        QVERIFY(run.answer(request(9, 1000), {}, true, start + 2s).verdict == MeasureVerdict::Granted);
    }

    void echoesItsOwnRunOnly()
    {
        MeasuredRun run;
        (void)run.answer(request(7, 1000), {}, false, start);
        QVERIFY(!run.echoOf({8, ProbeWay::Prompt, 1, 2}, ProbeWay::Prompt));
        QVERIFY(!run.echoOf({7, ProbeWay::Packet, 1, 2}, ProbeWay::Prompt)); // it did not come as it says
        const auto first = run.echoOf({7, ProbeWay::Prompt, 5, 99}, ProbeWay::Prompt);
        QVERIFY(first && *first == (ProbeEcho{7, ProbeWay::Prompt, 5, 99, 1}));
        QCOMPARE(run.echoOf({7, ProbeWay::Prompt, 6, 99}, ProbeWay::Prompt)->heard, 2U);
        QCOMPARE(run.echoOf({7, ProbeWay::Packet, 6, 99}, ProbeWay::Packet)->heard, 1U);
    }

    void dropsProbesBeyondTheirRate()
    {
        MeasuredRun run;
        (void)run.answer(request(7, 10000, 200), {}, false, start);
        int admitted = 0;
        for (int i = 0; i < 5000; ++i) // 1000 a second for 5 s
            admitted += run.admits(0, header(1 + std::uint64_t(i)), start + i * 1ms) ? 1 : 0;
        QVERIFY2(admitted >= 1000 && admitted <= 1080, qPrintable(QString::number(admitted)));
    }

    void aRhythmAtItsRateLosesNothing()
    {
        MeasuredRun run;
        (void)run.answer(request(7, 10000, 200), {}, false, start);
        for (int i = 0; i < 1000; ++i) // ten at once, as a busy computer makes them
            QVERIFY(run.admits(0, header(1 + std::uint64_t(i)), start + (i / 10 * 50 + 45) * 1ms));
    }

    void dropsImagesBeyondTheirRateAndWhole()
    {
        MeasuredRun run;
        (void)run.answer(request(7, 60000, 0, 1'000'000), {}, false, start);
        std::uint64_t taken = 0;
        for (std::uint64_t image = 0; image < 100; ++image) { // 10 MB/s
            const auto now = start + image * 100ms;
            const bool first = run.admits(1, header(image + 1, 10'000, true), now);
            for (int segment = 1; segment < 100; ++segment)
                QCOMPARE(run.admits(1, header(image + 1, 10'000, segment < 99), now), first);
            taken += first ? 1'000'000 : 0;
        }
        QVERIFY2(taken >= 9'000'000 && taken <= 12'000'000, qPrintable(QString::number(taken)));
    }

    void anImageThatWasBegunIsReadToItsEnd()
    {
        MeasuredRun run;
        (void)run.answer(request(7, 1000), {}, false, start);
        QVERIFY(run.admits(1, header(1, 10'000, true), start + 900ms));
        QVERIFY(run.admits(1, header(1, 10'000, false), start + 5s)); // else a piece of it stayed here
        QVERIFY(!run.admits(1, header(2, 10'000, false), start + 5s));
    }

    void endsWhenTheDeviceComesIntoUse()
    {
        MeasuredRun run;
        (void)run.answer(request(7, 10000), {}, false, start);
        QVERIFY(!run.endIfInUse(false));
        const auto told = run.endIfInUse(true);
        QVERIFY(told && told->verdict == MeasureVerdict::Ended && told->run == 7 && !run.isRunning());
        QVERIFY(!run.endIfInUse(true));
        (void)run.answer(request(8, 10000), {}, true, start); // granted as to a device in use
        QVERIFY(!run.endIfInUse(true) && run.isRunning());
    }
};

QTEST_APPLESS_MAIN(MeasuredRunTest)
#include "measured_run_test.moc"
