// What a write gathers: which bytes are copied, which stay where they are, and how long they live.
#include "support/hex.hpp"
#include "tasks/output_queue.hpp"

#include <QTest>

using namespace liena;
using namespace liena::protocol;
using namespace liena::tasks;
using namespace std::chrono_literals;

namespace {

const auto now = std::chrono::steady_clock::time_point(1h);
constexpr std::size_t segmentSize = 16384;

OutputQueue makeQueue()
{
    return {[](const OutputQueue::Entry&, OutputQueue::Fate) {},
            [](const DatagramHeader& begun) {
                return EncodedMessage{{{begun.message.origin, 0x0051}, begun.target, Timestamp{2}}, {std::byte{'A'}}};
            }};
}

OutputQueue::Entry entryOf(std::size_t size, std::uint16_t number = 0x0202)
{
    OutputQueue::Entry entry{{{{DeviceId(0x20010208U), number}, DeviceId(0x40018208U), Timestamp{1}}, {}}, Rank::Bulk, 0, std::nullopt, {}};
    for (std::size_t i = 0; i < size; ++i)
        entry.message.part.push_back(static_cast<std::byte>(i * 7 + number));
    return entry;
}

std::vector<std::byte> bytesOf(OutputBatch& batch)
{
    std::vector<std::byte> bytes;
    for (const auto part : batch.parts())
        bytes.insert(bytes.end(), part.begin(), part.end());
    return bytes;
}

/// The same messages through the other door of the queue, which copies everything.
std::vector<std::byte> expected(const std::vector<OutputQueue::Entry>& entries)
{
    auto queue = makeQueue();
    for (const auto& entry : entries)
        queue.push(OutputQueue::Entry(entry));
    std::vector<std::byte> out;
    while (queue.appendNext(segmentSize, now, out)) {
    }
    return out;
}

bool lies(std::span<const std::byte> inner, std::span<const std::byte> outer)
{
    const std::less_equal<> before;
    return before(outer.data(), inner.data()) && before(inner.data() + inner.size(), outer.data() + outer.size());
}

} // namespace

class OutputBatchTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void longMessageLeavesFromItsOwnBuffer();
    void shortMessagesAreOnePart();
    void copiesAllWhereItMayNotRefer();
    void mixedMessagesComeInOrder();
    void messageOutlivesItsQueueUntilTheWriteIsOver();
    void clearedBatchBeginsAnew();
    void lentBytesLeaveFromWhereTheyLie_data();
    void lentBytesLeaveFromWhereTheyLie();
    void lentBytesAreHeldUntilTheWriteIsOver();
};

void OutputBatchTest::longMessageLeavesFromItsOwnBuffer()
{
    auto entry = entryOf(3 * segmentSize - 5);
    const std::vector<std::byte> wire = expected({entry});
    const std::span<const std::byte> own(entry.message.part.data(), entry.message.part.size());
    auto queue = makeQueue();
    queue.push(std::move(entry));
    OutputBatch batch(65536, true);
    while (queue.appendNext(segmentSize, now, batch)) {
    }
    QCOMPARE(batch.size(), wire.size());
    QVERIFY(bytesOf(batch) == wire);
    QCOMPARE(batch.parts().size(), std::size_t{6}); // a header and a body, three times
    for (std::size_t i = 0; i < 6; ++i) {
        QCOMPARE(batch.parts()[i].size() == headerSize, i % 2 == 0);
        QCOMPARE(lies(batch.parts()[i], own), i % 2 == 1);
    }
}

void OutputBatchTest::shortMessagesAreOnePart()
{
    auto queue = makeQueue();
    for (int i = 0; i < 10; ++i)
        queue.push(entryOf(60));
    OutputBatch batch(65536, true);
    while (queue.appendNext(segmentSize, now, batch)) {
    }
    QCOMPARE(batch.parts().size(), std::size_t{1});
    QCOMPARE(batch.size(), std::size_t{10 * (headerSize + 60)});
}

void OutputBatchTest::copiesAllWhereItMayNotRefer()
{
    const std::vector entries{entryOf(100), entryOf(2 * segmentSize)};
    auto queue = makeQueue();
    for (const auto& entry : entries)
        queue.push(OutputQueue::Entry(entry));
    OutputBatch batch(65536, false);
    while (queue.appendNext(segmentSize, now, batch)) {
    }
    QCOMPARE(batch.parts().size(), std::size_t{1});
    QVERIFY(bytesOf(batch) == expected(entries));
}

void OutputBatchTest::mixedMessagesComeInOrder()
{
    const std::vector entries{entryOf(10, 0x0202), entryOf(20000, 0x0241), entryOf(30, 0x0202), entryOf(5000, 0x0242), entryOf(0, 0x0202)};
    auto queue = makeQueue();
    for (const auto& entry : entries)
        queue.push(OutputQueue::Entry(entry));
    OutputBatch batch(65536, true);
    while (queue.appendNext(segmentSize, now, batch)) {
    }
    QVERIFY(batch.parts().size() > 1);
    QVERIFY(bytesOf(batch) == expected(entries));
}

/// AddressSanitizer sees it when it does not.
void OutputBatchTest::messageOutlivesItsQueueUntilTheWriteIsOver()
{
    const auto entry = entryOf(2 * segmentSize);
    const auto wire = expected({entry});
    OutputBatch batch(65536, true);
    {
        auto queue = makeQueue();
        queue.push(OutputQueue::Entry(entry));
        QVERIFY(queue.appendNext(segmentSize, now, batch));
        queue.discardApplication();              // it is given up while its first segment is being written
        QCOMPARE(queue.bytes(), std::size_t{1}); // the Abandon
    }
    const auto written = bytesOf(batch);
    QVERIFY(std::equal(written.begin(), written.end(), wire.begin()));
}

void OutputBatchTest::clearedBatchBeginsAnew()
{
    auto queue = makeQueue();
    OutputBatch batch(65536, true);
    QVERIFY(batch.empty() && batch.parts().empty());
    for (const std::size_t size : {std::size_t{40000}, std::size_t{10}, std::size_t{9000}}) {
        const auto entry = entryOf(size);
        queue.push(OutputQueue::Entry(entry));
        while (queue.appendNext(segmentSize, now, batch)) {
        }
        QVERIFY(bytesOf(batch) == expected({entry}));
        batch.clear();
        QVERIFY(batch.empty() && batch.parts().empty());
    }
}

namespace {

/// The end of `entry` lent, so that its own bytes are the first `own`.
OutputQueue::Entry lending(OutputQueue::Entry entry, std::size_t own)
{
    auto& part = entry.message.part;
    auto owner = std::make_shared<const std::vector<std::byte>>(part.begin() + static_cast<std::ptrdiff_t>(own), part.end());
    const std::span<const std::byte> bytes(*owner);
    entry.message.lent = std::make_shared<const LentBytes>(LentBytes{std::move(owner), bytes});
    part.resize(own);
    return entry;
}

} // namespace

void OutputBatchTest::lentBytesLeaveFromWhereTheyLie_data()
{
    QTest::addColumn<quint64>("own");
    QTest::addColumn<bool>("refers");
    for (const quint64 own : {0, 24, 5000, 16384, 20000})
        for (const bool refers : {true, false})
            QTest::addRow("%llu own, %s", static_cast<unsigned long long>(own), refers ? "refers" : "copies") << own << refers;
}

void OutputBatchTest::lentBytesLeaveFromWhereTheyLie()
{
    QFETCH(quint64, own);
    QFETCH(bool, refers);
    const auto entry = entryOf(50000);
    auto lent = lending(entry, own);
    const auto bytes = lent.message.lent->bytes;
    QCOMPARE(lent.message.size(), entry.message.size());
    auto queue = makeQueue();
    queue.push(std::move(lent));
    QCOMPARE(queue.bytes(), entry.message.size());
    OutputBatch batch(65536, refers);
    while (queue.appendNext(segmentSize, now, batch)) {
    }
    QCOMPARE(queue.bytes(), std::size_t{0});
    QCOMPARE(queue.left().bytes, std::uint64_t{50000});
    QVERIFY(bytesOf(batch) == expected({entry}));
    std::size_t referred = 0;
    for (const auto part : batch.parts())
        referred += lies(part, bytes) ? part.size() : 0;
    if (refers)
        QVERIFY(referred + OutputBatch::longBody > bytes.size());
    else
        QCOMPARE(referred, std::size_t{0});
}

void OutputBatchTest::lentBytesAreHeldUntilTheWriteIsOver()
{
    auto entry = lending(entryOf(2 * segmentSize), 24);
    const std::weak_ptr<const void> owner = entry.message.lent->owner;
    OutputBatch batch(65536, true);
    {
        auto queue = makeQueue();
        queue.push(std::move(entry));
        QVERIFY(queue.appendNext(segmentSize, now, batch));
        queue.discardApplication();
    }
    QVERIFY(!owner.expired());
    batch.clear();
    QVERIFY(owner.expired());
}

QTEST_APPLESS_MAIN(OutputBatchTest)
#include "output_batch_test.moc"
