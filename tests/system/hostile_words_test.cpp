// A peer with a good certificate and a bad tongue: headers, lengths, segments and bodies that the protocol does not allow.
#include "hostile_stage.hpp"

#include <QTest>

#include <cmath>

using namespace liena;
using namespace liena::test;
using Kind = SessionEvent::Kind;
using wire::Bytes;
using wire::Words;
namespace number = wire::number;

namespace {

constexpr std::uint16_t motion = 0x0101; // control, to the robot: 41 bytes with its record
constexpr std::uint16_t frame = 0x0200;  // bulk, by the X-ray system
constexpr std::uint16_t status = 0x0201; // status, by the X-ray system: 86 bytes
constexpr std::uint16_t statusSize = 86;

struct Attack {
    const char* name;
    std::function<void(HostileStage&)> act;
    std::string told; ///< part of what the robot's application hears
};

/// A header that says what its body is not.
Bytes header(ScriptedPeer& peer, std::uint16_t number, std::uint16_t length, bool more = false)
{
    auto head = peer.header(number);
    head.length = length;
    head.more = more;
    return wire::encoded(head);
}

Bytes segment(wire::Header head, bool more, std::size_t size)
{
    head.more = more;
    return wire::datagram(head, Bytes(size));
}

Bytes withFields(ScriptedPeer& peer, const Bytes& fields) { return peer.control(motion, fields, peer.guard(motion)); }

void sendAs(HostileStage& stage, std::uint32_t origin, std::uint32_t target, std::uint16_t number, const Bytes& body)
{
    auto head = stage.peer.header(number);
    head.origin = origin;
    head.target = target;
    stage.peer.send(wire::datagram(head, body));
}

std::vector<Attack> headerViolations()
{
    return {
        {"origin of another device",
         [](HostileStage& s) { sendAs(s, s.cockpitId.value(), s.robotId.value(), number::linkReport, Bytes(56)); }, "origin 0x40018208"},
        {"origin of the receiver itself",
         [](HostileStage& s) { sendAs(s, s.robotId.value(), s.robotId.value(), status, Bytes(statusSize)); }, "origin 0x00008208"},
        {"origin of everybody", [](HostileStage& s) { sendAs(s, wire::everyone, s.robotId.value(), status, Bytes(statusSize)); }, "origin"},
        {"session message one byte longer than it can be", [](HostileStage& s) { s.peer.send(header(s.peer, number::heartbeat, 41)); },
         "longer than it can be"},
        {"session message of the greatest length, whose body never comes",
         [](HostileStage& s) { s.peer.send(header(s.peer, number::rejected, 32767)); }, "longer than it can be"},
        {"control one byte longer than its definition", [](HostileStage& s) { s.peer.send(header(s.peer, motion, 42)); }, "longer than"},
        {"status of the greatest length, whose body never comes", [](HostileStage& s) { s.peer.send(header(s.peer, status, 32767)); },
         "longer than"},
        {"control in segments", [](HostileStage& s) { s.peer.send(header(s.peer, motion, 41, true)); }, "several segments"},
        {"bulk on lane 0", [](HostileStage& s) { s.peer.send(header(s.peer, frame, 100)); }, "wrong kind of lane"},
        {"status on a bulk lane", [](HostileStage& s) { s.peer.keep(s.peer.lane(1))->send(header(s.peer, status, statusSize)); },
         "wrong kind of lane"},
        {"control on a bulk lane", [](HostileStage& s) { s.peer.keep(s.peer.lane(1))->send(withFields(s.peer, motionFields(1, 1, 1))); },
         "wrong kind of lane"},
        {"session management on a bulk lane",
         [](HostileStage& s) { s.peer.keep(s.peer.lane(8))->send(s.peer.said(number::channelClosed, wire::tokenOnly(s.peer.token()))); },
         "on a bulk lane"},
    };
}

std::vector<Attack> segmentViolations()
{
    const auto twice = [](std::size_t first, std::size_t second, bool more, auto change) {
        return [=](HostileStage& s) {
            auto head = s.peer.header(status);
            s.peer.send(segment(head, true, first));
            change(head, s);
            s.peer.send(segment(head, more, second));
        };
    };
    const auto same = [](wire::Header&, HostileStage&) {};
    return {
        {"sum of the segments over the maximum", twice(statusSize - 1, 2, false, same), "longer than"},
        {"sum over the maximum in a middle segment", twice(statusSize, 1, true, same), "longer than"},
        {"empty first segment", [](HostileStage& s) { s.peer.send(segment(s.peer.header(status), true, 0)); }, "empty segment"},
        {"empty middle segment", twice(10, 0, true, same), "empty segment"},
        {"empty last segment", twice(10, 0, false, same), "empty segment"},
        {"older than the unfinished message", twice(10, 10, true, [](wire::Header& h, HostileStage&) { --h.timestamp; }),
         "older timestamp"},
        {"another target in the second segment", twice(10, 10, true, [](wire::Header& h, HostileStage&) { h.target = wire::everyone; }),
         "changes its target"},
        {"over the maximum on a bulk lane",
         [](HostileStage& s) {
             auto* lane = s.peer.keep(s.peer.lane(1));
             const auto head = s.peer.header(frame);
             for (int i = 0; i < 513; ++i)
                 if (!lane->send(segment(head, true, 32767)))
                     break;
         },
         "longer than"},
    };
}

std::vector<Attack> drops()
{
    const auto numbered = [](std::uint16_t n, const char* name, const char* told) {
        return Attack{name, [n](HostileStage& s) { s.peer.say(n, Bytes(30)); }, told};
    };
    const auto malformed = [](const char* name, Bytes fields) {
        return Attack{name, [fields](HostileStage& s) { s.peer.send(withFields(s.peer, fields)); }, "malformed"};
    };
    const auto changed = [](std::size_t at, std::uint8_t value) {
        auto fields = motionFields(1, 1, 2.5F);
        fields[at] = value;
        return fields;
    };
    auto brief = motionFields(1, 1, 2.5F);
    brief.pop_back();
    return {
        {"target of another device", [](HostileStage& s) { sendAs(s, s.xrayId.value(), s.armId.value(), status, Bytes(statusSize)); },
         "target is another device"},
        {"target of another device, greatest length",
         [](HostileStage& s) { sendAs(s, s.xrayId.value(), s.cockpitId.value(), 0x0300, Bytes(32767)); }, "target is another device"},
        {"its own target", [](HostileStage& s) { sendAs(s, s.xrayId.value(), s.xrayId.value(), status, Bytes(statusSize)); },
         "target is another device"},
        numbered(0x0000, "number 0", "reserved"),
        numbered(0x1000, "first reserved number", "reserved"),
        numbered(0xFFFF, "last reserved number", "reserved"),
        numbered(0x00FE, "undefined session number", "unknown session message"),
        numbered(0x01FF, "undefined command", "unknown message number"),
        numbered(0x0FFF, "undefined report", "unknown message number"),
        {"command to everybody",
         [](HostileStage& s) { sendAs(s, s.xrayId.value(), wire::everyone, 0x0104, Words().u64(1).text("x").text("y")); }, "broadcast"},
        {"control to everybody", [](HostileStage& s) { sendAs(s, s.xrayId.value(), wire::everyone, motion, Bytes(41)); }, "broadcast"},
        malformed("one byte missing", brief),
        malformed("a bool that is 2", changed(8, 2)),
        malformed("infinite velocity", motionFields(1, 1, HUGE_VALF)),
        malformed("velocity that is no number", motionFields(1, 1, std::nanf(""))),
        malformed("velocity over its bound", motionFields(1, 1, 40.5F)),
        {"control without a whole record", [](HostileStage& s) { s.peer.say(motion, Bytes(15)); }, "no safety record"},
        {"text that is no UTF-8", [](HostileStage& s) { s.peer.say(0x0104, Words().u64(1).text("\xff\xfe").text("")); }, "malformed"},
        {"text longer than its body", [](HostileStage& s) { s.peer.say(0x0104, Words().u64(1).u16(60000)); }, "malformed"},
        {"heartbeat with an undeclared state",
         [](HostileStage& s) { s.peer.say(number::heartbeat, wire::heartbeat({.sequence = 1, .state = 99})); }, "does not decode"},
        {"heartbeat one byte short", [](HostileStage& s) { s.peer.say(number::heartbeat, Bytes(39)); }, "does not decode"},
    };
}

void addRows(const std::vector<Attack>& attacks)
{
    QTest::addColumn<std::size_t>("row");
    for (std::size_t i = 0; i < attacks.size(); ++i)
        QTest::newRow(attacks[i].name) << i;
}

/// The scripted session ended as a violation, and nothing else happened.
void expectViolation(const Attack& attack)
{
    HostileStage stage;
    stage.openPeer();
    attack.act(stage);
    QVERIFY2(eventually([&] { return stage.robot.heard(Kind::Lost, stage.xrayId); }), stage.story().c_str());
    const auto lost = stage.robot.events(Kind::Lost, stage.xrayId)[0];
    QCOMPARE(words(lost.diagnosis.cause), words(LossCause::ProtocolViolation));
    QVERIFY2(lost.diagnosis.detail.find(attack.told) != std::string::npos, lost.diagnosis.detail.c_str());
    QVERIFY(stage.peer.waits([&] { return !stage.peer.heard(number::rejected).empty(); }));
    QCOMPARE(stage.peer.heard(number::rejected)[0].datagram.body.at(8), wire::reason::protocolViolation);
    QVERIFY(stage.motions().empty());
    QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
}

} // namespace

class HostileWordsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void endsTheSessionForAWrongHeader_data() { addRows(headerViolations()); }
    void endsTheSessionForAWrongHeader()
    {
        QFETCH(std::size_t, row);
        expectViolation(headerViolations()[row]);
    }

    void endsTheSessionForWrongSegments_data() { addRows(segmentViolations()); }
    void endsTheSessionForWrongSegments()
    {
        QFETCH(std::size_t, row);
        expectViolation(segmentViolations()[row]);
    }

    /// Every row in one session: each is told as a cause of its own, and the stream stays in step.
    void passesOverWhatItMustNotTake()
    {
        HostileStage stage;
        stage.openPeer();
        std::uint32_t good = 0;
        for (const auto& attack : drops()) {
            const auto before = stage.dropped();
            attack.act(stage);
            QVERIFY2(eventually([&] { return stage.dropped() > before; }), attack.name);
            QVERIFY2(stage.toldOf(attack.told), (attack.name + ("\n" + stage.story())).c_str());
            QVERIFY(stage.peer.command(motion, motionFields(1, ++good, 1)));
            QVERIFY2(eventually([&] { return stage.motions().size() == good; }), (attack.name + ("\n" + stage.story())).c_str());
            QCOMPARE(stage.motions().back().get<std::uint32_t>("sequence"), good);
        }
        QCOMPARE(words(stage.robot.state(stage.xrayId)), words(SessionState::Open));
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }
};

QTEST_GUILESS_MAIN(HostileWordsTest)
#include "hostile_words_test.moc"
