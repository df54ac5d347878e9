// How much of a prompt connection the kernel may hold.
#include "transport/prompt_buffer.hpp"

#include <QTest>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <deque>
#include <utility>

using namespace liena::transport;
using namespace std::chrono_literals;

namespace {

/// A path with a queue, and a sender that always has more: it writes whenever a third of its buffer is free, as the kernel lets it.
class VirtualPath {
public:
    using Instant = std::chrono::steady_clock::time_point;

    VirtualPath(double bytesPerSecond, std::chrono::microseconds roundTrip) : m_rate(bytesPerSecond)
    {
        m_facts.leastRoundTrip = roundTrip;
        m_facts.roundTrip = roundTrip;
    }

    void send(PatientBuffer& buffer, std::chrono::milliseconds during)
    {
        const auto end = m_now + during;
        fill(buffer);
        while (m_now < end) {
            acknowledge();
            if (underWay() <= room(buffer) * 2 / 3)
                fill(buffer);
        }
    }

    /// What was sent is acknowledged; then short messages go by themselves for a while.
    void rest(PatientBuffer& buffer)
    {
        buffer.pause();
        while (underWay() > 0)
            acknowledge();
        for (int i = 0; i < 20; ++i) {
            m_now += 1ms;
            sendPacket();
            acknowledge();
        }
    }

    void become(double bytesPerSecond) { m_rate = bytesPerSecond; }

    std::uint64_t acknowledged() const { return m_facts.bytesAcknowledged; }
    Instant now() const { return m_now; }

    /// In milliseconds: how long what is sent now would wait for what was sent before.
    double wait() const { return std::chrono::duration<double, std::milli>(std::max(m_free - m_now, 0ns)).count(); }

private:
    static constexpr std::uint64_t packet = 1448;

    struct Packet {
        Instant sent;
        Instant acknowledged;
    };

    static std::uint64_t room(const PatientBuffer& buffer) { return 2 * static_cast<std::uint64_t>(buffer.bytes()); }
    std::uint64_t underWay() const { return m_facts.bytesSent - m_facts.bytesAcknowledged; }

    /// What is full may become larger at once, and is filled again.
    void fill(PatientBuffer& buffer)
    {
        while (underWay() < room(buffer)) {
            while (underWay() < room(buffer))
                sendPacket();
            buffer.full(m_facts);
        }
    }

    void sendPacket()
    {
        const std::chrono::duration<double> takes(packet / m_rate);
        m_free = std::max(m_free, m_now) + std::chrono::duration_cast<std::chrono::nanoseconds>(takes);
        m_packets.push_back({m_now, m_free + m_facts.leastRoundTrip});
        m_facts.bytesSent += packet;
    }

    /// RFC 6298: the smoothed round trip moves by an eighth of each one.
    void acknowledge()
    {
        const auto [sent, acknowledged] = m_packets.front();
        m_packets.pop_front();
        m_now = std::max(m_now, acknowledged);
        m_facts.bytesAcknowledged += packet;
        m_facts.roundTrip += (m_now - sent - m_facts.roundTrip) / 8;
    }

    double m_rate;
    Instant m_now{};
    Instant m_free{}; ///< when all that was sent has left the queue
    std::deque<Packet> m_packets;
    PathFacts m_facts;
};

constexpr double megabits = 1e6 / 8;

} // namespace

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

    void whatMayBePassedKeepsThePathBusyAndTheQueueShort_data()
    {
        QTest::addColumn<double>("rate");        // Mbit/s
        QTest::addColumn<int>("roundTrip");      // in microseconds
        QTest::addColumn<double>("longestWait"); // in milliseconds
        QTest::addColumn<double>("leastUsed");
        QTest::newRow("a narrow path across a room") << 100.0 << 100 << 0.3 << 0.95;
        QTest::newRow("a wider one") << 400.0 << 100 << 0.2 << 0.95;
        QTest::newRow("a wide one") << 1000.0 << 100 << 0.2 << 0.95;
        QTest::newRow("across a building") << 1000.0 << 500 << 0.5 << 0.95;
        QTest::newRow("across a city") << 100.0 << 5'000 << 1.0 << 0.25;
        QTest::newRow("across a country") << 50.0 << 40'000 << 10.0 << 0.75;
    }

    void whatMayBePassedKeepsThePathBusyAndTheQueueShort()
    {
        QFETCH(const double, rate);
        QFETCH(const int, roundTrip);
        QFETCH(const double, longestWait);
        QFETCH(const double, leastUsed);
        VirtualPath path(rate * megabits, std::chrono::microseconds(roundTrip));
        PatientBuffer buffer;
        path.send(buffer, 1s);
        const auto before = path.acknowledged();
        const auto begin = path.now();
        double longest = 0;
        for (int i = 0; i < 1000; ++i) {
            path.send(buffer, 1ms);
            longest = std::max(longest, path.wait());
        }
        const double seconds = std::chrono::duration<double>(path.now() - begin).count();
        const double used = double(path.acknowledged() - before) / (rate * megabits * seconds);
        QVERIFY2(longest <= longestWait, qPrintable(QString::number(longest)));
        QVERIFY2(used >= leastUsed, qPrintable(QString::number(used)));
    }

    void whatIsPassedIsNoMoreWhereThePathBecomesNarrow()
    {
        VirtualPath path(1000 * megabits, 500us);
        PatientBuffer buffer;
        path.send(buffer, 100ms);
        QVERIFY(buffer.bytes() > PatientBuffer::smallest);
        path.become(20 * megabits);
        path.send(buffer, 200ms);
        QCOMPARE(buffer.bytes(), PatientBuffer::smallest);
        path.become(1000 * megabits);
        path.send(buffer, 100ms);
        QVERIFY(buffer.bytes() > PatientBuffer::smallest);
    }

    /// Else a path that rested would look like a slow one.
    void whileNothingWaitsNothingIsLearnt()
    {
        VirtualPath path(1000 * megabits, 500us);
        PatientBuffer buffer;
        path.send(buffer, 100ms);
        const int present = buffer.bytes();
        for (int i = 0; i < 5; ++i) {
            path.rest(buffer);
            path.send(buffer, 2ms);
            QVERIFY2(buffer.bytes() >= present * 2 / 3, qPrintable(QString::number(buffer.bytes())));
        }
    }
};

QTEST_APPLESS_MAIN(PromptBufferTest)
#include "prompt_buffer_test.moc"
