// As many messages or frames as the link carries, a bounded number of them under way: the receiver gives credit.
#include "measure/result_line.hpp"
#include "workloads/phases.hpp"
#include "workloads/workload.hpp"

#include <utility>

namespace liena::compare {

namespace {

/// How many may be under way: fewer than any queue refuses, and more than the longest way between the ends holds.
std::uint64_t windowOf(const Options& options) { return options.sendsFrames() ? 8 : 2048; }
constexpr std::uint64_t creditsPerWindow = 8;

class ThroughputSender final : public LinkEvents {
public:
    ThroughputSender(Transport& transport, const Options& options)
        : m_transport(transport), m_frames(options.sendsFrames()), m_window(windowOf(options))
    {}

    void ready() override { fill(); }

    void commandReceived(const Command& credit) override
    {
        m_arrived = credit.stamp.number;
        fill();
    }

    void frameReceived(const Stamp& /*stamp*/, std::size_t /*size*/) override {}

private:
    void fill()
    {
        while (m_sent < m_arrived + m_window) {
            Command command;
            command.stamp.number = ++m_sent; // without a time: nobody asks, and a clock costs more than some transports do
            if (m_frames)
                m_transport.sendFrame(command.stamp);
            else
                m_transport.sendCommand(command);
        }
    }

    Transport& m_transport;
    bool m_frames;
    std::uint64_t m_window;
    std::uint64_t m_sent = 0;
    std::uint64_t m_arrived = 0;
};

class ThroughputReceiver final : public LinkEvents {
public:
    ThroughputReceiver(Transport& transport, const Options& options)
        : m_transport(transport), m_phases(options), m_creditEach(windowOf(options) / creditsPerWindow)
    {}

    void ready() override {}
    void commandReceived(const Command& command) override { count(sizeof command); }
    void frameReceived(const Stamp& /*stamp*/, std::size_t size) override { count(size); }

private:
    void count(std::size_t size)
    {
        m_bytes += size;
        if (++m_messages % m_creditEach == 0)
            giveCredit(Clock::now());
    }

    void giveCredit(Instant now)
    {
        Command credit;
        credit.stamp.number = m_messages;
        m_transport.sendCommand(credit);
        if (!m_phases.begun())
            m_phases.begin(now);
        if (m_phases.isMeasured(now) && m_from == Instant{}) {
            m_from = now;
            m_messagesBefore = m_messages;
            m_bytesBefore = m_bytes;
        }
        if (m_phases.isOver(now) && !std::exchange(m_ended, true))
            tell(std::chrono::duration<double>(now - m_from).count());
    }

    void tell(double seconds) const
    {
        ResultLine()
            .add("messages_per_second", static_cast<double>(m_messages - m_messagesBefore) / seconds)
            .add("megabytes_per_second", static_cast<double>(m_bytes - m_bytesBefore) / seconds / 1e6)
            .print();
    }

    Transport& m_transport;
    Phases m_phases;
    std::uint64_t m_creditEach;
    std::uint64_t m_messages = 0;
    std::uint64_t m_bytes = 0;
    std::uint64_t m_messagesBefore = 0;
    std::uint64_t m_bytesBefore = 0;
    Instant m_from{};
    bool m_ended = false;
};

} // namespace

std::unique_ptr<LinkEvents> makeThroughput(Transport& transport, const Options& options)
{
    if (options.role == Role::Client)
        return std::make_unique<ThroughputSender>(transport, options);
    return std::make_unique<ThroughputReceiver>(transport, options);
}

} // namespace liena::compare
