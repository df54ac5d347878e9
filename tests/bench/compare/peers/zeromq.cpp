// peer_zeromq: ZeroMQ, a pair of PAIR sockets for commands and one for frames, since one would queue them behind each other.
#include "measure/frame_post.hpp"
#include "measure/periodic_tasks.hpp"
#include "workloads/peer.hpp"

#include <zmq.h>

#include <cerrno>
#include <stdexcept>
#include <string>

namespace liena::compare {

namespace {

class Socket {
public:
    Socket(void* context, const Options& options, int place) : m_socket(zmq_socket(context, ZMQ_PAIR))
    {
        const int none = 0;
        zmq_setsockopt(m_socket, ZMQ_SNDHWM, &none, sizeof none); // as much may wait as in the other peers
        zmq_setsockopt(m_socket, ZMQ_RCVHWM, &none, sizeof none);
        zmq_setsockopt(m_socket, ZMQ_LINGER, &none, sizeof none);
        const auto url = "tcp://" + options.host + ":" + std::to_string(options.port + place);
        const int result = options.role == Role::Client ? zmq_connect(m_socket, url.c_str()) : zmq_bind(m_socket, url.c_str());
        if (result != 0)
            throw std::runtime_error(url + ": " + zmq_strerror(errno));
    }
    ~Socket() { zmq_close(m_socket); }
    Socket(const Socket&) = delete;
    Socket& operator=(const Socket&) = delete;

    void* get() const { return m_socket; }

private:
    void* m_socket;
};

class Context {
public:
    Context() : m_context(zmq_ctx_new()) {}
    ~Context() { zmq_ctx_term(m_context); }
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    void* get() const { return m_context; }

private:
    void* m_context;
};

class ZeroMq final : public Transport {
public:
    explicit ZeroMq(const Options& options)
        : m_pixels(options.frameBytes), m_commands(m_context.get(), options, 0), m_frames(m_context.get(), options, 1)
    {}

    void every(Nanoseconds period, std::function<void()> task) override { m_tasks.add(period, std::move(task)); }

    void run(LinkEvents& events) override
    {
        m_tasks.start();
        events.ready(); // what is sent before the connection stands waits, and is part of the warm-up
        while (!m_post.isStopped())
            turn(events);
    }

    void stop() override { m_post.stop(); }

    void sendCommand(const Command& command) override { zmq_send(m_commands.get(), &command, sizeof command, 0); }

    void sendFrame(const Stamp& stamp) override { m_post.put(stamp); }

private:
    void turn(LinkEvents& events)
    {
        m_watched.assign(
            {{m_commands.get(), 0, ZMQ_POLLIN, 0}, {m_frames.get(), 0, ZMQ_POLLIN, 0}, {nullptr, m_post.descriptor(), ZMQ_POLLIN, 0}});
        const auto own = m_watched.size();
        for (std::size_t i = 0; i < m_tasks.count(); ++i)
            m_watched.push_back({nullptr, m_tasks.descriptor(i), ZMQ_POLLIN, 0});
        zmq_poll(m_watched.data(), static_cast<int>(m_watched.size()), -1);
        for (std::size_t i = 0; i < m_tasks.count(); ++i)
            if (m_watched[own + i].revents != 0)
                m_tasks.expire(i);
        if (m_watched[2].revents != 0)
            for (const auto& stamp : m_post.take())
                writeFrame(stamp);
        if (m_watched[0].revents != 0)
            receiveCommands(events);
        if (m_watched[1].revents != 0)
            receiveFrames(events);
    }

    /// Without a copy: the pixels outlive the context.
    void writeFrame(const Stamp& stamp)
    {
        zmq_send(m_frames.get(), &stamp, sizeof stamp, ZMQ_SNDMORE);
        zmq_msg_t message;
        zmq_msg_init_data(&message, m_pixels.data(), m_pixels.size(), nullptr, nullptr);
        zmq_msg_send(&message, m_frames.get(), 0);
    }

    void receiveCommands(LinkEvents& events)
    {
        constexpr int mostInATurn = 1024;
        Command command;
        for (int i = 0; i < mostInATurn && zmq_recv(m_commands.get(), &command, sizeof command, ZMQ_DONTWAIT) == sizeof command; ++i)
            events.commandReceived(command);
    }

    void receiveFrames(LinkEvents& events)
    {
        Stamp stamp;
        while (zmq_recv(m_frames.get(), &stamp, sizeof stamp, ZMQ_DONTWAIT) == sizeof stamp) {
            zmq_msg_t message;
            zmq_msg_init(&message);
            zmq_msg_recv(&message, m_frames.get(), 0);
            events.frameReceived(stamp, zmq_msg_size(&message));
            zmq_msg_close(&message);
        }
    }

    std::vector<std::byte> m_pixels;
    PeriodicTasks m_tasks;
    FramePost m_post;
    Context m_context;
    Socket m_commands;
    Socket m_frames;
    std::vector<zmq_pollitem_t> m_watched;
};

} // namespace

} // namespace liena::compare

int main(int argc, char** argv)
{
    using namespace liena::compare;
    runPeer(argc, argv, "ZeroMQ", [](const Options& options) { return std::make_unique<ZeroMq>(options); });
}
