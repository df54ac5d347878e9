// Attempts to connect a broken lane again fit the way.
#include "system/reconnect_limit.hpp"

#include <QTest>

using namespace liena::system;
using namespace std::chrono_literals;

class ReconnectLimitTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void isLongEnoughForTheWay_data();
    void isLongEnoughForTheWay();
    void isShortWhereTheWayIsNotKnown();
};

void ReconnectLimitTest::isLongEnoughForTheWay_data()
{
    QTest::addColumn<int>("roundTrip"); // ms
    QTest::addColumn<int>("limit");
    QTest::newRow("a room") << 1 << 250;
    QTest::newRow("a country") << 60 << 250;
    QTest::newRow("where 250 ms are no longer enough") << 125 << 500;
    QTest::newRow("a continent") << 150 << 600;
    QTest::newRow("a satellite") << 600 << 1000;
}

void ReconnectLimitTest::isLongEnoughForTheWay()
{
    QFETCH(const int, roundTrip);
    QFETCH(const int, limit);
    QCOMPARE(reconnectLimit(std::chrono::milliseconds(roundTrip)) / 1ms, std::chrono::milliseconds(limit) / 1ms);
}

void ReconnectLimitTest::isShortWhereTheWayIsNotKnown() { QCOMPARE(reconnectLimit(std::nullopt) / 1ms, 250ms / 1ms); }

QTEST_APPLESS_MAIN(ReconnectLimitTest)
#include "reconnect_limit_test.moc"
