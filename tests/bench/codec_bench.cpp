// Measures what a message costs between a program's variables and its bytes, beside the copy of a structure of the same size.
#include "protocol/byte_writer.hpp"
#include "protocol/crc32c.hpp"
#include "protocol/datagram_decoder.hpp"
#include "protocol/datagram_encoder.hpp"
#include "protocol/information_part.hpp"
#include "protocol/message_access.hpp"
#include "protocol/reassembler.hpp"
#include "protocol/safety_record.hpp"
#include "protocol/wire_layout.hpp"
#include "status_sample.hpp"

#include <benchmark/benchmark.h>

#include <array>
#include <cstring>
#include <span>
#include <vector>

using namespace liena;
using namespace liena::bench;
using namespace liena::protocol;

namespace {

constexpr DeviceId robot(0x00038610U);
constexpr DeviceId cockpit(0x40018208U);
constexpr std::uint16_t statusBytes = 41; // the fields of RobotStatus

/// Header and fields as they stand on the wire.
struct [[gnu::packed]] Frame {
    HeaderBytes header;
    std::uint32_t sequence;
    std::uint64_t uptime;
    Mode mode;
    bool engaged;
    bool referenced;
    std::array<float, 6> reals;
    std::uint16_t faults;
};

/// Into a buffer and back as a whole: no program does less.
void structCopy(benchmark::State& state)
{
    Frame from{};
    Frame to{};
    std::array<std::byte, sizeof(Frame)> wire{};
    for (auto _ : state) {
        benchmark::DoNotOptimize(from);
        std::memcpy(wire.data(), &from, sizeof from);
        benchmark::DoNotOptimize(wire);
        std::memcpy(&to, wire.data(), sizeof to);
        benchmark::DoNotOptimize(to);
    }
}
BENCHMARK(structCopy);

/// Twelve variables to their places in a buffer and back, and a header that is there already: what a program without any codec and without
/// any check does. Each is read as it was written: what is read wider than it was written waits for the writing.
void structFilledAndCopied(benchmark::State& state)
{
    Status from;
    Status to;
    HeaderBytes header{};
    Frame frame{};
    for (auto _ : state) {
        from.sequence ^= 1U;
        benchmark::DoNotOptimize(from);
        benchmark::DoNotOptimize(header);
        frame.header = header;
        frame.sequence = from.sequence;
        frame.uptime = from.uptime;
        frame.mode = from.mode;
        frame.engaged = from.engaged;
        frame.referenced = from.referenced;
        frame.reals = {from.guidewirePosition, from.guidewireVelocity, from.catheterPosition, from.catheterVelocity, from.force,
                       from.temperature};
        frame.faults = from.faults;
        benchmark::DoNotOptimize(frame);
        header = frame.header;
        to.sequence = frame.sequence;
        to.uptime = frame.uptime;
        to.mode = frame.mode;
        to.engaged = frame.engaged;
        to.referenced = frame.referenced;
        to.guidewirePosition = frame.reals[0];
        to.guidewireVelocity = frame.reals[1];
        to.catheterPosition = frame.reals[2];
        to.catheterVelocity = frame.reals[3];
        to.force = frame.reals[4];
        to.temperature = frame.reals[5];
        to.faults = frame.faults;
        benchmark::DoNotOptimize(to);
    }
    if (!(from == to))
        state.SkipWithError("came back otherwise");
}
BENCHMARK(structFilledAndCopied);

/// Fields where they lie in received bytes, read at the places of their definition as Message::get() reads them in its own bytes.
class WireFields {
public:
    WireFields(const MessageDefinition& definition, std::span<const std::byte> bytes)
        : m_slots(definition.layout.get()->slots()), m_bytes(bytes)
    {}

    template <typename T>
    T get(std::size_t field) const
    {
        return loadWhole<T>(m_bytes.data() + m_slots[field].offset);
    }

private:
    std::span<const FieldSlot> m_slots;
    std::span<const std::byte> m_bytes;
};

/// A set, one of its messages, and both ways between variables and bytes.
class Codec {
public:
    explicit Codec(std::string_view name) : m_set(statusSet()), m_message(m_set, *m_set->find(name)) {}

    const std::shared_ptr<const MessageSet>& set() const { return m_set; }
    Message& message() { return m_message; }
    std::span<const std::byte> wire() const { return m_wire; }

    void appendMessage() { append(m_message); }

    void append(const Message& message)
    {
        const auto fields = message.fieldBytes();
        DatagramHeader header{message.id(), cockpit, Timestamp{1}, static_cast<std::uint16_t>(fields.size()), false};
        header.message.origin = robot;
        const auto bytes = encodeHeader(header);
        m_wire.clear();
        ByteWriter(m_wire).append(std::span<const std::byte>(bytes)).append(fields);
    }

    void appendControl()
    {
        const auto fields = m_message.fieldBytes();
        DatagramHeader header{m_message.id(), robot, Timestamp{1}, static_cast<std::uint16_t>(safetyRecordSize + fields.size()), false};
        header.message.origin = cockpit;
        SafetyRecord record{7, 8, 9, 0};
        record.crc = safetyCrc(header, record, fields);
        const auto bytes = encodeHeader(header);
        const auto recordBytes = encodeSafetyRecord(record);
        m_wire.clear();
        ByteWriter(m_wire).append(std::span<const std::byte>(bytes)).append(std::span<const std::byte>(recordBytes)).append(fields);
    }

    /// Whether header and fields are what the definition allows.
    bool judge(const DatagramHeader& header, std::span<const std::byte> fields) const
    {
        return header.length == fields.size() && header.target == cockpit && !checkFields(*m_set->find(header.message.number), fields);
    }

    bool judge(std::span<const std::byte> wire) const { return judge(decodeHeader(wire.first<headerSize>()), wire.subspan(headerSize)); }

    Message received(const DatagramHeader& header, std::span<const std::byte> fields) const
    {
        auto made =
            MessageAccess::fromFields(m_set, *m_set->find(header.message.number), FieldBytes(fields.data(), fields.data() + fields.size()));
        MessageAccess::setMeta(made, header.message.origin, header.target, header.timestamp);
        return made;
    }

    Message received(std::span<const std::byte> wire) const
    {
        return received(decodeHeader(wire.first<headerSize>()), wire.subspan(headerSize));
    }

private:
    std::shared_ptr<const MessageSet> m_set;
    Message m_message;
    std::vector<std::byte> m_wire;
};

void statusSet12Fields(benchmark::State& state)
{
    Codec codec("RobotStatus");
    Status from;
    for (auto _ : state) {
        benchmark::DoNotOptimize(from);
        write(from, codec.message());
        benchmark::ClobberMemory();
    }
    if (codec.message().fault())
        state.SkipWithError("refused");
}
BENCHMARK(statusSet12Fields);

void statusGet12Fields(benchmark::State& state)
{
    Codec codec("RobotStatus");
    Status to;
    for (auto _ : state) {
        benchmark::ClobberMemory();
        read(codec.message(), to);
        benchmark::DoNotOptimize(to);
    }
}
BENCHMARK(statusGet12Fields);

void statusCheck(benchmark::State& state)
{
    Codec codec("RobotStatus");
    write(Status(), codec.message());
    codec.appendMessage();
    for (auto _ : state) {
        benchmark::ClobberMemory();
        benchmark::DoNotOptimize(codec.judge(codec.wire()));
    }
}
BENCHMARK(statusCheck);

/// One turn after the other with another number, so that what comes back is known to have come over the wire in that turn.
template <typename Turn>
void thereAndBack(benchmark::State& state, Turn turn)
{
    Status from;
    Status to;
    for (auto _ : state) {
        from.sequence ^= 1U;
        benchmark::DoNotOptimize(from);
        if (!turn(from, to))
            state.SkipWithError("refused");
        benchmark::DoNotOptimize(to);
    }
    if (!(from == to))
        state.SkipWithError("came back otherwise");
}

/// Variables to bytes with their header by Message::set(), and back with every check; read where they lie on the wire, without a Message.
void statusEncodeDecode(benchmark::State& state)
{
    Codec codec("RobotStatus");
    const auto& definition = codec.message().definition();
    thereAndBack(state, [&](const Status& from, Status& to) {
        write(from, codec.message());
        codec.appendMessage();
        benchmark::ClobberMemory();
        const auto wire = codec.wire();
        if (!codec.judge(wire))
            return false;
        read(WireFields(definition, wire.subspan(headerSize)), to);
        return true;
    });
}
BENCHMARK(statusEncodeDecode);

/// The same, with the Message that a receiver's program is handed made of the wire's bytes.
void statusEncodeDecodeMessage(benchmark::State& state)
{
    Codec codec("RobotStatus");
    thereAndBack(state, [&](const Status& from, Status& to) {
        write(from, codec.message());
        codec.appendMessage();
        benchmark::ClobberMemory();
        if (!codec.judge(codec.wire()))
            return false;
        read(codec.received(codec.wire()), to);
        return true;
    });
}
BENCHMARK(statusEncodeDecodeMessage);

/// What the aim is set for: a structure to bytes with their header, and from these bytes back with every check of a receiver.
void statusBoundEncodeDecode(benchmark::State& state)
{
    const auto set = statusSet();
    const auto binding = StatusBinding::to(set, "RobotStatus").value();
    const MessageId id{robot, binding.definition().number};
    struct {
        HeaderBytes header;
        std::array<std::byte, statusBytes> fields;
    } wire{};
    thereAndBack(state, [&](const Status& from, Status& to) {
        new (&wire.header) HeaderBytes(encodeHeader({id, cockpit, Timestamp{1}, statusBytes, false})); // in place
        if (!binding.encode(from, wire.fields))
            return false;
        benchmark::DoNotOptimize(wire);
        const auto header = decodeHeader(wire.header);
        return header.length == statusBytes && header.target == cockpit && set->find(header.message.number) == &binding.definition() &&
               binding.decode(wire.fields, to);
    });
}
BENCHMARK(statusBoundEncodeDecode);

/// The same without the header: what codecs do that have none.
void statusBoundFieldsOnly(benchmark::State& state)
{
    const auto binding = StatusBinding::to(statusSet(), "RobotStatus").value();
    std::array<std::byte, statusBytes> fields{};
    thereAndBack(state, [&](const Status& from, Status& to) {
        const bool written = binding.encode(from, fields);
        benchmark::DoNotOptimize(fields);
        return written && binding.decode(fields, to);
    });
}
BENCHMARK(statusBoundFieldsOnly);

/// What a program and its peer do between send() and subscription: the sender keeps its Message, the receiver is handed a new one.
void statusBoundMessage(benchmark::State& state)
{
    Codec codec("RobotStatus");
    const auto binding = StatusBinding::to(codec.set(), "RobotStatus").value();
    thereAndBack(state, [&](const Status& from, Status& to) {
        const bool written = binding.write(from, codec.message());
        codec.appendMessage();
        benchmark::ClobberMemory();
        return written && codec.judge(codec.wire()) && binding.read(codec.received(codec.wire()), to);
    });
}
BENCHMARK(statusBoundMessage);

/// The same with a new Message at both ends.
void statusBoundNewMessages(benchmark::State& state)
{
    Codec codec("RobotStatus");
    const auto binding = StatusBinding::to(codec.set(), "RobotStatus").value();
    thereAndBack(state, [&](const Status& from, Status& to) {
        Message message(codec.set(), binding.definition());
        const bool written = binding.write(from, message);
        codec.append(message);
        benchmark::ClobberMemory();
        return written && codec.judge(codec.wire()) && binding.read(codec.received(codec.wire()), to);
    });
}
BENCHMARK(statusBoundNewMessages);

void statusSetByName(benchmark::State& state)
{
    Codec codec("RobotStatus");
    float value = 1.5F;
    for (auto _ : state) {
        benchmark::DoNotOptimize(value);
        codec.message().set("catheter_velocity", value);
        benchmark::ClobberMemory();
    }
}
BENCHMARK(statusSetByName);

void messageMade(benchmark::State& state)
{
    const auto set = statusSet();
    const auto& definition = *set->find("RobotStatus");
    for (auto _ : state) {
        const Message message(set, definition);
        benchmark::DoNotOptimize(message.fieldBytes().data());
    }
}
BENCHMARK(messageMade);

/// A command with its safety record: made, written, and taken by the other end, which reads it where it lies on the wire.
void controlEncodeDecode(benchmark::State& state)
{
    Codec codec("MotionCommand");
    auto& message = codec.message();
    std::uint32_t sequence = 0;
    std::uint32_t heard = 0;
    float speed = 2.5F;
    for (auto _ : state) {
        benchmark::DoNotOptimize(speed);
        message.set(std::size_t{0}, 4U).set(1, ++sequence).set(2, true).set(3, speed).set(4, speed).set(5, speed).set(6, speed);
        codec.appendControl();
        benchmark::ClobberMemory();
        const auto wire = codec.wire();
        const auto header = decodeHeader(wire.first<headerSize>());
        const auto record = decodeSafetyRecord(wire.subspan<headerSize, safetyRecordSize>());
        const auto fields = wire.subspan(headerSize + safetyRecordSize);
        if (safetyCrc(header, record, fields) != record.crc || checkFields(message.definition(), fields))
            state.SkipWithError("refused");
        const WireFields taken(message.definition(), fields);
        heard = taken.get<std::uint32_t>(1);
        for (std::size_t field = 3; field < 7; ++field)
            if (taken.get<float>(field) != speed)
                state.SkipWithError("came back otherwise");
    }
    if (heard != sequence)
        state.SkipWithError("came back otherwise");
}
BENCHMARK(controlEncodeDecode);

/// From the bytes that a stream brought to the Message that is delivered. The sequence is changed on the wire from turn to turn.
void statusThroughDecoder(benchmark::State& state)
{
    Codec codec("RobotStatus");
    write(Status(), codec.message());
    codec.appendMessage();
    std::vector<std::byte> wire(codec.wire().begin(), codec.wire().end());
    PartialBudget budget;
    Reassembler reassembler(budget);
    DatagramDecoder decoder;
    std::uint32_t sequence = 0;
    Status to;
    for (auto _ : state) {
        store(wire.data() + headerSize, ++sequence);
        std::memcpy(decoder.writable().data(), wire.data(), wire.size());
        decoder.commit(wire.size());
        decoder.process([](const DatagramHeader&) { return HeaderVerdict::Take; },
                        [&](const DatagramHeader& header, std::span<const std::byte> body) {
                            const auto outcome = reassembler.take(header, body, 1000);
                            const bool taken = std::holds_alternative<Reassembler::Whole>(outcome) && codec.judge(header, body);
                            if (taken)
                                read(codec.received(header, body), to);
                            return taken;
                        });
        benchmark::DoNotOptimize(to);
    }
    Status expected;
    expected.sequence = sequence;
    if (!(to == expected))
        state.SkipWithError("came back otherwise");
}
BENCHMARK(statusThroughDecoder);

void crcOfBytes(benchmark::State& state)
{
    std::vector<std::byte> bytes(static_cast<std::size_t>(state.range(0)), std::byte{0x5A});
    for (auto _ : state) {
        benchmark::DoNotOptimize(bytes.data());
        benchmark::DoNotOptimize(crc32c(bytes));
    }
    state.SetBytesProcessed(state.iterations() * state.range(0));
}
BENCHMARK(crcOfBytes)->Arg(41)->Arg(1200)->Arg(32767);

} // namespace

BENCHMARK_MAIN();
