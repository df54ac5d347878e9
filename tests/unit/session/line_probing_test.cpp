// A measurement in virtual time: rhythms, windows, limits, loss, and what is withheld.
#include "support/probed_line.hpp"

#include <QTest>

using namespace liena;
using namespace liena::session;
using namespace liena::test;
using namespace std::chrono_literals;
using protocol::ProbeWay;

namespace {

using Line = ProbedLine;
constexpr auto start = ProbedLine::start;

/// A hundred a second for 5 s over a line without delay, by a device that stands still for a while.
ProbeFigures ofADeviceThatStandsStill(Nanoseconds from, Nanoseconds until)
{
    LineProbing probing({{"paced", 5s, {100}, {}, {}}}, {}, start);
    for (auto now = start; now < start + 10s && !probing.isOver(); now += 10ms) {
        if (now == start + from)
            now = start + until;
        while (const auto order = probing.next(now))
            probing.heard({1, order->way, order->sequence, order->sentNs, 1}, now);
    }
    return probing.figures().at(0).prompt;
}

MeasurementPhase paced(double perSecond, Nanoseconds duration) { return {"paced", duration, {perSecond}, {}, {}}; }

} // namespace

class LineProbingTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void keepsItsRhythmAndFindsTheRoundTrip()
    {
        Line line({paced(500, 2s)});
        QVERIFY(line.run());
        const auto& prompt = line.phase().prompt;
        QCOMPARE(prompt.sent, std::uint64_t{1000});
        QCOMPARE(prompt.echoed, std::uint64_t{1000});
        QCOMPARE(prompt.heard, std::uint64_t{1000});
        QCOMPARE(prompt.withheld, std::uint64_t{0});
        QVERIFY(!prompt.limited);
        QCOMPARE(prompt.roundTrip.least(), std::uint64_t{4'000'000});
        QCOMPARE(prompt.roundTrip.max(), std::uint64_t{4'000'000});
        QVERIFY(line.now >= start + 2s && line.now < start + 2s + 10ms); // no longer than the last echo takes
    }

    void aLateSenderCountsAsLatencyAndLeavesNothingOut()
    {
        Line line({paced(500, 5s)});
        const auto first = line.probing.next(line.now);
        QVERIFY(first && !line.probing.next(line.now));
        line.now += 50ms; // it did not run
        for (std::uint64_t late = 1; late <= 25; ++late) {
            const auto order = line.probing.next(line.now);
            QVERIFY(order);
            QCOMPARE(order->sentNs, first->sentNs + late * 2'000'000); // when it was due
        }
        QVERIFY(!line.probing.next(line.now));
        line.now += 3s; // what is as late as that is not made up for
        QVERIFY(line.probing.next(line.now) && !line.probing.next(line.now));
    }

    void aLongStallIsWithheldAndNotForgotten()
    {
        const auto amid = ofADeviceThatStandsStill(1s, 4s);
        QCOMPARE(amid.sent + amid.withheld, std::uint64_t{500});
        QCOMPARE(amid.withheld, std::uint64_t{300});
        QCOMPARE(amid.echoed, amid.sent);
        const auto beyondTheEnd = ofADeviceThatStandsStill(3s, 8s);
        QCOMPARE(beyondTheEnd.sent, std::uint64_t{300});
        QCOMPARE(beyondTheEnd.withheld, std::uint64_t{200});
        const auto aLittleBeyond = ofADeviceThatStandsStill(3s, 5500ms);
        QCOMPARE(aLittleBeyond.sent, std::uint64_t{300});
        QCOMPARE(aLittleBeyond.withheld, std::uint64_t{200});
    }

    void aShortStallAtTheEndIsLatencyToo()
    {
        const auto figures = ofADeviceThatStandsStill(4500ms, 5200ms);
        QCOMPARE(figures.sent, std::uint64_t{500});
        QCOMPARE(figures.withheld, std::uint64_t{0});
        QCOMPARE(figures.roundTrip.max(), std::uint64_t{700'000'000});
    }

    void afterItsEndAPhaseOnlyWaits()
    {
        LineProbing probing({{"messages", 1s, {0, 4, 64}, {}, {}}}, {}, start);
        while (probing.next(start)) {
        }
        const auto now = start + 1s;
        probing.heard({1, ProbeWay::Prompt, 0, 0, 1}, now);
        QVERIFY(!probing.next(now) && !probing.isOver());
        QVERIFY(probing.wakeAt() > now); // three echoes are still to come
    }

    void backToBackSendsTheNextOnTheEcho()
    {
        Line line({{"back-to-back", 1s, {0, 1, 64}, {}, {}}});
        QVERIFY(line.run());
        QCOMPARE(line.phase().prompt.sent, std::uint64_t{250}); // 4 ms each
        QCOMPARE(line.phase().prompt.echoed, std::uint64_t{250});
        for (std::size_t i = 1; i < line.sent.size(); ++i)
            QCOMPARE(line.sent[i].sentNs - line.sent[i - 1].sentNs, std::uint64_t{4'000'000});
    }

    void aWindowIsNeverExceeded()
    {
        Line line({{"messages", 100ms, {0, 32, 64}, {}, {}}});
        std::size_t most = 0;
        while (!line.probing.isOver() && line.now < start + 10s) {
            while (const auto order = line.probing.next(line.now))
                line.send(*order);
            most = std::max(most, line.onTheWay.size());
            if (line.onTheWay.empty()) {
                line.now += 1ms;
                continue;
            }
            line.now = line.onTheWay.front().at;
            const auto echo = line.onTheWay.front().echo;
            line.onTheWay.erase(line.onTheWay.begin());
            line.probing.heard(echo, line.now);
        }
        QVERIFY(line.probing.isOver());
        QCOMPARE(most, std::size_t{32});
        QCOMPARE(line.phase().prompt.echoed, std::uint64_t{32 * 25});
    }

    void countsWhatIsLost()
    {
        Line line({{"paced", 2s, {}, {100}, {}}});
        line.loseEvery = 10;
        QVERIFY(line.run());
        const auto& packets = line.phase().packets;
        QCOMPARE(packets.sent, std::uint64_t{200});
        QCOMPARE(packets.echoed, std::uint64_t{180});
        QCOMPARE(packets.heard, std::uint64_t{180});
        QVERIFY(line.now >= start + 3s && line.now < start + 3s + 10ms); // it waited a second for them
    }

    void countsNoEchoTwiceAndNoneThatIsForeign()
    {
        Line line({paced(10, 1s)});
        const auto first = line.probing.next(line.now);
        QVERIFY(first);
        const protocol::ProbeEcho echo{1, first->way, first->sequence, first->sentNs, 1};
        line.probing.heard(echo, line.now + 1ms);
        line.probing.heard(echo, line.now + 2ms);
        line.probing.heard({1, ProbeWay::Prompt, 77, 0, 5}, line.now + 2ms);
        line.probing.heard({1, ProbeWay::Image, 0, 0, 5}, line.now + 2ms);
        line.run();
        QCOMPARE(line.phase().prompt.echoed, line.phase().prompt.sent);
        QCOMPARE(line.phase().images.echoed, std::uint64_t{0});
    }

    void withholdsImagesThatTheLineDoesNotCarry()
    {
        Line line({{"beside-images", 5s, {100}, {}, {20, 0, 1'000'000}}});
        line.imageTime = 200ms; // a quarter of what is asked
        QVERIFY(line.run());
        const auto& images = line.phase().images;
        QCOMPARE(images.sent + images.withheld, std::uint64_t{100});
        QVERIFY2(images.sent < 50, qPrintable(QString::number(images.sent))); // what went, and a second of what was due
        QVERIFY2(images.echoed >= 25 && images.echoed <= 30, qPrintable(QString::number(images.echoed))); // in 5 s, and the one after
        QCOMPARE(line.phase().prompt.sent, std::uint64_t{500});                                           // that is the images' own affair
    }

    void aLongLineIsNoNarrowOne()
    {
        Line line({{"beside-images", 5s, {100}, {}, {25, 0, 131'072}}, {"images", 1s, {}, {}, {0, 64, 131'072}}});
        line.roundTrip = 400ms;
        line.imageTime = 1ms;
        QVERIFY(line.run());
        const auto& images = line.phase(0).images;
        QCOMPARE(images.sent, std::uint64_t{125});
        QCOMPARE(images.withheld, std::uint64_t{0});
        QCOMPARE(images.echoed, std::uint64_t{125});
        QVERIFY(line.phase(1).images.echoed > 64 * 2);
    }

    void whatALimitSlowsHasNoMoreUnderWayThanASecondBrings()
    {
        const MeasurementPlan plan{{"images", 5s, {}, {}, {0, 64, 100'000}}};
        const auto sentIntoSilence = [&plan](std::uint64_t bytesPerSecond) {
            LineProbing probing(plan, {0, bytesPerSecond, 60s}, start);
            int sent = 0;
            for (auto now = start; now < start + 5s; now += 10ms)
                while (probing.next(now))
                    ++sent;
            return sent;
        };
        QCOMPARE(sentIntoSilence(0), 64);
        QCOMPARE(sentIntoSilence(1'000'000), 11);
        QCOMPARE(sentIntoSilence(100'000), 4); // the fewest
        LineProbing rhythm({{"beside-images", 5s, {}, {}, {1000, 0, 100'000}}}, {0, 1'000'000, 60s}, start);
        rhythm.limitImages(2'000'000, start); // it may change on the way
        int sent = 0;
        for (auto now = start; now < start + 3s; now += 10ms)
            while (rhythm.next(now))
                ++sent;
        QCOMPARE(sent, 21);
    }

    void staysWithinItsLimits()
    {
        const MeasuringLimits limits{200, 4'000'000, 60s};
        Line line({{"both", 2s, {500}, {500}, {15, 0, 2'000'000}}, {"back-to-back", 2s, {0, 1}, {}, {}}}, limits);
        QVERIFY(line.run());
        const auto& both = line.phase(0);
        QVERIFY(both.prompt.limited && both.packets.limited && both.images.limited);
        QCOMPARE(both.prompt.sent + both.packets.sent, std::uint64_t{400});
        QCOMPARE(both.images.sent, std::uint64_t{4}); // two a second
        QCOMPARE(both.images.perSecond, 2.0);
        const auto& single = line.phase(1);
        QVERIFY(single.prompt.limited);
        QVERIFY2(single.prompt.sent <= 400, qPrintable(QString::number(single.prompt.sent)));
    }

    void takesAnotherLimitOnItsWay()
    {
        const MeasurementPlan plan{{"beside-images", 4s, {100}, {}, {10, 0, 100'000}}, {"again", 2s, {100}, {}, {10, 0, 100'000}}};
        Line narrower(plan, {0, 1'000'000, 60s});
        narrower.changes = start + 2s;
        narrower.limitAfter = 100'000; // one a second
        QVERIFY(narrower.run());
        QVERIFY2(narrower.phase(0).images.sent >= 21 && narrower.phase(0).images.sent <= 22,
                 qPrintable(QString::number(narrower.phase(0).images.sent)));
        QVERIFY(narrower.phase(0).images.limited && narrower.phase(0).images.perSecond == 1.0);
        QCOMPARE(narrower.phase(0).prompt.sent, std::uint64_t{400}); // that is the images' own affair
        QCOMPARE(narrower.phase(1).images.sent, std::uint64_t{2});   // in the next phase, too

        Line wider(plan, {0, 100'000, 60s});
        wider.changes = start + 2s;
        wider.limitAfter = 1'000'000;
        QVERIFY(wider.run());
        QVERIFY2(wider.phase(0).images.sent >= 21 && wider.phase(0).images.sent <= 23,
                 qPrintable(QString::number(wider.phase(0).images.sent)));
        QVERIFY(wider.phase(0).images.limited && wider.phase(0).images.perSecond == 1.0); // its least is what it tells
        QVERIFY(!wider.phase(1).images.limited);

        Line same(plan, {0, 1'000'000, 60s});
        same.changes = start + 2s;
        same.limitAfter = 1'000'000;
        QVERIFY(same.run());
        QCOMPARE(same.phase(0).images.sent, std::uint64_t{40});
        QVERIFY(!same.phase(0).images.limited);
    }

    void endsThoughNothingComesBack()
    {
        Line line({paced(100, 1s), {"images", 1s, {}, {}, {0, 3, 1000}}});
        for (int turns = 0; turns < 10000 && !line.probing.isOver(); ++turns) {
            while (line.probing.next(line.now)) {
            }
            if (!line.probing.isOver())
                line.now = std::max(line.now + 1ns, line.probing.wakeAt());
        }
        QVERIFY(line.probing.isOver());
        QCOMPARE(line.phase(0).prompt.echoed, std::uint64_t{0});
        QCOMPARE(line.phase(1).images.sent, std::uint64_t{3});
        QVERIFY(line.now - start <= LineProbing::longest({paced(100, 1s), paced(100, 1s)}));
    }
};

QTEST_APPLESS_MAIN(LineProbingTest)
#include "line_probing_test.moc"
