// How many threads work on bulk, and how many lanes it has: as many as the load needs, and not more for a moment's sake.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>

namespace liena::tasks {

/// Pure. A number between two bounds that grows as soon as more is wanted, and shrinks by one each time less was wanted for a while
/// without a break: load that comes and goes does not make it flap.
class ElasticCount {
public:
    using Instant = std::chrono::steady_clock::time_point;

    struct Bounds {
        std::size_t least = 0;
        std::size_t most = 0;
        std::chrono::nanoseconds quiet{}; ///< before it shrinks
    };

    explicit ElasticCount(Bounds bounds) : m_bounds(bounds), m_count(bounds.least) {}

    std::size_t want(std::size_t wanted, Instant now);
    std::size_t count() const { return m_count; }

private:
    Bounds m_bounds;
    std::size_t m_count;
    std::optional<Instant> m_less; ///< since then less was wanted
};

/// Pure. The worker threads of a device, for all its peers together.
///
///   none ── bulk takes a quarter of the network thread ──► one ── they are three quarters busy, and there are lanes for more ──► more
///   none ◄── a quiet while: bulk takes a twentieth ─────── one ◄── a quiet while: one less would be half busy ─────────────────── more
///
/// A lane is worked on by one thread at a time, since its bytes have an order: more threads than lanes are of no use.
class LoadBalancer {
public:
    using Instant = ElasticCount::Instant;

    /// Of the time since the last one.
    struct Sample {
        double network = 0;    ///< share of the network thread's time that bulk's bytes took
        double workers = 0;    ///< of all workers together, in threads: 1.5 are one and a half
        std::size_t lanes = 0; ///< that have something to send or receive
    };

    /// `most`: workers, of which there are never more than four anyhow.
    explicit LoadBalancer(std::size_t most);

    /// Workers from now on.
    std::size_t judge(const Sample& sample, Instant now);
    std::size_t workers() const { return m_workers.count(); }

private:
    std::size_t wanted(const Sample& sample) const;

    ElasticCount m_workers;
};

/// The bulk lanes to one peer: one for each stream that sends, within bounds.
ElasticCount laneCount();

} // namespace liena::tasks
