// Measures the codecs of OpenIGTLink and protobuf with twelve numbers, for comparison with codec_bench.
#include "status_sample.hpp"

#ifdef LIENA_BENCH_OPENIGTLINK
#include <igtlSensorMessage.h>
#endif
#ifdef LIENA_BENCH_PROTOBUF
#include "status.pb.h"
#endif

#include <benchmark/benchmark.h>

#include <array>
#include <cstring>

using namespace liena::bench;

namespace {

#ifdef LIENA_BENCH_OPENIGTLINK
constexpr unsigned sensors = 12;

std::array<double, sensors> numbersOf(const Status& s)
{
    return {double(s.sequence),  double(s.uptime),   double(s.mode),     double(s.engaged), double(s.referenced), s.guidewirePosition,
            s.guidewireVelocity, s.catheterPosition, s.catheterVelocity, s.force,           s.temperature,        double(s.faults)};
}

/// SENSOR with twelve values: its own message for readings.
struct SensorPair {
    igtl::SensorMessage::Pointer sent = igtl::SensorMessage::New();
    igtl::MessageHeader::Pointer header = igtl::MessageHeader::New();
    igtl::SensorMessage::Pointer heard = igtl::SensorMessage::New();

    SensorPair()
    {
        sent->SetDeviceName("robot");
        sent->SetLength(sensors);
    }

    /// From the numbers to the wire, with header and CRC, and back.
    bool exchange(const std::array<double, sensors>& numbers) const
    {
        for (unsigned i = 0; i < sensors; ++i)
            sent->SetValue(i, numbers[i]);
        sent->Pack();
        header->InitPack();
        std::memcpy(header->GetPackPointer(), sent->GetPackPointer(), static_cast<std::size_t>(header->GetPackSize()));
        header->Unpack();
        heard->SetMessageHeader(header);
        heard->AllocatePack();
        std::memcpy(heard->GetPackBodyPointer(), sent->GetPackBodyPointer(), static_cast<std::size_t>(heard->GetPackBodySize()));
        return (heard->Unpack(1) & igtl::MessageHeader::UNPACK_BODY) != 0;
    }
};

template <typename PairOfTurn>
void exchangeSensors(benchmark::State& state, PairOfTurn pairOfTurn)
{
    Status from;
    double sum = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(from);
        const auto numbers = numbersOf(from);
        decltype(auto) pair = pairOfTurn();
        if (!pair.exchange(numbers))
            state.SkipWithError("refused");
        for (unsigned i = 0; i < sensors; ++i)
            benchmark::DoNotOptimize(sum = pair.heard->GetValue(i));
        from.faults = static_cast<std::uint16_t>((from.faults + 1) % 9999);
        if (pair.heard->GetValue(sensors - 1) != numbers[sensors - 1])
            state.SkipWithError("came back otherwise");
    }
}

/// Every object is kept from turn to turn, as a careful program does.
void openIgtLink(benchmark::State& state)
{
    const SensorPair kept;
    exchangeSensors(state, [&]() -> const SensorPair& { return kept; });
}
BENCHMARK(openIgtLink);

/// Every object is new in each turn, as in its examples.
void openIgtLinkNew(benchmark::State& state)
{
    exchangeSensors(state, [] { return SensorPair(); });
}
BENCHMARK(openIgtLinkNew);
#endif

#ifdef LIENA_BENCH_PROTOBUF
void fill(const Status& s, wire::Status& message)
{
    message.set_sequence(s.sequence);
    message.set_uptime(s.uptime);
    message.set_mode(static_cast<wire::Mode>(s.mode));
    message.set_engaged(s.engaged);
    message.set_referenced(s.referenced);
    message.set_guidewire_position(s.guidewirePosition);
    message.set_guidewire_velocity(s.guidewireVelocity);
    message.set_catheter_position(s.catheterPosition);
    message.set_catheter_velocity(s.catheterVelocity);
    message.set_force(s.force);
    message.set_temperature(s.temperature);
    message.set_faults(s.faults);
}

void take(const wire::Status& message, Status& s)
{
    s.sequence = message.sequence();
    s.uptime = message.uptime();
    s.mode = static_cast<Mode>(message.mode());
    s.engaged = message.engaged();
    s.referenced = message.referenced();
    s.guidewirePosition = message.guidewire_position();
    s.guidewireVelocity = message.guidewire_velocity();
    s.catheterPosition = message.catheter_position();
    s.catheterVelocity = message.catheter_velocity();
    s.force = message.force();
    s.temperature = message.temperature();
    s.faults = static_cast<std::uint16_t>(message.faults());
}

/// No header, no bounds, no check sum: fields to bytes and back.
bool exchange(const Status& from, wire::Status& sent, wire::Status& heard, Status& to)
{
    std::array<char, 256> bytes;
    fill(from, sent);
    const auto size = static_cast<int>(sent.ByteSizeLong());
    sent.SerializeWithCachedSizesToArray(reinterpret_cast<std::uint8_t*>(bytes.data()));
    benchmark::DoNotOptimize(bytes.data());
    benchmark::ClobberMemory();
    if (!heard.ParseFromArray(bytes.data(), size))
        return false;
    take(heard, to);
    return true;
}

template <typename Turn>
void exchangeStatus(benchmark::State& state, Turn turn)
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

/// Both messages are kept from turn to turn.
void protobuf(benchmark::State& state)
{
    wire::Status sent;
    wire::Status heard;
    exchangeStatus(state, [&](const Status& from, Status& to) { return exchange(from, sent, heard, to); });
}
BENCHMARK(protobuf);

/// Both messages are new in each turn.
void protobufNew(benchmark::State& state)
{
    exchangeStatus(state, [](const Status& from, Status& to) {
        wire::Status sent;
        wire::Status heard;
        return exchange(from, sent, heard, to);
    });
}
BENCHMARK(protobufNew);
#endif

} // namespace

BENCHMARK_MAIN();
