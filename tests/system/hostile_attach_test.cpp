// Wrong beginnings of connections, and connections that claim another's session.
#include "hostile_stage.hpp"

#include <QTest>

#include <thread>

using namespace liena;
using namespace liena::test;
using Kind = SessionEvent::Kind;
using wire::Bytes;
using wire::Words;
namespace number = wire::number;

namespace {

constexpr std::uint64_t strange = 0x1122334455667788U; ///< a token that nobody has
constexpr std::uint16_t motion = 0x0101;

Bytes both(const Bytes& first, const Bytes& second) { return Words().raw(first).raw(second); }

/// The first words of a connection, each to be answered by nothing but its end.
std::vector<std::pair<const char*, Bytes>> wrongBeginnings(HostileStage& s)
{
    auto& peer = s.peer;
    const auto attachAs = [&](std::uint32_t origin, std::uint32_t target, const Bytes& body, bool more = false) {
        auto head = peer.header(number::attach);
        head.origin = origin;
        head.target = target;
        head.more = more;
        return wire::datagram(head, body);
    };
    const auto own = s.xrayId.value();
    const auto robot = s.robotId.value();
    const auto right = wire::attach(peer.token(), 0);
    auto brief = right;
    brief.pop_back();
    auto cut = peer.header(number::handshake);
    cut.more = true;
    const auto half = wire::datagram(cut, Bytes(40));
    return {
        {"a heartbeat", peer.said(number::heartbeat, wire::heartbeat({.sequence = 1, .state = wire::state::open}))},
        {"a handshake", peer.handshake(strange)},
        {"a command", peer.control(motion, motionFields(1, 1, 1), {1, 1, 1})},
        {"no datagram", Bytes(2000, 0x47)},
        {"Attach in another's name", attachAs(s.cockpitId.value(), robot, right)},
        {"Attach in the receiver's name", attachAs(robot, robot, right)},
        {"Attach for another device", attachAs(own, s.armId.value(), right)},
        {"Attach for everybody", attachAs(own, wire::everyone, right)},
        {"Attach one byte short", attachAs(own, robot, brief)},
        {"Attach one byte long", attachAs(own, robot, both(right, Bytes(1)))},
        {"Attach with more to come", attachAs(own, robot, right, true)},
        {"lane 9", peer.attach(peer.token(), 9)},
        {"lane 255", peer.attach(peer.token(), 255)},
        {"lane 1 of no session", peer.attach(strange, 1)},
        {"lane 1 of token 0", peer.attach(0, 1)},
        {"token 0", both(peer.attach(0), peer.handshake(0))},
        {"a fresh token and no handshake", both(peer.attach(strange), peer.said(number::channelOpened, wire::tokenOnly(strange)))},
        {"a fresh token twice", both(peer.attach(strange), peer.attach(strange))},
        {"a fresh token and the handshake of another", both(peer.attach(strange), peer.handshake(strange + 2))},
        {"a fresh token and the handshake of our session", both(peer.attach(strange), peer.handshake(peer.token()))},
        {"a handshake in segments", both(peer.attach(strange), half)},
        {"a handshake with no end", both(peer.attach(strange), both(wire::encoded(peer.header(number::handshake)), {}))},
    };
}

} // namespace

class HostileAttachTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void closesAWrongBeginningWithoutAWord()
    {
        HostileStage stage;
        stage.openPeer();
        const auto rejections = stage.peer.heard(number::rejected).size();
        for (const auto& [name, first] : wrongBeginnings(stage)) {
            const auto link = stage.peer.saying(first);
            QCOMPARE(link->failure(), std::string());
            Bytes said;
            QVERIFY2(link->closes(&said), name);
            QVERIFY2(said.empty(), name);
        }
        QCOMPARE(stage.peer.heard(number::rejected).size(), rejections);
        QVERIFY2(stage.robot.events(Kind::StateChanged, stage.xrayId).back().to == SessionState::Open, stage.story().c_str());
        QVERIFY(stage.peer.command(motion, motionFields(1, 1, 1)));
        QVERIFY2(eventually([&] { return stage.motions().size() == 1; }), stage.story().c_str());
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }

    void closesTheSilent()
    {
        HostileStage stage;
        stage.openPeer();
        const auto attach = stage.peer.attach(strange);
        const auto nothing = stage.peer.connection();
        const auto half = stage.peer.saying(Bytes(attach.begin(), attach.begin() + 19));
        const auto noHandshake = stage.peer.saying(attach);
        const auto halfHandshake = stage.peer.saying(both(attach, Bytes(10)));
        for (const auto* link : {&nothing, &half, &noHandshake, &halfHandshake})
            QVERIFY((*link)->closes());
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
        QCOMPARE(words(stage.robot.state(stage.xrayId)), words(SessionState::Open));
    }

    void keepsFewConnectionsBeforeTheirHandshake()
    {
        HostileStage stage;
        std::vector<std::unique_ptr<TlsLink>> links;
        for (std::uint64_t i = 0; i < 40; ++i)
            links.push_back(stage.peer.saying(stage.peer.attach(strange + i)));
        for (const auto& link : links)
            QVERIFY(link->closes());
        stage.openPeer();
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }

    void tellsAnotherVersionWhy_data()
    {
        QTest::addColumn<int>("version");
        QTest::newRow("0") << 0;
        QTest::newRow("2") << 2;
        QTest::newRow("65535") << 65535;
    }
    void tellsAnotherVersionWhy()
    {
        QFETCH(int, version);
        HostileStage stage;
        const auto body = wire::attach(strange, 0, static_cast<std::uint16_t>(version));
        const auto link = stage.peer.saying(both(stage.peer.said(number::attach, body), stage.peer.handshake(strange)));
        QVERIFY(stage.peer.waits([&] { return !stage.peer.heard(number::rejected).empty(); }));
        const auto rejected = stage.peer.heard(number::rejected)[0];
        QCOMPARE(rejected.token, strange);
        QCOMPARE(rejected.datagram.body.at(8), wire::reason::protocolVersion);
        QVERIFY(link->closes());
        QCOMPARE(words(stage.robot.state(stage.xrayId)), words(SessionState::Closed));
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }

    void answersADeviceOfTheTopologyWithoutALink()
    {
        HostileStage stage;
        auto role = roleOf(stage.system, "arm", "cockpit"); // linked to the robot only
        ScriptedPeer unlinked(role);
        const auto link = unlinked.saying(both(unlinked.attach(strange), unlinked.handshake(strange)));
        QVERIFY(unlinked.waits([&] { return !unlinked.heard(number::rejected).empty(); }));
        QCOMPARE(unlinked.heard(number::rejected)[0].datagram.body.at(8), wire::reason::noLink);
        QVERIFY(link->closes());
        QVERIFY2(stage.cockpit.heard(Kind::IdentityRefused, stage.armId), stage.story().c_str());
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }

    void saysNothingToADeviceThatIsNotInTheTopology()
    {
        HostileStage stage;
        const DeviceId second(stage.armId.value() + 1); // a good certificate of the site, for another arm
        TestAuthority& site = stage.system.authority();
        const auto files = site.identityOf(second, "second-arm");
        auto role = roleOf(stage.system, "arm", "robot");
        role.id = second.value();
        role.face.certificate = files.certificate;
        role.face.key = files.key;
        ScriptedPeer unknown(role);
        Bytes said;
        QVERIFY(unknown.saying(both(unknown.attach(strange), unknown.handshake(strange)))->closes(&said));
        QVERIFY(said.empty());
        QVERIFY2(eventually([&] { return stage.robot.heard(Kind::IdentityRefused, second); }), stage.story().c_str());
        QVERIFY(unknown.heard(number::attach).empty());
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }

    void replacesLaneZeroWithoutAnEvent()
    {
        HostileStage stage;
        stage.openPeer();
        const auto changes = stage.robot.events(Kind::StateChanged, stage.xrayId).size();
        for (int i = 0; i < 60; ++i)
            stage.peer.replaceLaneZero();
        for (int i = 0; i < 20; ++i) // of bulk lanes as well
            stage.peer.keep(stage.peer.lane(static_cast<std::uint8_t>(1 + i % 8)));
        QVERIFY(stage.peer.command(motion, motionFields(1, 1, 1)));
        QVERIFY2(eventually([&] { return stage.motions().size() == 1; }), stage.story().c_str());
        QCOMPARE(stage.robot.events(Kind::StateChanged, stage.xrayId).size(), changes);
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }

    void aSecondAttachIsAViolation()
    {
        HostileStage stage;
        stage.openPeer();
        stage.peer.send(stage.peer.attach(stage.peer.token()));
        QVERIFY2(eventually([&] { return stage.robot.heard(Kind::Lost, stage.xrayId); }), stage.story().c_str());
        QCOMPARE(words(stage.robot.events(Kind::Lost)[0].diagnosis.cause), words(LossCause::ProtocolViolation));
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }

    void aByteInTheOtherDirectionEndsTheConnection()
    {
        HostileStage stage;
        stage.openPeer();
        QVERIFY(stage.peer.talkBack(Bytes(1)));
        QVERIFY2(eventually([&] { return stage.robot.heard(Kind::Interrupted, stage.xrayId); }), stage.story().c_str());
        QCOMPARE(words(stage.robot.state(stage.xrayId)), words(SessionState::Open));
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }

    /// An intruder with a good certificate of its own knows the token of a session in hand.
    void neverMixesAnIntruderIntoASession()
    {
        HostileStage stage;
        ScriptedPeer victim(roleOf(stage.system, "arm", "robot"));
        victim.open();
        auto& intruder = stage.peer;
        const auto token = victim.token();
        auto asVictim = intruder.header(number::attach);
        asVictim.origin = stage.armId.value();
        const auto command = intruder.control(motion, motionFields(666, 1, 1), {1, 1, 1});
        const std::vector<std::pair<const char*, Bytes>> attempts{
            {"lane 0 in its own name", both(intruder.attach(token), command)},
            {"lane 0 in the victim's name", both(wire::datagram(asVictim, wire::attach(token, 0)), command)},
            {"bulk lane in its own name", both(intruder.attach(token, 1), command)},
            {"bulk lane in the victim's name", both(wire::datagram(asVictim, wire::attach(token, 1)), command)},
            {"a commit", both(intruder.attach(token), intruder.said(number::handshakeCommit, wire::handshakeCommit(token, {})))},
            {"a session of its own under that token", both(intruder.attach(token), intruder.handshake(token))},
            {"a re-opening under that token", both(intruder.attach(token), intruder.diagnosisHandshake(token, token))},
        };
        for (const auto& [name, first] : attempts)
            QVERIFY2(intruder.saying(first)->closes(), name);
        QVERIFY2(intruder.heard(number::attach).empty(), stage.story().c_str()); // no answer to any of them
        QVERIFY2(!stage.robot.heard(Kind::StateChanged, stage.xrayId), stage.story().c_str());
        QVERIFY2(stage.toldOf("token is in use"), stage.story().c_str());
        QCOMPARE(words(stage.robot.state(stage.armId)), words(SessionState::Open));
        QCOMPARE(words(stage.robot.events(Kind::StateChanged, stage.armId).back().to), words(SessionState::Open));
        const auto packets = stage.linkOf(stage.armId).packetsHeard;
        QVERIFY2(eventually([&] { return stage.linkOf(stage.armId).packetsHeard > 0; }), std::to_string(packets).c_str());
        QVERIFY(victim.command(motion, motionFields(1, 1, 1)));
        QVERIFY2(eventually([&] { return !stage.motions().empty(); }), stage.story().c_str());
        QCOMPARE(stage.motions().size(), std::size_t{1});
        QCOMPARE(stage.motions()[0].origin(), stage.armId);
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }

    /// The name of an incident must not become the name of a session: its loss would be taken for the old one, which has ended.
    void refusesTheTokenOfALostSession()
    {
        HostileStage stage;
        stage.openPeer();
        const auto token = stage.peer.token();
        stage.peer.send(stage.peer.attach(token)); // a violation
        QVERIFY2(eventually([&] { return stage.robot.state(stage.xrayId) == SessionState::StandBy; }), stage.story().c_str());
        const auto again = both(stage.peer.attach(token), stage.peer.diagnosisHandshake(token, token));
        QVERIFY(stage.peer.saying(again)->closes());
        QCOMPARE(words(stage.robot.state(stage.xrayId)), words(SessionState::StandBy));
        stage.openPeer(); // with a fresh one
        QVERIFY2(eventually([&] { return stage.robot->incidents().empty(); }), stage.story().c_str());
        const auto changes = stage.robot.events(Kind::StateChanged, stage.xrayId).size();
        QVERIFY(stage.peer.saying(again)->closes());
        QCOMPARE(stage.robot.events(Kind::StateChanged, stage.xrayId).size(), changes);
        QVERIFY2(stage.toldOf("token is in use"), stage.story().c_str());
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }

    /// The same while the robot opens and waits for the victim to connect back: whoever comes first, only the victim gets in.
    void neverTakesAnotherForTheOneItAsked()
    {
        HostileStage stage;
        ScriptedPeer victim(roleOf(stage.system, "arm", "robot"));
        auto& intruder = stage.peer;
        std::atomic<bool> stop{false};
        std::atomic<int> closed{0};
        std::thread hammer([&] {
            while (!stop) {
                const auto asked = victim.heard(number::handshake);
                if (asked.empty())
                    continue;
                const auto token = asked.back().token;
                const auto commit = wire::handshakeCommit(token, wire::hashOf(intruder.role().set));
                closed += intruder.saying(both(intruder.attach(token), intruder.said(number::handshakeCommit, commit)))->closes() ? 1 : 0;
            }
        });
        std::vector<SessionEvent> opened;
        for (std::size_t round = 1; round <= 8; ++round) {
            (void)stage.robot->openChannel(stage.armId);
            if (!eventually([&] { return stage.robot.events(Kind::Opened, stage.armId).size() == round; }))
                break;
            victim.close();
            (void)eventually([&] { return stage.robot.state(stage.armId) == SessionState::Closed; });
        }
        (void)eventually([&] { return closed > 20; });
        stop = true;
        hammer.join();
        QVERIFY2(stage.robot.events(Kind::Opened, stage.armId).size() == 8, stage.story().c_str());
        QVERIFY(closed > 20);
        QVERIFY2(!stage.robot.heard(Kind::Opened, stage.xrayId), stage.story().c_str());
        QVERIFY2(stage.robot->incidents().empty(), stage.story().c_str());
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }

    /// What was said on them in the opening is read when the session opens: the first breaks it, and all of them end.
    void bulkLanesThatWaitedAndBreakTheSessionAreAllEnded()
    {
        HostileStage stage;
        auto& peer = stage.peer;
        peer.habits.answers = false;
        peer.begin(false);
        const auto token = peer.token();
        QVERIFY(peer.waits([&] {
            const auto commits = peer.heard(number::handshakeCommit);
            return !commits.empty() && commits.back().token == token;
        }));
        auto foreign = peer.header(0x0200);
        foreign.origin = stage.armId.value();
        std::vector<std::unique_ptr<TlsLink>> lanes;
        for (std::uint8_t lane = 1; lane <= 4; ++lane)
            lanes.push_back(peer.saying(both(peer.attach(token, lane), wire::datagram(foreign, Bytes(64)))));
        QVERIFY(peer.say(number::channelOpened, wire::tokenOnly(token)));
        QVERIFY2(eventually([&] { return stage.robot.heard(SessionEvent::Kind::Lost, stage.xrayId); }), stage.story().c_str());
        QVERIFY(stage.robot.events(SessionEvent::Kind::Lost, stage.xrayId)[0].diagnosis.cause == LossCause::ProtocolViolation);
        for (const auto& lane : lanes)
            QVERIFY(lane->closes());
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }
};

QTEST_GUILESS_MAIN(HostileAttachTest)
#include "hostile_attach_test.moc"
