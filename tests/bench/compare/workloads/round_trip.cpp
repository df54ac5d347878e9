// A command and its echo: back to back, or in a fixed rhythm.
#include "measure/result_line.hpp"
#include "workloads/phases.hpp"
#include "workloads/workload.hpp"

#include <atomic>

namespace liena::compare {

namespace {

class RoundTripClient final : public LinkEvents {
public:
    RoundTripClient(Transport& transport, const Options& options)
        : m_transport(transport), m_phases(options), m_paced(options.workload == WorkloadKind::Paced)
    {
        if (m_paced)
            transport.every(Nanoseconds(static_cast<std::int64_t>(1e9 / options.commandRate)), [this] { send(Clock::now()); });
        else
            transport.every(std::chrono::milliseconds(100), [this] { beginAnew(); });
    }

    void ready() override
    {
        const auto now = Clock::now();
        m_phases.begin(now);
        if (!m_paced)
            send(now);
    }

    void commandReceived(const Command& command) override
    {
        const auto now = Clock::now();
        m_heard = true;
        if (command.stamp.number > 0)
            m_roundTrips.record(std::chrono::duration_cast<Nanoseconds>(now.time_since_epoch()).count() - command.stamp.sentNs);
        if (!m_paced)
            send(now);
    }

    void frameReceived(const Stamp& /*stamp*/, std::size_t /*size*/) override {}

private:
    /// A link whose ends find each other in two steps may lose the first echo.
    void beginAnew()
    {
        if (m_phases.begun() && !m_heard)
            send(Clock::now());
    }

    void send(Instant now)
    {
        if (!m_phases.begun() || m_ended)
            return;
        if (m_phases.isOver(now)) {
            m_ended = true;
            return ResultLine().add("round_trip", m_roundTrips).print();
        }
        Command command;
        command.stamp = {m_phases.isMeasured(now) ? ++m_sent : 0, nowNs()};
        m_transport.sendCommand(command);
    }

    Transport& m_transport;
    Phases m_phases;
    bool m_paced;
    std::atomic<bool> m_heard = false; ///< a transport may receive on another thread than it waits on
    bool m_ended = false;
    std::uint64_t m_sent = 0;
    LatencyHistogram m_roundTrips;
};

class Echo final : public LinkEvents {
public:
    explicit Echo(Transport& transport) : m_transport(transport) {}

    void ready() override {}
    void commandReceived(const Command& command) override { m_transport.sendCommand(command); }
    void frameReceived(const Stamp& /*stamp*/, std::size_t /*size*/) override {}

private:
    Transport& m_transport;
};

} // namespace

std::unique_ptr<LinkEvents> makeRoundTrip(Transport& transport, const Options& options)
{
    if (options.role == Role::Client)
        return std::make_unique<RoundTripClient>(transport, options);
    return std::make_unique<Echo>(transport);
}

} // namespace liena::compare
