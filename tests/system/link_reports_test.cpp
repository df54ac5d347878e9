// What a device's reports say that it received: all of it, so that the sender takes nothing for a queue.
#include "hostile_stage.hpp"

#include <QTest>

#include <map>
#include <utility>
#include <vector>

using namespace liena;
using namespace liena::test;
using wire::Bytes;
namespace number = wire::number;

namespace {

constexpr std::uint16_t picture = 0x0200;
constexpr std::uint16_t acquisitionStatus = 0x0201;
constexpr std::uint16_t undefined = 0x0300;

/// What all reports together said, bytes and messages; those that were heard once count, also when the peer has forgotten them.
class Received {
public:
    explicit Received(ScriptedPeer& peer) : m_peer(peer) {}

    std::pair<std::uint64_t, std::uint64_t> now()
    {
        for (const auto& report : m_peer.heard(number::linkReport)) {
            wire::Reader body(report.datagram.body);
            body.u32(); // the window
            const auto bytes = body.u64();
            m_reports[report.datagram.header.timestamp] = {bytes, body.u64()};
        }
        std::pair<std::uint64_t, std::uint64_t> sum;
        for (const auto& [stamp, counts] : m_reports) {
            sum.first += counts.first;
            sum.second += counts.second;
        }
        return sum;
    }

private:
    ScriptedPeer& m_peer;
    std::map<std::uint64_t, std::pair<std::uint64_t, std::uint64_t>> m_reports; ///< by their timestamps
};

} // namespace

class LinkReportsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    /// What came while a report waited is in the next one.
    void nothingIsMissingForAPeerThatDidNotReadForAWhile()
    {
        HostileStage stage;
        stage.openPeer();
        Received received(stage.peer);
        const auto pass = [&](unsigned count) {
            const auto beats = stage.linkOf(stage.xrayId).heartbeatsReceived;
            return eventually([&] { return stage.linkOf(stage.xrayId).heartbeatsReceived >= beats + count; });
        };
        const auto queued = [&] { return stage.linkOf(stage.xrayId).queuedMessages; };
        stage.peer.habits.reads = false;
        const auto fill = [&] {
            for (int i = 0; i < 150; ++i) {
                auto report = stage.robot->report("InjectionReport").value();
                report.set("reason", std::string(128, 'x'));
                (void)stage.robot->send(stage.xrayId, report);
            }
        };
        // The kernel's buffers take some for as long as they grow. What waits stays less than the peer remembers.
        const auto staysFull = [&] {
            const auto fills = [&] { return queued() >= 100 || (stage.robot->post(fill), false); };
            return eventually(fills) && pass(10) && queued() >= 100;
        };
        QVERIFY2(eventually(staysFull), stage.story().c_str());
        for (int i = 0; i < 30; ++i) {
            for (int k = 0; k < 10; ++k)
                QVERIFY(stage.peer.send(stage.peer.said(acquisitionStatus, Bytes(10))));
            QVERIFY(pass(1));
        }
        QVERIFY2(queued() >= 100, std::to_string(queued()).c_str()); // all the time
        stage.peer.habits.reads = true;
        const std::pair<std::uint64_t, std::uint64_t> expected{3000, 300};
        QVERIFY2(eventually([&] { return received.now() == expected; }), std::to_string(received.now().first).c_str());
    }

    void whatIsSkippedIsReceived()
    {
        HostileStage stage;
        stage.openPeer();
        Received received(stage.peer);
        for (int i = 0; i < 20; ++i)
            QVERIFY(stage.peer.send(stage.peer.said(undefined, Bytes(50))));
        auto head = stage.peer.header(undefined);
        head.more = true;
        QVERIFY(stage.peer.send(wire::datagram(head, Bytes(300))));
        head.more = false;
        QVERIFY(stage.peer.send(wire::datagram(head, Bytes(7))));
        const std::pair<std::uint64_t, std::uint64_t> expected{20 * 50 + 307, 21};
        QVERIFY2(eventually([&] { return received.now() == expected; }), std::to_string(received.now().first).c_str());
    }

    /// Eight lanes of pictures that wait for their last segment: more than the process holds, and all of it came.
    void whatThereIsNoRoomForIsReceived()
    {
        HostileStage stage;
        stage.openPeer();
        Received received(stage.peer);
        constexpr std::size_t segments = 15 * 32; // 15 MiB of the 16 that a picture may have
        constexpr std::size_t length = 32767;
        constexpr std::size_t last = 7;
        std::vector<std::pair<TlsLink*, wire::Header>> lanes;
        for (std::uint8_t lane = 1; lane <= 8; ++lane) {
            auto& [link, head] = lanes.emplace_back(stage.peer.keep(stage.peer.lane(lane)), stage.peer.header(picture));
            head.more = true;
            for (std::size_t i = 0; i < segments; ++i)
                QVERIFY(link->send(wire::datagram(head, Bytes(length))));
        }
        QVERIFY2(eventually([&] { return stage.toldOf("hold too much"); }), stage.story().c_str());
        for (auto& [link, head] : lanes) {
            head.more = false;
            QVERIFY(link->send(wire::datagram(head, Bytes(last))));
        }
        const std::pair<std::uint64_t, std::uint64_t> expected{8 * (segments * length + last), 8};
        QVERIFY2(eventually([&] { return received.now() == expected; }), std::to_string(received.now().first).c_str());
    }
};

QTEST_GUILESS_MAIN(LinkReportsTest)
#include "link_reports_test.moc"
