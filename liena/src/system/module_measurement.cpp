// How measurements use the lanes of one peer.
#include "system/distributed_module.hpp"

#include <fmt/format.h>

namespace liena::system {

LineMeasurement::Ways DistributedModule::measuringWays()
{
    return {[this](const protocol::SessionMessage& message, std::uint32_t history) {
                m_laneZero.push({encode(message, m_peer.id), tasks::Rank::Status, history, std::nullopt, {}});
            },
            [this](const protocol::SessionMessage& message) { return m_datagrams.send(encode(message, m_peer.id), m_host.now().mono); },
            [this](const protocol::ProbeHead& head, LentBytes padding, session::Instant expires) {
                protocol::EncodedMessage image;
                image.header.message = {m_host.ownDevice().id, protocol::Probe::number};
                image.header.target = m_peer.id;
                image.header.timestamp = m_host.stamp();
                image.part = protocol::encodeProbeHead(head, padding.bytes.size());
                image.lent = std::make_shared<const LentBytes>(std::move(padding));
                // None that counts as under way is superseded. All have the same bytes: those that wait take less than a megabyte together.
                m_bulk.push({std::move(image), tasks::Rank::Measuring, session::LineProbing::mostUnderWay, expires, {}});
            },
            [this] { return m_bulk.knownRate(m_host.now().mono); },
            [this] { return m_bulk.left().bytes; },
            [this] { return m_bulk.waits(); }};
}

Result<void> DistributedModule::measure(MeasurementPlan plan, DistributedSystem::MeasurementHandler done)
{
    if (m_machine.state() != SessionState::Open)
        return fail(Errc::NotOpen, fmt::format("the session with {} is {}", m_peer.name, toString(m_machine.state())));
    return m_measurement.start(std::move(plan), std::move(done));
}

/// What is read of a probe: nothing that this device did not grant. That is no violation, since a peer may hear late that a run is over.
bool DistributedModule::admitsProbe(std::uint8_t lane, const protocol::DatagramHeader& header)
{
    if (carriesMessages(m_machine.state()) && m_measurement.admits(lane, header))
        return true;
    drop("a probe beyond what was granted", header.message.number);
    return false;
}

bool DistributedModule::heardMeasurement(protocol::ProbeWay arrived, const protocol::DatagramHeader& header,
                                         std::span<const std::byte> part)
{
    if (header.message.number == protocol::Probe::number) {
        if (!m_measurement.heardProbe(arrived, part))
            drop("a probe of no measurement", header.message.number);
        return true;
    }
    if (header.message.number != protocol::ProbeEcho::number)
        return false;
    const auto echo = protocol::decodeSessionMessage(header.message.number, part);
    if (!echo || !m_measurement.heardEcho(std::get<protocol::ProbeEcho>(*echo)))
        drop("an echo of no measurement", header.message.number);
    return true;
}

} // namespace liena::system
