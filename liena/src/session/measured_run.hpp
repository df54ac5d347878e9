// The answering end of a measurement: what is granted, and nothing beyond it.
#pragma once

#include "liena/measurement.hpp"
#include "protocol/datagram.hpp"
#include "protocol/probe_words.hpp"
#include "session/instant.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace liena::session {

/// The lower of two limits where 0 is none.
template <typename T>
T lower(T a, T b)
{
    return a == 0 ? b : b == 0 ? a : std::min(a, b);
}

/// What may be used of `asked`.
MeasuringLimits grantOf(const MeasuringLimits& asked, const MeasuringBudget& budget, bool inUse);

/// Bytes per second: of a path that nothing has filled yet. Less than any that is meant for pictures, so that a tenth of it disturbs none.
inline constexpr double assumedBulkRate = 2.5e6;

/// In use: what of `bulkBytesPerSecond` may leave now. `bulkRate`: bytes per second that bulk to the peer is known to be carried at.
std::uint64_t shareOfPath(std::uint64_t bulkBytesPerSecond, const MeasuringBudget& budget, std::optional<double> bulkRate);

/// Why a device in use measures no second line: `line` is the peer whose line is being measured.
std::string oneAtATime(std::string_view line);

/// Fills at a rate, holds a tenth of a second of it, and may be overdrawn once.
class Allowance {
public:
    /// 0: without limit.
    void restart(double perSecond, Instant now);
    bool isLeft(Instant now);
    void spend(double amount) { m_left -= amount; }

private:
    double m_perSecond = 0;
    double m_left = 0;
    Instant m_filled{};
};

/// Pure; one per session. Of what the peer sends it lets pass what it was granted, and a run ends by itself.
class MeasuredRun {
public:
    /// `measured`: the peer to which a line of this device is being measured; in use that is Busy. Empty: to none.
    protocol::MeasureAnswer answer(const protocol::MeasureRequest& request, const MeasuringBudget& budget, bool inUse, Instant now,
                                   std::string_view measured = {});

    /// Whether this part of a probe may be read. What is decided for a message's first segment holds for its others.
    bool admits(std::uint8_t lane, const protocol::DatagramHeader& header, Instant now);

    /// Nothing for a probe that is of another run, or came another way than it says.
    std::optional<protocol::ProbeEcho> echoOf(const protocol::ProbeHead& probe, protocol::ProbeWay arrived);

    bool isRunning() const { return m_run != 0; }

    /// It runs, and its time is not over.
    bool isRunningAt(Instant now) const;

    /// What to tell the peer when it ends now though its time is not over; nothing when it goes on.
    std::optional<protocol::MeasureAnswer> endIfInUse(bool inUse);

    void end() { m_run = 0; }

private:
    struct Decision {
        Timestamp message; ///< the one that was decided on last
        bool admitted = false;
    };
    static constexpr std::size_t mostLanes = 9;

    std::uint32_t m_run = 0;
    bool m_inUse = false;
    Instant m_ends{};
    Allowance m_probes;
    Allowance m_bulk;
    std::array<Decision, mostLanes> m_decisions;
    std::array<std::uint32_t, 4> m_heard{}; ///< by way
};

} // namespace liena::session
