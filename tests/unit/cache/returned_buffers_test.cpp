// Buffers on their way back: bounded in number and in bytes, and only those that are worth it.
#include "cache/returned_buffers.hpp"

#include <QTest>

#include <thread>

using namespace liena;
using liena::cache::ReturnedBuffers;

namespace {

FieldBytes bufferOf(std::size_t bytes)
{
    FieldBytes buffer;
    buffer.resize(bytes);
    return buffer;
}

} // namespace

class ReturnedBuffersTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void givesBackTheSameMemoryFromAnotherThread();
    void keepsABoundedNumberOfBytes_data();
    void keepsABoundedNumberOfBytes();
};

void ReturnedBuffersTest::givesBackTheSameMemoryFromAnotherThread()
{
    ReturnedBuffers returned;
    auto buffer = bufferOf(1'000'000);
    const auto* memory = buffer.data();
    std::thread([&] { returned.put(std::move(buffer)); }).join();
    std::vector<FieldBytes> taken;
    returned.take(taken);
    QCOMPARE(taken.size(), std::size_t{1});
    QVERIFY(taken.front().data() == memory);
    taken.clear();
    returned.take(taken);
    QVERIFY(taken.empty());
}

void ReturnedBuffersTest::keepsABoundedNumberOfBytes_data()
{
    QTest::addColumn<std::size_t>("bytes");
    QTest::addColumn<std::size_t>("kept");
    QTest::newRow("small ones") << ReturnedBuffers::leastBytes - 1 << std::size_t{0};
    QTest::newRow("many") << std::size_t{100'000} << ReturnedBuffers::mostBuffers;
    QTest::newRow("huge ones") << std::size_t{5} * 1024 * 1024 << std::size_t{3};
}

void ReturnedBuffersTest::keepsABoundedNumberOfBytes()
{
    QFETCH(const std::size_t, bytes);
    QFETCH(const std::size_t, kept);
    ReturnedBuffers returned;
    std::vector<FieldBytes> taken;
    for (int round = 0; round < 2; ++round) { // what was taken counts no more
        for (std::size_t i = 0; i < 2 * ReturnedBuffers::mostBuffers; ++i)
            returned.put(bufferOf(bytes));
        returned.take(taken);
        QCOMPARE(taken.size(), kept);
        taken.clear();
    }
}

QTEST_APPLESS_MAIN(ReturnedBuffersTest)
#include "returned_buffers_test.moc"
