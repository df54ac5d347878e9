// A peer for tests that speaks LiENa from PROTOCOL.md alone: it opens an honest session and then does whatever it is told.
#pragma once

#include "support/tls_link.hpp"
#include "support/wire_words.hpp"

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <thread>

namespace liena::test {

/// Whom it plays, and against whom.
struct PeerRole {
    std::uint32_t id = 0;
    std::uint16_t port = 0; ///< where the device connects back to: TCP and UDP
    std::uint32_t device = 0;
    std::uint16_t devicePort = 0;
    std::string topology;  ///< the file's text
    std::string set;       ///< our message set's text
    std::string sentSet;   ///< what is sent for it; empty: the same
    std::string deviceSet; ///< the device's
    TlsFace face;
    std::chrono::milliseconds heartbeat{50};
};

/// Its own thread answers the device, beats and reads; everything else happens when a test says so, in the test's thread.
///
/// The honest steps throw when they do not succeed, since no test can go on then.
class ScriptedPeer {
public:
    /// What it does by itself. May be changed at any time.
    struct Habits {
        std::atomic<bool> heartbeats{true};
        std::atomic<bool> datagrams{true}; ///< heartbeats also by UDP
        std::atomic<bool> laneZero{true};  ///< heartbeats also on lane 0
        std::atomic<bool> accepts{true};   ///< takes connections to its own port
        std::atomic<bool> reads{true};     ///< what the device says on them
        std::atomic<bool> answers{true};   ///< goes on with the dialogue of an opening
        /// The device's heartbeats are that long on their way to us.
        std::atomic<std::chrono::milliseconds> delay{std::chrono::milliseconds(0)};
        /// One in four of our heartbeats is that long on its way to the device, and those behind it wait for it, as in a queue. What a
        /// test says itself does not wait.
        std::atomic<std::chrono::milliseconds> lateness{std::chrono::milliseconds(0)};
    };

    struct Heard {
        wire::Datagram datagram;
        std::uint8_t lane = 0;
        std::uint64_t token = 0; ///< of the connection's Attach
    };

    struct Guard {
        std::uint32_t epoch = 0;
        std::uint32_t sequence = 0;
        std::uint32_t echo = 0;
    };

    explicit ScriptedPeer(PeerRole role);
    ~ScriptedPeer();

    Habits habits;
    const PeerRole& role() const { return m_role; }

    /// Opens a session as the one who asks: with a DiagnosisHandshake when `again`.
    void open(bool again = false);
    /// The same, or the reason of the Rejected that it got; 0 when the device ended it without a word.
    std::optional<std::uint8_t> refusalOfOpening(bool again = false);
    /// The same when it cannot even connect: the reason is then 0.
    std::optional<std::uint8_t> refusalOfConnecting();
    /// Connects and says the handshake, no more.
    void begin(bool again);
    /// From now on it announces the hash of `announced` as its set, and sends `sent` when it is asked.
    void showSet(const std::string& announced, const std::string& sent);
    /// From now on it shows this identity, on both ends of its connections.
    void show(const TlsFace& face);
    void close(); ///< in order
    /// Waits until the device has opened a session with us.
    void awaitOpen();
    bool isOpen() const;
    bool laneClosed() const; ///< our lane 0 was closed by the device
    std::uint64_t token() const;
    std::uint8_t deviceState() const; ///< as its newest Heartbeat says
    std::uint32_t deviceEpoch() const;

    /// True as soon as `holds` does, asked after each thing that happens; false when it never did within TlsLink::patience.
    bool waits(const std::function<bool()>& holds) const;

    // Words for any connection.
    std::uint64_t stamp(); ///< now, and newer than any before
    wire::Header header(std::uint16_t number);
    wire::Bytes said(std::uint16_t number, const wire::Bytes& body) { return wire::datagram(header(number), body); }
    wire::Bytes attach(std::uint64_t token, std::uint8_t lane = 0) { return said(wire::number::attach, wire::attach(token, lane)); }
    wire::Bytes handshake(std::uint64_t token);
    wire::Bytes diagnosisHandshake(std::uint64_t token, std::uint64_t previous);

    /// A new connection to the device, on which nothing was said. Ask its failure().
    std::unique_ptr<TlsLink> connection() const { return TlsLink::connect(m_client.get(), m_role.devicePort); }
    /// A new connection, on which `first` was said.
    std::unique_ptr<TlsLink> saying(const wire::Bytes& first) const;
    /// A connection that is attached to the session in hand as this lane.
    std::unique_ptr<TlsLink> lane(std::uint8_t lane);
    /// Leaves it open as long as the peer lives.
    TlsLink* keep(std::unique_ptr<TlsLink> link) { return m_kept.emplace_back(std::move(link)).get(); }

    /// Our lane 0 is made anew with the same token, as after a broken connection.
    void replaceLaneZero();
    /// Says something on the connection that the device made to us.
    bool talkBack(const wire::Bytes& bytes);

    // On lane 0 of the session in hand.
    bool send(const wire::Bytes& bytes);
    bool say(std::uint16_t number, const wire::Bytes& body);
    /// The next right guard for a command of this number.
    Guard guard(std::uint16_t number);
    wire::Bytes control(std::uint16_t number, const wire::Bytes& fields, const Guard& guard);
    bool command(std::uint16_t number, const wire::Bytes& fields) { return send(control(number, fields, guard(number))); }

    // By UDP.
    wire::Bytes packet(const wire::Bytes& datagram); ///< sealed under the next number
    wire::Bytes packetNumbered(std::uint64_t packet, const wire::Bytes& datagram) const;
    std::uint64_t lastPacket() const;
    void sendPacket(const wire::Bytes& packet) const;
    std::vector<wire::Bytes> sentPackets() const; ///< the newest 2 000, as they left

    /// What the device said, of one number.
    std::vector<Heard> heard(std::uint16_t number) const;
    std::size_t packetsHeard() const; ///< genuine ones of the session in hand

private:
    struct Incoming {
        std::unique_ptr<TlsLink> link;
        wire::Bytes stream;
        std::uint64_t token = 0;
        std::uint8_t lane = 0;
    };

    void run();
    void accept();
    void read(Incoming& incoming);
    void readPackets();
    void judge(Incoming& incoming, const wire::Datagram& datagram);
    void answer(const wire::Datagram& datagram);
    void sendSet();
    void hear(const wire::Heartbeat& beat);
    void hearDelayed();
    void take(const wire::Heartbeat& beat);
    void beat();
    void sendLate();
    void begin(std::uint64_t token, std::unique_ptr<TlsLink> lane0, const wire::Bytes& first);
    wire::Bytes sealNext(const wire::Bytes& datagram);

    PeerRole m_role;
    ContextPtr m_client;
    ContextPtr m_server;
    Descriptor m_listener;
    Descriptor m_udp;

    mutable std::mutex m_mutex;
    mutable std::condition_variable m_changed;
    std::unique_ptr<TlsLink> m_lane0;
    std::vector<std::unique_ptr<Incoming>> m_incoming;
    std::vector<std::unique_ptr<TlsLink>> m_kept;
    std::deque<Heard> m_heard;
    std::deque<wire::Bytes> m_sentPackets;
    std::deque<std::chrono::steady_clock::time_point> m_packetTimes;
    std::map<std::uint16_t, std::uint32_t> m_sequences;
    wire::Bytes m_sealKey;
    wire::Bytes m_openKey;
    struct Underway {
        std::chrono::steady_clock::time_point arrives;
        wire::Heartbeat beat;
    };
    std::deque<Underway> m_underway;
    struct Late {
        std::chrono::steady_clock::time_point leaves;
        wire::Bytes datagram;
    };
    std::deque<Late> m_late;
    wire::Heartbeat m_newest;
    std::uint64_t m_newestReceived = 0;
    std::uint64_t m_token = 0;
    std::uint64_t m_previous = 0; ///< the incident of this pair
    std::uint64_t m_packet = 0;
    std::uint64_t m_packetsHeard = 0;
    std::uint32_t m_beat = 0;
    std::uint32_t m_epoch = 0;
    std::uint8_t m_state = wire::state::closed;
    bool m_again = false;
    bool m_laneClosed = false;
    std::atomic<std::uint64_t> m_lastStamp{0};
    std::atomic<bool> m_stop{false};
    std::thread m_thread;
};

} // namespace liena::test
