// From Attach to the handshake, or to the refusal.
#include "fresh_connections.hpp"

#include "protocol/header_judge.hpp"

#include <algorithm>

namespace liena::simulation {

using namespace std::chrono_literals;

SimulatedFresh::SimulatedFresh(Program& program, AttachedConnection connection, DeviceId self, protocol::PartialBudget& budget,
                               Handlers handlers)
    : m_token(connection.attach.token),
      m_peer(connection.peer),
      m_self(self),
      m_handlers(std::move(handlers)),
      m_timer(program),
      m_reception(std::make_unique<SimulatedReception>(program, connection.connection, std::move(connection.decoder), budget,
                                                       std::uint8_t{0}, *this))
{}

void SimulatedFresh::start()
{
    m_timer.after(1s, [this] { m_handlers.ended(); });
    m_reception->start();
}

void SimulatedFresh::ignore()
{
    m_reception->pause();
    m_timer.after(3s, [this] { m_handlers.ended(); });
}

std::unique_ptr<SimulatedReception> SimulatedFresh::release()
{
    m_timer.cancel();
    return std::move(m_reception);
}

void SimulatedFresh::close()
{
    m_timer.cancel();
    if (m_reception)
        m_reception->close();
}

Judgement SimulatedFresh::judge(std::uint8_t /*lane*/, const protocol::DatagramHeader& header)
{
    if (m_heard || !protocol::isHandshakeHeader(m_self, m_peer, header)) {
        m_handlers.ended();
        return {protocol::HeaderVerdict::Refuse, 0};
    }
    return {protocol::HeaderVerdict::Take, header.length};
}

void SimulatedFresh::received(std::uint8_t /*lane*/, const protocol::DatagramHeader& header, std::span<const std::byte> part)
{
    const auto message = protocol::decodeSessionMessage(header.message.number, part);
    const auto tokenOf = [](const protocol::SessionMessage& m) {
        const auto* plain = std::get_if<protocol::Handshake>(&m);
        return plain != nullptr ? plain->token : std::get<protocol::DiagnosisHandshake>(m).handshake.token;
    };
    if (!message || tokenOf(*message) != m_token || m_token == 0)
        return m_handlers.ended();
    m_heard = true;
    m_timer.cancel();
    m_reception->pause();
    m_handlers.handshake(*message);
}

void SimulatedFresh::violated(std::uint8_t /*lane*/, const std::string& /*detail*/) { m_handlers.ended(); }
void SimulatedFresh::laneLost(std::uint8_t /*lane*/, const std::string& /*detail*/) { m_handlers.ended(); }

void SimulatedCouriers::send(std::unique_ptr<SimulatedFresh> refused, const protocol::EncodedMessage& attach,
                             protocol::EncodedMessage rejected)
{
    constexpr std::size_t mostTrips = 8;
    if (m_trips.size() >= mostTrips)
        end(m_trips.front().get());
    auto* place = &m_trips.emplace_back();
    SimulatedLane::Handlers handlers;
    handlers.up = [this, place, message = std::make_shared<const protocol::EncodedMessage>(std::move(rejected))] {
        auto& trip = **place;
        trip.lane.push({*message, tasks::Rank::Safety, 0, std::nullopt, {}});
        trip.timer.after(100ms, [this, one = &trip] { end(one); });
    };
    handlers.failed = [this, place](const ConnectFailure&) { end(place->get()); };
    handlers.lost = [this, place](const std::string&) { end(place->get()); };
    handlers.dropped = [](const tasks::OutputQueue::Entry&, tasks::OutputQueue::Fate) {};
    handlers.abandoning = [](const protocol::DatagramHeader&) { return protocol::EncodedMessage(); }; // it carries no segments
    handlers.leaving = [](std::vector<std::byte>&, std::size_t) {};
    *place = std::make_shared<Trip>(m_program, m_peer, std::move(handlers));
    (*place)->refused = std::move(refused);
    (*place)->lane.connect(attach, 1s);
}

void SimulatedCouriers::end(const Trip* trip)
{
    const auto found =
        std::find_if(m_trips.begin(), m_trips.end(), [&](const std::shared_ptr<Trip>& candidate) { return candidate.get() == trip; });
    if (found == m_trips.end())
        return;
    (*found)->timer.cancel();
    (*found)->lane.close(0ns);
    if ((*found)->refused)
        (*found)->refused->close();
    m_program.bury(std::move(*found));
    m_trips.erase(found);
}

} // namespace liena::simulation
