// Floods: abandoned handshakes, a thousand slow sockets, no descriptors left, endless segments, and wrong things without end.
#include "hostile_stage.hpp"

#include <QTest>

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <thread>

// Freed memory that waits to be reused would hide what grows.
extern "C" const char* __asan_default_options() { return "quarantine_size_mb=16"; }

using namespace liena;
using namespace liena::test;
using namespace std::chrono_literals;
using Kind = SessionEvent::Kind;
using wire::Bytes;
using wire::Words;
namespace number = wire::number;

namespace {

constexpr std::size_t mebibyte = std::size_t{1} << 20U;

/// The process may have that many descriptors until the end of the scope; ask reached().
class DescriptorLimit {
public:
    explicit DescriptorLimit(rlim_t wanted)
    {
        ::getrlimit(RLIMIT_NOFILE, &m_before);
        auto limit = m_before;
        limit.rlim_cur = std::min(wanted, m_before.rlim_max);
        m_reached = ::setrlimit(RLIMIT_NOFILE, &limit) == 0 && limit.rlim_cur >= wanted;
    }
    ~DescriptorLimit() { restore(); }
    bool reached() const { return m_reached; }
    void restore() { ::setrlimit(RLIMIT_NOFILE, &m_before); }

private:
    rlimit m_before{};
    bool m_reached = false;
};

/// The lowest number that is free now.
int freeDescriptor()
{
    const int number = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
    ::close(number);
    return number;
}

/// The first bytes of a TLS client, as OpenSSL says them.
Bytes clientHello()
{
    const auto context = clientContext({.certificate = {}, .key = {}, .authority = {}, .between = {}});
    const std::unique_ptr<SSL, void (*)(SSL*)> ssl(SSL_new(context.get()), SSL_free);
    SSL_set_bio(ssl.get(), BIO_new(BIO_s_mem()), BIO_new(BIO_s_mem()));
    SSL_set_connect_state(ssl.get());
    SSL_do_handshake(ssl.get());
    Bytes hello(4096);
    hello.resize(static_cast<std::size_t>(BIO_read(SSL_get_wbio(ssl.get()), hello.data(), static_cast<int>(hello.size()))));
    return hello;
}

/// CPU time of the robot's network thread so far.
std::chrono::nanoseconds cpuTime(TestDevice& device)
{
    std::atomic<std::int64_t> taken{-1};
    device->post([&] {
        timespec spent{};
        ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &spent);
        taken = spent.tv_sec * 1'000'000'000LL + spent.tv_nsec;
    });
    (void)eventually([&] { return taken >= 0; });
    return std::chrono::nanoseconds(taken);
}

Bytes segment(wire::Header head, std::size_t size)
{
    head.more = true;
    return wire::datagram(head, Bytes(size));
}

} // namespace

class HostileFloodTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void abandonedHandshakesDisturbNobody()
    {
        HostileStage stage;
        stage.openPeer();
        const auto hello = clientHello();
        QVERIFY(hello.size() > 100);
        const auto memory = residentBytes();
        const auto flood = [&](bool whole) {
            for (int i = 0; i < 300; ++i) {
                const auto socket = tcpTo(stage.peer.role().devicePort);
                waitFor(socket.number(), POLLOUT, 5000ms);
                const auto size = whole ? hello.size() : hello.size() / 2;
                if (::send(socket.number(), hello.data(), size, MSG_NOSIGNAL) > 0 && whole)
                    waitFor(socket.number(), POLLIN, 5000ms); // until the device has paid for its answer
            }
        };
        std::vector<std::thread> threads;
        for (int i = 0; i < 4; ++i)
            threads.emplace_back(flood, i != 0);
        for (auto& thread : threads)
            thread.join();
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
        QCOMPARE(words(stage.robot.state(stage.xrayId)), words(SessionState::Open));
        QVERIFY2(stage.refusals().size() < 60, stage.story().c_str()); // a few causes, each at most every ten seconds
        QVERIFY(residentBytes() < memory + 64 * mebibyte);
        ScriptedPeer next(roleOf(stage.system, "arm", "robot"));
        next.open();
    }

    void aThousandSlowSocketsDisturbNobody()
    {
        HostileStage stage;
        stage.openPeer();
        const DescriptorLimit limit(2500);
        if (!limit.reached())
            QSKIP("this process may not open 2500 descriptors: raise the hard limit (ulimit -Hn)");
        const auto hello = clientHello();
        const auto memory = residentBytes();
        std::vector<Descriptor> sockets;
        for (int i = 0; i < 1000; ++i)
            sockets.push_back(tcpTo(stage.peer.role().devicePort));
        QCOMPARE(std::count_if(sockets.begin(), sockets.end(), [](const Descriptor& one) { return static_cast<bool>(one); }), 1000);
        // One byte a second of half of them, the others silent, for longer than the time that an Attach has.
        for (std::size_t second = 0; second < 3; ++second) {
            for (std::size_t i = 0; i < sockets.size(); i += 2)
                (void)::send(sockets[i].number(), hello.data() + second, 1, MSG_NOSIGNAL);
            const auto beats = stage.linkOf(stage.cockpitId).heartbeatsReceived;
            QVERIFY2(eventually([&] { return stage.linkOf(stage.cockpitId).heartbeatsReceived >= beats + 20; }), stage.story().c_str());
        }
        QVERIFY2(stage.honestSessionUntouched(), stage.story().c_str());
        QVERIFY(residentBytes() < memory + 64 * mebibyte);
        ScriptedPeer next(roleOf(stage.system, "arm", "robot")); // while they are still there
        next.open();
        QVERIFY2(stage.refusals().size() < 40, stage.story().c_str());
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }

    void withoutDescriptorsTheSessionsGoOnAndTheListenerComesBack()
    {
        HostileStage stage;
        stage.openPeer();
        DescriptorLimit limit(static_cast<rlim_t>(freeDescriptor()) + 16);
        std::array<Descriptor, 4> callers; // several: what the device opens for a moment may be free again for one of them
        std::generate(callers.begin(), callers.end(), tcpSocket);
        std::vector<Descriptor> taken;
        while (taken.emplace_back(::open("/dev/null", O_RDONLY | O_CLOEXEC))) {
        }
        QCOMPARE(errno, EMFILE);
        for (const auto& caller : callers)
            QVERIFY2(connectTo(caller, stage.peer.role().devicePort), std::strerror(errno));
        const auto failed = [&] {
            const auto lines = stage.log();
            return std::count_if(lines.begin(), lines.end(),
                                 [](const std::string& line) { return line.find("cannot accept") != std::string::npos; });
        };
        QVERIFY2(eventually([&] { return failed() > 0; }), stage.story().c_str());
        const auto spent = cpuTime(stage.robot);
        const auto begun = std::chrono::steady_clock::now();
        const auto beats = stage.linkOf(stage.cockpitId).heartbeatsReceived;
        QVERIFY2(eventually([&] { return stage.linkOf(stage.cockpitId).heartbeatsReceived >= beats + 30; }), stage.story().c_str());
        const auto busy = cpuTime(stage.robot) - spent;
        QVERIFY2(busy < (std::chrono::steady_clock::now() - begun) / 2, std::to_string(busy.count()).c_str()); // it waits between its tries
        QVERIFY2(stage.honestSessionUntouched(), stage.story().c_str());
        QVERIFY(failed() < 5);
        taken.clear();
        limit.restore();
        ScriptedPeer next(roleOf(stage.system, "arm", "robot"));
        next.open();
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }

    /// Eight lanes of pictures that never end: together they hold 64 MiB and no more, and what ends gives its share back.
    void endlessSegmentsStayWithinTheirBudget()
    {
        HostileStage stage;
        stage.openPeer();
        const auto memory = residentBytes();
        std::vector<TlsLink*> lanes;
        for (std::uint8_t lane = 1; lane <= 8; ++lane) {
            lanes.push_back(stage.peer.keep(stage.peer.lane(lane)));
            const auto head = stage.peer.header(0x0200);
            for (int i = 0; i < 15 * 32; ++i) // 15 MiB of the 16 that a picture may have
                QVERIFY(lanes.back()->send(segment(head, 32767)));
        }
        QVERIFY2(eventually([&] { return stage.toldOf("hold too much"); }), stage.story().c_str());
        QVERIFY(residentBytes() < memory + 192 * mebibyte);
        for (int i = 0; i < 300; ++i) // begun and given up, again and again
            QVERIFY(lanes[0]->send(segment(stage.peer.header(0x0200), 32767)));
        QVERIFY(stage.peer.command(0x0103, Words().u32(1).u8(1).u8(1)));
        QVERIFY2(eventually([&] { return !stage.robot.messages("GripperCommand").empty(); }), stage.story().c_str());
        QCOMPARE(words(stage.robot.state(stage.xrayId)), words(SessionState::Open));
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }

    /// It beats and takes nothing: what waits for it is what the queue may hold, and of the heartbeats the newest alone.
    void aPeerThatNeverReadsFillsNothing()
    {
        HostileStage stage;
        stage.openPeer();
        stage.peer.habits.reads = false;
        std::atomic<bool> full{false};
        const auto fill = [&] {
            for (int i = 0; i < 500 && !full; ++i) {
                auto report = stage.robot->report("InjectionReport").value();
                report.set("reason", std::string(128, 'x'));
                const auto sent = stage.robot->send(stage.xrayId, report);
                full = !sent && sent.error().code == Errc::QueueFull;
            }
        };
        const auto pass = [&](unsigned count) {
            const auto beats = stage.linkOf(stage.xrayId).heartbeatsReceived;
            return eventually([&] { return stage.linkOf(stage.xrayId).heartbeatsReceived >= beats + count; });
        };
        // The kernel's buffers take some for as long as they grow: only a queue that stays full shows that nobody reads.
        const auto staysFull = [&] {
            full = false;
            return eventually([&] { return stage.robot->post(fill), full.load(); }) && pass(10) &&
                   stage.linkOf(stage.xrayId).queuedMessages >= 4096 - 2;
        };
        QVERIFY2(eventually(staysFull), stage.story().c_str());
        QVERIFY2(pass(40), stage.story().c_str());
        QCOMPARE(words(stage.robot.state(stage.xrayId)), words(SessionState::Open));
        const auto queued = stage.linkOf(stage.xrayId).queuedMessages;
        QVERIFY2(queued >= 4096 - 2 && queued <= 4096 + 4, std::to_string(queued).c_str());
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }

    /// It asks again and again about an incident that is over, and takes no answer. When it does, it hears what is held, and may ask again.
    void aPeerThatTakesNoAnswersFillsNothing()
    {
        HostileStage stage;
        stage.openPeer();
        auto& peer = stage.peer;
        const auto toEverybody = [&](std::uint16_t number, const Bytes& body) {
            auto head = peer.header(number);
            head.target = wire::everyone;
            return wire::datagram(head, body);
        };
        const auto standBy = [&](std::uint64_t id) {
            return toEverybody(number::standBy, wire::standBy(id, stage.xrayId.value(), stage.armId.value(), 1, 1, stage.xrayId.value()));
        };
        const auto hears = [&](std::uint16_t number, std::uint64_t id) {
            const auto heard = peer.heard(number);
            return std::any_of(heard.begin(), heard.end(), [&](const auto& one) { return wire::Reader(one.datagram.body).u64() == id; });
        };
        for (const std::uint64_t over : {7U, 8U}) {
            peer.send(standBy(over));
            peer.send(toEverybody(number::incidentDismissed, Words().u64(over).u32(stage.xrayId.value()).text(std::string(200, 'x'))));
        }
        peer.send(standBy(9));
        QVERIFY2(eventually([&] { return stage.robot->incidents().size() == 1 && stage.robot->incidents()[0].id == 9; }),
                 stage.story().c_str());
        peer.habits.reads = false;
        constexpr std::uint32_t most = 32768;
        Words many;
        for (int i = 0; i < 1000; ++i)
            many.raw(standBy(7));
        for (int i = 0; i < 60; ++i)
            QVERIFY(peer.send(many));
        QVERIFY(peer.send(standBy(8))); // whose answer finds no room
        QVERIFY(peer.say(0x0FFF, {}));  // dropped, when all that came before was judged
        QVERIFY2(eventually([&] { return stage.dropped() == 1; }), stage.story().c_str());
        const auto queued = stage.linkOf(stage.xrayId).queuedMessages;
        QVERIFY2(queued > most / 2 && queued <= most + 8, std::to_string(queued).c_str());
        QCOMPARE(words(stage.robot.state(stage.xrayId)), words(SessionState::Open));
        peer.habits.reads = true;
        QVERIFY2(peer.waits([&] { return hears(number::standBy, 9); }), stage.story().c_str());
        QVERIFY(!hears(number::incidentDismissed, 8));
        QVERIFY(peer.send(standBy(8)));
        QVERIFY2(peer.waits([&] { return hears(number::incidentDismissed, 8); }), stage.story().c_str());
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }

    void eachCauseIsCountedAndToldOnce()
    {
        HostileStage stage;
        stage.openPeer();
        const auto begun = std::chrono::steady_clock::now();
        const auto lines = stage.log().size();
        std::size_t sent = 0;
        for (std::uint32_t i = 0; i < 3000; ++i, sent += 3) {
            auto stray = stage.peer.header(static_cast<std::uint16_t>(0x0300 + i % 0xC00)); // of a number that nothing defines
            stray.target = i * 77777 + 1;
            stage.peer.send(wire::datagram(stray, {}));
            stage.peer.send(stage.peer.said(static_cast<std::uint16_t>(0x1000 + i * 13), {})); // reserved
            stage.peer.send(stage.peer.said(static_cast<std::uint16_t>(0x0300 + i % 0xC00), {}));
        }
        QVERIFY2(eventually([&] { return stage.dropped() == sent; }), std::to_string(stage.dropped()).c_str());
        const auto tens = static_cast<std::size_t>((std::chrono::steady_clock::now() - begun) / 10s);
        const auto events = stage.robot.events(Kind::MessagesDropped, stage.xrayId);
        QVERIFY2(events.size() >= 3 && events.size() <= 3 * (tens + 1), stage.robot.story().c_str());
        QVERIFY(stage.log().size() <= lines + 3 * (tens + 1));
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }

    void refusedIdentitiesAreCountedAndToldOnce()
    {
        HostileStage stage;
        const auto begun = std::chrono::steady_clock::now();
        TestAuthority elsewhere;
        const auto files = elsewhere.identityOf(stage.xrayId, "xray");
        const auto lines = stage.log().size();
        stage.peer.show({.certificate = files.certificate, .key = files.key, .authority = {}, .between = {}});
        for (int i = 0; i < 40; ++i)
            QVERIFY(stage.peer.saying(stage.peer.attach(1))->closes());
        const auto tens = static_cast<std::size_t>((std::chrono::steady_clock::now() - begun) / 10s);
        QVERIFY2(eventually([&] { return !stage.refusals().empty(); }), stage.story().c_str());
        QVERIFY2(stage.refusals().size() <= 2 * (tens + 1), stage.story().c_str());
        QVERIFY2(stage.log().size() <= lines + 2 * (tens + 1), stage.story().c_str());
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }

    void aLengthWhoseBodyNeverComesEndsInReconnecting()
    {
        HostileStage stage({.timing = R"(heartbeat="50ms" suspect="2s" lost="3s" reconnect="3500ms")"});
        stage.openPeer();
        auto head = stage.peer.header(0x0201);
        head.length = 86;
        stage.peer.habits.laneZero = false; // heartbeats go on by UDP, so that only lane 0 is silent
        stage.peer.send(wire::encoded(head));
        QVERIFY2(eventually([&] { return stage.robot.state(stage.xrayId) != SessionState::Open; }), stage.story().c_str());
        const auto left = stage.robot.events(Kind::StateChanged, stage.xrayId).back();
        QVERIFY2(left.to == SessionState::Reconnecting || left.to == SessionState::StandBy, stage.story().c_str());
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }
};

QTEST_GUILESS_MAIN(HostileFloodTest)
#include "hostile_flood_test.moc"
