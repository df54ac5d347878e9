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
        const auto order = MeasureOrder::parse("measure 0x00008208 20 500 524288 7.500");
        QVERIFY(order);
        QVERIFY(order.value().peer == DeviceId(0x00008208U));
        const auto plan = order.value().plan();
        QCOMPARE(plan.size(), std::size_t{2});
        for (const auto& phase : plan) {
            QCOMPARE(phase.duration, std::chrono::nanoseconds(std::chrono::seconds(20)));
            QCOMPARE(phase.prompt.perSecond, 500.0);
            for (const auto* stream : {&phase.prompt, &phase.packets, &phase.images})
                QCOMPARE(stream->atOnce, 0U); // none as fast as it goes
        }
        QVERIFY(!plan[0].images.isUsed());
        QCOMPARE(plan[1].images.perSecond, 7.5);
        QCOMPARE(plan[1].images.bytes, 524'288U);
    }

    void refusesEverythingElse_data()
    {
        QTest::addColumn<QByteArray>("line");
        for (const char* line : {"",
                                 "measure",
                                 "measure 0x00008208",
                                 "measure 0x00008208 20 500 524288",
                                 "measure 0x00008208 20 500 524288 15 1",
                                 "measure 0x00008208 20 500 524288 15 ",
                                 " measure 0x00008208 20 500 524288 15",
                                 "measure  0x00008208 20 500 524288 15",
                                 "measure robot 20 500 524288 15",
                                 "measure 0x00008208 0 500 524288 15",
                                 "measure 0x00008208 601 500 524288 15",
                                 "measure 0x00008208 -1 500 524288 15",
                                 "measure 0x00008208 20 0 524288 15",
                                 "measure 0x00008208 20 10001 524288 15",
                                 "measure 0x00008208 20 500 0 15",
                                 "measure 0x00008208 20 500 8388609 15",
                                 "measure 0x00008208 20 500 524288 -1",
                                 "measure 0x00008208 20 500 524288 nan",
                                 "measure 0x00008208 20 500 524288 inf",
                                 "measure 0x00008208 20 500 524288 1001",
                                 "measure 0x00008208 20 500 99999999999999999999 15",
                                 "Measure 0x00008208 20 500 524288 15",
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
