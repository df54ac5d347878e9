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

    /// Reads the topology, the message sets and the certificates, and takes the port. Nothing runs yet.
    static Result<std::unique_ptr<DistributedSystem>> create(Settings settings);

    ~DistributedSystem(); ///< stops
    DistributedSystem(const DistributedSystem&) = delete;
    DistributedSystem& operator=(const DistributedSystem&) = delete;

    // Before start():

    /// `handler` gets every message of that name, from any peer, on the network thread; it does not go to the cache then.
    /// An error if neither our set (commands) nor a linked peer's set (reports) in the register has that name.
    Result<void> subscribe(std::string_view message, MessageHandler handler);

    /// The same for whoever keeps messages, as images for a thread of their own: nothing is copied, the bytes stay where they were put
    /// together. Any thread may read and let go of it, also after this object is gone; the buffer of a long one is then used again. One per
    /// name, called after those that only look.
    Result<void> subscribeToKeep(std::string_view message, KeepingHandler handler);

    /// Every SessionEvent on the network thread; the cache gets it as well.
    void subscribe(EventHandler handler);

    /// Runs `task` on the network thread each `period`, from start() to stop(); a run that is late is not made up for.
    void every(std::chrono::nanoseconds period, std::function<void()> task);

    /// Starts listening and the network thread.
    void start();

    /// Closes every session in order (bounded by one second) and ends the network thread. Harmless when repeated. Not from that thread.
    void stop();

    const SystemTopology& topology() const;
    const TopologyDevice& self() const;

    /// The set of a device of this topology: our own, the register's or a learnt one; null while it is unknown.
    std::shared_ptr<const MessageSet> messageSet(DeviceId device) const;

    // Sessions. These start a dialogue; its outcome is a SessionEvent.

    Result<void> openChannel(DeviceId peer);
    Result<void> closeChannel(DeviceId peer, std::string_view reason = {});

    /// Only on a person's command. Ends the pair's incidents when it succeeds; it never gives permission to move.
    Result<void> reopenChannel(DeviceId peer);

    /// Only on a person's command: gives an incident up because a device will not return. Its link stays closed.
    Result<void> dismissIncident(IncidentId incident, std::string_view reason);

    /// Looks what stands between us and a peer that is not in session; the outcome is a SessionEvent (Diagnosed).
    Result<void> probe(DeviceId peer);

    /// Measures the line to a peer inside its open session, within Settings::measuring of both ends; `done` hears the figures on the
    /// network thread, in the order of the calls. What is sent waits behind every command, and nothing of it can end the session. One at a
    /// time.
    Result<void> measure(DeviceId peer, MeasurementPlan plan, MeasurementHandler done);
    void stopMeasuring(DeviceId peer);

    // Stand-by.

    std::vector<Incident> incidents() const;

    /// This device has stopped and holds (or no longer does): told to every device for each incident, now and later ones, until changed.
    void confirmHold(bool holding);

    /// Raises the epoch of every session: no control message composed before the peers hear of it will be delivered.
    void revokeControl();

    // Messages.

    /// A report of our own set, or a command of `target`'s set, with every field at its default.
    Result<Message> report(std::string_view name) const;
    Result<Message> command(DeviceId target, std::string_view name) const;

    /// Accepts the message for sending, or says why not. Accepted is not delivered: what is lost later is told by an event (SendFailed).
    Result<void> send(DeviceId target, Message message);

    /// A report to every device whose session is Open; returns how many.
    std::size_t publish(Message message);

    MessageCache& cache();

    std::vector<LinkStatus> links() const;

    /// Puts what only the application knows into the audit file: `event` as `permit-granted`, and who decided it. Without such a file it
    /// does nothing. Never waits for the disk; any thread.
    void audit(std::string_view event, std::string_view who, std::string_view text = {});

    /// Runs `task` on the network thread soon; in order of the calls of one thread.
    void post(std::function<void()> task);

private:
    struct State;
    explicit DistributedSystem(std::unique_ptr<State> state);
    std::unique_ptr<State> m_state;
};

} // namespace liena
