// Measuring the line to one peer inside its session: asking, answering, and the probes both ways.
#pragma once

#include "liena/distributed_system.hpp"
#include "liena/measurement.hpp"
#include "protocol/datagram.hpp"
#include "protocol/probe_words.hpp"
#include "session/line_probing.hpp"
#include "session/measured_run.hpp"
#include "system/module_host.hpp"
#include "tasks/path_rate.hpp"
#include "transport/timer.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace liena::system {

/// Network thread. Nothing of a measurement touches the session: it waits behind every command, is dropped where it was not granted, and
/// is over with the session.
class LineMeasurement {
public:
    struct Ways {
        /// On lane 0 behind control; at most `history` of its number wait there.
        std::function<void(const protocol::SessionMessage&, std::uint32_t history)> prompt;
        std::function<bool(const protocol::SessionMessage&)> packet; ///< false where there is no way by UDP
        std::function<void(const protocol::ProbeHead&, LentBytes padding, session::Instant expires)> image;
        std::function<std::optional<tasks::KnownRate>()> bulkRate; ///< that the path to the peer carries
        std::function<std::uint64_t()> bulkLeft;                   ///< bytes of the application's bulk that left whole
        std::function<bool()> bulkWaits;                           ///< some that has not
    };

    LineMeasurement(ModuleHost& host, std::string peer, Ways ways);

    /// Measures; `done` hears how it went, on this thread. Busy: this line is being measured, or this device is in use and another one is.
    Result<void> start(MeasurementPlan plan, DistributedSystem::MeasurementHandler done);

    /// Ends what was started here; `done` hears `why` with the phases that were measured.
    void stop(const std::string& why);

    /// How many of this line go on: one that was asked for here, one that is answered.
    int running() const;

    /// Whether this part of a probe is read; it is dropped otherwise.
    bool admits(std::uint8_t lane, const protocol::DatagramHeader& header);

    /// While the session carries messages.
    void heard(const protocol::MeasureRequest& request);
    void heard(const protocol::MeasureAnswer& answer);

    /// False when it belongs to no measurement, or is none.
    bool heardProbe(protocol::ProbeWay arrived, std::span<const std::byte> part);
    bool heardEcho(const protocol::ProbeEcho& echo);

    /// The session carries no messages any more.
    void sessionEnded();

    /// From time to time: a device that comes into use is not measured any more, or on one line alone where the peer was in use already;
    /// and one in use leaves a path that narrows alone.
    void housekeeping();

private:
    struct Asked {
        std::uint32_t run = 0;
        MeasurementPlan plan;
        DistributedSystem::MeasurementHandler done;
        MeasuringLimits agreed; ///< asked for, then those of both ends
        MeasuringLimits limits; ///< the least that was in force
        bool inUse = false;
        std::uint64_t bulkLeft = 0; ///< before it
        bool bulkWaits = false;
        std::optional<session::LineProbing> probing; ///< after the peer's answer
    };

    void begin(const protocol::MeasureAnswer& answer);
    std::uint64_t bulkLimit() const;
    void pump();
    void send(const session::LineProbing::Order& order);
    void finish(const std::string& failure);

    ModuleHost& m_host;
    std::string m_peer;
    Ways m_ways;
    session::MeasuredRun m_answering;
    std::optional<Asked> m_asked;
    std::shared_ptr<const std::vector<std::byte>> m_padding; ///< that cannot be compressed; images are sent from it
    transport::Timer m_timer;
};

} // namespace liena::system
