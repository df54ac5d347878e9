// The read loop of one lane.
#include "tasks/reception_task.hpp"

#include <utility>

namespace liena::tasks {

ReceptionTask::ReceptionTask(std::shared_ptr<transport::TcpChannel> channel, std::unique_ptr<protocol::DatagramDecoder> decoder,
                             protocol::PartialBudget& budget, std::uint8_t lane, LaneSink& sink)
    : m_channel(std::move(channel)), m_decoder(std::move(decoder)), m_reassembler(budget), m_lane(lane), m_sink(&sink)
{
    m_channel->setListener(this);
    if (m_lane == 0)
        m_channel->expectPrompt();
}

ReceptionTask::~ReceptionTask() { close(); }

void ReceptionTask::close()
{
    if (std::exchange(m_closed, true))
        return;
    m_channel->setListener(nullptr);
    m_channel->close();
    m_reassembler.clear();
}

void ReceptionTask::orphan()
{
    m_paused = true;
    m_channel->setListener(nullptr);
}

void ReceptionTask::start()
{
    m_paused = false;
    process();
}

void ReceptionTask::bytesRead(std::size_t count)
{
    m_reading = false;
    m_bytesReceived += count;
    m_decoder->commit(count);
    process();
}

void ReceptionTask::process()
{
    if (m_closed || m_paused)
        return;
    m_sink->turned();
    if (m_closed || m_paused)
        return;
    m_decoder->process([this](const protocol::DatagramHeader& header) { return judge(header); },
                       [this](const protocol::DatagramHeader& header, std::span<const std::byte> body) {
                           return conclude(header, m_reassembler.take(header, body, m_maximum), body);
                       },
                       [this](const protocol::DatagramHeader& header, std::span<const std::byte> bytes, bool last) {
                           m_reassembler.add(bytes);
                           return !last || conclude(header, m_reassembler.close(), {});
                       });
    if (!m_closed && !m_paused && !m_reading) {
        m_reading = true;
        if (std::exchange(m_concluded, false) && m_lane != 0 && m_decoder->buffered() == 0)
            m_channel->acknowledge();
        readOn();
    }
}

/// What is missing of a long message's segment goes from the connection to the message's own buffer.
void ReceptionTask::readOn()
{
    using ReadAhead = protocol::DatagramDecoder::ReadAhead;
    if (auto place = m_reassembler.place(m_decoder->awaited()); !place.bytes.empty())
        m_decoder->landIn(place.bytes, std::move(place.keeper));
    const auto room = m_decoder->room(m_channel->hasWorkers() ? ReadAhead::All : ReadAhead::Header);
    m_channel->read({room.landing, room.buffer}, m_decoder);
}

/// The segments of a long message go to its own buffer as they come.
protocol::HeaderVerdict ReceptionTask::judge(const protocol::DatagramHeader& header)
{
    using protocol::HeaderVerdict;
    const auto judgement = m_sink->judge(m_lane, header);
    m_maximum = judgement.maximum;
    if (m_closed || m_paused)
        return HeaderVerdict::Refuse;
    if (judgement.verdict != HeaderVerdict::Take || (!header.moreSegments && !m_reassembler.hasPartial()))
        return judgement.verdict;
    const auto outcome = m_reassembler.open(header, header.length, m_maximum);
    if (std::holds_alternative<protocol::Reassembler::Incomplete>(outcome))
        return HeaderVerdict::TakeInPieces;
    if (const auto* violation = std::get_if<protocol::Reassembler::Violation>(&outcome)) {
        m_sink->violated(m_lane, violation->what);
        return HeaderVerdict::Refuse;
    }
    return HeaderVerdict::Take;
}

bool ReceptionTask::conclude(const protocol::DatagramHeader& header, protocol::Reassembler::Outcome outcome,
                             std::span<const std::byte> body)
{
    m_concluded = !m_reassembler.hasPartial();
    if (const auto* violation = std::get_if<protocol::Reassembler::Violation>(&outcome))
        m_sink->violated(m_lane, violation->what);
    else if (const auto* passed = std::get_if<protocol::Reassembler::OverBudget>(&outcome))
        m_sink->overBudget(header, *passed);
    else if (std::holds_alternative<protocol::Reassembler::Whole>(outcome))
        m_sink->received(m_lane, header, body, nullptr);
    else if (auto* assembled = std::get_if<protocol::Reassembler::Assembled>(&outcome))
        m_sink->received(m_lane, header, {assembled->bytes.data(), assembled->bytes.size()}, &assembled->bytes);
    return !m_closed && !m_paused;
}

void ReceptionTask::channelLost(const std::string& detail, bool /*identity*/)
{
    m_closed = true;
    m_reassembler.clear();
    m_sink->laneLost(m_lane, detail);
}

} // namespace liena::tasks
