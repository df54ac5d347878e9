// From accept to Attach.
#include "simulated_server.hpp"

#include "protocol/header_judge.hpp"

#include <algorithm>
#include <utility>

namespace liena::simulation {

using namespace std::chrono_literals;

class SimulatedServer::Pending : public Connection::Listener {
public:
    Pending(SimulatedServer& server, ConnectionNumber connection, HostIndex from, DeviceId peer)
        : m_server(server),
          m_connection(connection),
          m_from(from),
          m_peer(peer),
          m_decoder(std::make_unique<protocol::DatagramDecoder>()),
          m_timer(server.m_program)
    {}
    ~Pending() override { close(); }
    Pending(const Pending&) = delete;
    Pending& operator=(const Pending&) = delete;

    HostIndex from() const { return m_from; }

    void close()
    {
        if (m_connection == 0)
            return; // and the program may be gone
        if (auto* stands = find())
            stands->close(m_server.m_program.host());
        m_connection = 0;
    }

    void start()
    {
        m_timer.after(2s, [this] { m_server.forget(this); });
        if (auto* stands = find()) {
            stands->setListener(m_server.m_program.host(), this);
            stands->read(m_decoder->writable());
        }
    }

    void bytesRead(std::size_t count) override
    {
        m_decoder->commit(count);
        bool attached = false;
        bool wrong = false;
        const auto judge = [&](const protocol::DatagramHeader& header) {
            if (attached)
                return protocol::HeaderVerdict::Refuse;
            wrong = !protocol::isAttachHeader(m_server.m_self, m_peer, header);
            return wrong ? protocol::HeaderVerdict::Refuse : protocol::HeaderVerdict::Take;
        };
        const auto take = [&](const protocol::DatagramHeader& header, std::span<const std::byte> body) {
            const auto message = protocol::decodeSessionMessage(header.message.number, body);
            wrong = !message;
            attached = !wrong;
            if (attached)
                m_attach = std::get<protocol::Attach>(*message);
            return attached;
        };
        m_decoder->process(judge, take);
        if (wrong)
            m_server.forget(this);
        else if (attached)
            handOver();
        else if (auto* stands = find())
            stands->read(m_decoder->writable());
    }
    void bytesWritten() override {}
    void connectionLost(const char* /*detail*/) override { m_server.forget(this); }

private:
    Connection* find() { return m_server.m_program.network().find(m_connection); }

    void handOver()
    {
        m_timer.cancel();
        if (auto* stands = find())
            stands->setListener(m_server.m_program.host(), nullptr);
        AttachedConnection connection{std::exchange(m_connection, 0), m_from, m_peer, std::move(m_decoder), m_attach};
        const auto attached = m_server.m_attached;
        m_server.forget(this);
        attached(std::move(connection));
    }

    SimulatedServer& m_server;
    ConnectionNumber m_connection;
    HostIndex m_from;
    DeviceId m_peer;
    std::unique_ptr<protocol::DatagramDecoder> m_decoder;
    Program::Timer m_timer;
    protocol::Attach m_attach;
};

SimulatedServer::SimulatedServer(Program& program, DeviceId self, Attached attached)
    : m_program(program), m_self(self), m_attached(std::move(attached))
{}

SimulatedServer::~SimulatedServer() = default;

void SimulatedServer::admit(ConnectionNumber connection, HostIndex from, DeviceId peer)
{
    const auto same = [from](const std::unique_ptr<Pending>& pending) { return pending->from() == from; };
    if (static_cast<std::size_t>(std::count_if(m_pending.begin(), m_pending.end(), same)) >= mostPerAddress)
        m_pending.erase(std::find_if(m_pending.begin(), m_pending.end(), same));
    if (m_pending.size() >= mostPending)
        m_pending.pop_front();
    m_pending.push_back(std::make_unique<Pending>(*this, connection, from, peer));
    m_pending.back()->start();
}

void SimulatedServer::forget(const Pending* pending)
{
    const auto found =
        std::find_if(m_pending.begin(), m_pending.end(), [&](const std::unique_ptr<Pending>& one) { return one.get() == pending; });
    if (found == m_pending.end())
        return;
    (*found)->close();
    m_program.bury(std::shared_ptr<Pending>(std::move(*found)));
    m_pending.erase(found);
}

} // namespace liena::simulation
