// One TCP connection, in the clear or under TLS: bytes in, bytes out, and how it ended.
#pragma once

#include "liena/device_id.hpp"
#include "liena/error.hpp"
#include "security/datagram_seal.hpp"
#include "transport/handler_memory.hpp"
#include "transport/kernel_buffer.hpp"
#include "transport/path_facts.hpp"
#include "transport/stream_end.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace liena::security {
class TlsIdentity;
}

namespace liena::transport {

class WorkerThreads;

/// Network thread only. Shared, because an operation in flight and its owner end independently; after close() no callback comes any more.
///
/// The bytes of a connection that shareWork() was called for are read, written, sealed and opened by worker threads while there are any:
/// one step of one connection at a time, so that its order is kept. Everything else, and all that is told, stays on the network thread.
class TcpChannel : public std::enable_shared_from_this<TcpChannel> {
public:
    class Listener {
    public:
        virtual ~Listener() = default;
        virtual void bytesRead(std::size_t count) = 0;
        virtual void bytesWritten() = 0;
        virtual void roomMade() {} ///< after askForRoom() said no
        /// The connection failed or was closed by the peer; once. `identity`: TLS ended it over a certificate.
        virtual void channelLost(const std::string& detail, bool identity) = 0;
    };

    using HandshakeHandler = std::function<void(Result<void>)>;
    using Parts = StreamEnd::Parts;
    using Room = StreamEnd::Room;

    /// What keeps bytes where they are while a step in flight needs them.
    using Keeper = std::shared_ptr<const void>;

    explicit TcpChannel(boost::asio::ip::tcp::socket socket);
    ~TcpChannel();

    /// Puts TLS on the connection; `handler` is called once, unless close() comes first.
    void secure(SSL_CTX* context, bool asServer, HandshakeHandler handler);

    /// The device that the peer's certificate names; nothing in the clear.
    Result<std::optional<DeviceId>> peerDevice();

    /// The key of the datagram path that belongs to this connection; an error in the clear.
    Result<security::DatagramKey> datagramKey(std::uint64_t token) const;

    /// Whether the certificates of both ends allow a new session over this connection; always in the clear.
    Result<void> admitSession(security::TlsIdentity& identity);

    void setListener(Listener* listener) { m_listener = listener; }

    /// From now on worker threads do the steps, whenever there are some; `workers` outlives the connection.
    void shareWork(WorkerThreads& workers) { m_workers = &workers; }

    /// Worker threads do the steps now. Each wakes two threads, however short it is: who reads or writes much at a time has fewer.
    bool hasWorkers() const;

    /// One read in flight at a time. `room` stays until bytesRead; after close() for as long as `keeper` does.
    void read(Room room, Keeper keeper = nullptr);
    void read(std::span<std::byte> buffer, Keeper keeper = nullptr) { read(Room{{}, buffer}, std::move(keeper)); }

    /// One write in flight at a time; all of `parts`, in order. They and their bytes stay until bytesWritten; after close() for as long as
    /// `keeper` does. Under TLS each part is sealed by itself.
    void write(Parts parts, Keeper keeper = nullptr, Urgency urgency = Urgency::Urgent);

    /// Whether a patient write would leave now; otherwise roomMade() tells when to ask again. Only of Traffic::Prompt, with no write in
    /// flight; an urgent one may come before.
    bool askForRoom();

    /// Bytes of a patient write that leave in one piece.
    std::size_t patientWrite() const { return m_buffer.patientWrite(); }

    /// To be called when nothing waits to be written.
    void nothingWaits() { m_buffer.pause(); }

    /// What we send on this connection: small messages that must not wait, the same to a peer on this computer, where no path is shared, or
    /// much.
    enum class Traffic : std::uint8_t { Prompt, Here, Bulk };

    /// Chooses the kernel's buffers and timers, and marks the packets; a kernel that refuses one of them goes on without.
    void tune(Traffic traffic, std::uint8_t dscp);

    /// Gives what leaves, acknowledgements too, this DSCP (RFC 2474).
    void mark(std::uint8_t dscp);

    /// What arrives here are small messages that must not wait, and they may be answered elsewhere: they are acknowledged when reading goes
    /// on, after the answer has left. Else reading sends the acknowledgement first, and the answer waits until that has gone through the
    /// network stack.
    void expectPrompt();

    /// What was read is acknowledged now, and not with what comes next or 40 ms later, which the sender would take for a slow path.
    void acknowledge();

    /// Sends no faster than this, in bursts of at most so many bytes. Not while a write is in flight.
    void pace(double bytesPerSecond, std::size_t burst);

    /// The same rate for what the kernel has already, at any time.
    void slow(double bytesPerSecond);

    boost::asio::io_context& io() { return m_io; }

    std::optional<PathFacts> facts() const { return m_closed ? std::nullopt : readPathFacts(m_descriptor); }

    /// Both ends are on this computer: there is no path that others share.
    bool isLocal() const { return m_remote.address().is_loopback() || m_remote.address() == m_localAddress; }

    /// Of our end: which of our interfaces it leaves by.
    const boost::asio::ip::address& localAddress() const { return m_localAddress; }

    /// At once and without a word on the wire; harmless when repeated.
    void close();

    /// Bytes written that the peer's kernel has not acknowledged.
    std::size_t unacknowledged() const;

    bool isClosed() const { return m_closed; }
    bool isSecured() const { return m_end.tls() != nullptr; }
    boost::asio::ip::tcp::endpoint remote() const { return m_remote; }

private:
    using Step = StreamEnd::Step;

    /// One way of the connection, and its operation in flight.
    struct Way {
        bool active = false;         ///< asked for, and not over
        bool due = false;            ///< could go on, but the other way's step is in flight
        std::optional<Step> outcome; ///< of a step that was made and is not told yet
        Keeper keeper;
        HandlerMemory memory;
    };
    struct Ready;
    class WorkerStep;

    void pursueHandshake();
    void goOn(Way& way);
    Step step(Way& way, std::size_t most);
    void startOnWorker(Way& way);
    void stepFinished(Way& way, const Step& done);
    void settle(Way& way, const Step& done);
    void awaitNeed(Way& way, StreamEnd::Need need);
    void fitBuffer(Urgency urgency);
    void fitWhileWaiting();
    void later(Way& way);
    void lose(const StreamEnd::Failure& failure);
    void end();

    boost::asio::ip::tcp::socket m_socket;
    boost::asio::io_context& m_io;
    int m_descriptor;
    boost::asio::ip::tcp::endpoint m_remote;
    boost::asio::ip::address m_localAddress;
    StreamEnd m_end; ///< a worker's while its step is in flight
    HandshakeHandler m_handshake;
    Way m_reading;
    Way m_writing;
    Way m_makingRoom; ///< active: for patient bytes that are not written yet
    Room m_room;
    Parts m_parts;
    std::size_t m_done = 0;              ///< bytes of m_parts that have left
    std::size_t m_burst = 0;             ///< for the next write
    Urgency m_urgency = Urgency::Urgent; ///< of the last write
    KernelBuffer m_buffer;
    WorkerThreads* m_workers = nullptr;
    std::uint64_t m_mark = 0;
    Listener* m_listener = nullptr;
    bool m_expectsPrompt = false;
    bool m_stepInFlight = false; ///< on a worker
    bool m_closed = false;
};

} // namespace liena::transport
