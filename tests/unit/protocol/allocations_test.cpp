// The way of a message between a program's variables and its bytes takes no memory from the heap: every request is counted here.
#include "liena/message_binding.hpp"
#include "protocol/datagram_decoder.hpp"
#include "protocol/datagram_encoder.hpp"
#include "protocol/information_part.hpp"
#include "protocol/message_access.hpp"
#include "protocol/reassembler.hpp"
#include "protocol/safety_record.hpp"
#include "support/counting_new.hpp"
#include "support/sample_set.hpp"

#include <QTest>

#include <cstring>

using namespace liena;
using namespace liena::protocol;
using namespace liena::test;

namespace {

std::size_t requests = 0; // one thread

} // namespace

void liena::test::heapAsked(std::size_t /*bytes*/) { ++requests; }

namespace {

constexpr std::string_view twelveFieldsXml = R"(<message-set xmlns="urn:liena:message-set:1" name="twelve" version="1.0" class="hand"
    manufacturer="7" type="5" device-version="1" vendor="Sample" title="Twelve fields">
  <enum name="Mode" base="uint8"><value name="off" number="0"/><value name="moving" number="1"/><value name="special" number="9"/></enum>
  <message number="0x0201" name="RobotStatus" role="report" priority="status" title="State">
    <field name="sequence" type="uint32" title="1"/>
    <field name="uptime" type="uint64" title="2"/>
    <field name="mode" type="Mode" title="3"/>
    <field name="engaged" type="bool" title="4"/>
    <field name="offset" type="int16" min="-100" max="100" title="5"/>
    <field name="position_of_the_guidewire" type="float32" min="-2000" max="2000" title="6"/>
    <field name="velocity_of_the_guidewire" type="float32" min="-40" max="40" title="7"/>
    <field name="force" type="float64" min="-20" max="20" title="8"/>
    <field name="axes" type="float32[6]" min="-1" max="1" title="9"/>
    <field name="trace" type="int16[]" max-count="4" title="10"/>
    <field name="note" type="string" max-length="40" title="11"/>
    <field name="faults" type="uint16" min="0" max="9999" title="12"/>
  </message>
</message-set>)";

void fill(Message& status)
{
    constexpr std::array axes{0.25, 0.5, -0.5, 1.0, 0.0, -1.0};
    constexpr std::array trace{1.0, 2.0, 3.0};
    status.set(std::size_t{0}, 17U).set(1, std::uint64_t{1} << 40U).set(2, 9).set(3, true).set(4, -7).set(5, 812.5).set(6, -3.25F);
    status.set("force", 1.75).set("axes", axes).set("trace", trace).set("note", "a longer note than a string holds").set("faults", 3);
    status.set("mode", "moving").set("position_of_the_guidewire", 811);
}

/// What a receiver does with a stream, up to the message that it delivers; the sum is of what is read.
class Receiver {
public:
    explicit Receiver(std::shared_ptr<const MessageSet> set) : m_set(std::move(set)) {}

    template <typename Read>
    int receive(std::span<const std::byte> wire, Read read)
    {
        std::memcpy(m_decoder.writable().data(), wire.data(), wire.size());
        m_decoder.commit(wire.size());
        int delivered = 0;
        m_decoder.process([](const DatagramHeader&) { return HeaderVerdict::Take; },
                          [&](const DatagramHeader& header, std::span<const std::byte> part) {
                              delivered += deliver(header, part, read) ? 1 : 0;
                              return true;
                          });
        return delivered;
    }

private:
    template <typename Read>
    bool deliver(const DatagramHeader& header, std::span<const std::byte> part, Read read)
    {
        const auto* definition = m_set->find(header.message.number);
        const auto outcome = m_reassembler.take(header, part, definition->maximumSize());
        if (!std::holds_alternative<Reassembler::Whole>(outcome))
            return false;
        const auto fields = part.subspan(definition->recordSize());
        if (definition->recordSize() > 0) {
            const auto record = decodeSafetyRecord(part.first<safetyRecordSize>());
            if (safetyCrc(header, record, fields) != record.crc)
                return false;
        }
        if (checkFields(*definition, fields))
            return false;
        auto message = MessageAccess::fromFields(m_set, *definition, FieldBytes(fields.begin(), fields.end()));
        MessageAccess::setMeta(message, header.message.origin, header.target, header.timestamp);
        return read(message);
    }

    std::shared_ptr<const MessageSet> m_set;
    PartialBudget m_budget;
    Reassembler m_reassembler{m_budget};
    DatagramDecoder m_decoder;
};

void appendWire(Message& message, std::vector<std::byte>& wire)
{
    EncodedMessage encoded;
    encoded.header.message = {DeviceId(0x00038610U), message.definition().number};
    encoded.header.target = DeviceId(0x40018208U);
    encoded.header.timestamp = Timestamp{5};
    if (message.definition().recordSize() > 0) {
        SafetyRecord record{1, 2, 3, 0};
        record.crc = safetyCrc(encoded.header, record, message.fieldBytes());
        const auto bytes = encodeSafetyRecord(record);
        encoded.part.assign(bytes.begin(), bytes.end());
    }
    const auto fields = message.fieldBytes();
    encoded.part.insert(encoded.part.end(), fields.data(), fields.data() + fields.size());
    DatagramEncoder().appendSegment(encoded, maximumBody, wire);
}

} // namespace

class AllocationsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void countsRequests();
    void controlMessageNeedsNone();
    void statusOfTwelveFieldsNeedsNone();
    void boundStructureNeedsNone();
};

void AllocationsTest::countsRequests()
{
    const auto before = requests;
    auto text = std::make_unique<std::string>(100, 'x');
    QVERIFY(text->size() == 100);
    QCOMPARE(requests - before, std::size_t{2});
}

void AllocationsTest::controlMessageNeedsNone()
{
    const auto set = sampleSet();
    const auto& definition = *set->find("Move");
    Receiver receiver(set);
    std::vector<std::byte> wire;
    wire.reserve(1024);
    const auto before = requests;
    Message move(set, definition);
    move.set("permit", 4U).set("engaged", true).set("speed", 2.5).set("force", 3).set("mode", "fast").set(2, -2.5F);
    const bool sound = !move.fault();
    appendWire(move, wire);
    const auto delivered = receiver.receive(wire, [](const Message& heard) {
        return heard.get<float>("speed") == -2.5F && heard.get<bool>(1) && heard.get<std::string_view>("mode") == "fast";
    });
    QCOMPARE(requests - before, std::size_t{0});
    QVERIFY(sound);
    QCOMPARE(delivered, 1);
}

void AllocationsTest::statusOfTwelveFieldsNeedsNone()
{
    const auto set = MessageSet::parse(twelveFieldsXml, "twelve.xml").value();
    const auto& definition = *set->find("RobotStatus");
    QCOMPARE(definition.fields.size(), std::size_t{12});
    Receiver receiver(set);
    std::vector<std::byte> wire;
    wire.reserve(1024);
    const auto before = requests;
    Message status(set, definition);
    fill(status);
    const bool sound = !status.fault();
    appendWire(status, wire);
    appendWire(status, wire);
    const auto delivered = receiver.receive(wire, [](const Message& heard) {
        const auto moved = heard; // a copy for another thread
        return moved.get<double>("force") == 1.75 && moved.get<int>("faults") == 3 &&
               moved.get<std::uint64_t>(1) == std::uint64_t{1} << 40U && moved.get<std::string_view>("note").size() == 33 &&
               moved.get<int>("offset") == -7;
    });
    QCOMPARE(requests - before, std::size_t{0});
    QVERIFY(sound);
    QCOMPARE(delivered, 2);
}

void AllocationsTest::boundStructureNeedsNone()
{
    struct Part {
        std::uint8_t mode = 9; // beyond a gap: asked about in full
        float velocity = -3.25F;
        std::array<float, 6> axes{1, 0.5F, 0, -0.5F, -1, 0};
    };
    using Binding =
        MessageBinding<Part, Bind<"mode", &Part::mode>, Bind<"velocity_of_the_guidewire", &Part::velocity>, Bind<"axes", &Part::axes>>;
    const auto binding = Binding::to(MessageSet::parse(twelveFieldsXml, "twelve.xml").value(), "RobotStatus").value();
    std::vector<std::byte> fields(binding.size());
    Message status(binding.messageSet(), binding.definition());
    const Part from;
    Part to{0, 0, {}};
    const auto before = requests;
    bool sound = binding.encode(from, fields) && binding.decode(fields, to);
    sound &= binding.write(from, status) && binding.read(status, to);
    QCOMPARE(requests - before, std::size_t{0});
    QVERIFY(sound && to.mode == 9 && to.velocity == -3.25F && to.axes == from.axes);
}

QTEST_APPLESS_MAIN(AllocationsTest)
#include "allocations_test.moc"
