// Measures what a message costs between a program's variables and its bytes, beside the copy of a structure of the same size.
#include "protocol/byte_writer.hpp"
#include "protocol/crc32c.hpp"
#include "protocol/datagram_decoder.hpp"
#include "protocol/datagram_encoder.hpp"
#include "protocol/information_part.hpp"
#include "protocol/message_access.hpp"
#include "protocol/reassembler.hpp"
#include "protocol/safety_record.hpp"
#include "status_sample.hpp"

#include <benchmark/benchmark.h>

#include <array>
#include <cstring>
#include <vector>

using namespace liena;
using namespace liena::bench;
using namespace liena::protocol;

namespace {

constexpr DeviceId robot(0x00038610U);
constexpr DeviceId cockpit(0x40018208U);

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

/// From twelve variables through a structure into a buffer, and back: what a program without any codec does, without any check.
void structFilledAndCopied(benchmark::State& state)
{
    Status from;
    Status to;
    Frame frame{};
    std::array<std::byte, sizeof(Frame)> wire{};
    for (auto _ : state) {
        benchmark::DoNotOptimize(from);
        frame.sequence = from.sequence;
        frame.uptime = from.uptime;
        frame.mode = from.mode;
        frame.engaged = from.engaged;
        frame.referenced = from.referenced;
        frame.reals = {from.guidewirePosition, from.guidewireVelocity, from.catheterPosition, from.catheterVelocity, from.force,
                       from.temperature};
        frame.faults = from.faults;
        std::memcpy(wire.data(), &frame, sizeof frame);
        benchmark::DoNotOptimize(wire);
        std::memcpy(&frame, wire.data(), sizeof frame);
        benchmark::DoNotOptimize(frame);
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
}
BENCHMARK(structFilledAndCopied);

/// A set, one of its messages, and both ways between variables and bytes.
class Codec {
public:
    explicit Codec(std::string_view name) : m_set(statusSet()), m_message(m_set, *m_set->find(name)) {}

    Message& message() { return m_message; }
    const std::vector<std::byte>& wire() const { return m_wire; }

    void appendMessage()
    {
        const auto fields = m_message.fieldBytes();
        DatagramHeader header{m_message.id(), cockpit, Timestamp{1}, static_cast<std::uint16_t>(fields.size()), false};
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

    /// False when the bytes are not what the definition allows.
    bool judge(std::span<const std::byte> wire) const
    {
        const auto header = decodeHeader(wire.first<headerSize>());
        return header.length == wire.size() - headerSize && header.target == cockpit &&
               !checkFields(*m_set->find(header.message.number), wire.subspan(headerSize));
    }

    Message received(std::span<const std::byte> wire) const
    {
        const auto header = decodeHeader(wire.first<headerSize>());
        const auto fields = wire.subspan(headerSize);
        auto made =
            MessageAccess::fromFields(m_set, *m_set->find(header.message.number), FieldBytes(fields.data(), fields.data() + fields.size()));
        MessageAccess::setMeta(made, header.message.origin, header.target, header.timestamp);
        return made;
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

/// What the aim is set for: variables to bytes with their header, and back with every check.
void statusEncodeDecode(benchmark::State& state)
{
    Codec codec("RobotStatus");
    Status from;
    Status to;
    for (auto _ : state) {
        benchmark::DoNotOptimize(from);
        write(from, codec.message());
        codec.appendMessage();
        benchmark::ClobberMemory();
        if (!codec.judge(codec.wire()))
            state.SkipWithError("refused");
        read(codec.message(), to);
        benchmark::DoNotOptimize(to);
    }
    if (!(from == to))
        state.SkipWithError("came back otherwise");
}
BENCHMARK(statusEncodeDecode);

/// The same, with the Message that a receiver's program is handed.
void statusEncodeDecodeMessage(benchmark::State& state)
{
    Codec codec("RobotStatus");
    Status from;
    Status to;
    for (auto _ : state) {
        benchmark::DoNotOptimize(from);
        write(from, codec.message());
        codec.appendMessage();
        benchmark::ClobberMemory();
        if (!codec.judge(codec.wire()))
            state.SkipWithError("refused");
        read(codec.received(codec.wire()), to);
        benchmark::DoNotOptimize(to);
    }
    if (!(from == to))
        state.SkipWithError("came back otherwise");
}
BENCHMARK(statusEncodeDecodeMessage);

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

/// A command with its safety record: made, written, and taken by the other end.
void controlEncodeDecode(benchmark::State& state)
{
    Codec codec("MotionCommand");
    auto& message = codec.message();
    std::uint32_t sequence = 0;
    float speed = 2.5F;
    for (auto _ : state) {
        benchmark::DoNotOptimize(speed);
        message.set(std::size_t{0}, 4U).set(1, ++sequence).set(2, true).set(3, speed).set(4, speed).set(5, speed).set(6, speed);
        codec.appendControl();
        benchmark::ClobberMemory();
        const std::span<const std::byte> wire(codec.wire());
        const auto header = decodeHeader(wire.first<headerSize>());
        const auto record = decodeSafetyRecord(wire.subspan<headerSize, safetyRecordSize>());
        const auto fields = wire.subspan(headerSize + safetyRecordSize);
        if (safetyCrc(header, record, fields) != record.crc || checkFields(message.definition(), fields))
            state.SkipWithError("refused");
        for (std::size_t field = 3; field < 7; ++field)
            benchmark::DoNotOptimize(message.get<float>(field));
    }
}
BENCHMARK(controlEncodeDecode);

/// From the stream to the Message that is delivered.
void statusThroughDecoder(benchmark::State& state)
{
    Codec codec("RobotStatus");
    write(Status(), codec.message());
    codec.appendMessage();
    const std::vector<std::byte> wire = codec.wire();
    PartialBudget budget;
    Reassembler reassembler(budget);
    DatagramDecoder decoder;
    Status to;
    for (auto _ : state) {
        std::memcpy(decoder.writable().data(), wire.data(), wire.size());
        decoder.commit(wire.size());
        decoder.process([](const DatagramHeader&) { return HeaderVerdict::Take; },
                        [&](const DatagramHeader& header, std::span<const std::byte> body) {
                            const auto outcome = reassembler.take(header, body, 1000);
                            const bool taken = std::holds_alternative<Reassembler::Whole>(outcome) && codec.judge(wire);
                            if (taken)
                                read(codec.received(wire), to);
                            return taken;
                        });
        benchmark::DoNotOptimize(to);
    }
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
