// A value that knows when it was received, so that no stale number can look live.
#pragma once

#include "model/instant.hpp"

#include <cstdint>
#include <optional>
#include <utility>

namespace console {

enum class Freshness : std::uint8_t {
    Unknown, ///< never received
    Fresh,
    Stale, ///< received, and older than its limit
};

template <typename T>
struct Aged {
    T value{};
    std::optional<Instant> received; ///< nothing: the value was never received and must not be shown

    bool known() const { return received.has_value(); }

    /// Zero for a value that was never received: ask known() first.
    Duration age(Instant now) const { return received && now > *received ? Duration(now - *received) : Duration::zero(); }

    Freshness freshness(Instant now, Duration limit) const
    {
        if (!received)
            return Freshness::Unknown;
        return age(now) > limit ? Freshness::Stale : Freshness::Fresh;
    }

    void receive(T newValue, Instant at)
    {
        value = std::move(newValue);
        received = at;
    }

    void forget() { *this = {}; }
};

} // namespace console
