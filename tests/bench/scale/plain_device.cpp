// A device of a mesh that is nothing but sockets and timers: signs of life by TCP and by UDP, questions and answers by TCP.
#include "scale/mesh_device.hpp"

#include "liena/system_topology.hpp"

#include <boost/asio.hpp>

#include <array>
#include <atomic>
#include <cstring>
#include <future>
#include <stdexcept>
#include <thread>
#include <utility>

namespace liena::bench {

namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using asio::ip::udp;
using Clock = std::chrono::steady_clock;
using boost::system::error_code;

enum class Word : std::uint32_t { Hello, SignOfLife, Asked, Answered };

/// As long as a sealed command of the mesh's.
struct MeshPacket {
    Word word{};
    std::uint32_t from = 0;
    std::int64_t sent = 0;
    std::array<char, 112> rest{};
};
using Bytes = std::array<char, sizeof(MeshPacket)>;

Bytes bytesOf(const MeshPacket& packet)
{
    Bytes bytes;
    std::memcpy(bytes.data(), &packet, sizeof packet);
    return bytes;
}

MeshPacket packetOf(const Bytes& bytes)
{
    MeshPacket packet;
    std::memcpy(&packet, bytes.data(), sizeof packet);
    return packet;
}

class PlainDevice final : public MeshDevice {
public:
    explicit PlainDevice(const MeshDeviceOptions& options)
        : MeshDevice(options),
          m_index(options.index),
          m_topology(load(options)),
          m_acceptor(m_io, placeOf<tcp>(m_index)),
          m_datagrams(m_io, placeOf<udp>(m_index)),
          m_connections(options.devices)
    {
        accept();
        readDatagram();
        m_thread = std::thread([this] { m_io.run(); });
    }

    ~PlainDevice() override
    {
        m_io.stop();
        m_thread.join();
    }
    PlainDevice(const PlainDevice&) = delete;
    PlainDevice& operator=(const PlainDevice&) = delete;

    MeshCounts open() override
    {
        for (const auto peer : m_toOpen)
            post([this, peer] {
                auto connection = std::make_unique<Connection>(m_io);
                connection->socket.connect(placeOf<tcp>(peer));
                auto& joined = join(peer, std::move(connection));
                send(joined, Word::Hello);
            });
        const auto limit = Clock::now() + openingLimit;
        while (m_usable < m_peers.size() && Clock::now() < limit)
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        return counts();
    }

    MeshCounts counts() override
    {
        auto all = tally();
        all.sessionEnds = m_usable;
        all.heartbeats = m_signs;
        return all;
    }

    std::vector<std::int64_t> takeLatencies() override
    {
        std::promise<std::vector<std::int64_t>> taken;
        post([&] { taken.set_value(std::exchange(m_latencies, {})); });
        return taken.get_future().get();
    }

    void post(std::function<void()> work) override { asio::post(m_io, std::move(work)); }

    void ask() override
    {
        send(*m_connections[m_peers[m_next++ % m_peers.size()]], Word::Asked, nowNs());
        ++m_asked;
    }

private:
    struct Connection {
        explicit Connection(asio::io_context& io) : socket(io), signs(io) {}

        tcp::socket socket;
        asio::steady_timer signs;
        udp::endpoint datagrams;
        Bytes read{};
        bool wasHeard = false;
    };

    static SystemTopology load(const MeshDeviceOptions& options)
    {
        auto topology = SystemTopology::load(options.folder / "topology.xml");
        if (!topology)
            throw std::runtime_error(topology.error().what);
        return std::move(topology.value());
    }

    template <typename Protocol>
    typename Protocol::endpoint placeOf(std::size_t index) const
    {
        const auto* device = m_topology.find(meshDeviceName(index));
        return {asio::ip::make_address(device->host), device->port};
    }

    void accept()
    {
        m_acceptor.async_accept([this](error_code error, tcp::socket socket) {
            if (error)
                return fail();
            auto connection = std::make_unique<Connection>(m_io);
            connection->socket = std::move(socket);
            auto* caller = connection.get();
            asio::async_read(caller->socket, asio::buffer(caller->read),
                             [this, connection = std::move(connection)](error_code failed, std::size_t) mutable {
                                 if (failed)
                                     return fail();
                                 const auto from = packetOf(connection->read).from;
                                 join(from, std::move(connection));
                             });
            accept();
        });
    }

    Connection& join(std::size_t peer, std::unique_ptr<Connection> connection)
    {
        auto& joined = *(m_connections.at(peer) = std::move(connection));
        joined.socket.set_option(tcp::no_delay(true));
        joined.datagrams = placeOf<udp>(peer);
        joined.signs.expires_after(m_topology.links().front().timing.heartbeat);
        giveSigns(joined);
        read(joined);
        return joined;
    }

    void giveSigns(Connection& connection)
    {
        connection.signs.async_wait([this, &connection](error_code error) {
            if (error)
                return;
            send(connection, Word::SignOfLife);
            error_code failed;
            m_datagrams.send_to(asio::buffer(bytesOf({Word::SignOfLife, static_cast<std::uint32_t>(m_index)})), connection.datagrams, 0,
                                failed);
            connection.signs.expires_at(connection.signs.expiry() + m_topology.links().front().timing.heartbeat);
            giveSigns(connection);
        });
    }

    void read(Connection& connection)
    {
        asio::async_read(connection.socket, asio::buffer(connection.read), [this, &connection](error_code error, std::size_t) {
            if (error)
                return fail();
            take(connection, packetOf(connection.read));
            read(connection);
        });
    }

    void take(Connection& from, const MeshPacket& packet)
    {
        switch (packet.word) {
        case Word::Hello:
            return;
        case Word::SignOfLife:
            ++m_signs;
            m_usable += std::exchange(from.wasHeard, true) ? 0 : 1;
            return;
        case Word::Asked:
            ++m_heard;
            return send(from, Word::Answered, packet.sent);
        case Word::Answered:
            m_latencies.push_back(nowNs() - packet.sent);
            ++m_answered;
        }
    }

    void readDatagram()
    {
        m_datagrams.async_receive(asio::buffer(m_datagram), [this](error_code error, std::size_t) {
            if (error)
                return fail();
            readDatagram();
        });
    }

    void send(Connection& connection, Word word, std::int64_t sent = 0)
    {
        error_code failed;
        asio::write(connection.socket, asio::buffer(bytesOf({word, static_cast<std::uint32_t>(m_index), sent})), failed);
        if (failed)
            fail();
    }

    void fail() { ++m_troubles; }

    std::size_t m_index;
    SystemTopology m_topology;
    asio::io_context m_io{1};
    tcp::acceptor m_acceptor;
    udp::socket m_datagrams;
    Bytes m_datagram{};
    std::vector<std::unique_ptr<Connection>> m_connections; ///< by the peer's index; the thread's, as what follows
    std::size_t m_next = 0;
    std::vector<std::int64_t> m_latencies; ///< ns

    std::atomic<std::size_t> m_usable = 0;
    std::atomic<std::uint64_t> m_signs = 0;
    std::thread m_thread;
};

} // namespace

std::unique_ptr<MeshDevice> plainDevice(const MeshDeviceOptions& options) { return std::make_unique<PlainDevice>(options); }

} // namespace liena::bench
