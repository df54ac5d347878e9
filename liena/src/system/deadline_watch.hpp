// Raises "deadline missed" once per gap between messages that declare a deadline (protocol section 4).
#pragma once

#include "liena/message_set.hpp"

#include <chrono>
#include <cstdint>
#include <map>
#include <string>

namespace liena::system {

class DeadlineWatch {
public:
    using Instant = std::chrono::steady_clock::time_point;

    /// Keeps nothing of `definition`, whose set may be exchanged while the session lasts.
    void arrived(const MessageDefinition& definition, Instant now)
    {
        if (!definition.deadline)
            return;
        auto& stream = m_streams[definition.number];
        if (stream.name.empty())
            stream.name = definition.name;
        stream.deadline = *definition.deadline;
        stream.last = now;
        stream.told = false;
    }

    /// Calls `missed(number, name)` for each stream whose gap has become too long since the last call.
    template <typename Missed>
    void check(Instant now, Missed&& missed)
    {
        for (auto& [number, stream] : m_streams) {
            if (stream.told || now - stream.last <= stream.deadline)
                continue;
            stream.told = true;
            missed(number, stream.name);
        }
    }

    void reset() { m_streams.clear(); }

private:
    struct Stream {
        std::string name;
        std::chrono::nanoseconds deadline{};
        Instant last;
        bool told = false;
    };
    std::map<std::uint16_t, Stream> m_streams;
};

} // namespace liena::system
