// Commands that are lost on the way count until a newer one is there.
#include "measure/command_row.hpp"

#include <QTest>

using namespace liena::compare;

class CommandRowTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void eachThatComesIsThereByItself()
    {
        CommandRow row;
        for (const auto number : {1, 2, 3}) {
            const auto& there = row.come({static_cast<std::uint64_t>(number), 2000 * number});
            QCOMPARE(there.size(), std::size_t(1));
            QCOMPARE(there.front().sentNs, std::int64_t(2000 * number));
        }
        QCOMPARE(row.missing(), std::uint64_t(0));
    }

    void newerOneTakesThePlaceOfThoseThatAreMissing()
    {
        CommandRow row;
        (void)row.come({1, 2000});
        const auto& there = row.come({4, 8300});
        QCOMPARE(there.size(), std::size_t(3));
        QCOMPARE(there[0].sentNs, std::int64_t(4100));
        QCOMPARE(there[1].sentNs, std::int64_t(6200));
        QCOMPARE(there[2].sentNs, std::int64_t(8300));
        QCOMPARE(row.missing(), std::uint64_t(2));
    }

    void whatComesAfterANewerOneChangesNothing()
    {
        CommandRow row;
        (void)row.come({1, 2000});
        (void)row.come({3, 6000});
        QVERIFY(row.come({2, 4000}).empty());
        QVERIFY(row.come({3, 6000}).empty());
        QCOMPARE(row.missing(), std::uint64_t(1));
    }

    void nobodyKnowsWhenThoseBeforeTheFirstWereDue()
    {
        CommandRow row;
        QCOMPARE(row.come({3, 6000}).size(), std::size_t(1));
        QCOMPARE(row.missing(), std::uint64_t(0));
    }
};

QTEST_APPLESS_MAIN(CommandRowTest)
#include "command_row_test.moc"
