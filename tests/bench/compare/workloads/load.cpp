// Commands in a fixed rhythm beside frames that go the same way, in one stream or in two: one-way latencies of all.
#include "measure/command_row.hpp"
#include "measure/due_grid.hpp"
#include "measure/result_line.hpp"
#include "measure/ticker.hpp"
#include "workloads/phases.hpp"
#include "workloads/workload.hpp"

#include <array>
#include <atomic>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace liena::compare {

namespace {

using namespace std::chrono_literals;

Nanoseconds periodOf(double rate) { return Nanoseconds(static_cast<std::int64_t>(1e9 / rate)); }

std::int64_t nanosecondsOf(Instant at) { return std::chrono::duration_cast<Nanoseconds>(at.time_since_epoch()).count(); }

/// Of the figures, by stream.
constexpr std::array<const char*, mostStreams> frameNames{"frame", "second_frame"};

/// Commands are sent on the transport's thread, frames from a thread of each camera's own, as in an application.
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
        const std::array<double, mostStreams> rates{m_options.frameRate, m_options.secondRate};
        for (std::size_t stream = 0; stream < rates.size(); ++stream)
            if (rates[stream] > 0)
                m_cameras.push_back(
                    std::make_unique<Ticker>(periodOf(rates[stream]), [this, stream](Instant due) { sendFrame(stream, due); }));
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

    void sendFrame(std::size_t stream, Instant due)
    {
        if (!m_phases.isOver(due))
            m_transport.sendFrame({frameNumber(stream, m_phases.isMeasured(due) ? ++m_frames[stream] : 0), nanosecondsOf(due)});
    }

    /// What is under way arrives first; the last command is repeated, since not every transport delivers every message.
    void end(Instant now)
    {
        constexpr auto underWay = 1s;
        constexpr auto repetition = 100ms;
        if (!m_cameras.empty()) {
            m_cameras.clear();
            return;
        }
        if (now < m_phases.end() + underWay || now < m_lastSent + repetition)
            return;
        if (m_lastSent == Instant{})
            tell();
        m_lastSent = now;
        Command last;
        last.stamp = {lastNumber, nanosecondsOf(now)};
        m_transport.sendCommand(last);
    }

    void tell() const
    {
        ResultLine line;
        line.add("commands_sent", static_cast<double>(m_commands));
        for (std::size_t stream = 0; stream < m_options.streams(); ++stream)
            line.add(std::string(frameNames[stream]) + "s_sent", static_cast<double>(m_frames[stream]));
        line.print();
    }

    Transport& m_transport;
    Options m_options;
    Phases m_phases;
    DueGrid m_grid;
    std::uint64_t m_commands = 0;
    std::array<std::atomic<std::uint64_t>, mostStreams> m_frames{}; ///< by stream
    Instant m_lastSent{};
    std::vector<std::unique_ptr<Ticker>> m_cameras; ///< end first: they use the others
};

/// Latencies; each with the moment at which it was due as well, both in ms, where all are told. The moment is on the monotonic clock.
struct Record {
    LatencySamples latencies;
    std::vector<double> due;
    std::vector<double> late;

    void take(const Stamp& stamp, bool tellsAll)
    {
        const auto latency = nowNs() - stamp.sentNs;
        latencies.record(latency);
        if (!tellsAll)
            return;
        due.push_back(static_cast<double>(stamp.sentNs) / 1e6);
        late.push_back(static_cast<double>(latency) / 1e6);
    }

    void addTo(ResultLine& line, const std::string& name, bool tellsAll) const
    {
        line.add(name, latencies);
        if (tellsAll)
            line.add(name + "_due_ms", due).add(name + "_late_ms", late);
    }
};

class LoadReceiver final : public LinkEvents {
public:
    explicit LoadReceiver(const Options& options) : m_options(options) {}

    void ready() override {}

    void commandReceived(const Command& command) override
    {
        if (command.stamp.number == lastNumber)
            return end();
        if (command.stamp.number == 0)
            return;
        for (const auto& stamp : m_row.come(command.stamp))
            m_commands.take(stamp, m_options.timeline);
    }

    void frameReceived(const Stamp& stamp, std::size_t /*size*/) override
    {
        if (countOf(stamp) > 0)
            m_frames[streamOf(stamp)].take(stamp, m_options.timeline);
    }

private:
    void end()
    {
        if (std::exchange(m_ended, true))
            return;
        ResultLine line;
        m_commands.addTo(line, "command", m_options.timeline);
        line.add("commands_arrived", static_cast<double>(m_commands.latencies.count() - m_row.missing()));
        for (std::size_t stream = 0; stream < m_options.streams(); ++stream) {
            const auto count = static_cast<double>(m_frames[stream].latencies.count());
            m_frames[stream].addTo(line, frameNames[stream], m_options.timeline);
            line.add(std::string(frameNames[stream]) + "s_per_second", count / m_options.seconds);
        }
        line.print();
    }

    Options m_options;
    CommandRow m_row;
    Record m_commands;
    std::array<Record, mostStreams> m_frames; ///< by stream
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
