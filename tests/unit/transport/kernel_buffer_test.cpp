// What the kernel is told of a connection whose messages must not wait.
#include "transport/kernel_buffer.hpp"

#include <QTest>

#include <cstdint>

using namespace liena::transport;
using namespace std::chrono_literals;

namespace {

/// A way of 40 ms, all of whose room is under way, and none of it in a queue.
PathFacts fullLongWay(std::uint64_t acknowledged)
{
    PathFacts facts;
    facts.leastRoundTrip = 40ms;
    facts.roundTrip = 40ms;
    facts.bytesSent = acknowledged + 30'000;
    facts.bytesAcknowledged = acknowledged;
    return facts;
}

} // namespace

class KernelBufferTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void kernelChoosesUntilItBegins()
    {
        KernelBuffer buffer;
        QVERIFY(!buffer.isOurs());
        QVERIFY(!buffer.fit(Urgency::Urgent));
        QVERIFY(!buffer.fit(Urgency::Patient));
        QCOMPARE(buffer.begin(PromptBuffer::unsent), PromptBuffer::smallest);
        QVERIFY(buffer.isOurs());
    }

    void kernelIsToldWhatIsNewOnly()
    {
        KernelBuffer buffer;
        buffer.begin(PromptBuffer::unsent);
        QVERIFY(!buffer.fit(Urgency::Urgent));
        QVERIFY(buffer.fit(Urgency::Patient) == PatientBuffer::smallest);
        QVERIFY(!buffer.fit(Urgency::Patient));
        QVERIFY(buffer.fit(Urgency::Urgent) == PromptBuffer::smallest);
        QVERIFY(!buffer.fit(Urgency::Urgent));
    }

    void eachKindHasASizeOfItsOwn()
    {
        KernelBuffer buffer;
        buffer.begin(PromptBuffer::unsent);
        buffer.full(Urgency::Urgent, fullLongWay(0));
        QVERIFY(buffer.fit(Urgency::Urgent) == 2 * PromptBuffer::smallest);
        QVERIFY(buffer.fit(Urgency::Patient) == PatientBuffer::smallest);
    }

    /// Else a command would find less room than what it passes.
    void urgentNeverHasLessThanPatient()
    {
        KernelBuffer buffer;
        buffer.begin(PromptBuffer::unsent);
        for (std::uint64_t acknowledged = 0; acknowledged < 3'000'000; acknowledged += 40'000)
            buffer.full(Urgency::Patient, fullLongWay(acknowledged));
        QVERIFY(buffer.fit(Urgency::Patient) == PatientBuffer::largest);
        QVERIFY(!buffer.fit(Urgency::Urgent));
        QVERIFY(buffer.patientWrite() > KernelBuffer().patientWrite());
    }
};

QTEST_APPLESS_MAIN(KernelBufferTest)
#include "kernel_buffer_test.moc"
