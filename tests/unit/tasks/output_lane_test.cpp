// What an output lane knows when it is closed; no connection is made.
#include "tasks/output_lane.hpp"

#include <QTest>

#include <boost/asio/io_context.hpp>

using namespace liena;
using namespace liena::tasks;
using namespace std::chrono_literals;

namespace {

constexpr std::uint16_t picture = 0x0200;

OutputQueue::Entry entry(std::size_t size)
{
    OutputQueue::Entry made{{{{DeviceId(0x20010208U), picture}, DeviceId(0x40018208U), Timestamp{1}}, {}}, Rank::Bulk, 0, std::nullopt, {}};
    made.message.part.resize(size);
    return made;
}

/// As if a connection took all that waits.
void takeAll(OutputLane& lane)
{
    std::vector<std::byte> out;
    while (lane.queue().appendNext(8192, std::chrono::steady_clock::now(), out)) {
    }
}

} // namespace

class OutputLaneTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    /// What left once has left: the peer's reports are compared with it.
    void countOfWhatLeftDoesNotFallWhenItIsClosed()
    {
        boost::asio::io_context io{1};
        OutputLane::Handlers handlers;
        handlers.dropped = [](const OutputQueue::Entry&, OutputQueue::Fate) {};
        handlers.abandoning = [](const protocol::DatagramHeader&) { return protocol::EncodedMessage(); };
        OutputLane lane(io, {}, nullptr, {}, std::move(handlers));
        QVERIFY(lane.push(entry(100'000)));
        QVERIFY(lane.push(entry(2'000)));
        takeAll(lane);
        QCOMPARE(lane.left().bytes, std::uint64_t{102'000});
        QCOMPARE(lane.left().largest, std::size_t{100'000});
        lane.close(0ns);
        QCOMPARE(lane.left().bytes, std::uint64_t{102'000});
        QVERIFY(lane.push(entry(500)));
        takeAll(lane);
        QCOMPARE(lane.left().bytes, std::uint64_t{102'500});
        QCOMPARE(lane.left().largest, std::size_t{500});
        QVERIFY(lane.push(entry(70)));
        lane.close(0ns); // it never left
        QCOMPARE(lane.left().bytes, std::uint64_t{102'500});
    }
};

QTEST_APPLESS_MAIN(OutputLaneTest)
#include "output_lane_test.moc"
