// The read loop of one simulated lane.
#include "simulated_reception.hpp"

#include <utility>

namespace liena::simulation {

SimulatedReception::SimulatedReception(Program& program, ConnectionNumber connection, std::unique_ptr<protocol::DatagramDecoder> decoder,
                                       protocol::PartialBudget& budget, std::uint8_t lane, ReceptionOwner& owner)
    : m_program(program), m_connection(connection), m_decoder(std::move(decoder)), m_reassembler(budget), m_lane(lane), m_owner(&owner)
{
    if (auto* stands = m_program.network().find(m_connection))
        stands->setListener(m_program.host(), this);
}

void SimulatedReception::close()
{
    if (std::exchange(m_closed, true))
        return;
    if (auto* stands = m_program.network().find(m_connection))
        stands->close(m_program.host());
    m_reassembler.clear();
}

void SimulatedReception::orphan()
{
    m_paused = true;
    if (auto* stands = m_program.network().find(m_connection))
        stands->setListener(m_program.host(), nullptr);
}

void SimulatedReception::start()
{
    m_paused = false;
    process();
}

void SimulatedReception::bytesRead(std::size_t count)
{
    m_reading = false;
    m_decoder->commit(count);
    process();
}

void SimulatedReception::process()
{
    if (m_closed || m_paused)
        return;
    m_owner->turned();
    if (m_closed || m_paused)
        return;
    const auto judge = [this](const protocol::DatagramHeader& header) {
        const auto judgement = m_owner->judge(m_lane, header);
        m_maximum = judgement.maximum;
        return m_closed || m_paused ? protocol::HeaderVerdict::Refuse : judgement.verdict;
    };
    m_decoder->process(judge,
                       [this](const protocol::DatagramHeader& header, std::span<const std::byte> body) { return take(header, body); });
    if (m_closed || m_paused || m_reading)
        return;
    m_reading = true;
    if (auto* stands = m_program.network().find(m_connection))
        stands->read(m_decoder->writable());
}

bool SimulatedReception::take(const protocol::DatagramHeader& header, std::span<const std::byte> body)
{
    auto outcome = m_reassembler.take(header, body, m_maximum);
    if (!std::holds_alternative<protocol::Reassembler::Incomplete>(outcome))
        m_kept.erase(header.message.number);
    if (const auto* violation = std::get_if<protocol::Reassembler::Violation>(&outcome))
        m_owner->violated(m_lane, violation->what);
    else if (const auto* passed = std::get_if<protocol::Reassembler::OverBudget>(&outcome); passed != nullptr && passed->first)
        m_owner->overBudget(header);
    else if (std::holds_alternative<protocol::Reassembler::Incomplete>(outcome))
        return keep(header, body.size());
    else if (std::holds_alternative<protocol::Reassembler::Whole>(outcome))
        m_owner->received(m_lane, header, body);
    else if (auto* assembled = std::get_if<protocol::Reassembler::Assembled>(&outcome))
        m_owner->received(m_lane, header, {assembled->bytes.data(), assembled->bytes.size()});
    return !m_closed && !m_paused;
}

bool SimulatedReception::keep(const protocol::DatagramHeader& header, std::size_t bytes)
{
    auto& kept = m_kept[header.message.number];
    kept = {header.timestamp, kept.first == header.timestamp ? kept.second + bytes : bytes};
    m_owner->kept(m_lane, header, kept.second);
    return true;
}

void SimulatedReception::connectionLost(const char* detail)
{
    m_closed = true;
    m_reassembler.clear();
    m_owner->laneLost(m_lane, detail);
}

} // namespace liena::simulation
