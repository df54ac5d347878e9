// The memory of partial messages: what is used, and the buffers that are used again.
#include "protocol/partial_budget.hpp"

#include <QTest>

using namespace liena;
using namespace liena::protocol;

class PartialBudgetTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void takesUpToItsLimit();
    void laneThatFillsUpLeavesAsMuchForOthers();
    void recycledBufferServesTheNextMessage();
    void shortBuffersAreNotKept();
    void muchTooLargeBufferIsNotTaken();
    void keepsNoMoreThanAQuarter();
    void spareBuffersMakeRoomForThoseInUse();
    void buffersThatNothingNeedsGo();
    void bufferThatIsNeededStays();
};

void PartialBudgetTest::takesUpToItsLimit()
{
    PartialBudget budget(100);
    for (int lane = 0; lane < 100; ++lane)
        QCOMPARE(budget.take(1, 0), lane < 99); // the hundredth would have more than is left
    QVERIFY(!budget.take(2, 0));
    budget.giveBack(99);
    QCOMPARE(budget.used(), std::size_t{0});
}

void PartialBudgetTest::laneThatFillsUpLeavesAsMuchForOthers()
{
    PartialBudget budget(90);
    std::size_t greedy = 0;
    while (budget.take(1, greedy))
        ++greedy;
    QCOMPARE(greedy, std::size_t{45});
    QVERIFY(!budget.take(23, 0) && budget.take(22, 0)); // another lane's message fits still
    budget.giveBack(22);
    std::size_t second = 0;
    while (budget.take(1, second) || budget.take(1, greedy))
        ++second;
    QVERIFY(budget.used() <= 68); // two leave a third, though the first came long before
    budget.giveBack(budget.used());
}

void PartialBudgetTest::recycledBufferServesTheNextMessage()
{
    PartialBudget budget;
    auto first = budget.buffer(1'000'000);
    QVERIFY(first.bytes.empty() && first.bytes.capacity() >= 1'000'000);
    const auto* place = first.bytes.data();
    first.bytes.resize(5);
    budget.release(first.room);
    QCOMPARE(budget.kept(), std::size_t{0});
    budget.recycle(std::move(first.bytes));
    const auto kept = budget.kept();
    QVERIFY(kept >= 1'000'000);
    const auto second = budget.buffer(990'000);
    QCOMPARE(second.bytes.data(), place);
    QVERIFY(second.bytes.empty());
    QCOMPARE(budget.kept(), kept); // as before, now in use
    budget.release(second.room);
    QCOMPARE(budget.kept(), std::size_t{0});
}

void PartialBudgetTest::shortBuffersAreNotKept()
{
    PartialBudget budget;
    QCOMPARE(budget.buffer(1000).room, std::size_t{0});
    budget.recycle(FieldBytes(1000));
    QCOMPARE(budget.kept(), std::size_t{0});
}

void PartialBudgetTest::muchTooLargeBufferIsNotTaken()
{
    PartialBudget budget;
    budget.recycle(FieldBytes(4'000'000));
    const auto kept = budget.kept();
    const auto buffer = budget.buffer(100'000);
    QVERIFY(buffer.bytes.capacity() < 1'000'000);
    QCOMPARE(budget.kept(), kept + buffer.room);
}

void PartialBudgetTest::keepsNoMoreThanAQuarter()
{
    PartialBudget budget(4'000'000);
    QCOMPARE(budget.buffer(1'000'001).room, std::size_t{0});
    const auto one = budget.buffer(600'000);
    QCOMPARE(one.room, std::size_t{600'000});
    QCOMPARE(budget.buffer(600'000).room, std::size_t{0}); // it grows as its bytes come
    QCOMPARE(budget.kept(), std::size_t{600'000});
    budget.recycle(FieldBytes(600'000)); // larger than an eighth
    QCOMPARE(budget.kept(), std::size_t{600'000});
}

void PartialBudgetTest::spareBuffersMakeRoomForThoseInUse()
{
    PartialBudget budget(4'000'000);
    budget.recycle(FieldBytes(400'000));
    budget.recycle(FieldBytes(400'000));
    QVERIFY(budget.kept() >= 800'000);
    const auto needed = budget.buffer(950'000);
    QCOMPARE(needed.room, std::size_t{950'000});
    QCOMPARE(budget.kept(), needed.room);
}

void PartialBudgetTest::buffersThatNothingNeedsGo()
{
    PartialBudget budget;
    budget.recycle(FieldBytes(1'000'000));
    budget.recycle(FieldBytes(2'000'000));
    std::chrono::steady_clock::time_point now{std::chrono::hours(1)};
    budget.trim(now);
    budget.trim(now + PartialBudget::idleAfter / 2);
    QVERIFY(budget.kept() >= 3'000'000); // the time is not over
    budget.trim(now += PartialBudget::idleAfter);
    QVERIFY(budget.kept() >= 2'000'000 && budget.kept() < 3'000'000); // one each time
    budget.trim(now += PartialBudget::idleAfter);
    QCOMPARE(budget.kept(), std::size_t{0});
    budget.trim(now + PartialBudget::idleAfter); // and nothing is no fault
}

void PartialBudgetTest::bufferThatIsNeededStays()
{
    PartialBudget budget;
    budget.recycle(FieldBytes(1'000'000));
    std::chrono::steady_clock::time_point now{std::chrono::hours(1)};
    for (int i = 0; i < 5; ++i) {
        budget.trim(now += PartialBudget::idleAfter);
        auto one = budget.buffer(900'000);
        QVERIFY(one.bytes.capacity() >= 900'000);
        budget.release(one.room);
        budget.recycle(std::move(one.bytes));
    }
    QVERIFY(budget.kept() >= 900'000);
}

QTEST_APPLESS_MAIN(PartialBudgetTest)
#include "partial_budget_test.moc"
