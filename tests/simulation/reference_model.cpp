// The judgement of each observation.
#include "reference_model.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace liena::simulation {

using namespace std::chrono_literals;

namespace {

constexpr auto clockDrift = 100us; ///< two clocks may differ by 400 ppm over the times that are judged here
constexpr auto memory = 20s;       ///< how long a message is remembered
constexpr std::size_t mostFresh = 4;
constexpr std::size_t mostPending = 64;
constexpr std::size_t mostIncidents = 256;
constexpr std::uint16_t motionCommand = 0x0101;

} // namespace

void ReferenceModel::note(Instant at, const Observation& observation)
{
    m_now = at;
    std::visit([this](const auto& o) { on(o); }, observation);
}

void ReferenceModel::require(bool holds, const char* invariant, const std::string& what)
{
    if (!holds)
        m_violations.push_back({invariant, m_now, what});
}

bool ReferenceModel::someoneLies() const
{
    return std::any_of(m_devices.begin(), m_devices.end(), [](const auto& entry) { return entry.second.lies; });
}

void ReferenceModel::on(const Lies& o) { m_devices[o.device].lies = true; }

void ReferenceModel::on(const Started& o)
{
    auto& device = m_devices[o.device];
    const bool lies = device.lies;
    device = Device();
    device.lies = lies;
    device.resumed = m_now;
}

void ReferenceModel::on(const Ended& o)
{
    std::erase_if(m_ends, [&](const auto& entry) { return entry.first.first == o.device; });
    std::erase_if(m_waitingControl, [&](const auto& entry) { return entry.first.first == o.device; });
    m_devices[o.device].incidents.clear();
}

void ReferenceModel::on(const Paused& o)
{
    m_devices[o.device].paused = o.paused;
    m_devices[o.device].resumed = m_now;
}

void ReferenceModel::on(const Requested& o)
{
    require(!m_dialogues.contains(o.token), "I3", "a token was drawn twice");
    m_dialogues[o.token] = {o.device, o.reopen, o.byPerson, o.incident, {}};
}

/// What a person asks for may come too late; what then begins may not.
void ReferenceModel::judgeConfirmation(const Entered& o)
{
    const auto found = m_dialogues.find(o.token);
    if (found == m_dialogues.end() || found->second.device != o.device)
        return; // the peer's person confirmed
    const auto& dialogue = found->second;
    require(dialogue.reopen, "I4", "an opening was begun as a re-opening");
    // A device that was restarted has no incident to show: its peer holds the one.
    const auto& held = m_devices[o.device].incidents;
    require(dialogue.incident == 0 || held.contains(dialogue.incident), "I4", "the confirmation was for an incident that is over");
}

void ReferenceModel::on(const Entered& o)
{
    auto& end = m_ends[{o.device, o.peer}];
    require(o.from == end.state, "I3", "a state was left in which the session was not");
    const bool wasOpen = open(end);
    end.state = o.to;
    if (o.to == SessionState::Reopening)
        judgeConfirmation(o);
    if (wasOpen && !open(end)) {
        end.permitted = m_now;
        m_devices[o.device].closedSince[o.peer] = m_now;
        const bool frozen = m_now - m_devices[o.device].resumed < 1ms;
        require(o.silence <= m_rules.lost + clockDrift || frozen, "I1",
                fmt::format("a loss was noticed only after {} ns", o.silence.count()));
    }
    if (!open(end) && o.to != SessionState::Opening && o.to != SessionState::Reopening)
        require(m_waitingControl[{o.device, o.peer}].empty(), "I8", "control that was queued before the end was neither sent nor reported");
}

void ReferenceModel::on(const Lost& o) { m_lost.try_emplace(o.incident, IncidentFacts{pairOf(o.device, o.peer), false}); }

void ReferenceModel::on(const LaneTaken& o)
{
    require(m_rules.links.contains(pairOf(o.device, o.peer)), "I6", "a lane of a device without a link was taken");
    require(o.attachToken == o.sessionToken, "I6", "a lane of another session was taken into this one");
}

void ReferenceModel::on(const Opened& o)
{
    auto& end = m_ends[{o.device, o.peer}];
    require(o.epoch > end.epoch || !end.openedBefore, "I3", "control flows again in an epoch that was opened before");
    require(open(end), "I3", "opened, and not in the state for it");
    if (!o.healed) { // what heals was interrupted before, and its peer may know already
        if (end.openedBefore)
            end.permitted = m_now;
        end.stamps.clear(); // a peer that was restarted may have set its clock back
        judgeOpening(o);
    }
    end.openedBefore = true;
    end.epoch = o.epoch;
}

void ReferenceModel::judgeOpening(const Opened& o)
{
    const auto found = m_dialogues.find(o.token);
    const bool lies = m_devices[o.peer].lies;
    require(found != m_dialogues.end() || lies, "I4", "a session with a token that nobody drew");
    auto& held = m_devices[o.device].incidents;
    const bool holds = std::any_of(held.begin(), held.end(), [&](const auto& entry) { return entry.second == pairOf(o.device, o.peer); });
    require(!holds || o.reopened, "I4", "a lost link was opened again without a confirmation");
    if (found == m_dialogues.end())
        return;
    auto& dialogue = found->second;
    require(dialogue.opened.insert(o.device).second, "I3", "one dialogue opened twice at one end");
    require(dialogue.reopen == o.reopened || lies, "I4", "an opening became a re-opening");
    if (!o.reopened)
        return;
    require(dialogue.byPerson || lies, "I4", "re-opened, and no person confirmed it");
    for (auto& [incident, facts] : m_lost)
        if (facts.pair == pairOf(o.device, o.peer) && incident != o.token)
            facts.over = true;
}

void ReferenceModel::on(const Revoked& o)
{
    for (auto& [pair, end] : m_ends)
        if (pair.first == o.device)
            end.permitted = m_now;
}

void ReferenceModel::on(const Raised& o)
{
    auto& device = m_devices[o.device];
    if (device.incidents.empty())
        device.standsBySince = m_now;
    device.incidents[o.incident] = {o.first, o.second};
    require(m_lost.contains(o.incident) || someoneLies(), "I10", "an incident that no session's loss began");
}

void ReferenceModel::on(const Over& o)
{
    m_devices[o.device].incidents.erase(o.incident);
    const auto facts = m_lost.find(o.incident);
    require(someoneLies() || (facts != m_lost.end() && facts->second.over), "I10", "an incident ended that nobody re-opened or gave up");
}

void ReferenceModel::on(const Dismissed& o)
{
    const auto facts = m_lost.find(o.incident);
    if (facts != m_lost.end())
        facts->second.over = true;
}

void ReferenceModel::on(const Composed& o)
{
    forgetOld();
    m_sent[o.name] = {m_now, o.target, o.content, false};
    m_bySending.emplace_back(m_now, o.name);
    if (!o.control)
        return;
    require(open(m_ends[{o.device, o.target}]), "I8", "control was accepted for a session that is not open");
    m_waitingControl[{o.device, o.target}].insert(o.name);
}

void ReferenceModel::forgetOld()
{
    while (!m_bySending.empty() && m_now - m_bySending.front().first > memory) {
        m_sent.erase(m_bySending.front().second);
        m_bySending.pop_front();
    }
}

void ReferenceModel::drained(HostIndex device, HostIndex target, const MessageName& name)
{
    auto& waiting = m_waitingControl[{device, target}];
    waiting.erase(name);
}

void ReferenceModel::on(const Beat& o)
{
    const auto& end = m_ends[{o.device, o.target}];
    require(o.state == end.state, "I11", "a heartbeat says a state in which its session is not");
    require(o.epoch >= end.epoch, "I11", "a heartbeat says an epoch that is over");
}

void ReferenceModel::on(const Left& o)
{
    const auto sent = m_sent.find(o.name);
    const bool control = m_waitingControl[{o.device, o.target}].contains(o.name);
    const auto& end = m_ends[{o.device, o.target}];
    if (control && sent != m_sent.end())
        require(sent->second.at >= end.permitted && open(end), "I8", "a command that was queued before a loss left after it");
    drained(o.device, o.target, o.name);
}

void ReferenceModel::on(const Unsent& o) { drained(o.device, o.target, o.name); }

void ReferenceModel::on(const Kept& o)
{
    const bool command = o.name.number < 0x0200;
    const auto most = m_rules.largest.find({command ? o.device : o.peer, o.name.number});
    require(most == m_rules.largest.end() || o.bytes <= most->second, "I9", "a partial message is longer than it may become");
}

void ReferenceModel::on(const Delivered& o)
{
    const auto& end = m_ends[{o.device, o.peer}];
    auto& device = m_devices[o.device];
    const bool lies = m_devices[o.peer].lies;
    require(m_rules.links.contains(pairOf(o.device, o.peer)) && o.forUs, "I6", "a message that does not belong here");
    require(o.name.origin == m_rules.ids[o.peer], "I6", "a message whose origin is not the peer's identity");
    require(!o.refusedInStandBy || device.incidents.empty(), "I1", "a message that is refused in stand-by was delivered in it");
    const auto found = m_sent.find(o.name);
    auto* sent = found != m_sent.end() && found->second.target == o.device ? &found->second : nullptr;
    require(sent != nullptr || lies, "I5", "a message that nobody sent here, or long ago");
    if (sent != nullptr) {
        require(!sent->delivered || lies, "I2", "a message was delivered twice");
        require(sent->content == o.content || lies, "I2", "a message is not what was sent");
        sent->delivered = true;
    }
    const bool shared = open(end) || end.state == SessionState::Reconnecting || end.state == SessionState::Closing;
    require(o.control ? open(end) : shared, "I1", "a message was delivered while its session was not open");
    if (o.control)
        judgeControl(o, sent);
}

void ReferenceModel::judgeControl(const Delivered& o, const Sent* sent)
{
    ++m_controlDelivered;
    auto& end = m_ends[{o.device, o.peer}];
    auto& newest = end.delivered[o.name.number];
    const std::pair place(o.epoch, o.sequence);
    require(place > newest, "I2", fmt::format("control {}.{} after {}.{}", o.epoch, o.sequence, newest.first, newest.second));
    newest = std::max(newest, place);
    if (sent == nullptr || m_devices[o.peer].lies)
        return;
    require(o.name.stamp > end.stamps[o.name.number], "I2", "control in another order than it was given");
    end.stamps[o.name.number] = o.name.stamp;
    require(sent->at >= end.permitted, "I2", "control from before an interruption");
    const auto age = m_now - sent->at;
    const bool ofRobot = (o.name.number == motionCommand) && age > m_rules.motionAge + clockDrift && m_rules.ids[o.device] >> 29U == 0;
    require(age <= m_rules.lost + clockDrift && !ofRobot, "I5", fmt::format("control that is {} ns old", age.count()));
}

void ReferenceModel::on(const Applied& o)
{
    if (!o.engaged)
        return;
    auto& device = m_devices[o.device];
    require(open(m_ends[{o.device, o.owner}]) && device.incidents.empty(), "I1", "motion was applied without session or in stand-by");
    const auto sent = m_sent.find(o.name);
    device.engagedAt = m_now;
    device.engagedComposed = sent != m_sent.end() ? sent->second.at : m_now;
    device.owner = o.owner;
}

void ReferenceModel::on(const Drove& o)
{
    auto& device = m_devices[o.device];
    require(o.withinEnvelope, "I7", "the drives left their envelope");
    const auto began = m_now - o.passed;
    if (!o.moving)
        return;
    const auto slack = m_rules.ramp + clockDrift;
    require(began - device.engagedAt <= m_rules.lease + slack, "I1", "the drives move without a lease");
    require(began - device.engagedComposed <= m_rules.motionAge + m_rules.lease + slack, "I5", "the drives follow a hand of long ago");
    const bool session = open(m_ends[{o.device, device.owner}]);
    require(session || began - device.closedSince[device.owner] <= slack, "I1", "the drives move and the session is not open");
    require(device.incidents.empty() || began - device.standsBySince <= slack, "I1", "the drives move in stand-by");
    require(!o.faster || (session && device.incidents.empty() && began - device.engagedAt <= m_rules.lease + clockDrift), "I1",
            "the drives gain speed without a lease");
}

void ReferenceModel::on(const Holdings& o)
{
    require(o.partialBytes <= m_rules.partialBytes, "I9", "partial messages hold more than their budget");
    require(o.queuedBytes <= m_rules.queuedBytes * 2 * m_rules.links.size(), "I9", "queues hold more than their bounds");
    require(o.fresh <= mostFresh && o.pending <= mostPending && o.incidents <= mostIncidents, "I9", "more is held than is allowed");
    const bool frozen = m_now - m_devices[o.device].resumed < 1ms;
    require(o.silence <= m_rules.lost + clockDrift || frozen, "I1", "a session is open and its peer is silent");
}

void ReferenceModel::on(const Settled& o)
{
    require(o.state == SessionState::Open, "G19",
            fmt::format("{} and {} are not open again: state {}", o.device, o.peer, static_cast<int>(o.state)));
    require(o.incidents == 0, "I10", fmt::format("device {} still stands by", o.device));
    auto& end = m_ends[{o.device, o.peer}];
    end.epoch = std::max(end.epoch, o.epoch);
    if (m_settled.contains({o.peer, o.device})) {
        const auto& other = m_settled.at({o.peer, o.device});
        require(other.token == o.token, "I11", "two ends are open in two sessions");
        const auto rose = std::max(end.permitted, m_ends[{o.peer, o.device}].permitted);
        const bool agree = other.epoch == o.peerEpoch && other.peerEpoch == o.epoch;
        require(agree || m_now - rose < m_rules.agreement, "I11", "the ends do not agree on an epoch");
        m_settled.erase({o.peer, o.device});
    } else {
        m_settled[{o.device, o.peer}] = o;
    }
}

} // namespace liena::simulation
