// What leaves for a device on this computer: how long the segments are that its reader has a turn for each of.
#include "protocol/datagram.hpp"
#include "support/test_authority.hpp"
#include "tasks/output_lane.hpp"

#include "security/tls_identity.hpp"

#include <boost/asio/ip/tcp.hpp>

#include <QTest>

#include <chrono>
#include <memory>
#include <numeric>
#include <span>
#include <stdexcept>
#include <vector>

using namespace liena;
using namespace liena::test;
using namespace liena::tasks;
using namespace liena::transport;
using namespace std::chrono_literals;

namespace asio = boost::asio;
using asio::ip::tcp;

namespace {

constexpr DeviceId nearId(0x40018208U);
constexpr DeviceId farId(0x20010208U);
constexpr std::uint16_t attach = 0x0001;
constexpr std::uint16_t picture = 0x0200;

/// The other end, which keeps what it hears.
class Reader : public TcpChannel::Listener {
public:
    ~Reader() override { close(); }
    Reader() = default;
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;

    void begin(tcp::socket socket, security::TlsIdentity* identity)
    {
        m_channel = std::make_shared<TcpChannel>(std::move(socket));
        m_channel->setListener(this);
        if (identity == nullptr)
            return readOn();
        m_channel->secure(identity->serverContext(), true, [this](const Result<void>& result) {
            if (result)
                readOn();
        });
    }
    void close()
    {
        if (!m_channel)
            return;
        m_channel->setListener(nullptr);
        m_channel->close();
        m_channel.reset();
    }

    /// Of the bodies of messages with that number, in order, as far as they came whole.
    std::vector<std::size_t> lengthsOf(std::uint16_t number) const
    {
        using protocol::headerSize;
        std::vector<std::size_t> lengths;
        for (std::size_t at = 0; at + headerSize <= m_received.size();) {
            const auto header = protocol::decodeHeader(std::span<const std::byte, headerSize>(m_received.data() + at, headerSize));
            at += headerSize + header.length;
            if (header.message.number == number && at <= m_received.size())
                lengths.push_back(header.length);
        }
        return lengths;
    }

private:
    void readOn() { m_channel->read(*m_buffer, m_buffer); }
    void bytesRead(std::size_t count) override
    {
        m_received.insert(m_received.end(), m_buffer->begin(), m_buffer->begin() + static_cast<std::ptrdiff_t>(count));
        readOn();
    }
    void bytesWritten() override {}
    void channelLost(const std::string& /*detail*/, bool /*identity*/) override {}

    std::shared_ptr<TcpChannel> m_channel;
    std::shared_ptr<std::vector<std::byte>> m_buffer = std::make_shared<std::vector<std::byte>>(65536);
    std::vector<std::byte> m_received;
};

protocol::EncodedMessage message(std::uint16_t number, std::size_t size)
{
    protocol::EncodedMessage made{{{nearId, number}, farId, Timestamp{1}}, {}};
    made.part.resize(size);
    return made;
}

/// A lane and its reader, both in this thread.
class Line {
public:
    Line(bool secured, const TransmissionTask::Settings& settings)
        : m_near(secured ? identityOf(nearId, "near") : nullptr),
          m_far(secured ? identityOf(farId, "far") : nullptr),
          m_lane(m_io, {"far", farId, "", "127.0.0.1", m_acceptor.local_endpoint().port(), "", ""}, m_near, settings, handlers())
    {
        m_acceptor.async_accept([this](const boost::system::error_code& error, tcp::socket socket) {
            if (!error)
                reader.begin(std::move(socket), m_far.get());
        });
        m_lane.connect(message(attach, 10), 20s);
        until([this] { return m_isUp; });
    }
    ~Line()
    {
        m_lane.close(0ns);
        reader.close();
        m_io.poll();
    }
    Line(const Line&) = delete;
    Line& operator=(const Line&) = delete;

    void push(std::uint16_t number, std::size_t size, Rank rank) { m_lane.push({message(number, size), rank, 0, std::nullopt, {}}); }

    template <typename Condition>
    void until(Condition condition)
    {
        while (!condition())
            if (m_io.run_one_for(20s) == 0)
                throw std::runtime_error("nothing happens any more");
    }

    Reader reader;

private:
    std::shared_ptr<security::TlsIdentity> identityOf(DeviceId device, const char* name)
    {
        const auto files = m_authority.identityOf(device, name);
        return security::TlsIdentity::load(files.certificate, files.key, files.authority, device).value();
    }

    OutputLane::Handlers handlers()
    {
        OutputLane::Handlers handlers;
        handlers.up = [this] { m_isUp = true; };
        handlers.failed = [](const ConnectionFailure& failure) { throw std::runtime_error(failure.detail); };
        handlers.lost = [](const std::string& detail, bool) { throw std::runtime_error(detail); };
        handlers.dropped = [](const OutputQueue::Entry&, OutputQueue::Fate) {};
        handlers.abandoning = [](const protocol::DatagramHeader&) { return protocol::EncodedMessage(); };
        return handlers;
    }

    asio::io_context m_io{1};
    tcp::acceptor m_acceptor{m_io, tcp::endpoint(asio::ip::address_v4::loopback(), 0)};
    TestAuthority m_authority;
    std::shared_ptr<security::TlsIdentity> m_near;
    std::shared_ptr<security::TlsIdentity> m_far;
    bool m_isUp = false;
    OutputLane m_lane;
};

} // namespace

class LocalLaneTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void aSegmentIsAsLongAsItsReaderGains_data()
    {
        QTest::addColumn<bool>("bulk");
        QTest::addColumn<bool>("secured");
        QTest::addColumn<quint64>("longest");
        QTest::newRow("images in the clear: the longest there are") << true << false << quint64{32767};
        QTest::newRow("images under TLS: a record") << true << true << quint64{16364};
        QTest::newRow("beside commands, in the clear") << false << false << quint64{16364};
    }

    void aSegmentIsAsLongAsItsReaderGains()
    {
        QFETCH(bool, bulk);
        QFETCH(bool, secured);
        QFETCH(quint64, longest);
        constexpr std::size_t size = 100'000;
        const auto traffic = bulk ? TcpChannel::Traffic::Bulk : TcpChannel::Traffic::Prompt;
        Line line(secured, {.segment = 16364, .batch = 65536, .traffic = traffic});
        line.push(picture, size, bulk ? Rank::Bulk : Rank::Status);
        std::vector<std::size_t> lengths;
        line.until([&] {
            lengths = line.reader.lengthsOf(picture);
            return std::accumulate(lengths.begin(), lengths.end(), std::size_t{0}) >= size;
        });
        std::vector<std::size_t> expected(size / longest, longest);
        expected.push_back(size % longest);
        QVERIFY(lengths == expected);
    }
};

QTEST_GUILESS_MAIN(LocalLaneTest)
#include "local_lane_test.moc"
