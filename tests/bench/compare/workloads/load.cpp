// Commands in a fixed rhythm beside frames that go the same way: one-way latencies of both.
#include "measure/command_row.hpp"
#include "measure/due_grid.hpp"
#include "measure/result_line.hpp"
#include "measure/ticker.hpp"
#include "workloads/phases.hpp"
#include "workloads/workload.hpp"

#include <atomic>
#include <optional>
#include <utility>
#include <vector>

namespace liena::compare {

namespace {

using namespace std::chrono_literals;

Nanoseconds periodOf(double rate) { return Nanoseconds(static_cast<std::int64_t>(1e9 / rate)); }

std::int64_t nanosecondsOf(Instant at) { return std::chrono::duration_cast<Nanoseconds>(at.time_since_epoch()).count(); }

/// Commands are sent on the transport's thread, frames from a thread of the camera's own, as in an application.
class LoadSender final : public LinkEvents {
public:
    LoadSender(Transport& transport, const Options& options)
        : m_transport(transport), m_options(options), m_phases(options), m_grid(periodOf(options.commandRate))
    {
        transport.every(periodOf(options.commandRate), [this] { tick(); });
    }

    void ready() override
    {
        m_phases.begin(Clock::now());
        if (m_options.frameRate > 0)
            m_camera.emplace(periodOf(m_options.frameRate), [this](Instant due) { sendFrame(due); });
    }

    void commandReceived(const Command& /*command*/) override {}
    void frameReceived(const Stamp& /*stamp*/, std::size_t /*size*/) override {}

private:
    void tick()
    {
        const auto now = Clock::now();
        const auto due = m_grid.due(now);
        if (!m_phases.begun())
            return;
        if (m_phases.isOver(now))
            return end(now);
        Command command;
        command.stamp = {m_phases.isMeasured(due) ? ++m_commands : 0, nanosecondsOf(due)};
        m_transport.sendCommand(command);
    }

    void sendFrame(Instant due)
    {
        if (!m_phases.isOver(due))
            m_transport.sendFrame({m_phases.isMeasured(due) ? ++m_frames : 0, nanosecondsOf(due)});
    }

    /// What is under way arrives first; the last command is repeated, since not every transport delivers every message.
    void end(Instant now)
    {
        constexpr auto underWay = 1s;
        constexpr auto repetition = 100ms;
        if (m_camera) {
            m_camera.reset();
            return;
        }
        if (now < m_phases.end() + underWay || now < m_lastSent + repetition)
            return;
        if (m_lastSent == Instant{})
            ResultLine().add("commands_sent", static_cast<double>(m_commands)).add("frames_sent", static_cast<double>(m_frames)).print();
        m_lastSent = now;
        Command last;
        last.stamp = {lastNumber, nanosecondsOf(now)};
        m_transport.sendCommand(last);
    }

    Transport& m_transport;
    Options m_options;
    Phases m_phases;
    DueGrid m_grid;
    std::uint64_t m_commands = 0;
    std::atomic<std::uint64_t> m_frames = 0;
    Instant m_lastSent{};
    std::optional<Ticker> m_camera; ///< ends first: it uses the others
};

/// Each latency with the moment at which it was due, both in ms; the moment on the monotonic clock.
struct Timeline {
    std::vector<double> due;
    std::vector<double> late;

    void record(const Stamp& stamp, std::int64_t latency)
    {
        due.push_back(static_cast<double>(stamp.sentNs) / 1e6);
        late.push_back(static_cast<double>(latency) / 1e6);
    }
};

class LoadReceiver final : public LinkEvents {
public:
    explicit LoadReceiver(const Options& options) : m_tellsAll(options.timeline) {}

    void ready() override {}

    void commandReceived(const Command& command) override
    {
        if (command.stamp.number == lastNumber)
            return end();
        if (command.stamp.number == 0)
            return;
        for (const auto& stamp : m_row.come(command.stamp))
            record(stamp, m_commands, m_commandTimes);
    }

    void frameReceived(const Stamp& stamp, std::size_t /*size*/) override
    {
        if (stamp.number > 0)
            record(stamp, m_frames, m_frameTimes);
    }

private:
    void record(const Stamp& stamp, LatencySamples& latencies, Timeline& timeline) const
    {
        const auto latency = nowNs() - stamp.sentNs;
        latencies.record(latency);
        if (m_tellsAll)
            timeline.record(stamp, latency);
    }

    void end()
    {
        if (std::exchange(m_ended, true))
            return;
        ResultLine line;
        line.add("command", m_commands)
            .add("commands_arrived", static_cast<double>(m_commands.count() - m_row.missing()))
            .add("frame", m_frames);
        if (m_tellsAll) {
            line.add("command_due_ms", m_commandTimes.due).add("command_late_ms", m_commandTimes.late);
            line.add("frame_due_ms", m_frameTimes.due).add("frame_late_ms", m_frameTimes.late);
        }
        line.print();
    }

    CommandRow m_row;
    LatencySamples m_commands;
    LatencySamples m_frames;
    Timeline m_commandTimes;
    Timeline m_frameTimes;
    bool m_tellsAll;
    bool m_ended = false;
};

} // namespace

std::unique_ptr<LinkEvents> makeLoad(Transport& transport, const Options& options)
{
    if (options.role == Role::Client)
        return std::make_unique<LoadSender>(transport, options);
    return std::make_unique<LoadReceiver>(options);
}

} // namespace liena::compare
