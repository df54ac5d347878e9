// The asking end of a measurement: what is to be sent when, and the figures of what came back.
#pragma once

#include "liena/measurement.hpp"
#include "protocol/session_messages.hpp"
#include "session/instant.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace liena::session {

/// Pure: time comes in, probes come out. Each phase runs for its duration and then waits a moment for the last echoes.
///
///   running ── duration over ──► waiting ── every echo heard, or a second over ──► next phase … over
///
/// A probe of a rhythm is stamped with the moment at which it was due: when this device is late, that counts as latency and no probe is
/// left out, also at the end of a phase; what is later than a second was withheld, and counts as that. What is under way is bounded, so a
/// path that does not carry what is asked withholds the rest at the source: prompt probes and images by their number, and images in a
/// rhythm or within a limit by what is due in a second, though not below four.
class LineProbing {
public:
    static constexpr std::uint32_t mostUnderWay = 1024; ///< of prompt probes, and of images

    struct Order {
        protocol::ProbeWay way = protocol::ProbeWay::Prompt;
        std::uint32_t sequence = 0;
        std::uint64_t sentNs = 0;
        std::uint32_t bytes = 0; ///< of padding
        Instant expires;         ///< then nobody waits for it any more
    };

    /// `limits` are those that both ends agreed to.
    LineProbing(MeasurementPlan plan, MeasuringLimits limits, Instant now);

    /// What is to be sent now, until there is nothing more.
    std::optional<Order> next(Instant now);

    /// When next() may have something again, unless an echo comes first.
    Instant wakeAt() const;

    void heard(const protocol::ProbeEcho& echo, Instant now);

    /// Another limit for images, from now on: the path was learnt, or has changed. What was sent is not taken back.
    void limitImages(std::uint64_t bytesPerSecond, Instant now);

    bool isOver() const { return m_phase == m_plan.size(); }

    /// Of the phases that ended.
    const std::vector<PhaseFigures>& figures() const { return m_figures; }

    /// The time that a plan takes at most.
    static Nanoseconds longest(const MeasurementPlan& plan);

private:
    struct Way {
        ProbeFigures figures;
        Nanoseconds period{};    ///< 0: as fast as echoes come
        std::uint32_t most = 0;  ///< under way
        std::uint32_t first = 0; ///< sequence of this phase
        std::uint32_t next = 0;
        std::uint32_t heardBefore = 0; ///< by the peer, in earlier phases
        std::uint32_t heardNow = 0;
        std::vector<bool> echoed;
        Instant due{};
        Instant firstSent{};

        bool isRhythm() const { return figures.asked.atOnce == 0; }
        std::uint32_t underWay() const { return next - first - static_cast<std::uint32_t>(figures.echoed); }
    };

    void begin(Instant now);
    void beginWay(Way& way, const ProbeStream& asked, double mostPerSecond, std::uint32_t most, Instant now);
    double mostImagesPerSecond(const ProbeStream& asked) const;
    /// Due before the phase ended, though this device was late.
    bool isOwed(const Way& way) const { return way.isRhythm() && way.due < m_phaseEnds; }
    void leaveOut(Way& way, Instant until);
    void endPhase();
    void advance(Instant now);
    std::optional<Order> nextOf(protocol::ProbeWay kind, Instant now);
    Way& wayOf(protocol::ProbeWay kind) { return m_ways[static_cast<std::size_t>(kind) - 1]; }

    MeasurementPlan m_plan;
    MeasuringLimits m_limits;
    std::size_t m_phase = 0;
    Instant m_phaseEnds{};
    std::array<Way, 3> m_ways; ///< prompt, packets, images
    std::vector<PhaseFigures> m_figures;
};

} // namespace liena::session
