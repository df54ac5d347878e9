// A peer that measures more than it was granted, or without being granted anything: dropped and counted, and the session goes on.
#include "hostile_stage.hpp"

#include <QTest>

#include <mutex>

using namespace liena;
using namespace liena::test;
using namespace std::chrono_literals;
using Kind = SessionEvent::Kind;
using wire::Bytes;
using wire::Words;

namespace {

constexpr std::uint16_t request = 0x60, answer = 0x61, probe = 0x62, echo = 0x63;
constexpr std::uint8_t prompt = 1, packet = 2, image = 3;

Bytes requestFor(std::uint32_t run, std::uint32_t durationMs, std::uint32_t probes, std::uint64_t bulk)
{
    return Words().u32(run).u32(durationMs).u32(probes).u64(bulk);
}

Bytes probeOf(std::uint32_t run, std::uint8_t way, std::uint32_t sequence, std::size_t padding)
{
    return Words().u32(run).u8(way).u32(sequence).u64(sequence).bytes(std::string(padding, 'p'));
}

std::size_t echoes(HostileStage& stage) { return stage.peer.heard(echo).size(); }

/// The verdict of the newest answer; 0 before there is one.
std::uint8_t verdict(HostileStage& stage)
{
    const auto answers = stage.peer.heard(answer);
    return answers.empty() ? std::uint8_t{0} : answers.back().datagram.body.at(4);
}

bool peerIsOpen(HostileStage& stage) { return stage.peer.isOpen() && stage.linkOf(stage.xrayId).state == SessionState::Open; }

bool isGranted(HostileStage& stage, std::uint32_t run, std::uint32_t probes, std::uint64_t bulk)
{
    const auto before = stage.peer.heard(answer).size();
    stage.peer.say(request, requestFor(run, 60'000, probes, bulk));
    return eventually([&] { return stage.peer.heard(answer).size() > before; }) && verdict(stage) == 1;
}

} // namespace

class HostileMeasuringTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void probesWithoutAGrantAreDropped()
    {
        HostileStage stage;
        stage.openPeer();
        for (std::uint32_t i = 0; i < 100; ++i) {
            stage.peer.say(probe, probeOf(7, prompt, i, 64));
            stage.peer.sendPacket(stage.peer.packet(stage.peer.said(probe, probeOf(7, packet, i, 64))));
        }
        stage.peer.keep(stage.peer.lane(1))->send(stage.peer.said(probe, probeOf(7, image, 0, 20'000)));
        stage.peer.say(echo, Words().u32(7).u8(prompt).u32(0).u64(0).u32(1));
        QVERIFY2(eventually([&] { return stage.toldOf("a probe beyond what was granted") && stage.toldOf("an echo of no measurement"); }),
                 stage.story().c_str());
        QCOMPARE(echoes(stage), std::size_t{0});
        QVERIFY2(peerIsOpen(stage) && stage.honestSessionLives(), stage.story().c_str());
    }

    void probesBeyondAGrantAreDropped()
    {
        HostileStage stage;
        stage.openPeer();
        QVERIFY(isGranted(stage, 7, 50, 1'000'000));
        for (std::uint32_t i = 0; i < 2000; ++i)
            stage.peer.say(probe, probeOf(7, prompt, i, 64));
        QVERIFY2(eventually([&] { return stage.toldOf("a probe beyond what was granted") && echoes(stage) > 0; }), stage.story().c_str());
        QVERIFY(stage.honestSessionLives());
        QVERIFY2(echoes(stage) < 1000, qPrintable(QString::number(echoes(stage))));
        QVERIFY2(peerIsOpen(stage), stage.story().c_str());
    }

    void imagesBeyondAGrantAreDroppedWhole()
    {
        HostileStage stage;
        stage.openPeer();
        QVERIFY(isGranted(stage, 7, 0, 10'000));
        auto* lane = stage.peer.keep(stage.peer.lane(1));
        for (std::uint32_t i = 0; i < 200; ++i)
            lane->send(stage.peer.said(probe, probeOf(7, image, i, 30'000)));
        QVERIFY2(eventually([&] { return stage.toldOf("a probe beyond what was granted") && echoes(stage) > 0; }), stage.story().c_str());
        QVERIFY2(stage.honestSessionLives() && peerIsOpen(stage), stage.story().c_str());
        QVERIFY2(echoes(stage) < 100, qPrintable(QString::number(echoes(stage))));
    }

    void requestsInAFloodAreAnsweredWithinBounds()
    {
        HostileStage stage;
        stage.openPeer();
        stage.peer.habits.reads = false; // and nothing of it is read
        constexpr std::uint32_t flood = 20'000;
        const auto before = stage.linkOf(stage.xrayId).bytesReceived;
        for (std::uint32_t i = 1; i <= flood; ++i)
            stage.peer.say(request, requestFor(i, 60'000, 0, 0));
        QVERIFY(eventually([&] { return stage.linkOf(stage.xrayId).bytesReceived >= before + flood * 40; }));
        const auto waiting = stage.linkOf(stage.xrayId).queuedMessages;
        QVERIFY2(waiting < 100, qPrintable(QString::number(waiting)));
        stage.peer.habits.reads = true;
        QVERIFY2(eventually([&] { return verdict(stage) == 3; }), stage.story().c_str()); // Busy with the first of them
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }

    void aGrantEndsWhenItsTimeIsOver()
    {
        HostileStage stage;
        stage.openPeer();
        stage.peer.say(request, requestFor(7, 1, 0, 0));
        QVERIFY(eventually([&] { return verdict(stage) == 1; }));
        QVERIFY2(eventually([&] {
                     stage.peer.say(probe, probeOf(7, prompt, 1, 8));
                     return stage.toldOf("a probe beyond what was granted");
                 }),
                 stage.story().c_str());
        QVERIFY2(peerIsOpen(stage), stage.story().c_str());
    }

    void malformedProbesAreDropped()
    {
        HostileStage stage;
        stage.openPeer();
        QVERIFY(isGranted(stage, 7, 0, 0));
        stage.peer.say(probe, probeOf(8, prompt, 1, 8));  // of another run
        stage.peer.say(probe, probeOf(7, image, 1, 8));   // not the way it came
        stage.peer.say(probe, probeOf(7, 9, 1, 8));       // no way at all
        stage.peer.say(probe, Words().u32(7).u8(prompt)); // cut off
        stage.peer.say(probe, Words().u32(7).u8(prompt).u32(1).u64(1).u32(0xFFFFFFFFU));
        QVERIFY2(eventually([&] { return stage.toldOf("a probe of no measurement"); }), stage.story().c_str());
        stage.peer.say(probe, probeOf(7, prompt, 2, 8));
        QVERIFY(eventually([&] { return echoes(stage) == 1; }));
        QVERIFY2(peerIsOpen(stage) && stage.honestSessionLives(), stage.story().c_str());
    }

    void whatIsNoProbeForItsLaneIsAViolation_data()
    {
        QTest::addColumn<bool>("onBulkLane");
        QTest::newRow("a long probe on lane 0") << false;
        QTest::newRow("an echo on a bulk lane") << true;
    }
    void whatIsNoProbeForItsLaneIsAViolation()
    {
        QFETCH(bool, onBulkLane);
        HostileStage stage;
        stage.openPeer();
        QVERIFY(isGranted(stage, 7, 0, 0));
        if (onBulkLane)
            stage.peer.keep(stage.peer.lane(2))->send(stage.peer.said(echo, Words().u32(7).u8(image).u32(0).u64(0).u32(1)));
        else
            stage.peer.say(probe, probeOf(7, prompt, 1, 1025));
        QVERIFY2(eventually([&] { return stage.robot.heard(Kind::Lost, stage.xrayId); }), stage.story().c_str());
        QVERIFY2(stage.honestSessionUntouched(), stage.story().c_str());
    }

    void aPeerThatDoesNotKnowMeasurementsIsSaidToBe()
    {
        HostileStage stage;
        stage.openPeer();
        std::mutex mutex;
        std::string failure;
        QVERIFY(stage.robot->measure(stage.xrayId, {{"paced", 1s, {100}, {}, {}}}, [&](const Measurement& found) {
            const std::lock_guard lock(mutex);
            failure = found.failure;
        }));
        QVERIFY2(eventually([&] {
                     const std::lock_guard lock(mutex);
                     return failure.find("xray does not answer") != std::string::npos;
                 }),
                 failure.c_str());
        QVERIFY2(peerIsOpen(stage) && stage.honestSessionUntouched(), stage.story().c_str());
    }

    void aLiarsEchoesAreCountedOnce()
    {
        HostileStage stage;
        stage.openPeer();
        std::mutex mutex;
        std::optional<Measurement> found;
        QVERIFY(stage.robot->measure(stage.xrayId, {{"paced", 300ms, {50}, {}, {}}}, [&](const Measurement& done) {
            const std::lock_guard lock(mutex);
            found = done;
        }));
        QVERIFY(eventually([&] { return !stage.peer.heard(request).empty(); }));
        const auto body = stage.peer.heard(request).back().datagram.body;
        wire::Reader asked(body);
        const auto run = asked.u32();
        stage.peer.say(answer, Words().u32(run).u8(1).u8(0).u32(60'000).u32(0).u64(0).text(""));
        QVERIFY(eventually([&] { return !stage.peer.heard(probe).empty(); }));
        for (std::uint32_t i = 0; i < 50; ++i) // more than were sent, and each twice
            for (int twice = 0; twice < 2; ++twice)
                stage.peer.say(echo, Words().u32(run).u8(prompt).u32(i).u64(~std::uint64_t{0}).u32(0xFFFFFFFFU));
        QVERIFY(eventually([&] {
            const std::lock_guard lock(mutex);
            return found.has_value();
        }));
        QVERIFY2(found->failure.empty(), found->failure.c_str());
        QVERIFY(found->phases.at(0).prompt.echoed <= found->phases.at(0).prompt.sent);
        QVERIFY2(peerIsOpen(stage), stage.story().c_str());
    }
};

QTEST_GUILESS_MAIN(HostileMeasuringTest)
#include "hostile_measuring_test.moc"
