// How much the kernel may hold of what a command may pass.
#include "transport/patient_buffer.hpp"

#include <QTest>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <deque>

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

class PatientBufferTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void keepsThePathBusyAndTheQueueShort_data()
    {
        QTest::addColumn<double>("rate");        // Mbit/s
        QTest::addColumn<int>("roundTrip");      // in microseconds
        QTest::addColumn<double>("longestWait"); // in milliseconds
        QTest::addColumn<double>("leastUsed");
        QTest::newRow("a narrow path across a room") << 100.0 << 100 << 0.3 << 0.95;
        QTest::newRow("a wider one") << 400.0 << 100 << 0.3 << 0.95;
        QTest::newRow("a wide one") << 1000.0 << 100 << 0.2 << 0.95;
        QTest::newRow("across a building") << 1000.0 << 500 << 0.5 << 0.95;
        QTest::newRow("across a city") << 100.0 << 5'000 << 1.0 << 0.25;
        QTest::newRow("across a country") << 50.0 << 40'000 << 12.0 << 0.75;
    }

    void keepsThePathBusyAndTheQueueShort()
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

    void isSmallWhereThePathBecomesNarrow()
    {
        VirtualPath path(1000 * megabits, 500us);
        PatientBuffer buffer;
        path.send(buffer, 100ms);
        QVERIFY(buffer.bytes() > 2 * PatientBuffer::smallestOn(500us));
        path.become(20 * megabits);
        path.send(buffer, 200ms);
        QCOMPARE(buffer.bytes(), PatientBuffer::smallestOn(500us));
        path.become(1000 * megabits);
        path.send(buffer, 100ms);
        QVERIFY(buffer.bytes() > 2 * PatientBuffer::smallestOn(500us));
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

    /// What others queue, and a path's unrest, must not take the room of commands under way.
    void longWayKeepsRoomForCommandsWhateverItsRoundTripsSay()
    {
        PatientBuffer buffer;
        PathFacts facts;
        facts.leastRoundTrip = 20ms;
        facts.roundTrip = 40ms;
        for (int i = 1; i <= 20; ++i) {
            facts.bytesSent = facts.bytesAcknowledged = static_cast<std::uint64_t>(i) * 100'000;
            buffer.full(facts);
        }
        QCOMPARE(buffer.bytes(), PatientBuffer::smallestOn(20ms));
        QVERIFY(2 * buffer.bytes() * 2 / 3 > 20 * 1300); // a command a millisecond, as the kernel counts it
    }

    void smallestGrowsWithTheWay()
    {
        QCOMPARE(PatientBuffer::smallestOn(0ms), PatientBuffer::smallest);
        QCOMPARE(PatientBuffer::smallestOn(6ms), PatientBuffer::smallest + 6 * 1152);
        QCOMPARE(PatientBuffer::smallestOn(80ms), PromptBuffer::smallest);
    }
};

QTEST_APPLESS_MAIN(PatientBufferTest)
#include "patient_buffer_test.moc"
