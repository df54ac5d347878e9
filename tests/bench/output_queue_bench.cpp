// Measures the scheduler: what waits for a lane, pushed and taken in segments.
#include "status_sample.hpp"
#include "tasks/output_batch.hpp"
#include "tasks/output_queue.hpp"

#include <benchmark/benchmark.h>

using namespace liena;
using namespace liena::bench;
using namespace liena::tasks;

namespace {

constexpr std::size_t segment = 16 * 1024;

OutputQueue::Entry entryOf(const Message& message, Rank rank, std::uint32_t history)
{
    const auto fields = message.fieldBytes();
    OutputQueue::Entry entry;
    entry.message.header.message = {DeviceId(0x00038610U), message.definition().number};
    entry.message.header.target = DeviceId(0x40018208U);
    entry.message.part.assign(fields.data(), fields.data() + fields.size());
    entry.rank = rank;
    entry.history = history;
    entry.name = message.name();
    return entry;
}

OutputQueue emptyQueue()
{
    return {[](const OutputQueue::Entry&, OutputQueue::Fate) {},
            [](const protocol::DatagramHeader&) { return protocol::EncodedMessage(); }};
}

/// `range` messages wait, then all leave.
void pushAndAppend(benchmark::State& state)
{
    const auto set = statusSet();
    const Message message(set, *set->find("RobotStatus"));
    auto queue = emptyQueue();
    std::vector<std::byte> out;
    const auto now = std::chrono::steady_clock::now();
    for (auto _ : state) {
        for (std::int64_t i = 0; i < state.range(0); ++i)
            queue.push(entryOf(message, Rank::Status, 0));
        out.clear();
        while (queue.appendNext(segment, now, out)) {
        }
        benchmark::DoNotOptimize(out.data());
    }
    state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(pushAndAppend)->Arg(1)->Arg(16)->Arg(256);

/// A command takes the place of the one before it, behind `range` other kinds that wait.
void pushNewest(benchmark::State& state)
{
    const auto set = statusSet();
    const Message message(set, *set->find("MotionCommand"));
    auto queue = emptyQueue();
    for (std::int64_t i = 0; i < state.range(0); ++i) {
        auto other = entryOf(message, Rank::Control, 0);
        other.message.header.message.number = static_cast<std::uint16_t>(0x0110 + i);
        queue.push(std::move(other));
    }
    for (auto _ : state)
        benchmark::DoNotOptimize(queue.push(entryOf(message, Rank::Control, 1)));
}
BENCHMARK(pushNewest)->Arg(0)->Arg(16);

/// Frames of 512 KiB, one in each of `range` streams, which take turns segment by segment. They are lent, as an X-ray system lends them.
void framesInSegments(benchmark::State& state)
{
    auto queue = emptyQueue();
    OutputBatch out(segment + protocol::headerSize, true);
    const auto now = std::chrono::steady_clock::now();
    const auto pixels = std::make_shared<const std::vector<std::byte>>(512 * 1024);
    std::int64_t segments = 0;
    for (auto _ : state) {
        for (std::int64_t i = 0; i < state.range(0); ++i) {
            OutputQueue::Entry entry;
            entry.message.header.message.number = static_cast<std::uint16_t>(0x0200 + i);
            entry.message.lent = std::make_shared<const LentBytes>(LentBytes{pixels, *pixels});
            entry.rank = Rank::Bulk;
            queue.push(std::move(entry));
        }
        for (; queue.appendNext(segment, now, out); out.clear())
            ++segments;
    }
    state.SetItemsProcessed(segments);
}
BENCHMARK(framesInSegments)->Arg(1)->Arg(2)->Arg(4);

/// What a command costs that passes a frame between two of its segments.
void commandPassesAFrame(benchmark::State& state)
{
    const auto set = statusSet();
    const Message message(set, *set->find("MotionCommand"));
    auto queue = emptyQueue();
    std::vector<std::byte> out;
    const auto now = std::chrono::steady_clock::now();
    OutputQueue::Entry frame;
    frame.message.part.resize(512 * 1024, std::byte{0});
    frame.rank = Rank::Bulk;
    queue.push(std::move(frame));
    queue.appendNext(segment, now, out);
    for (auto _ : state) {
        queue.push(entryOf(message, Rank::Control, 1));
        out.clear();
        benchmark::DoNotOptimize(queue.appendNext(segment, now, out));
    }
}
BENCHMARK(commandPassesAFrame);

} // namespace

BENCHMARK_MAIN();
