// Observations as numbers for the hash, and as words for a person.
#include "observation.hpp"

#include <fmt/format.h>

namespace liena::simulation {

namespace {

/// Hands each field of an observation to `v(name, value)`.
struct Fields {
    void operator()(const Started& o, auto&& v) const { v("device", o.device); }
    void operator()(const Ended& o, auto&& v) const { v("device", o.device); }
    void operator()(const Requested& o, auto&& v) const
    {
        v("device", o.device), v("peer", o.peer), v("token", o.token), v("reopen", o.reopen), v("person", o.byPerson);
        v("incident", o.incident);
    }
    void operator()(const Entered& o, auto&& v) const
    {
        v("device", o.device), v("peer", o.peer), v("from", o.from), v("to", o.to), v("token", o.token);
    }
    void operator()(const Lost& o, auto&& v) const { v("device", o.device), v("peer", o.peer), v("incident", o.incident); }
    void operator()(const LaneTaken& o, auto&& v) const { v("device", o.device), v("peer", o.peer), v("token", o.attachToken); }
    void operator()(const Opened& o, auto&& v) const
    {
        v("device", o.device), v("peer", o.peer), v("token", o.token), v("reopened", o.reopened), v("healed", o.healed);
        v("epoch", o.epoch);
    }
    void operator()(const Revoked& o, auto&& v) const { v("device", o.device); }
    void operator()(const Raised& o, auto&& v) const
    {
        v("device", o.device), v("incident", o.incident), v("first", o.first), v("second", o.second);
    }
    void operator()(const Over& o, auto&& v) const
    {
        v("device", o.device), v("incident", o.incident), v("dismissed", o.dismissed), v("teller", o.teller);
    }
    void operator()(const Dismissed& o, auto&& v) const { v("device", o.device), v("incident", o.incident); }
    void operator()(const Composed& o, auto&& v) const
    {
        v("device", o.device), v("target", o.target), name(o.name, v), v("content", o.content);
    }
    void operator()(const Beat& o, auto&& v) const
    {
        v("device", o.device), v("target", o.target), v("state", o.state), v("epoch", o.epoch);
    }
    void operator()(const Kept& o, auto&& v) const
    {
        v("device", o.device), v("peer", o.peer), v("lane", o.lane), name(o.name, v), v("bytes", o.bytes);
    }
    void operator()(const Left& o, auto&& v) const { v("device", o.device), v("target", o.target), name(o.name, v); }
    void operator()(const Unsent& o, auto&& v) const { v("device", o.device), v("target", o.target), name(o.name, v), v("fate", o.fate); }
    void operator()(const Delivered& o, auto&& v) const
    {
        v("device", o.device), v("peer", o.peer), name(o.name, v), v("epoch", o.epoch), v("sequence", o.sequence);
        v("content", o.content);
    }
    void operator()(const Dropped& o, auto&& v) const
    {
        v("device", o.device), v("peer", o.peer), name(o.name, v), v("cause", o.cause.size());
    }
    void operator()(const Applied& o, auto&& v) const
    {
        v("device", o.device), v("owner", o.owner), name(o.name, v), v("engaged", o.engaged);
    }
    void operator()(const Drove& o, auto&& v) const { v("device", o.device), v("moving", o.moving), v("faster", o.faster); }
    void operator()(const Holdings& o, auto&& v) const
    {
        v("device", o.device), v("partial", o.partialBytes), v("queued", o.queuedBytes), v("incidents", o.incidents);
    }
    void operator()(const Settled& o, auto&& v) const
    {
        v("device", o.device), v("peer", o.peer), v("state", o.state), v("token", o.token), v("epoch", o.epoch);
    }
    void operator()(const Paused& o, auto&& v) const { v("device", o.device), v("paused", o.paused); }
    void operator()(const Lies& o, auto&& v) const { v("device", o.device); }

    static void name(const MessageName& name, auto&& v) { v("origin", name.origin), v("number", name.number), v("stamp", name.stamp); }
};

constexpr const char* kindNames[] = {"started",   "ended",   "requested", "entered",  "lost",  "lane-taken", "opened", "revoked",
                                     "raised",    "over",    "dismissed", "composed", "beat",  "left",       "unsent", "kept",
                                     "delivered", "dropped", "applied",   "drove",    "holds", "settled",    "paused", "lies"};
static_assert(std::size(kindNames) == std::variant_size_v<Observation>);

} // namespace

std::string describe(const Observation& observation)
{
    std::string line = kindNames[observation.index()];
    const auto add = [&](const char* field, auto value) {
        if constexpr (std::is_same_v<decltype(value), SessionState>)
            line += fmt::format(" {}={}", field, toString(value));
        else
            line += fmt::format(" {}={:x}", field, static_cast<std::uint64_t>(value));
    };
    std::visit([&](const auto& o) { Fields()(o, add); }, observation);
    if (const auto* dropped = std::get_if<Dropped>(&observation))
        line += fmt::format(" ({})", dropped->cause);
    return line;
}

void TraceHash::add(Instant at, const Observation& observation)
{
    ++m_count;
    mix(static_cast<std::uint64_t>(at.time_since_epoch().count()));
    mix(observation.index());
    const auto mixField = [this](const char* /*name*/, auto value) { mix(static_cast<std::uint64_t>(value)); };
    std::visit([&](const auto& o) { Fields()(o, mixField); }, observation);
}

} // namespace liena::simulation
