// The line by which a running device is asked to measure: strictly read, and never a plan that fills the line.
#include "system/measure_order.hpp"

#include <QTest>

using namespace liena;
using namespace liena::system;

class MeasureOrderTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void readsAnOrder()
    {
        const auto order = MeasureOrder::parse("measure 0x00008208 20 500 32 7.500 524288");
        QVERIFY(order);
        QVERIFY(order.value().peer == DeviceId(0x00008208U));
        const auto plan = order.value().plan();
        QCOMPARE(plan.size(), std::size_t{2});
        for (const auto& phase : plan) {
            QCOMPARE(phase.duration, std::chrono::nanoseconds(std::chrono::seconds(20)));
            QCOMPARE(phase.prompt.perSecond, 500.0);
            QCOMPARE(phase.packets.perSecond, 500.0); // an equal part of what is asked for: nothing is slowed where nothing has a limit
            QCOMPARE(phase.prompt.bytes, 32U);
            QCOMPARE(phase.packets.bytes, 32U);
            for (const auto* stream : {&phase.prompt, &phase.packets, &phase.images})
                QCOMPARE(stream->atOnce, 0U); // none as fast as it goes
        }
        QVERIFY(!plan[0].images.isUsed());
        QCOMPARE(plan[1].images.perSecond, 7.5);
        QCOMPARE(plan[1].images.bytes, 524'288U);
    }

    void takesARateThatIsNoWholeNumber()
    {
        const auto order = MeasureOrder::parse("measure 0x00008208 20 2.5 32 7.5 524288");
        QVERIFY(order);
        for (const auto& phase : order.value().plan()) {
            QCOMPARE(phase.prompt.perSecond, 2.5);
            QCOMPARE(phase.packets.perSecond, 2.5);
        }
    }

    void refusesEverythingElse_data()
    {
        QTest::addColumn<QByteArray>("line");
        for (const char* line : {"",
                                 "measure",
                                 "measure 0x00008208",
                                 "measure 0x00008208 20 500 64 15",
                                 "measure 0x00008208 20 500 64 15 524288 1",
                                 "measure 0x00008208 20 500 64 15 524288 ",
                                 " measure 0x00008208 20 500 64 15 524288",
                                 "measure  0x00008208 20 500 64 15 524288",
                                 "measure robot 20 500 64 15 524288",
                                 "measure 0x00008208 0 500 64 15 524288",
                                 "measure 0x00008208 601 500 64 15 524288",
                                 "measure 0x00008208 -1 500 64 15 524288",
                                 "measure 0x00008208 20 0 64 15 524288",
                                 "measure 0x00008208 20 0.5 64 15 524288",
                                 "measure 0x00008208 20 nan 64 15 524288",
                                 "measure 0x00008208 20 inf 64 15 524288",
                                 "measure 0x00008208 20 10000.5 64 15 524288",
                                 "measure 0x00008208 20 10001 64 15 524288",
                                 "measure 0x00008208 20 500 -1 15 524288",
                                 "measure 0x00008208 20 500 1025 15 524288",
                                 "measure 0x00008208 20 500 64 15 0",
                                 "measure 0x00008208 20 500 64 15 8388609",
                                 "measure 0x00008208 20 500 64 -1 524288",
                                 "measure 0x00008208 20 500 64 nan 524288",
                                 "measure 0x00008208 20 500 64 inf 524288",
                                 "measure 0x00008208 20 500 64 1001 524288",
                                 "measure 0x00008208 20 500 64 15 99999999999999999999",
                                 "Measure 0x00008208 20 500 64 15 524288",
                                 "stop"})
            QTest::newRow(line) << QByteArray(line);
    }
    void refusesEverythingElse()
    {
        QFETCH(QByteArray, line);
        QVERIFY(!MeasureOrder::parse(line.toStdString()));
    }
};

QTEST_APPLESS_MAIN(MeasureOrderTest)
#include "measure_order_test.moc"
