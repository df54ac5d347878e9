// When the kernel acknowledges what bulk has read: a sender that waits for it takes the wait for a queue on the path.
#include "protocol/datagram_encoder.hpp"
#include "tasks/reception_task.hpp"

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>

#include <QTest>

#include <linux/sockios.h>
#include <sys/ioctl.h>

#include <array>
#include <chrono>
#include <memory>
#include <span>
#include <stdexcept>
#include <vector>

using namespace liena;
using namespace liena::tasks;
using namespace liena::transport;
using namespace std::chrono_literals;

namespace asio = boost::asio;
using asio::ip::tcp;

namespace {

constexpr std::uint16_t picture = 0x0200;

/// Takes each message, and counts those that are whole.
class Counter : public LaneSink {
public:
    int messages = 0;

private:
    void turned() override {}
    Judgement judge(std::uint8_t, const protocol::DatagramHeader&) override { return {protocol::HeaderVerdict::Take, 1'000'000}; }
    void received(std::uint8_t, const protocol::DatagramHeader&, std::span<const std::byte>, FieldBytes*) override { ++messages; }
    void overBudget(const protocol::DatagramHeader&, const protocol::Reassembler::OverBudget&) override {}
    void violated(std::uint8_t, const std::string& detail) override { throw std::runtime_error(detail); }
    void laneLost(std::uint8_t, const std::string& detail) override { throw std::runtime_error(detail); }
};

/// A bulk lane that is read as in a session, and the bare socket of who sends.
class Line {
public:
    Line()
    {
        tcp::acceptor acceptor(m_io, tcp::endpoint(asio::ip::address_v4::loopback(), 0));
        m_sender.connect(acceptor.local_endpoint());
        m_sender.set_option(tcp::no_delay(true));
        m_channel = std::make_shared<TcpChannel>(acceptor.accept());
        m_task = std::make_unique<ReceptionTask>(m_channel, std::make_unique<protocol::DatagramDecoder>(), m_budget, 1, m_counter);
        m_task->start();
    }
    ~Line() { m_task->close(); }
    Line(const Line&) = delete;
    Line& operator=(const Line&) = delete;

    /// Returns when the message is there and its lane is read on.
    void send(std::size_t size, std::size_t segment)
    {
        protocol::EncodedMessage message{{{DeviceId(0x40018208U), picture}, DeviceId(0x20010208U), Timestamp{++m_sent}}, {}};
        message.part.resize(size);
        std::vector<std::byte> bytes;
        for (protocol::DatagramEncoder encoder; !encoder.appendSegment(message, segment, bytes);) {
        }
        asio::write(m_sender, asio::buffer(bytes));
        while (m_counter.messages < static_cast<int>(m_sent))
            if (m_io.run_one_for(20s) == 0)
                throw std::runtime_error("nothing happens any more");
    }

    /// A word the other way: from then on the kernel holds acknowledgements back for the next one to carry them.
    void answer()
    {
        m_channel->write(m_answer);
        m_io.poll();
    }

    /// Of the bytes that were sent.
    int unacknowledged()
    {
        int bytes = 0;
        if (::ioctl(m_sender.native_handle(), SIOCOUTQ, &bytes) != 0)
            throw std::runtime_error("SIOCOUTQ");
        return bytes;
    }

private:
    asio::io_context m_io{1};
    tcp::socket m_sender{m_io};
    protocol::PartialBudget m_budget;
    Counter m_counter;
    std::shared_ptr<TcpChannel> m_channel;
    std::unique_ptr<ReceptionTask> m_task;
    std::array<std::byte, 8> m_word{};
    std::array<std::span<const std::byte>, 1> m_answer{m_word};
    std::uint64_t m_sent = 0;
};

} // namespace

class AcknowledgementTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void aWholeImageIsAcknowledgedAtOnce_data()
    {
        QTest::addColumn<int>("size");
        QTest::newRow("in one segment") << 1129;
        QTest::newRow("in several") << 8192;
    }

    void aWholeImageIsAcknowledgedAtOnce()
    {
        QFETCH(int, size);
        Line line;
        for (int i = 0; i < 40; ++i) {
            line.send(static_cast<std::size_t>(size), 2854);
            QCOMPARE(line.unacknowledged(), 0);
            line.answer();
        }
    }
};

QTEST_GUILESS_MAIN(AcknowledgementTest)
#include "acknowledgement_test.moc"
