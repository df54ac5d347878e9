// What a baseline asks of the kernel for long lines.
#include "measure/send_buffer.hpp"

#include <QTest>

using namespace liena::compare;

class SendBufferTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void asksForMoreThanTheKernelGivesByItself()
    {
        QCOMPARE(sendBufferWorthAsking(4'194'304, 4'194'304), std::optional(4'194'304)); // of which it takes the double
        QCOMPARE(sendBufferWorthAsking(2'097'153, 4'194'304), std::optional(2'097'153));
    }

    void asksForNothingWhereItWouldGetLess()
    {
        QVERIFY(!sendBufferWorthAsking(212'992, 4'194'304));
        QVERIFY(!sendBufferWorthAsking(2'097'152, 4'194'304));
        QVERIFY(!sendBufferWorthAsking(4'194'304, 0)); // not known
        QVERIFY(!sendBufferWorthAsking(0, 4'194'304));
    }
};

QTEST_APPLESS_MAIN(SendBufferTest)
#include "send_buffer_test.moc"
