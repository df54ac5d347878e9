// What a queue keeps of its memory.
#include "base/ring.hpp"

#include <QTest>

using namespace liena::base;

namespace {

/// So many at once, and then none.
void burst(Ring<int>& ring, int count)
{
    for (int i = 0; i < count; ++i)
        append(ring, int{i});
    ring.erase_begin(ring.size());
    settle(ring);
}

} // namespace

class RingTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void memoryOfAShortBurstIsThereForTheNext()
    {
        Ring<int> ring;
        burst(ring, 255);
        const auto kept = ring.capacity();
        QVERIFY(kept >= 255);
        burst(ring, 255);
        QCOMPARE(ring.capacity(), kept);
    }

    void memoryOfALongBurstIsGivenBack()
    {
        Ring<int> ring;
        burst(ring, 5000);
        QVERIFY(ring.capacity() <= 256);
    }

    void nothingIsGivenBackWhileSomethingWaits()
    {
        Ring<int> ring;
        for (int i = 0; i < 5000; ++i)
            append(ring, int{i});
        settle(ring);
        QCOMPARE(ring.size(), std::size_t{5000});
        QCOMPARE(ring.back(), 4999);
    }
};

QTEST_APPLESS_MAIN(RingTest)
#include "ring_test.moc"
