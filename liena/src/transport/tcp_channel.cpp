// Reading, writing and ending of one connection.
#include "transport/tcp_channel.hpp"

#include "security/tls_identity.hpp"
#include "transport/close_on_exec.hpp"
#include "transport/packet_mark.hpp"
#include "transport/worker_threads.hpp"

#include <boost/asio/post.hpp>

#include <linux/sockios.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <numeric>
#include <optional>
#include <utility>

namespace liena::transport {

namespace asio = boost::asio;
using asio::ip::tcp;

namespace {

constexpr int mostBulkUnsent = 128 * 1024;
constexpr std::size_t networkStep = 16 * 1024 + 64; // bytes, about, in one turn of the network thread: a segment and a header
constexpr std::size_t workerStep = 1024 * 1024;

std::size_t sizeOf(TcpChannel::Parts parts)
{
    return std::accumulate(parts.begin(), parts.end(), std::size_t{0}, [](std::size_t sum, const auto part) { return sum + part.size(); });
}

void set(int socket, int level, int option, int value)
{
    (void)::setsockopt(socket, level, option, &value, sizeof value); // without it all works as before
}

/// What is lost twice waits for a timer of at least 200 ms and stalls the lane that long, twice that when it is lost again. Where the
/// kernel can (Linux 6.15: TCP_RTO_MIN_US, which Debian's header does not name), the timer may be as short as a heartbeat. Not for bulk:
/// a connection that was idle for longer than this timer forgets how fast it could send.
void retransmitSoon(int socket)
{
    constexpr int rtoMinUs = 45;
    constexpr int soonest = 20'000;
    set(socket, IPPROTO_TCP, rtoMinUs, soonest);
}

/// What the kernel may be asked to hold of one connection, in bytes, where that is more than it would by itself; else nothing. It writes
/// on when a third of its buffer is free, so that two thirds of it are what a long path carries in a round trip (tcp(7): tcp_wmem;
/// socket(7): wmem_max, of which it takes the double).
std::optional<int> largestSendBuffer()
{
    static const std::optional<int> largest = []() -> std::optional<int> {
        int asked = 0;
        int least = 0;
        int usual = 0;
        int byItself = 0;
        std::ifstream("/proc/sys/net/core/wmem_max") >> asked;
        std::ifstream("/proc/sys/net/ipv4/tcp_wmem") >> least >> usual >> byItself;
        return byItself > 0 && asked > byItself / 2 ? std::optional(asked) : std::nullopt;
    }();
    return largest;
}

} // namespace

TcpChannel::TcpChannel(tcp::socket socket)
    : m_socket(std::move(socket)),
      m_io(static_cast<asio::io_context&>(m_socket.get_executor().context())),
      m_descriptor(m_socket.native_handle()),
      m_end(m_descriptor)
{
    closeOnExec(m_descriptor);
    boost::system::error_code ignored;
    m_socket.set_option(tcp::no_delay(true), ignored);
    m_remote = m_socket.remote_endpoint(ignored);
    m_localAddress = m_socket.local_endpoint(ignored).address();
}

void TcpChannel::tune(Traffic traffic, std::uint8_t dscp)
{
    if (m_closed)
        return;
    mark(dscp);
    if (traffic == Traffic::Bulk)
        return;
    retransmitSoon(m_descriptor);
    m_end.keepBuffers();
    const int mostUnsent = traffic == Traffic::Prompt ? PromptBuffer::unsent : PromptBuffer::unsentHere;
    set(m_descriptor, SOL_SOCKET, SO_SNDBUF, m_buffer.begin(mostUnsent));
    set(m_descriptor, IPPROTO_TCP, TCP_NOTSENT_LOWAT, mostUnsent);
}

void TcpChannel::expectPrompt()
{
    m_expectsPrompt = true;
    m_end.keepBuffers();
}

/// tcp(7), TCP_QUICKACK: 1 sends an acknowledgement that is due; 0 leaves the next one to what is answered.
void TcpChannel::acknowledge()
{
    if (m_closed)
        return;
    set(m_descriptor, IPPROTO_TCP, TCP_QUICKACK, 1);
    if (m_expectsPrompt)
        set(m_descriptor, IPPROTO_TCP, TCP_QUICKACK, 0);
}

void TcpChannel::mark(std::uint8_t dscp)
{
    if (!m_closed)
        markPackets(m_descriptor, m_remote.address().is_v6(), dscp);
}

void TcpChannel::pace(double bytesPerSecond, std::size_t burst)
{
    if (m_closed)
        return;
    slow(bytesPerSecond);
    if (const auto buffer = largestSendBuffer(); buffer && m_burst == 0)
        set(m_descriptor, SOL_SOCKET, SO_SNDBUF, *buffer); // as long as the path; what waits in front of it is limited below
    // What is in the kernel can no longer give way to something newer, nor to a path that becomes narrow: 4 ms of it, within bounds.
    const auto unsent = std::clamp(static_cast<int>(std::min(bytesPerSecond / 250, 1e9)), static_cast<int>(2 * burst), mostBulkUnsent);
    set(m_descriptor, IPPROTO_TCP, TCP_NOTSENT_LOWAT, unsent);
    m_burst = burst; // at the next step
}

void TcpChannel::slow(double bytesPerSecond)
{
    const auto rate = static_cast<std::uint64_t>(bytesPerSecond);
    if (!m_closed)
        (void)::setsockopt(m_descriptor, SOL_SOCKET, SO_MAX_PACING_RATE, &rate, sizeof rate);
}

TcpChannel::~TcpChannel() { close(); }

/// The socket can be read, or written, or it is just time to go on.
struct TcpChannel::Ready {
    using allocator_type = HandlerAllocator<std::byte>;

    std::shared_ptr<TcpChannel> channel;
    Way* way;

    allocator_type get_allocator() const { return allocator_type(way->memory); }
    void operator()(const boost::system::error_code& /*error*/) { (*this)(); } // the next step meets it, too
    void operator()() { channel->goOn(*way); }
};

void TcpChannel::secure(SSL_CTX* context, bool asServer, HandshakeHandler handler)
{
    m_handshake = std::move(handler);
    if (!m_end.secure(context, asServer))
        m_handshake = nullptr; // no memory: the deadline of whoever asked ends it
    later(m_reading);
}

void TcpChannel::pursueHandshake()
{
    const auto done = m_end.shakeHands();
    if (done.need != StreamEnd::Need::Nothing)
        return awaitNeed(m_reading, done.need);
    const auto handler = std::exchange(m_handshake, nullptr);
    if (!done.failure)
        return handler(ok());
    handler(fail(Errc::CertificateInvalid,
                 done.failure->tls ? done.failure->detail : "the connection ended during the TLS handshake: " + done.failure->detail));
}

Result<std::optional<DeviceId>> TcpChannel::peerDevice()
{
    if (!isSecured())
        return std::optional<DeviceId>();
    const auto device = security::peerDevice(m_end.tls());
    if (!device)
        return device.as_failure();
    return std::optional(device.value());
}

Result<security::DatagramKey> TcpChannel::datagramKey(std::uint64_t token) const
{
    if (!isSecured())
        return fail(Errc::CertificateInvalid, "a connection in the clear has no keys");
    return security::exportDatagramKey(m_end.tls(), token);
}

Result<void> TcpChannel::admitSession(security::TlsIdentity& identity)
{
    return isSecured() ? identity.trust().admitSession(m_end.tls()) : ok();
}

void TcpChannel::read(Room room, Keeper keeper)
{
    m_room = room;
    m_reading.keeper = std::move(keeper);
    m_reading.active = true;
    if (m_stepInFlight)
        m_reading.due = true;
    else if (m_end.mayHaveMore())
        later(m_reading);
    else
        awaitNeed(m_reading, StreamEnd::Need::Readable);
}

void TcpChannel::write(Parts parts, Keeper keeper, Urgency urgency)
{
    m_parts = parts;
    m_done = 0;
    m_urgency = urgency;
    fitBuffer(urgency);
    m_writing.keeper = std::move(keeper);
    m_writing.active = true;
    if (m_stepInFlight)
        m_writing.due = true;
    else if (hasWorkers())
        startOnWorker(m_writing);
    else {
        m_writing.outcome = step(m_writing, networkStep); // now, and told later
        later(m_writing);
    }
}

bool TcpChannel::hasWorkers() const { return m_workers != nullptr && m_workers->count() > 0; }

/// In a turn of its own.
void TcpChannel::goOn(Way& way)
{
    if (m_closed)
        return;
    if (m_handshake)
        return pursueHandshake();
    if (!way.active)
        return;
    if (&way == &m_makingRoom) {
        way.active = false;
        if (m_listener != nullptr)
            m_listener->roomMade();
        return;
    }
    if (way.outcome)
        return settle(way, *std::exchange(way.outcome, std::nullopt));
    if (m_stepInFlight)
        way.due = true;
    else if (hasWorkers())
        startOnWorker(way);
    else
        settle(way, step(way, networkStep));
}

/// On whichever thread has its turn: it touches nothing but m_end and what belongs to this way.
TcpChannel::Step TcpChannel::step(Way& way, std::size_t most)
{
    const bool counted = m_workers != nullptr && most == networkStep;
    const auto begin = counted ? std::chrono::steady_clock::now() : std::chrono::steady_clock::time_point();
    if (&way == &m_writing) {
        m_end.limitBursts(m_burst);
        m_end.keepApart(m_urgency == Urgency::Patient);
    }
    auto done = &way == &m_reading ? m_end.read(m_room, most) : m_end.write(m_parts, m_done, most);
    if (counted)
        m_workers->noteTime(std::chrono::steady_clock::now() - begin);
    return done;
}

class TcpChannel::WorkerStep : public WorkerThreads::Job {
public:
    WorkerStep(std::shared_ptr<TcpChannel> channel, Way& way) : m_channel(std::move(channel)), m_way(way) {}

    void work() override { m_result = m_channel->step(m_way, workerStep); }
    void finish() override { m_channel->stepFinished(m_way, m_result); }

private:
    std::shared_ptr<TcpChannel> m_channel;
    Way& m_way;
    Step m_result;
};

void TcpChannel::startOnWorker(Way& way)
{
    m_stepInFlight = true;
    m_workers->run(std::make_shared<WorkerStep>(shared_from_this(), way));
}

void TcpChannel::stepFinished(Way& way, const Step& done)
{
    m_stepInFlight = false;
    if (m_closed)
        return end();
    auto& other = &way == &m_reading ? m_writing : m_reading;
    if (std::exchange(other.due, false))
        goOn(other);
    if (!m_closed)
        settle(way, done);
}

void TcpChannel::settle(Way& way, const Step& done)
{
    if (done.failure)
        return lose(*done.failure);
    const bool reading = &way == &m_reading;
    if (m_workers != nullptr && done.bytes > 0)
        m_workers->noteBytes(m_mark);
    if (!reading)
        m_done += done.bytes;
    const bool over = reading ? done.bytes > 0 : m_done == sizeOf(m_parts);
    if (!over)
        return done.need == StreamEnd::Need::Nothing ? later(way) : awaitNeed(way, done.need);
    way.active = false;
    way.keeper.reset();
    if (m_listener == nullptr)
        return;
    if (reading)
        m_listener->bytesRead(done.bytes);
    else
        m_listener->bytesWritten();
}

void TcpChannel::awaitNeed(Way& way, StreamEnd::Need need)
{
    if (m_expectsPrompt && &way == &m_reading)
        acknowledge();
    if (&way == &m_writing && need == StreamEnd::Need::Writable)
        fitWhileWaiting();
    m_socket.async_wait(need == StreamEnd::Need::Writable ? tcp::socket::wait_write : tcp::socket::wait_read,
                        Ready{shared_from_this(), &way});
}

/// There is room while a third of the buffer is free, and less than half as much is unsent as the kernel was told. An urgent write opens
/// the buffer, so that the wait ends early, and who is told asks again.
bool TcpChannel::askForRoom()
{
    if (m_makingRoom.active || m_closed)
        return false;
    fitBuffer(Urgency::Patient);
    pollfd asked{m_descriptor, POLLOUT, 0};
    if (::poll(&asked, 1, 0) != 0)
        return true; // or an error, which the write meets
    if (const auto facts = readPathFacts(m_descriptor)) {
        m_buffer.full(Urgency::Patient, *facts);
        fitBuffer(Urgency::Patient);
    }
    m_makingRoom.active = true;
    m_socket.async_wait(tcp::socket::wait_write, Ready{shared_from_this(), &m_makingRoom});
    return false;
}

void TcpChannel::fitBuffer(Urgency urgency)
{
    if (const auto bytes = m_buffer.fit(urgency))
        set(m_descriptor, SOL_SOCKET, SO_SNDBUF, *bytes);
}

/// A write has to wait. What is patient asked for room before; what is left of it has begun, and leaves before all else.
void TcpChannel::fitWhileWaiting()
{
    if (!m_buffer.isOurs())
        return;
    if (const auto facts = m_urgency == Urgency::Urgent ? readPathFacts(m_descriptor) : std::nullopt)
        m_buffer.full(Urgency::Urgent, *facts);
    fitBuffer(Urgency::Urgent);
}

void TcpChannel::later(Way& way) { asio::post(m_io, Ready{shared_from_this(), &way}); }

void TcpChannel::lose(const StreamEnd::Failure& failure)
{
    close();
    if (auto* listener = std::exchange(m_listener, nullptr))
        listener->channelLost(failure.detail, failure.tls);
}

std::size_t TcpChannel::unacknowledged() const
{
    int bytes = 0;
    return !m_closed && ::ioctl(m_descriptor, SIOCOUTQ, &bytes) == 0 && bytes > 0 ? static_cast<std::size_t>(bytes) : 0;
}

void TcpChannel::close()
{
    if (std::exchange(m_closed, true))
        return;
    m_handshake = nullptr;
    if (!m_stepInFlight)
        return end();
    // A worker uses the descriptor: it must not be another's before that step is over, and the connection ends all the same.
    ::shutdown(m_descriptor, SHUT_RDWR);
    boost::system::error_code ignored;
    m_socket.cancel(ignored);
}

void TcpChannel::end()
{
    boost::system::error_code ignored;
    m_socket.close(ignored);
    m_reading.keeper.reset();
    m_writing.keeper.reset();
}

} // namespace liena::transport
