// What a session measures of the way and of the peer's clock, from the heartbeats' echoes, in virtual time.
#include "session_side.hpp"

#include <QTest>

#include <functional>

using namespace liena;
using namespace liena::test;
using namespace liena::session;

namespace {

/// A peer over a line of 4 ms each way, which answers each heartbeat of ours after 6 ms.
class AnsweringPeer {
public:
    explicit AnsweringPeer(Side& side) : m_side(side), m_begun(side.now) {}

    /// `meanwhile` happens while the peer holds the heartbeat; its answer takes `longer` than usual.
    void answer(const std::function<void()>& meanwhile = {}, std::chrono::nanoseconds longer = 0ns)
    {
        const auto actions = m_side.tick(20ms);
        const auto ours = *findSent<protocol::Heartbeat>(actions);
        m_side.pass(4ms);
        protocol::Heartbeat heartbeat;
        heartbeat.echoSequence = ours.sequence;
        heartbeat.echoSentNs = ours.sentNs;
        heartbeat.echoReceivedNs = clock();
        m_side.pass(3ms);
        if (meanwhile)
            meanwhile();
        m_side.pass(3ms);
        heartbeat.sequence = ++m_side.peerSequence;
        heartbeat.sentNs = clock();
        heartbeat.state = SessionState::Open;
        heartbeat.epoch = m_side.peerEpoch;
        m_side.pass(4ms + longer);
        m_side.handle(LifeHeard{});
        m_side.hear(heartbeat);
    }

    std::chrono::nanoseconds ahead{}; ///< its clock, of ours as it was at the beginning

private:
    std::uint64_t clock() const { return m_begun.wall.ns + static_cast<std::uint64_t>((m_side.now.mono - m_begun.mono + ahead).count()); }

    Side& m_side;
    Now m_begun;
};

} // namespace

class SessionMeasureTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void measuresTheClockFromEchoes();
    void echoOfNothingThatWasSentIsNoSample();
    void steppedClockLooksLikeNeitherDelayNorJitter_data();
    void steppedClockLooksLikeNeitherDelayNorJitter();
    void lateHeartbeatIsDelayAndJitter();
};

void SessionMeasureTest::measuresTheClockFromEchoes()
{
    // The peer's clock is 3 s ahead; each way takes 4 ms.
    Side side;
    side.becomeOpen();
    for (std::uint32_t i = 0; i < 8; ++i) {
        const auto sent = side.tick(20ms);
        const auto* ours = findSent<protocol::Heartbeat>(sent);
        QVERIFY(ours != nullptr);
        side.pass(8ms);
        side.handle(LifeHeard{});
        protocol::Heartbeat echo;
        echo.sequence = 1000 + i;
        echo.echoSequence = ours->sequence;
        echo.echoSentNs = ours->sentNs;
        echo.echoReceivedNs = ours->sentNs + 4'000'000 + 3'000'000'000;
        echo.sentNs = echo.echoReceivedNs;
        echo.state = SessionState::Open;
        echo.epoch = 1;
        QVERIFY(!side.machine.clock().offset());
        side.hear(echo);
        side.hear(echo); // the other copy does not count twice
    }
    QVERIFY(side.machine.clock().offset() == 3s);
    QVERIFY(side.machine.clock().uncertainty() == 4ms);
}

void SessionMeasureTest::echoOfNothingThatWasSentIsNoSample()
{
    Side side;
    side.becomeOpen();
    protocol::Heartbeat echo;
    echo.sequence = 1000;
    echo.echoSequence = 77;
    echo.echoSentNs = echo.echoReceivedNs = echo.sentNs = side.now.wall.ns;
    echo.state = SessionState::Open;
    echo.epoch = 1;
    side.hear(echo);
    QCOMPARE(side.machine.clock().samples(), std::size_t{0});
    QVERIFY(!side.machine.clock().lastDelay());
}

void SessionMeasureTest::steppedClockLooksLikeNeitherDelayNorJitter_data()
{
    QTest::addColumn<bool>("own");
    QTest::addColumn<bool>("held"); // while the peer holds our heartbeat, or between two exchanges
    QTest::addColumn<int>("seconds");
    for (const bool own : {true, false})
        for (const bool held : {true, false})
            for (const int seconds : {3600, 1, -1, -3600})
                QTest::addRow("%s clock by %d s, %s", own ? "our" : "the peer's", seconds, held ? "while held" : "between")
                    << own << held << seconds;
}

void SessionMeasureTest::steppedClockLooksLikeNeitherDelayNorJitter()
{
    QFETCH(bool, own);
    QFETCH(bool, held);
    QFETCH(int, seconds);
    Side side;
    side.becomeOpen();
    AnsweringPeer peer(side);
    for (int i = 0; i < 60; ++i)
        peer.answer();
    QVERIFY(side.machine.clock().offset() == 0ns);
    const auto step = [&] {
        if (own)
            side.now.wall.ns += static_cast<std::uint64_t>(seconds * 1'000'000'000LL);
        else
            peer.ahead += std::chrono::seconds(seconds);
    };
    if (!held)
        step();
    for (int i = 0; i < 10; ++i) {
        peer.answer(held && i == 0 ? std::function<void()>(step) : nullptr);
        QVERIFY2(side.machine.clock().lastDelay() == 8ms, std::to_string(side.machine.clock().lastDelay()->count()).c_str());
        QVERIFY2(side.machine.jitter() < 100us, std::to_string(side.machine.jitter().count()).c_str());
    }
    QVERIFY(side.machine.clock().offset() == (own ? -1 : 1) * std::chrono::seconds(seconds));
}

void SessionMeasureTest::lateHeartbeatIsDelayAndJitter()
{
    Side side;
    side.becomeOpen();
    AnsweringPeer peer(side);
    for (int i = 0; i < 60; ++i)
        peer.answer();
    peer.answer(nullptr, 16ms);
    QVERIFY(side.machine.clock().lastDelay() == 24ms);
    QVERIFY(side.machine.jitter() >= 1ms && side.machine.jitter() < 1100us); // a sixteenth
    QVERIFY(side.machine.clock().offset() == 0ns);
}

QTEST_APPLESS_MAIN(SessionMeasureTest)
#include "session_measure_test.moc"
