// Frames of two streams are told apart by their numbers.
#include "measure/stamp.hpp"

#include <QTest>

using namespace liena::compare;

class StampTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void eachStreamCountsByItself_data()
    {
        QTest::addColumn<quint64>("stream");
        QTest::addColumn<quint64>("count");
        for (quint64 stream = 0; stream < mostStreams; ++stream)
            for (const quint64 count : {0, 1, 75}) // 0: while warming up
                QTest::addRow("frame %d of stream %d", static_cast<int>(count), static_cast<int>(stream)) << stream << count;
    }

    void eachStreamCountsByItself()
    {
        QFETCH(quint64, stream);
        QFETCH(quint64, count);
        const Stamp frame{frameNumber(stream, count), 2000};
        QCOMPARE(quint64(streamOf(frame)), stream);
        QCOMPARE(quint64(countOf(frame)), count);
    }

    void aSingleStreamsNumbersAreItsCounts() { QCOMPARE(frameNumber(0, 75), std::uint64_t(75)); }
};

QTEST_APPLESS_MAIN(StampTest)
#include "stamp_test.moc"
