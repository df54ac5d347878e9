// peer_raw_tcp: one TCP socket and poll(), or nothing but the socket's own reading again and again, without any library: what the kernel
// alone takes. Two streams of frames have a socket each, beside that of the commands.
#include "measure/frame_post.hpp"
#include "measure/periodic_tasks.hpp"
#include "measure/send_buffer.hpp"
#include "stream/stream_input.hpp"
#include "stream/stream_output.hpp"
#include "workloads/peer.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <vector>

namespace liena::compare {

namespace {

int checked(int result, const char* what)
{
    if (result < 0)
        throw std::system_error(errno, std::generic_category(), what);
    return result;
}

sockaddr_in addressOf(const Options& options)
{
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(options.port);
    if (::inet_pton(AF_INET, options.host.c_str(), &address.sin_addr) != 1)
        throw std::runtime_error("not an address: " + options.host);
    return address;
}

std::vector<int> acceptEach(const Options& options, std::size_t count)
{
    const int listener = checked(::socket(AF_INET, SOCK_STREAM, 0), "socket");
    const int on = 1;
    ::setsockopt(listener, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    const auto address = addressOf(options);
    checked(::bind(listener, reinterpret_cast<const sockaddr*>(&address), sizeof address), "bind");
    checked(::listen(listener, static_cast<int>(count)), "listen");
    std::vector<int> sockets(count);
    for (auto& socket : sockets)
        socket = checked(::accept(listener, nullptr, nullptr), "accept");
    ::close(listener);
    return sockets;
}

/// The echo may start later.
int connectTo(const Options& options)
{
    const auto address = addressOf(options);
    for (int attempt = 0;; ++attempt) {
        const int socket = checked(::socket(AF_INET, SOCK_STREAM, 0), "socket");
        if (::connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0)
            return socket;
        ::close(socket);
        constexpr int mostAttempts = 500;
        if (attempt == mostAttempts)
            throw std::runtime_error("nobody listens at " + options.host);
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
}

std::vector<int> connectEach(const Options& options, std::size_t count)
{
    std::vector<int> sockets(count);
    for (auto& socket : sockets)
        socket = connectTo(options);
    return sockets;
}

/// As LiENa's bulk lanes, which leave to the kernel what the other end may take: the age of their frames is held against this one's, which
/// is to be the line's and not that of a buffer too short for it. Nothing is asked for on one computer.
void askForLongLine(int socket)
{
    const auto addressBy = [socket](auto ask) {
        sockaddr_in address{};
        socklen_t size = sizeof address;
        checked(ask(socket, reinterpret_cast<sockaddr*>(&address), &size), "address");
        return address.sin_addr.s_addr;
    };
    const auto bytes = addressBy(::getsockname) != addressBy(::getpeername) ? sendBufferWorthAsking() : std::nullopt;
    if (bytes)
        ::setsockopt(socket, SOL_SOCKET, SO_SNDBUF, &*bytes, sizeof *bytes);
}

/// A connection: what waits for it, and what came of a message.
class RawSocket {
public:
    explicit RawSocket(int socket) : m_socket(socket)
    {
        const int on = 1;
        ::setsockopt(m_socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
        askForLongLine(m_socket);
    }

    bool isConnected() const { return m_connected; }
    StreamOutput& output() { return m_output; }

    pollfd watched() const { return {m_socket, static_cast<short>(m_underWay.empty() ? POLLIN : POLLIN | POLLOUT), 0}; }

    /// What poll() found of that.
    void serve(short happened, LinkEvents& events)
    {
        if ((happened & ~POLLOUT) != 0)
            receive(events);
        if (m_underWay.empty() || (happened & POLLOUT) != 0)
            flush();
    }

    void flush()
    {
        while (!m_underWay.empty() || !m_output.empty()) {
            if (m_underWay.empty()) {
                m_underWay = m_output.take();
                m_written = 0;
            }
            if (!writeSome())
                return;
        }
    }

    void receive(LinkEvents& events)
    {
        const auto space = m_input.space();
        const auto count = ::recv(m_socket, space.data(), space.size(), MSG_DONTWAIT);
        if (count > 0)
            m_input.read(static_cast<std::size_t>(count), events);
        else if (count == 0 || errno != EAGAIN)
            m_connected = false;
    }

private:
    /// False when something is left.
    bool writeSome()
    {
        const auto left = collectParts();
        msghdr message{};
        message.msg_iov = m_parts.data();
        message.msg_iovlen = m_parts.size();
        const auto count = ::sendmsg(m_socket, &message, MSG_DONTWAIT | MSG_NOSIGNAL);
        if (count < 0 || static_cast<std::size_t>(count) < left) {
            m_written += static_cast<std::size_t>(std::max<ssize_t>(count, 0));
            return false; // also after a part: trying on would keep the thread here as long as the frame leaves
        }
        m_underWay.clear();
        return true;
    }

    /// What of m_underWay is still to be written, as far as one call takes it; returns all its bytes.
    std::size_t collectParts()
    {
        constexpr std::size_t mostParts = 64;
        m_parts.clear();
        auto skip = m_written;
        std::size_t left = 0;
        const auto add = [&](const std::vector<std::byte>& bytes) {
            const auto from = std::min(skip, bytes.size());
            skip -= from;
            left += bytes.size() - from;
            if (from < bytes.size() && m_parts.size() < mostParts)
                m_parts.push_back({const_cast<std::byte*>(bytes.data() + from), bytes.size() - from});
        };
        for (const auto& chunk : m_underWay) {
            add(chunk.bytes);
            if (chunk.pixels)
                add(*chunk.pixels);
        }
        return left;
    }

    int m_socket;
    bool m_connected = true;
    StreamOutput m_output;
    std::vector<StreamOutput::Chunk> m_underWay;
    std::size_t m_written = 0; ///< of what is under way
    std::vector<iovec> m_parts;
    StreamInput m_input;
};

class RawTcp final : public Transport {
public:
    explicit RawTcp(const Options& options)
        : m_options(options), m_pixels(std::make_shared<const std::vector<std::byte>>(options.frameBytes))
    {}

    void every(Nanoseconds period, std::function<void()> task) override { m_tasks.add(period, std::move(task)); }

    void run(LinkEvents& events) override
    {
        connect();
        m_tasks.start();
        events.ready();
        for (auto& socket : m_sockets)
            socket.flush();
        while (!m_post.isStopped() && isConnected()) {
            if (m_options.spins)
                spin(events);
            turn(events, m_options.spins ? 0 : -1);
        }
    }

    void stop() override { m_post.stop(); }

    /// Leaves at the end of the turn, with all others of it.
    void sendCommand(const Command& command) override { m_sockets.front().output().append(command); }

    void sendFrame(const Stamp& stamp) override { m_post.put(stamp); }

private:
    void connect()
    {
        const auto count = m_options.streams() > 1 ? 1 + m_options.streams() : 1;
        for (const int socket : m_options.role == Role::Client ? connectEach(m_options, count) : acceptEach(m_options, count))
            m_sockets.emplace_back(socket);
    }

    bool isConnected() const
    {
        return std::all_of(m_sockets.begin(), m_sockets.end(), [](const auto& socket) { return socket.isConnected(); });
    }

    /// A single stream's frames leave with the commands.
    RawSocket& socketOf(const Stamp& frame) { return m_sockets[m_sockets.size() > 1 ? 1 + streamOf(frame) : 0]; }

    /// Timers and the end may wait for as many looks at the socket.
    void spin(LinkEvents& events)
    {
        constexpr int looks = 64;
        for (int i = 0; i < looks && isConnected(); ++i)
            for (auto& socket : m_sockets) {
                socket.receive(events);
                socket.flush();
            }
    }

    /// Sleeps for at most `limit` ms; -1: as long as nothing happens.
    void turn(LinkEvents& events, int limit)
    {
        m_watched.clear();
        for (const auto& socket : m_sockets)
            m_watched.push_back(socket.watched());
        m_watched.push_back({m_post.descriptor(), POLLIN, 0});
        for (std::size_t i = 0; i < m_tasks.count(); ++i)
            m_watched.push_back({m_tasks.descriptor(i), POLLIN, 0});
        ::poll(m_watched.data(), m_watched.size(), limit);
        const auto post = m_sockets.size();
        for (std::size_t i = 0; i < m_tasks.count(); ++i)
            if (m_watched[post + 1 + i].revents != 0)
                m_tasks.expire(i);
        if (m_watched[post].revents != 0)
            for (const auto& stamp : m_post.take())
                socketOf(stamp).output().append(stamp, m_pixels);
        for (std::size_t i = 0; i < m_sockets.size(); ++i)
            m_sockets[i].serve(m_watched[i].revents, events);
    }

    Options m_options;
    StreamOutput::Pixels m_pixels;
    std::vector<RawSocket> m_sockets; ///< of the commands first
    PeriodicTasks m_tasks;
    FramePost m_post;
    std::vector<pollfd> m_watched;
};

} // namespace

} // namespace liena::compare

int main(int argc, char** argv)
{
    using namespace liena::compare;
    runPeer(argc, argv, "raw TCP", [](const Options& options) { return std::make_unique<RawTcp>(options); });
}
