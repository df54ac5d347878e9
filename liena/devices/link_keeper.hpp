// Which links a patient-side device opens by itself, and when it may follow a person's re-open.
#pragma once

#include "drive_gate.hpp"

#include "liena/session_event.hpp"

#include <chrono>
#include <map>
#include <vector>

namespace liena::devices {

/// Opens from Closed again and again, never out of stand-by: a lost link is re-opened only after a person re-opened, elsewhere, a channel
/// between a cockpit and this device or the lost link's peer, and only a few times then. Pure: time comes from the caller.
/// A device that was restarted holds no incident that could end: to it, that a cockpit re-opened its own channel here says the same, also
/// before it hears from the peer that there is an incident.
///
///   Wanted ──due──► Trying ──opened──► Up ──closed in order──► Wanted
///     ▲               │ failed, again after 1 s              Up ──lost──► Lost ──a person's re-open heard──► Following ──opened──► Up
///     └───────────────┘                                       ▲                                                │ five failures, or lost
///                                                             └───────────────────────────────────── Lost ◄────┘
///   Left: a person closed it here or gave its incident up; only a person's `open` leads back to Wanted.
class LinkKeeper {
public:
    static constexpr std::chrono::seconds pause{1};
    static constexpr int mostFollowing = 5;

    enum class Act : std::uint8_t { Open, ReOpen };
    struct Wish {
        DeviceId peer;
        Act act = Act::Open;
    };

    LinkKeeper(DeviceId self, const std::vector<DeviceId>& peers);

    void handle(const SessionEvent& event, SteadyTime now);

    /// A person here closed the link, or asked to open it.
    void closedByPerson(DeviceId peer);
    void openedByPerson(DeviceId peer, SteadyTime now);

    /// What is due now; each wish is given once per try.
    std::vector<Wish> due(SteadyTime now);

private:
    enum class State : std::uint8_t { Wanted, Up, Lost, Following, Left };
    struct Link {
        State state = State::Wanted;
        SteadyTime next; ///< of the next try
        int tries = 0;
        bool personReopened = false; ///< while it was Wanted
    };

    void handleOwn(Link& link, const SessionEvent& event, SteadyTime now);
    void handleIncidentEnded(const SessionEvent& event, SteadyTime now);
    static void follow(Link& link, SteadyTime now);
    bool personReopened(const SessionEvent& event, DeviceId peer) const;

    DeviceId m_self;
    std::map<DeviceId, Link> m_links;
};

} // namespace liena::devices
