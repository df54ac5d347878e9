// What a command waits for where status fills the path: what the kernel has. The peer that does not read plays the path.
#include "protocol/datagram.hpp"
#include "tasks/transmission_task.hpp"
#include "transport/patient_buffer.hpp"
#include "transport/prompt_buffer.hpp"
#include "transport/worker_threads.hpp"

#include <boost/asio/ip/tcp.hpp>

#include <QElapsedTimer>
#include <QTest>

#include <netinet/tcp.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

using namespace liena;
using namespace liena::tasks;
using namespace liena::transport;
using namespace std::chrono_literals;

namespace asio = boost::asio;
using asio::ip::tcp;

namespace {

constexpr std::uint16_t state = 0x0200;
constexpr std::uint16_t motion = 0x0101;
constexpr std::size_t segment = 8192;
constexpr std::size_t mostHeld = 16 * 1024; ///< that both ends' kernels hold of what may be passed, between their smallest buffers
constexpr int wideOpen = 1 << 20;

/// One lane, and a peer that reads when it is told to.
struct NarrowPath {
    asio::io_context io{1};
    OutputQueue queue{[](const OutputQueue::Entry&, OutputQueue::Fate) {},
                      [](const protocol::DatagramHeader&) { return protocol::EncodedMessage(); }};
    tcp::socket peer{io};
    int descriptor = -1; ///< of our end
    std::shared_ptr<TcpChannel> channel;
    std::unique_ptr<TransmissionTask> task;
    std::vector<std::byte> received;

    /// `rate`: of a bulk lane, which it paces. `peerRoom`: bytes that the peer's kernel keeps.
    explicit NarrowPath(PathRate* rate = nullptr, int peerRoom = 4096)
    {
        tcp::acceptor acceptor(io);
        acceptor.open(tcp::v4());
        acceptor.set_option(tcp::acceptor::receive_buffer_size(peerRoom));
        acceptor.bind(tcp::endpoint(asio::ip::address_v4::loopback(), 0));
        acceptor.listen();
        tcp::socket here(io);
        here.connect(acceptor.local_endpoint());
        acceptor.accept(peer);
        descriptor = here.native_handle();
        channel = std::make_shared<TcpChannel>(std::move(here));
        TransmissionTask::Settings settings{.segment = segment, .batch = 4 * segment};
        settings.traffic = rate != nullptr ? TcpChannel::Traffic::Bulk : TcpChannel::Traffic::Prompt;
        task = std::make_unique<TransmissionTask>(channel, queue, settings, rate, [](const std::string&, bool) {});
    }
    ~NarrowPath() { task->close(); }

    void push(std::uint16_t number, Rank rank, std::size_t size)
    {
        add(number, rank, size);
        task->wake();
    }

    /// Without a word to who sends.
    void add(std::uint16_t number, Rank rank, std::size_t size)
    {
        OutputQueue::Entry entry{{{{DeviceId(0x20010208U), number}, DeviceId(0x40018208U), Timestamp{1}}, {}}, rank, 0, std::nullopt, {}};
        entry.message.part.resize(size);
        queue.push(std::move(entry));
    }

    /// Writes until the kernel takes no more.
    void sendOn()
    {
        while (io.poll() > 0)
            continue;
    }

    /// At most so many bytes of what has come.
    void read(std::size_t most)
    {
        std::array<std::byte, 4096> room;
        while (most > 0) {
            const auto got = ::recv(peer.native_handle(), room.data(), std::min(most, room.size()), MSG_DONTWAIT);
            if (got <= 0)
                return;
            const auto bytes = std::span(room).first(static_cast<std::size_t>(got));
            received.insert(received.end(), bytes.begin(), bytes.end());
            most -= bytes.size();
        }
    }

    /// All that the kernel has was read; nothing of ours was added meanwhile.
    bool isEmptied()
    {
        read(~std::size_t{0});
        return channel->unacknowledged() == 0;
    }

    /// From now on the kernel sends next to nothing. It does so with the first ten packets of a connection only when they are over.
    void holdBack()
    {
        const std::uint64_t bytesPerSecond = 1;
        (void)::setsockopt(descriptor, SOL_SOCKET, SO_MAX_PACING_RATE, &bytesPerSecond, sizeof bytesPerSecond);
        for (int i = 0; i < 12; ++i) {
            push(motion, Rank::Control, 60);
            sendOn();
        }
    }

    /// Where the first message of that number begins.
    std::optional<std::size_t> placeOf(std::uint16_t number) const
    {
        using protocol::headerSize;
        for (std::size_t at = 0; at + headerSize <= received.size();) {
            const auto header = protocol::decodeHeader(std::span<const std::byte, headerSize>(received.data() + at, headerSize));
            if (header.message.number == number)
                return at;
            at += headerSize + header.length;
        }
        return std::nullopt;
    }

    template <typename Value = int>
    Value option(int level, int name) const
    {
        Value value{};
        socklen_t size = sizeof value;
        return ::getsockopt(descriptor, level, name, &value, &size) == 0 ? value : Value(-1);
    }
    int sendBuffer() const { return option(SOL_SOCKET, SO_SNDBUF); }
    int mostUnsent() const { return option(IPPROTO_TCP, TCP_NOTSENT_LOWAT); }
    std::uint64_t pace() const { return option<std::uint64_t>(SOL_SOCKET, SO_MAX_PACING_RATE); }
};

} // namespace

class NarrowPathTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void kernelHoldsLittle()
    {
        NarrowPath path;
        QCOMPARE(path.sendBuffer(), 2 * PromptBuffer::smallest); // it counts what it needs itself, and doubles it for that
        QCOMPARE(path.mostUnsent(), PromptBuffer::unsent);
        for (int i = 0; i < 100; ++i)
            path.push(state, Rank::Status, segment);
        path.sendOn();
        QVERIFY2(path.sendBuffer() <= 2 * PatientBuffer::smallestOn(1ms), qPrintable(QString::number(path.sendBuffer())));
        QTRY_VERIFY(path.isEmptied());
        QVERIFY2(path.received.size() <= mostHeld, qPrintable(QString::number(path.received.size())));
    }

    void allThatMayBePassedLeavesInTheEnd()
    {
        NarrowPath path;
        for (int i = 0; i < 100; ++i)
            path.push(state, Rank::Status, segment);
        QElapsedTimer time;
        time.start();
        while (!(path.isEmptied() && path.queue.empty()) && !time.hasExpired(10'000))
            path.sendOn();
        QVERIFY(path.queue.empty());
        QCOMPARE(path.received.size(), std::size_t(path.task->bytesSent()));
    }

    /// The kernel itself holds bulk back: not faster than the rate, whatever the path would take.
    void bulkLeavesNoFasterThanItsRate()
    {
        constexpr std::size_t frame = 1'000'000;
        PathRate rate;
        NarrowPath path(&rate, wideOpen);
        const double begun = rate.rate();
        QElapsedTimer time;
        time.start();
        path.push(state, Rank::Bulk, frame);
        while (path.received.size() < frame && !time.hasExpired(10'000)) {
            path.sendOn();
            path.read(~std::size_t{0});
        }
        QVERIFY2(path.received.size() >= frame, qPrintable(QString::number(path.received.size())));
        const double seconds = double(time.nsecsElapsed()) / 1e9;
        const auto pace = double(path.pace());
        QVERIFY2(pace >= begun / 2 && pace <= 2 * rate.rate(), qPrintable(QStringLiteral("%1 of %2").arg(pace).arg(rate.rate())));
        QVERIFY2(path.mostUnsent() > 0 && path.mostUnsent() < int(frame / 4), qPrintable(QString::number(path.mostUnsent())));
        const double most = std::max(begun, rate.rate()) * 1.25; // a burst's end may try a step more
        QVERIFY2(double(frame - frame / 4) / seconds <= most, qPrintable(QStringLiteral("%1 s").arg(seconds)));
    }

    /// To hand a write over wakes two threads, however short it is.
    void workersAreGivenMuchAtATime()
    {
        constexpr std::size_t frame = 1'000'000;
        PathRate rate;
        rate.beginAt(PathRate::most);
        NarrowPath alone(&rate, wideOpen);
        alone.push(state, Rank::Bulk, frame);
        QVERIFY2(alone.task->bytesSent() <= 8 * segment, qPrintable(QString::number(alone.task->bytesSent())));
        NarrowPath path(&rate, wideOpen);
        WorkerThreads workers(path.io, [] {});
        path.channel->shareWork(workers);
        workers.resize(1);
        path.push(state, Rank::Bulk, frame);
        QVERIFY2(path.task->bytesSent() >= 16 * segment, qPrintable(QString::number(path.task->bytesSent())));
        QVERIFY2(path.task->bytesSent() <= 20 * segment, qPrintable(QString::number(path.task->bytesSent())));
    }

    /// Commands under way, or others' queues, may leave no room for long. Here it is the kernel that holds back what it has; it takes a
    /// little more, but does not say so.
    void whatFindsNoRoomIsWrittenAfterAWhile()
    {
        NarrowPath path(nullptr, wideOpen);
        path.holdBack();
        const auto before = path.task->bytesSent();
        path.push(state, Rank::Status, 2 * segment);
        path.sendOn();
        const auto piece = path.channel->patientWrite();
        QTRY_VERIFY((path.sendOn(), path.task->bytesSent() > before + 2 * piece)); // the first is held back, and there is another one
    }

    /// Else many commands would carry along what has to wait for room.
    void commandTakesNothingLongAlong()
    {
        NarrowPath path;
        path.add(state, Rank::Status, segment);
        path.add(motion, Rank::Control, 60);
        path.task->wake();
        QCOMPARE(path.task->bytesSent(), std::uint64_t{60 + protocol::headerSize});
        QTRY_VERIFY((path.sendOn(), path.isEmptied() && path.queue.empty()));
        QVERIFY(path.task->bytesSent() > segment);
    }

    void commandAndShortReportLeaveInOneWrite()
    {
        NarrowPath path;
        path.add(state, Rank::Status, 64);
        path.add(motion, Rank::Control, 60);
        path.task->wake();
        QCOMPARE(path.task->bytesSent(), std::uint64_t{60 + 64 + 2 * protocol::headerSize});
    }

    void commandWaitsForWhatTheKernelHasAndNoMore_data()
    {
        QTest::addColumn<int>("size");
        QTest::newRow("behind long reports") << static_cast<int>(segment);
        QTest::newRow("behind short ones") << 64;
    }

    void commandWaitsForWhatTheKernelHasAndNoMore()
    {
        QFETCH(const int, size);
        NarrowPath path;
        for (int left = 1'000'000; left > 0; left -= size)
            path.push(state, Rank::Status, static_cast<std::size_t>(size));
        for (int i = 0; i < 20; ++i) {
            path.sendOn();
            path.read(10'000);
        }
        path.sendOn();
        QVERIFY(!path.queue.empty());
        const auto committed = static_cast<std::size_t>(path.task->bytesSent());
        QVERIFY2(committed - path.received.size() <= mostHeld, qPrintable(QString::number(committed - path.received.size())));
        path.push(motion, Rank::Control, 60);
        QTRY_VERIFY((path.sendOn(), path.read(~std::size_t{0}), path.placeOf(motion).has_value()));
        QCOMPARE(*path.placeOf(motion), committed);
    }
};

QTEST_GUILESS_MAIN(NarrowPathTest)
#include "narrow_path_test.moc"
