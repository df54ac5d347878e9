// Connections whose bytes are moved by worker threads, more and fewer of them: order, ends, and what may not be touched any more. The
// test's own thread is the network thread.
#include "support/test_authority.hpp"
#include "transport/tcp_channel.hpp"
#include "transport/worker_threads.hpp"

#include "security/tls_identity.hpp"

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/post.hpp>

#include <QTest>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <functional>
#include <future>
#include <random>
#include <system_error>
#include <thread>

using namespace liena;
using namespace liena::test;
using namespace liena::transport;
using namespace std::chrono_literals;

namespace asio = boost::asio;

namespace {

constexpr DeviceId nearId(0x40018208U);
constexpr DeviceId farId(0x20010208U);

using Bytes = std::vector<std::byte>;

Bytes randomBytes(std::mt19937& random, std::size_t size)
{
    Bytes bytes(size);
    for (auto& byte : bytes)
        byte = static_cast<std::byte>(random());
    return bytes;
}

/// One end of a connection, which keeps what it hears.
struct End : TcpChannel::Listener {
    std::shared_ptr<TcpChannel> channel;
    std::shared_ptr<Bytes> buffer = std::make_shared<Bytes>(65574);
    Bytes received;
    int writes = 0; ///< that are over
    std::vector<std::string> lost;

    ~End() override { close(); }
    void begin(std::shared_ptr<TcpChannel> made)
    {
        channel = std::move(made);
        channel->setListener(this);
        channel->read(*buffer, buffer);
    }
    void close()
    {
        if (!channel)
            return;
        channel->setListener(nullptr);
        channel->close();
        channel.reset();
    }
    void bytesRead(std::size_t count) override
    {
        received.insert(received.end(), buffer->begin(), buffer->begin() + static_cast<std::ptrdiff_t>(count));
        channel->read(*buffer, buffer);
    }
    void bytesWritten() override { ++writes; }
    void channelLost(const std::string& detail, bool /*identity*/) override { lost.push_back(detail); }
};

/// What is written, kept with it.
struct Writing {
    explicit Writing(Bytes content, std::mt19937& random, bool cut) : bytes(std::move(content))
    {
        for (std::span<const std::byte> rest = bytes; !rest.empty();) {
            const auto size = cut ? std::min<std::size_t>(rest.size(), 1 + random() % 30000) : rest.size();
            parts.push_back(rest.first(size));
            rest = rest.subspan(size);
        }
    }
    Bytes bytes;
    std::vector<std::span<const std::byte>> parts;
};

class Rig {
public:
    explicit Rig(bool secured) : m_secured(secured)
    {
        if (!secured)
            return;
        const auto identityOf = [&](DeviceId device, const char* name) {
            const auto files = m_authority.identityOf(device, name);
            return security::TlsIdentity::load(files.certificate, files.key, files.authority, device).value();
        };
        m_nearIdentity = identityOf(nearId, "near");
        m_farIdentity = identityOf(farId, "far");
    }
    ~Rig()
    {
        near.close();
        far.close();
        workers.stop();
        io.poll();
    }

    void connect()
    {
        asio::ip::tcp::acceptor acceptor(io, asio::ip::tcp::endpoint(asio::ip::address_v4::loopback(), 0));
        asio::ip::tcp::socket here(io);
        here.connect(acceptor.local_endpoint());
        auto nearChannel = std::make_shared<TcpChannel>(std::move(here));
        auto farChannel = std::make_shared<TcpChannel>(acceptor.accept());
        int shaken = m_secured ? 0 : 2;
        const auto count = [&](const Result<void>& result) { shaken += result ? 1 : 100; };
        if (m_secured) {
            nearChannel->secure(m_nearIdentity->clientContext(), false, count);
            farChannel->secure(m_farIdentity->serverContext(), true, count);
        }
        until([&] { return shaken >= 2; });
        if (shaken != 2)
            throw std::runtime_error("the handshake failed");
        nearChannel->shareWork(workers);
        farChannel->shareWork(workers);
        near.begin(std::move(nearChannel));
        far.begin(std::move(farChannel));
    }

    template <typename Condition>
    void until(Condition condition)
    {
        while (!condition())
            if (io.run_one_for(20s) == 0)
                throw std::runtime_error("nothing happens any more");
    }

    asio::io_context io{1};
    WorkerThreads workers{io, [] {}};
    End near;
    End far;

private:
    asio::executor_work_guard<asio::io_context::executor_type> m_open{io.get_executor()};
    bool m_secured;
    TestAuthority m_authority;
    std::shared_ptr<security::TlsIdentity> m_nearIdentity;
    std::shared_ptr<security::TlsIdentity> m_farIdentity;
};

void bothKinds()
{
    QTest::addColumn<bool>("secured");
    QTest::newRow("TLS") << true;
    QTest::newRow("in the clear") << false;
}

/// A job that counts what happened to it.
struct Counted : WorkerThreads::Job {
    Counted(std::atomic<int>& worked, int& finished) : m_worked(worked), m_finished(finished) {}
    void work() override { ++m_worked; }
    void finish() override { ++m_finished; }

private:
    std::atomic<int>& m_worked;
    int& m_finished;
};

} // namespace

class WorkerThreadsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void threadsComeAndGo();
    void goesOnWithoutThreadsThatCannotBeHad();
    void nobodyWaitsForAThreadThatLeaves();
    void jobsOfAThreadThatLeavesAreDone();
    void stopEndsThreadsWithJobs();
    void everyByteArrivesInOrderHoweverManyWork_data() { bothKinds(); }
    void everyByteArrivesInOrderHoweverManyWork();
    void bothWaysShareOneConnection_data() { bothKinds(); }
    void bothWaysShareOneConnection();
    void closingDuringAStepEndsAllCallbacks_data() { bothKinds(); }
    void closingDuringAStepEndsAllCallbacks();
    void theOtherEndHearsOfAClosingDuringAStep_data() { bothKinds(); }
    void theOtherEndHearsOfAClosingDuringAStep();
    void systemStopsDuringSteps_data() { bothKinds(); }
    void systemStopsDuringSteps();
};

void WorkerThreadsTest::threadsComeAndGo()
{
    Rig rig(false);
    std::atomic<int> worked = 0;
    int finished = 0;
    int given = 0;
    for (const std::size_t count : {1U, 4U, 2U, 3U, 1U}) {
        rig.workers.resize(count);
        QCOMPARE(rig.workers.count(), count);
        for (int i = 0; i < 20; ++i, ++given)
            rig.workers.run(std::make_shared<Counted>(worked, finished));
        rig.until([&] { return finished == given; });
    }
    QCOMPARE(worked.load(), given);
    QVERIFY(rig.workers.takeBusy().workers > 0ns);
    QVERIFY(rig.workers.takeBusy().workers == 0ns);
}

/// A limit of threads that is reached must not end the process in the middle of a session.
void WorkerThreadsTest::goesOnWithoutThreadsThatCannotBeHad()
{
    asio::io_context network;
    std::size_t left = 1;
    WorkerThreads workers(
        network, [] {},
        [&](std::function<void()> life) {
            if (left == 0)
                throw std::system_error(EAGAIN, std::generic_category(), "thread");
            --left;
            return WorkerThread(std::move(life));
        });
    QVERIFY(!workers.lacks());
    workers.resize(3);
    QCOMPARE(workers.count(), std::size_t{1});
    QVERIFY(workers.lacks());
    left = 2;
    workers.resize(3);
    QCOMPARE(workers.count(), std::size_t{3});
    QVERIFY(!workers.lacks());
}

/// It has nothing left to do, and is long about its last steps.
void WorkerThreadsTest::nobodyWaitsForAThreadThatLeaves()
{
    asio::io_context network;
    std::atomic<bool> lived = false;
    std::atomic<bool> gone = false;
    std::promise<void> release;
    WorkerThreads workers(
        network, [] {},
        [&, released = release.get_future().share()](std::function<void()> life) {
            return WorkerThread([&, released, life = std::move(life)] {
                life();
                lived = true;
                released.wait_for(10s);
                gone = true;
            });
        });
    workers.resize(1);
    workers.resize(0);
    const auto open = asio::make_work_guard(network);
    while (!lived)
        network.run_one_for(1ms);
    for (int turns = 0; turns < 3; ++turns) {
        workers.resize(0);
        bool served = false;
        asio::post(network, [&] { served = true; });
        while (!served)
            network.run_one_for(20s);
    }
    QVERIFY(!gone);
    release.set_value();
    workers.stop();
    QVERIFY(gone);
}

void WorkerThreadsTest::jobsOfAThreadThatLeavesAreDone()
{
    Rig rig(false);
    std::atomic<int> worked = 0;
    int finished = 0;
    rig.workers.resize(3);
    for (int i = 0; i < 300; ++i)
        rig.workers.run(std::make_shared<Counted>(worked, finished));
    rig.workers.resize(0);
    rig.until([&] { return finished == 300; });
    QCOMPARE(worked.load(), 300);
}

void WorkerThreadsTest::stopEndsThreadsWithJobs()
{
    std::atomic<int> worked = 0;
    int finished = 0;
    Rig rig(false);
    rig.workers.resize(2);
    for (int i = 0; i < 100; ++i)
        rig.workers.run(std::make_shared<Counted>(worked, finished));
    rig.workers.stop();
    QCOMPARE(rig.workers.count(), std::size_t{0});
    rig.io.poll();
    QCOMPARE(finished, worked.load());
}

void WorkerThreadsTest::everyByteArrivesInOrderHoweverManyWork()
{
    QFETCH(bool, secured);
    std::mt19937 random(7);
    Rig rig(secured);
    rig.connect();
    Bytes sent;
    for (int i = 0; i < 60; ++i) {
        rig.workers.resize(static_cast<std::size_t>(i) / 3 % 4); // also while bytes are under way
        const auto writing = std::make_shared<Writing>(randomBytes(random, 1 + random() % 150000), random, !secured);
        sent.insert(sent.end(), writing->bytes.begin(), writing->bytes.end());
        rig.near.channel->write(writing->parts, writing);
        rig.until([&] { return rig.near.writes > i; });
    }
    rig.until([&] { return rig.far.received.size() >= sent.size(); });
    QVERIFY(rig.far.received == sent);
    QVERIFY(rig.near.lost.empty() && rig.far.lost.empty());
}

void WorkerThreadsTest::bothWaysShareOneConnection()
{
    QFETCH(bool, secured);
    std::mt19937 random(8);
    Rig rig(secured);
    rig.connect();
    rig.workers.resize(2);
    Bytes fromNear;
    Bytes fromFar;
    for (int i = 0; i < 20; ++i) {
        const auto here = std::make_shared<Writing>(randomBytes(random, 100000), random, false);
        const auto there = std::make_shared<Writing>(randomBytes(random, 70000), random, false);
        fromNear.insert(fromNear.end(), here->bytes.begin(), here->bytes.end());
        fromFar.insert(fromFar.end(), there->bytes.begin(), there->bytes.end());
        rig.near.channel->write(here->parts, here);
        rig.far.channel->write(there->parts, there);
        rig.until([&] { return rig.near.writes > i && rig.far.writes > i; });
    }
    rig.until([&] { return rig.far.received.size() >= fromNear.size() && rig.near.received.size() >= fromFar.size(); });
    QVERIFY(rig.far.received == fromNear);
    QVERIFY(rig.near.received == fromFar);
}

/// The sanitizers see a byte that is touched too late.
void WorkerThreadsTest::closingDuringAStepEndsAllCallbacks()
{
    QFETCH(bool, secured);
    std::mt19937 random(9);
    Rig rig(secured);
    for (int i = 0; i < 30; ++i) {
        rig.workers.resize(2);
        rig.connect();
        auto writing = std::make_shared<Writing>(randomBytes(random, 400000), random, false);
        rig.near.channel->write(writing->parts, writing);
        writing.reset();
        for (unsigned turns = random() % 4; turns > 0; --turns)
            rig.io.run_one_for(1ms);
        const auto writes = rig.near.writes;
        const auto received = rig.far.received.size();
        rig.near.close();
        rig.far.close();
        rig.near.buffer = std::make_shared<Bytes>(65574);
        rig.far.buffer = std::make_shared<Bytes>(65574);
        rig.workers.resize(0);
        rig.io.run_for(2ms);
        QCOMPARE(rig.near.writes, writes);
        QCOMPARE(rig.far.received.size(), received);
        QVERIFY(rig.near.lost.empty() && rig.far.lost.empty());
    }
}

void WorkerThreadsTest::theOtherEndHearsOfAClosingDuringAStep()
{
    QFETCH(bool, secured);
    std::mt19937 random(10);
    Rig rig(secured);
    rig.workers.resize(1);
    rig.connect();
    const auto writing = std::make_shared<Writing>(randomBytes(random, 4000000), random, false);
    rig.near.channel->write(writing->parts, writing);
    rig.near.close();
    rig.until([&] { return !rig.far.lost.empty(); });
    QCOMPARE(rig.far.lost.size(), std::size_t{1});
    QVERIFY(rig.far.received.size() <= writing->bytes.size()); // the step ends, and a kernel may take all of it meanwhile
    QVERIFY(std::equal(rig.far.received.begin(), rig.far.received.end(), writing->bytes.begin()));
    QCOMPARE(rig.near.writes, 0);
}

void WorkerThreadsTest::systemStopsDuringSteps()
{
    QFETCH(bool, secured);
    std::mt19937 random(11);
    for (int i = 0; i < 5; ++i) {
        Rig rig(secured);
        rig.workers.resize(3);
        rig.connect();
        const auto writing = std::make_shared<Writing>(randomBytes(random, 4000000), random, false);
        rig.near.channel->write(writing->parts, writing);
        rig.io.run_one_for(1ms);
        rig.workers.stop(); // as when the network thread has ended; the rest is done by the rig's end
    }
}

QTEST_GUILESS_MAIN(WorkerThreadsTest)
#include "worker_threads_test.moc"
