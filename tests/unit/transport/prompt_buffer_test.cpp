// How much of a prompt connection the kernel may hold.
#include "transport/prompt_buffer.hpp"

#include <QTest>

using namespace liena::transport;
using namespace std::chrono_literals;

class PromptBufferTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void fitsThePath_data()
    {
        QTest::addColumn<int>("present");
        QTest::addColumn<int>("roundTrip"); // in microseconds
        QTest::addColumn<int>("least");
        QTest::addColumn<int>("unsent");
        QTest::addColumn<int>("next");
        const int kibi = 1024;
        QTest::newRow("a long path that is full") << 32 * kibi << 41'000 << 40'000 << 0 << 64 * kibi;
        QTest::newRow("and is still full") << 128 * kibi << 41'000 << 40'000 << 2'000 << 256 * kibi;
        QTest::newRow("never more than that") << 256 * kibi << 41'000 << 40'000 << 0 << 256 * kibi;
        QTest::newRow("in a room") << 32 * kibi << 900 << 200 << 0 << 64 * kibi;
        QTest::newRow("what waits is not on the wire yet") << 32 * kibi << 41'000 << 40'000 << 16 * kibi << 32 * kibi;
        QTest::newRow("a queue on a narrow path") << 32 * kibi << 90'000 << 20'000 << 0 << 32 * kibi;
        QTest::newRow("a queue where there was none") << 256 * kibi << 90'000 << 20'000 << 0 << 128 * kibi;
        QTest::newRow("a queue, and more that waits") << 64 * kibi << 90'000 << 20'000 << 64 * kibi << 32 * kibi;
    }

    void fitsThePath()
    {
        QFETCH(const int, present);
        QFETCH(const int, roundTrip);
        QFETCH(const int, least);
        QFETCH(const int, unsent);
        PathFacts facts;
        facts.roundTrip = std::chrono::microseconds(roundTrip);
        facts.leastRoundTrip = std::chrono::microseconds(least);
        facts.bytesUnsent = static_cast<std::uint32_t>(unsent);
        QTEST(PromptBuffer::next(present, facts, PromptBuffer::unsent), "next");
    }
};

QTEST_APPLESS_MAIN(PromptBufferTest)
#include "prompt_buffer_test.moc"
