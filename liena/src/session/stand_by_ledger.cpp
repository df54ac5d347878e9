// The rules of incidents.
#include "session/stand_by_ledger.hpp"

#include "liena/log.hpp"

#include <algorithm>
#include <chrono>

namespace liena::session {

namespace {

SessionEvent eventOf(SessionEvent::Kind kind, const Incident& incident, Now now)
{
    SessionEvent event;
    event.kind = kind;
    event.at = now.mono;
    event.incident = incident;
    return event;
}

} // namespace

std::vector<Incident> StandByLedger::incidents() const
{
    std::vector<Incident> all;
    for (const auto& [id, incident] : m_incidents)
        all.push_back(incident);
    std::sort(all.begin(), all.end(), [](const Incident& a, const Incident& b) { return a.since < b.since; });
    return all;
}

const Incident* StandByLedger::find(IncidentId id) const
{
    const auto found = m_incidents.find(id);
    return found != m_incidents.end() ? &found->second : nullptr;
}

LedgerActions StandByLedger::lost(DeviceId peer, IncidentId id, LossCause cause, Timestamp since, Now now)
{
    LedgerActions actions;
    const auto [a, b] = std::minmax(m_self, peer);
    const protocol::StandBy message{id, a, b, cause, since.ns, m_self};
    if (m_incidents.contains(id)) {
        actions.push_back(PairChanged{peer, id});
        noteCause(message, std::nullopt, actions, now);
    } else {
        raise(message, std::nullopt, actions, now);
    }
    return actions;
}

void StandByLedger::raise(const protocol::StandBy& message, std::optional<DeviceId> from, LedgerActions& actions, Now now)
{
    const bool first = m_incidents.empty();
    auto& incident = m_incidents[message.incident];
    incident = {message.incident, message.peerA, message.peerB, message.cause, Timestamp{message.sinceNs}, {}};
    causeAt(incident, message.device) = message.cause;
    if (const auto peer = otherEnd(incident))
        actions.push_back(PairChanged{*peer, incident.id});
    actions.push_back(Broadcast{message, from});
    auto raised = eventOf(SessionEvent::Kind::IncidentRaised, incident, now);
    if (from)
        raised.peer = *from;
    actions.push_back(Tell{raised});
    if (first)
        actions.push_back(Tell{eventOf(SessionEvent::Kind::StandByBegan, incident, now)});
    if (m_holding) {
        incident.holds.push_back({m_self, true, m_holdingSince});
        report(incident.id, actions);
    }
}

/// Both ends speak of one incident, and each once.
void StandByLedger::noteCause(const protocol::StandBy& message, std::optional<DeviceId> from, LedgerActions& actions, Now now)
{
    auto& incident = m_incidents.at(message.incident);
    auto& cause = causeAt(incident, message.device);
    if (cause != LossCause::None || incident.a != message.peerA || incident.b != message.peerB)
        return;
    cause = message.cause;
    actions.push_back(Broadcast{message, from});
    auto event = eventOf(SessionEvent::Kind::CauseReported, incident, now);
    event.peer = message.device;
    actions.push_back(Tell{event});
}

LossCause& StandByLedger::causeAt(Incident& incident, DeviceId end) { return end == incident.a ? incident.causeOfA : incident.causeOfB; }

LedgerActions StandByLedger::reopened(DeviceId peer, std::uint64_t token, IncidentId named, Now now)
{
    LedgerActions actions;
    const auto [a, b] = std::minmax(m_self, peer);
    std::vector<IncidentId> ids;
    for (const auto& [id, incident] : m_incidents)
        if (incident.a == a && incident.b == b && id != token)
            ids.push_back(id);
    std::vector<protocol::ChannelReOpened> messages;
    for (const auto id : ids)
        messages.push_back({token, id, a, b});
    // A device that was restarted, or holds another one than its peer, knows this one by its name alone.
    if (named != token && !m_incidents.contains(named) && (named != 0 || messages.empty()))
        messages.push_back({token, named, a, b});
    for (const auto& message : messages) {
        remember(message);
        rememberEnded(message.incident, message, now);
        if (m_incidents.contains(message.incident))
            end(message.incident, message, m_self, false, {}, actions, now);
    }
    for (const auto& message : messages)
        actions.push_back(Broadcast{message, std::nullopt});
    return actions;
}

LedgerActions StandByLedger::dismiss(IncidentId id, const std::string& reason, Now now)
{
    LedgerActions actions;
    if (!m_incidents.contains(id))
        return actions;
    const protocol::IncidentDismissed message{id, m_self, {reason}};
    end(id, message, m_self, true, reason, actions, now);
    actions.push_back(Broadcast{message, std::nullopt});
    return actions;
}

LedgerActions StandByLedger::confirmHold(bool holding, Now now)
{
    LedgerActions actions;
    if (holding == m_holding)
        return actions;
    m_holding = holding;
    // The others take the newer word by this time, also after our wall clock was set back.
    m_holdingSince = Timestamp{std::max(now.wall.ns, m_holdingSince.ns + 1)};
    for (auto& [id, incident] : m_incidents) {
        std::erase_if(incident.holds, [this](const HoldReport& hold) { return hold.device == m_self; });
        incident.holds.push_back({m_self, holding, m_holdingSince});
        auto event = eventOf(SessionEvent::Kind::HoldReported, incident, now);
        event.hold = incident.holds.back();
        actions.push_back(Tell{event});
        report(id, actions);
    }
    return actions;
}

void StandByLedger::report(IncidentId id, LedgerActions& actions) const
{
    actions.push_back(Broadcast{protocol::StandByReport{id, m_self, m_holding, m_holdingSince.ns}, std::nullopt});
}

LedgerActions StandByLedger::greet(DeviceId peer) const
{
    LedgerActions actions;
    for (const auto& [id, incident] : m_incidents) {
        for (const auto end : {incident.a, incident.b})
            if (const auto cause = end == incident.a ? incident.causeOfA : incident.causeOfB; cause != LossCause::None)
                actions.push_back(Answer{peer, protocol::StandBy{id, incident.a, incident.b, cause, incident.since.ns, end}});
        for (const auto& hold : incident.holds)
            actions.push_back(Answer{peer, protocol::StandByReport{id, hold.device, hold.holding, hold.confirmed.ns}});
    }
    return actions;
}

LedgerActions StandByLedger::heard(DeviceId from, const protocol::StandBy& message, Now now)
{
    LedgerActions actions;
    if (const auto* ended = findEnded(message.incident, now)) {
        actions.push_back(Answer{from, ended->by});
        return actions;
    }
    if (message.incident == 0 || !(message.peerA < message.peerB) || (message.device != message.peerA && message.device != message.peerB)) {
        actions.push_back(LedgerViolation{from, "StandBy with a pair, an end or an incident that cannot be"});
    } else if (m_incidents.contains(message.incident)) {
        if (message.device != m_self)
            noteCause(message, from, actions, now);
    } else if (m_incidents.size() >= mostIncidents) {
        actions.push_back(IncidentNotKept{from});
    } else {
        const auto news = judgeNews(from, protocol::StandBy::number, now);
        if (news != News::Drop)
            raise(message, from, actions, now);
        if (news != News::HandOn)
            keepHere(actions, from, protocol::StandBy::number);
    }
    return actions;
}

LedgerActions StandByLedger::heard(DeviceId from, const protocol::StandByReport& message, Now now)
{
    LedgerActions actions;
    const auto found = m_incidents.find(message.incident);
    if (found == m_incidents.end() || message.device == m_self)
        return actions;
    auto& holds = found->second.holds;
    const auto known = std::find_if(holds.begin(), holds.end(), [&](const HoldReport& hold) { return hold.device == message.device; });
    const HoldReport report{message.device, message.holding, Timestamp{message.confirmedNs}};
    if (known != holds.end() ? known->confirmed >= report.confirmed : holds.size() >= mostIncidents)
        return actions;
    const auto news = judgeNews(from, protocol::StandByReport::number, now);
    if (news == News::Drop) {
        keepHere(actions, from, protocol::StandByReport::number);
        return actions;
    }
    if (known != holds.end())
        *known = report;
    else
        holds.push_back(report);
    auto event = eventOf(SessionEvent::Kind::HoldReported, found->second, now);
    event.hold = report;
    actions.push_back(Tell{event});
    actions.push_back(Broadcast{message, from});
    if (news == News::Keep)
        keepHere(actions, from, protocol::StandByReport::number);
    return actions;
}

LedgerActions StandByLedger::heard(DeviceId from, const protocol::IncidentDismissed& message, Now now)
{
    LedgerActions actions;
    if (!m_incidents.contains(message.incident))
        return actions;
    end(message.incident, message, from, true, printable(message.reason.value, 256), actions, now);
    actions.push_back(Broadcast{message, from});
    return actions;
}

/// It ends the one that it names and no other: wall clocks of two devices cannot say which loss of a pair came first.
LedgerActions StandByLedger::heard(DeviceId from, const protocol::ChannelReOpened& message, Now now)
{
    LedgerActions actions;
    const bool isNews = !isRemembered(message);
    const auto* named = find(message.incident);
    const bool ends = named != nullptr && named->a == message.peerA && named->b == message.peerB;
    if (message.incident == message.token || (!isNews && !ends))
        return actions;
    if (!ends && judgeNews(from, protocol::ChannelReOpened::number, now) != News::HandOn) {
        keepHere(actions, from, protocol::ChannelReOpened::number);
        return actions; // it changes nothing here, and is news when another neighbour brings it
    }
    remember(message);
    rememberEnded(message.incident, message, now);
    if (ends)
        end(message.incident, message, from, false, {}, actions, now);
    actions.push_back(Broadcast{message, from});
    return actions;
}

void StandByLedger::end(IncidentId id, const protocol::SessionMessage& by, DeviceId teller, bool dismissed, const std::string& detail,
                        LedgerActions& actions, Now now)
{
    const auto incident = m_incidents.at(id);
    m_incidents.erase(id);
    rememberEnded(id, by, now);
    if (const auto peer = otherEnd(incident)) {
        const auto other = std::find_if(m_incidents.begin(), m_incidents.end(),
                                        [&](const auto& entry) { return entry.second.a == incident.a && entry.second.b == incident.b; });
        actions.push_back(PairChanged{*peer, other != m_incidents.end() ? other->first : 0, id});
    }
    auto event = eventOf(SessionEvent::Kind::IncidentEnded, incident, now);
    event.peer = teller;
    event.dismissed = dismissed;
    event.detail = printable(detail, 256); // a peer may have written it
    actions.push_back(Tell{event});
    if (m_incidents.empty())
        actions.push_back(Tell{eventOf(SessionEvent::Kind::StandByEnded, incident, now)});
}

void StandByLedger::rememberEnded(IncidentId id, const protocol::SessionMessage& by, Now now)
{
    if (id == 0 || m_incidents.contains(id) || findEnded(id, now) != nullptr)
        return;
    while (!m_ended.empty() && (m_ended.size() >= mostEnded || now.mono - m_ended.front().at > endedLife))
        m_ended.pop_front();
    m_ended.push_back({id, by, now.mono});
}

const StandByLedger::Ended* StandByLedger::findEnded(IncidentId id, Now now) const
{
    const auto found = std::find_if(m_ended.begin(), m_ended.end(),
                                    [&](const Ended& ended) { return ended.id == id && now.mono - ended.at <= endedLife; });
    return found != m_ended.end() ? &*found : nullptr;
}

bool StandByLedger::isRemembered(const protocol::ChannelReOpened& message) const
{
    return std::find(m_reopenings.begin(), m_reopenings.end(), std::pair(message.token, message.incident)) != m_reopenings.end();
}

void StandByLedger::remember(const protocol::ChannelReOpened& message)
{
    if (isRemembered(message))
        return;
    if (m_reopenings.size() >= mostEnded)
        m_reopenings.pop_front();
    m_reopenings.emplace_back(message.token, message.incident);
}

StandByLedger::News StandByLedger::judgeNews(DeviceId from, std::uint16_t number, Now now)
{
    auto& allowance = m_allowances.try_emplace({from, number}, Allowance{2 * m_mostNews, now.mono}).first->second;
    const auto seconds = std::chrono::duration<double>(now.mono - std::exchange(allowance.at, now.mono)).count();
    allowance.left = std::min(2 * m_mostNews, allowance.left + seconds * 2 * m_mostNews / newsPeriod);
    if (allowance.left < 1)
        return News::Drop;
    allowance.left -= 1;
    return allowance.left >= m_mostNews ? News::HandOn : News::Keep;
}

/// Others hear of it from somebody else, or when a session with them begins.
void StandByLedger::keepHere(LedgerActions& actions, DeviceId teller, std::uint16_t number)
{
    std::erase_if(actions, [](const LedgerAction& action) {
        const auto* broadcast = std::get_if<Broadcast>(&action);
        return broadcast != nullptr && broadcast->except; // what this device says itself has none
    });
    actions.push_back(NewsNotHandedOn{teller, number});
}

std::optional<DeviceId> StandByLedger::otherEnd(const Incident& incident) const
{
    if (incident.a == m_self)
        return incident.b;
    return incident.b == m_self ? std::optional(incident.a) : std::nullopt;
}

} // namespace liena::session
