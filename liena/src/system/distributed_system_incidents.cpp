// Incidents: what is told of them, and to whom.
#include "system/distributed_system_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <variant>

namespace liena {

void DistributedSystem::State::sessionOpened(DeviceId peer, const session::SessionOpened& opened)
{
    if (opened.reopened)
        perform(ledger.reopened(peer, opened.token, opened.incident, now()));
    perform(ledger.greet(peer));
}

void DistributedSystem::State::sessionLost(DeviceId peer, const session::SessionLost& lost, SessionEvent event)
{
    const auto actions = ledger.lost(peer, lost.incident, lost.diagnosis.cause, lost.diagnosis.since, now());
    showIncidents();
    tell(std::move(event));
    perform(actions);
}

void DistributedSystem::State::showIncidents()
{
    board.showIncidents(ledger.incidents());
    for (auto& [peer, one] : modules)
        one->setIncidentCount(ledger.size());
}

void DistributedSystem::State::heardBroadcast(DeviceId from, const protocol::SessionMessage& message)
{
    if (const auto* standBy = std::get_if<protocol::StandBy>(&message))
        perform(ledger.heard(from, *standBy, now()));
    else if (const auto* report = std::get_if<protocol::StandByReport>(&message))
        heardHold(from, *report);
    else if (const auto* dismissed = std::get_if<protocol::IncidentDismissed>(&message))
        perform(ledger.heard(from, *dismissed, now()));
    else if (const auto* reopened = std::get_if<protocol::ChannelReOpened>(&message)) {
        const auto actions = ledger.heard(from, *reopened, now());
        if (actions.size() > 1) // else it is handed on and ends nothing here, and there may be many
            log(LogLevel::Info, "channel-reopened",
                fmt::format("{} says that {} and {} re-opened their channel", from.toString(), reopened->peerA.toString(),
                            reopened->peerB.toString()));
        perform(actions);
    }
}

/// All devices of a system have the same topology, so that nobody else can have confirmed anything.
void DistributedSystem::State::heardHold(DeviceId from, const protocol::StandByReport& report)
{
    if (topology.find(report.device) != nullptr)
        perform(ledger.heard(from, report, now()));
    else if (auto* one = module(from))
        one->notTaken("it speaks of a device that is not in the topology", protocol::StandByReport::number);
}

void DistributedSystem::State::perform(const session::LedgerActions& actions)
{
    // Whatever changes an incident is told; what is only handed on may come often.
    if (std::ranges::any_of(actions, [](const auto& action) { return std::holds_alternative<session::Tell>(action); }))
        showIncidents();
    for (const auto& action : actions) {
        if (const auto* broadcast = std::get_if<session::Broadcast>(&action)) {
            performBroadcast(*broadcast);
        } else if (const auto* answer = std::get_if<session::Answer>(&action)) {
            if (auto* one = module(answer->to))
                one->sendSession(answer->message, DeviceId::broadcast());
        } else if (const auto* changed = std::get_if<session::PairChanged>(&action)) {
            if (auto* one = module(changed->peer))
                one->setIncident(changed->incident, changed->ended);
        } else if (const auto* told = std::get_if<session::Tell>(&action)) {
            logIncident(told->event);
            tell(told->event);
        } else if (const auto* violation = std::get_if<session::LedgerViolation>(&action)) {
            if (auto* one = module(violation->peer))
                one->endForViolation(violation->detail);
        } else if (const auto* notKept = std::get_if<session::IncidentNotKept>(&action)) {
            if (auto* one = module(notKept->teller))
                one->notTaken("more incidents than a device keeps", protocol::StandBy::number);
        } else if (const auto* news = std::get_if<session::NewsNotHandedOn>(&action)) {
            if (auto* one = module(news->teller))
                one->notTaken("more news of incidents than is handed on of one device", news->number);
        }
    }
}

void DistributedSystem::State::performBroadcast(const session::Broadcast& broadcast)
{
    for (auto& [peer, one] : modules)
        if ((carriesMessages(one->state()) || one->state() == SessionState::Reconnecting) && peer != broadcast.except)
            one->sendSession(broadcast.message, DeviceId::broadcast());
}

} // namespace liena
