// A device that the topology gives by name: a session that stands needs no name server.
#include "hostile_stage.hpp"
#include "slow_line.hpp"

#include <QTest>

#include <atomic>
#include <memory>
#include <string_view>

#include <arpa/inet.h>
#include <dlfcn.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

using namespace liena;
using namespace liena::test;
using Kind = SessionEvent::Kind;

namespace {

constexpr const char* host = "device.liena.test";

std::atomic<int> asked{0};
std::atomic<bool> answers{true};
std::atomic<bool> isTwoAddresses{false};

/// Who calls there gets no answer, as from a network that is gone: it listens, and its queue of those who wait to be taken is full.
class DeafPort {
public:
    DeafPort(const char* address, std::uint16_t port)
    {
        sockaddr_in at{};
        at.sin_family = AF_INET;
        at.sin_port = htons(port);
        ::inet_pton(AF_INET, address, &at.sin_addr);
        const auto* place = reinterpret_cast<const sockaddr*>(&at);
        const int on = 1;
        ::setsockopt(m_listener, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
        if (::bind(m_listener, place, sizeof at) == 0 && ::listen(m_listener, 0) == 0)
            (void)::connect(m_caller, place, sizeof at); // the one that it has room for
    }
    ~DeafPort()
    {
        ::close(m_caller);
        ::close(m_listener);
    }
    Q_DISABLE_COPY_MOVE(DeafPort)

    bool isDeaf() const
    {
        tcp_info info{};
        socklen_t size = sizeof info;
        // of a socket that listens: those who wait, and how many may
        return ::getsockopt(m_listener, IPPROTO_TCP, TCP_INFO, &info, &size) == 0 && info.tcpi_state == TCP_LISTEN &&
               info.tcpi_unacked > info.tcpi_sacked;
    }

private:
    int m_listener = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    int m_caller = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
};

} // namespace

// Stands before the C library's, which Asio asks.
extern "C" int getaddrinfo(const char* node, const char* service, const addrinfo* hints, addrinfo** result)
{
    using Ask = int (*)(const char*, const char*, const addrinfo*, addrinfo**);
    static const auto ask = reinterpret_cast<Ask>(::dlsym(RTLD_NEXT, "getaddrinfo"));
    if (node == nullptr || std::string_view(node) != host)
        return ask(node, service, hints, result);
    ++asked;
    if (!answers)
        return EAI_AGAIN;
    const int error = ask(isTwoAddresses ? "127.0.0.2" : "127.0.0.1", service, hints, result);
    if (error != 0 || !isTwoAddresses)
        return error;
    auto* last = *result;
    while (last->ai_next != nullptr)
        last = last->ai_next;
    return ask("127.0.0.1", service, hints, &last->ai_next);
}

class HostNamesTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void init()
    {
        asked = 0;
        answers = true;
        isTwoAddresses = false;
    }

    void aLaneThatIsMadeAnewGoesWhereItWent()
    {
        HostileStage stage({.xrayHost = host});
        stage.openPeer();
        QVERIFY(asked > 0);
        answers = false;
        asked = 0;
        QVERIFY(stage.peer.talkBack(wire::Bytes(1))); // ends the robot's lane
        QVERIFY2(eventually([&] { return stage.robot.heard(Kind::Interrupted, stage.xrayId); }), stage.story().c_str());
        QCOMPARE(words(stage.robot.state(stage.xrayId)), words(SessionState::Open));
        QCOMPARE(asked.load(), 0);
    }

    void aLaneWhoseAddressIsGoneGoesToAnotherOfTheSameHost()
    {
        isTwoAddresses = true;
        HostileStage stage({.xrayHost = host});
        auto line = std::make_unique<SlowLine>(QHostAddress("127.0.0.2"), QHostAddress("127.0.0.1"));
        QVERIFY(line->open(stage.peer.role().port));
        stage.openPeer();
        QCOMPARE(stage.linkOf(stage.xrayId).remoteAddress, std::string("127.0.0.2"));
        answers = false;
        asked = 0;
        line.reset(); // that network is gone
        QVERIFY2(eventually([&] { return stage.robot.heard(Kind::Interrupted, stage.xrayId); }), stage.story().c_str());
        QVERIFY2(!stage.robot.heard(Kind::Lost, stage.xrayId), stage.story().c_str());
        QVERIFY2(eventually([&] { return stage.linkOf(stage.xrayId).remoteAddress == "127.0.0.1"; }), stage.story().c_str());
        QCOMPARE(asked.load(), 0);
    }

    /// No error says that it is gone, and an attempt has no time to wait for one.
    void aLaneWhoseAddressFellSilentGoesToAnotherOfTheSameHost()
    {
        isTwoAddresses = true;
        HostileStage stage({.xrayHost = host});
        SlowLine line(QHostAddress("127.0.0.2"), QHostAddress("127.0.0.1"));
        QVERIFY(line.open(stage.peer.role().port));
        stage.openPeer();
        answers = false;
        asked = 0;
        line.stopListening();
        const DeafPort silence("127.0.0.2", stage.peer.role().port);
        QVERIFY2(eventually([&] { return silence.isDeaf(); }), "no full queue at 127.0.0.2");
        QVERIFY(stage.peer.talkBack(wire::Bytes(1))); // ends the robot's lane
        QVERIFY2(eventually([&] { return stage.robot.heard(Kind::Interrupted, stage.xrayId); }), stage.story().c_str());
        QVERIFY2(!stage.robot.heard(Kind::Lost, stage.xrayId), stage.story().c_str());
        QCOMPARE(asked.load(), 0);
    }

    void aSessionThatIsOpenedAnewAsksAgain()
    {
        HostileStage stage({.xrayHost = host});
        stage.openPeer();
        stage.peer.close();
        QVERIFY2(eventually([&] { return stage.robot.heard(Kind::Closed, stage.xrayId); }), stage.story().c_str());
        asked = 0;
        stage.openPeer();
        QVERIFY(asked > 0); // it may be elsewhere by now
    }

    void picturesGoWhereTheSessionGoes()
    {
        auto viewer = reference::cockpit;
        viewer.host = host;
        TestSystem system({viewer, reference::xray}, {"cockpit xray"});
        TestDevice xray(system.settingsOf("xray"));
        TestDevice cockpit(system.settingsOf("cockpit"));
        QVERIFY(cockpit->openChannel(system.idOf("xray")));
        QTRY_VERIFY2(xray.heard(Kind::Opened), xray.story().c_str());
        answers = false;
        asked = 0;
        const std::vector<std::byte> pixels(std::size_t{2} * 64 * 64);
        const auto arrives = [&] {
            auto frame = xray->report("XrayFrame").value();
            frame.set("frame", 1U).set("rows", 64U).set("columns", 64U).set("bits_stored", 16U);
            frame.set("pixels", std::span<const std::byte>(pixels));
            (void)xray->send(system.idOf("cockpit"), frame); // they live for half a second
            return !cockpit.messages("XrayFrame").empty();
        };
        QTRY_VERIFY2(arrives(), (cockpit.story() + xray.story()).c_str());
        QCOMPARE(asked.load(), 0);
    }
};

QTEST_GUILESS_MAIN(HostNamesTest)
#include "host_names_test.moc"
