// Which links a patient-side device opens by itself: implementation.
#include "link_keeper.hpp"

namespace liena::devices {

namespace {

bool isBrain(DeviceId id) { return id.classNumber() == static_cast<std::uint8_t>(DeviceClass::Brain); }

} // namespace

LinkKeeper::LinkKeeper(DeviceId self, const std::vector<DeviceId>& peers) : m_self(self)
{
    for (const DeviceId peer : peers)
        m_links.try_emplace(peer);
}

void LinkKeeper::handle(const SessionEvent& event, SteadyTime now)
{
    if (event.kind == SessionEvent::Kind::IncidentEnded)
        return handleIncidentEnded(event, now);
    if (const auto found = m_links.find(event.peer); found != m_links.end())
        handleOwn(found->second, event, now);
    else if (event.kind == SessionEvent::Kind::ReOpened && isBrain(event.peer))
        for (auto& [peer, link] : m_links) // no device keeps a cockpit's channel open by itself, so a person stood behind this
            follow(link, now);
}

void LinkKeeper::handleOwn(Link& link, const SessionEvent& event, SteadyTime now)
{
    switch (event.kind) {
    case SessionEvent::Kind::Opened:
    case SessionEvent::Kind::ReOpened:
        link = {State::Up, now};
        break;
    case SessionEvent::Kind::Closed:
        if (link.state != State::Left)
            link = {State::Wanted, now + pause};
        break;
    case SessionEvent::Kind::Lost:
        link = {State::Lost, now};
        break;
    case SessionEvent::Kind::OpenFailed:
        // The peer holds an incident of this pair that we do not know, because we were started anew: that is a lost link too.
        // It is older than we are, and so older than what a person re-opened here since.
        if (link.state == State::Wanted && event.reason == RejectReason::StandBy)
            link.state = link.personReopened ? State::Following : State::Lost;
        link.next = now + pause;
        break;
    default:
        break;
    }
}

bool LinkKeeper::personReopened(const SessionEvent& event, DeviceId peer) const
{
    const auto concerns = [&](DeviceId id) { return id == peer || id == m_self; };
    const Incident& incident = event.incident;
    return (isBrain(incident.a) && concerns(incident.b)) || (isBrain(incident.b) && concerns(incident.a));
}

void LinkKeeper::handleIncidentEnded(const SessionEvent& event, SteadyTime now)
{
    for (auto& [peer, link] : m_links) {
        const bool ours =
            (event.incident.a == m_self && event.incident.b == peer) || (event.incident.b == m_self && event.incident.a == peer);
        if (ours && event.dismissed)
            link.state = State::Left;
        else if (!event.dismissed && personReopened(event, peer))
            follow(link, now);
    }
}

void LinkKeeper::follow(Link& link, SteadyTime now)
{
    if (link.state == State::Lost)
        link = {State::Following, now};
    else if (link.state == State::Wanted)
        link.personReopened = true;
}

void LinkKeeper::closedByPerson(DeviceId peer)
{
    if (const auto found = m_links.find(peer); found != m_links.end())
        found->second.state = State::Left;
}

void LinkKeeper::openedByPerson(DeviceId peer, SteadyTime now)
{
    const auto found = m_links.find(peer);
    if (found != m_links.end() && found->second.state == State::Left)
        found->second = {State::Wanted, now + pause}; // the person's own try is on its way
}

std::vector<LinkKeeper::Wish> LinkKeeper::due(SteadyTime now)
{
    std::vector<Wish> wishes;
    for (auto& [peer, link] : m_links) {
        const bool trying = link.state == State::Wanted || link.state == State::Following;
        if (!trying || now < link.next)
            continue;
        if (link.state == State::Following && link.tries++ == mostFollowing) {
            link.state = State::Lost;
            continue;
        }
        wishes.push_back({peer, link.state == State::Wanted ? Act::Open : Act::ReOpen});
        link.next = now + pause;
    }
    return wishes;
}

} // namespace liena::devices
