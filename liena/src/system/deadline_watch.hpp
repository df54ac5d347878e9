// Raises "deadline missed" once per gap between messages that declare a deadline (protocol section 4).
#pragma once

#include "liena/message_set.hpp"

#include <chrono>
#include <cstdint>
#include <map>

namespace liena::system {

class DeadlineWatch {
public:
    using Instant = std::chrono::steady_clock::time_point;

    void arrived(const MessageDefinition& definition, Instant now)
    {
        if (definition.deadline)
            m_streams.insert_or_assign(definition.number, Stream{&definition, now, false});
    }

    /// Calls `missed(const MessageDefinition&)` for each stream whose gap has become too long since the last call.
    template <typename Missed>
    void check(Instant now, Missed&& missed)
    {
        for (auto& [number, stream] : m_streams) {
            if (stream.told || now - stream.last <= *stream.definition->deadline)
                continue;
            stream.told = true;
            missed(*stream.definition);
        }
    }

    void reset() { m_streams.clear(); }

private:
    struct Stream {
        const MessageDefinition* definition;
        Instant last;
        bool told;
    };
    std::map<std::uint16_t, Stream> m_streams;
};

} // namespace liena::system
