// A device that the topology gives by name: a session that stands needs no name server.
#include "hostile_stage.hpp"
#include "slow_line.hpp"

#include <QTest>

#include <atomic>
#include <memory>
#include <string_view>

#include <dlfcn.h>
#include <netdb.h>

using namespace liena;
using namespace liena::test;
using Kind = SessionEvent::Kind;

namespace {

constexpr const char* host = "device.liena.test";

std::atomic<int> asked{0};
std::atomic<bool> answers{true};
std::atomic<bool> isTwoAddresses{false};

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
        answers = false;
        asked = 0;
        line.reset(); // that network is gone
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
