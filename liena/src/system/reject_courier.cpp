// The courier's trips.
#include "system/reject_courier.hpp"

#include <boost/asio/post.hpp>

#include <algorithm>

namespace liena::system {

using namespace std::chrono_literals;

void RejectCouriers::send(std::unique_ptr<FreshConnection> refused, protocol::EncodedMessage attach, protocol::EncodedMessage rejected)
{
    if (m_trips.size() >= mostTrips)
        end(m_trips.front().get());
    auto* place = &m_trips.emplace_back();
    tasks::OutputLane::Handlers handlers;
    handlers.up = [this, place, message = std::move(rejected)] {
        auto& trip = **place;
        trip.lane.push({message, tasks::Rank::Safety, 0, std::nullopt, {}});
        trip.timer.after(100ms, [this, one = &trip] { end(one); });
    };
    handlers.failed = [this, place](const transport::ConnectionFailure&) { end(place->get()); };
    handlers.lost = [this, place](const std::string&, bool) { end(place->get()); };
    handlers.dropped = [](const tasks::OutputQueue::Entry&, tasks::OutputQueue::Fate) {};
    handlers.abandoning = [](const protocol::DatagramHeader&) { return protocol::EncodedMessage(); }; // it carries no segments
    *place = std::make_shared<Trip>(m_host, m_peer, std::move(handlers));
    (*place)->refused = std::move(refused);
    (*place)->lane.connect(std::move(attach), 1s);
}

void RejectCouriers::end(const Trip* trip)
{
    const auto found =
        std::find_if(m_trips.begin(), m_trips.end(), [&](const std::shared_ptr<Trip>& candidate) { return candidate.get() == trip; });
    if (found == m_trips.end())
        return;
    (*found)->timer.cancel();
    (*found)->lane.close(0ns);
    if ((*found)->refused)
        (*found)->refused->close();
    boost::asio::post(m_host.io(), [ended = std::move(*found)] {});
    m_trips.erase(found);
}

} // namespace liena::system
