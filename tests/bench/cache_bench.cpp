// Measures the seam to the application: putting messages into the cache and draining it.
#include "cache/message_cache_access.hpp"
#include "protocol/message_access.hpp"
#include "status_sample.hpp"

#include <benchmark/benchmark.h>

using namespace liena;
using namespace liena::bench;

namespace {

/// `range` messages of one kind that are all kept, then one drain.
void putAndDrain(benchmark::State& state)
{
    const auto set = statusSet();
    const Message message(set, *set->find("RobotStatus"));
    MessageCache cache;
    for (auto _ : state) {
        for (std::int64_t i = 0; i < state.range(0); ++i)
            MessageCacheAccess::put(cache, message);
        benchmark::DoNotOptimize(cache.drain().messages.size());
    }
    state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(putAndDrain)->Arg(1)->Arg(16)->Arg(256);

/// The newest takes the place of the one before it.
void putNewest(benchmark::State& state)
{
    const auto set = statusSet();
    const Message message(set, *set->find("MotionCommand")); // history="1"
    MessageCache cache;
    for (auto _ : state)
        MessageCacheAccess::put(cache, message);
}
BENCHMARK(putNewest);

} // namespace

BENCHMARK_MAIN();
