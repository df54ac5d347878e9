// The facade: one device's part in a robotic system.
#pragma once

#include "liena/device_id.hpp"
#include "liena/error.hpp"
#include "liena/measurement.hpp"
#include "liena/message.hpp"
#include "liena/message_cache.hpp"
#include "liena/message_set.hpp"
#include "liena/session_event.hpp"
#include "liena/settings.hpp"
#include "liena/system_topology.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace liena {

/// Opens and keeps sessions with the devices it is linked to.
///
/// One network thread runs everything from start() to stop(). Subscriptions, timers and posted functions run on that thread and must not
/// block it: a heartbeat waits behind them. All other functions may be called from any thread, also from that one.
class DistributedSystem {
public:
    using MessageHandler = std::function<void(const Message&)>;
    using KeepingHandler = std::function<void(std::shared_ptr<const Message>)>;
    using EventHandler = std::function<void(const SessionEvent&)>;
    using MeasurementHandler = std::function<void(const Measurement&)>;

    /// Reads the topology, the message sets and the certificates, and takes the port. Nothing runs yet. Blocks: it reads files and asks for
    /// the address of this device's host. Errors: of the files TopologyInvalid, XmlInvalid, MessageSetInvalid, CertificateInvalid,
    /// FileUnreadable, and FileUnwritable (store, audit); UnknownDevice when the topology has no such device; AddressUnavailable; Forbidden
    /// for what the operating system does not permit, and for an open network in mode `none`; InvalidArgument for marks and `realTime`.
    static Result<std::unique_ptr<DistributedSystem>> create(Settings settings);

    ~DistributedSystem(); ///< stops
    DistributedSystem(const DistributedSystem&) = delete;
    DistributedSystem& operator=(const DistributedSystem&) = delete;

    // Before start():

    /// `handler` gets every message of that name, from any peer, on the network thread; it does not go to the cache then. Of a name that
    /// is a command of our own set it gets that command only: what a peer reports by the same name goes to the cache.
    /// UnknownMessage if neither our set (commands) nor a linked peer's set (reports) in the register has that name.
    Result<void> subscribe(std::string_view message, MessageHandler handler);

    /// The same for whoever keeps messages, as images for a thread of their own: nothing is copied, the bytes stay where they were put
    /// together. Any thread may read and let go of it, also after this object is gone; the buffer of a long one is then used again. One per
    /// name (InvalidArgument for another), called after those that only look.
    Result<void> subscribeToKeep(std::string_view message, KeepingHandler handler);

    /// Every SessionEvent on the network thread; the cache gets it as well.
    void subscribe(EventHandler handler);

    /// Runs `task` on the network thread each `period`, from start() to stop(); a run that is late is not made up for. One that is
    /// given after start() never runs.
    void every(std::chrono::nanoseconds period, std::function<void()> task);

    /// Starts listening and the network thread. Once: after stop() it does nothing.
    void start();

    /// Closes every session in order (bounded by one second) and ends the network thread. Harmless when repeated. Not from that thread.
    void stop();

    // Valid as long as this object.
    const SystemTopology& topology() const;
    const TopologyDevice& self() const;

    /// The set of a device of this topology: our own, the register's or a learnt one; null while it is unknown.
    std::shared_ptr<const MessageSet> messageSet(DeviceId device) const;

    // Sessions. These start a dialogue; its outcome is a SessionEvent. Those that name a peer fail with UnknownDevice (not in the
    // topology), NoLink (in it, and not linked to us) and, after stop(), Stopped.

    /// Busy unless the session is Closed; StandBy when a person has to re-open it.
    Result<void> openChannel(DeviceId peer);

    /// NotOpen when it is Closed or in stand-by. An opening that is under way is given up.
    Result<void> closeChannel(DeviceId peer, std::string_view reason = {});

    /// Only on a person's command. Ends the pair's incidents when it succeeds; it never gives permission to move. NoIncident unless the
    /// session is in stand-by; Busy while it is being re-opened.
    Result<void> reopenChannel(DeviceId peer);

    /// Only on a person's command: gives an incident up because a device will not return. Its link stays closed. NoIncident when this
    /// device does not hold it.
    Result<void> dismissIncident(IncidentId incident, std::string_view reason);

    /// Looks what stands between us and a peer that is not in session; the outcome is a SessionEvent (Diagnosed).
    Result<void> probe(DeviceId peer);

    /// Measures the line to a peer inside its open session, within Settings::measuring of both ends; `done` hears the figures on the
    /// network thread, in the order of the calls. What is sent waits behind every command, and nothing of it can end the session. NotOpen
    /// unless the session is Open: not when it is Suspect, either. One at a time for each peer, and while a device is in use one on all its
    /// sessions, which a peer may have asked for: `done` of a second one hears at once that it failed and which line is being measured, as
    /// it hears all that goes wrong later (Measurement::failure). When stop() comes first it may never be called.
    Result<void> measure(DeviceId peer, MeasurementPlan plan, MeasurementHandler done);
    void stopMeasuring(DeviceId peer);

    // Stand-by.

    std::vector<Incident> incidents() const;

    /// This device has stopped and holds (or no longer does): told to every device for each incident, now and later ones, until changed.
    void confirmHold(bool holding);

    /// Raises the epoch of every session: no control message composed before the peers hear of it will be delivered.
    void revokeControl();

    // Messages.

    /// A report of our own set, or a command of `target`'s set, with every field at its default. UnknownMessage when the set has none of
    /// that name; NotYet while the target's set is unknown, which is so before the first session with a device whose set is not in the
    /// register.
    Result<Message> report(std::string_view name) const;
    Result<Message> command(DeviceId target, std::string_view name) const;

    /// Accepts the message for sending, or says why not. Accepted is not delivered: what is lost later is told by an event (SendFailed).
    ///
    /// ValueRefused (the message's fault()), UnknownMessage (a report that is not of our set, a command that is not of the target's),
    /// NotOpen (control also when it is interrupted; all else waits then), StandBy, UnknownDevice, NoLink, Stopped, and QueueFull when too
    /// many messages of its priority wait for the network thread. Only the network thread itself gets these back, others hear of them by
    /// SendFailed: Forbidden by the topology's flows, NotYet for control before the session's first heartbeat, QueueFull when too much
    /// waits for this peer.
    Result<void> send(DeviceId target, Message message);

    /// A report to every device whose session is open or interrupted, where it waits; returns how many are open. 0, and nothing is sent,
    /// when the message has a fault() or is no report, and after stop(): look at fault() where values may be refused. So it is from other
    /// threads when none is open. What single sessions refuse is not told.
    std::size_t publish(Message message);

    MessageCache& cache(); ///< valid as long as this object

    /// Of every link of this device, a copy of one moment.
    std::vector<LinkStatus> links() const;

    /// Puts what only the application knows into the audit file: `event` as `permit-granted`, and who decided it. Without such a file it
    /// does nothing. Never waits for the disk; any thread.
    void audit(std::string_view event, std::string_view who, std::string_view text = {});

    /// Runs `task` on the network thread soon; in order of the calls of one thread. Before start() it waits for that; what stop() finds
    /// waiting runs in stop(), and what comes later never. A stall of this process is known, and its sessions are interrupted, before it
    /// runs.
    void post(std::function<void()> task);

private:
    struct State;
    explicit DistributedSystem(std::unique_ptr<State> state);
    std::unique_ptr<State> m_state;
};

} // namespace liena
