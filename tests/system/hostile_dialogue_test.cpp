// Session messages where the session's state does not allow them, refusals as a weapon, and floods of incidents.
#include "hostile_stage.hpp"

#include <QTest>

#include <array>

using namespace liena;
using namespace liena::test;
using Kind = SessionEvent::Kind;
using wire::Bytes;
using wire::Words;
namespace number = wire::number;

namespace {

struct Word {
    const char* name;
    std::uint16_t number;
    std::function<Bytes(HostileStage&)> body;
    bool toEverybody = false;
};

Bytes text(std::uint64_t token, std::string_view words) { return Words().u64(token).text(words); }

Bytes incident(HostileStage& s, std::uint64_t id) { return wire::standBy(id, s.xrayId.value(), s.armId.value(), 1, 1, s.xrayId.value()); }

std::vector<Word> wrongWhenOpen()
{
    const auto token = [](HostileStage& s) { return wire::tokenOnly(s.peer.token()); };
    const auto handshake = [](HostileStage& s) { return wire::handshake(s.peer.token(), {}, {}); };
    return {
        {"Handshake", number::handshake, handshake},
        {"DiagnosisHandshake", number::diagnosisHandshake,
         [](HostileStage& s) { return wire::diagnosisHandshake(s.peer.token(), {}, {}, 0); }},
        {"HandshakeCommit", number::handshakeCommit, [](HostileStage& s) { return wire::handshakeCommit(s.peer.token(), {}); }},
        {"DiagnosisHandshakeCommit", number::diagnosisHandshakeCommit,
         [](HostileStage& s) { return Bytes(Words().raw(wire::handshakeCommit(s.peer.token(), {})).u64(0)); }},
        {"MessageSetRequest", number::messageSetRequest, [](HostileStage&) { return Bytes(32); }},
        {"MessageSet", number::messageSet, [](HostileStage&) { return wire::messageSet({}, "<a/>"); }},
        {"ChannelOpened", number::channelOpened, token},
        {"ChannelReOpened to the device", number::channelReOpened,
         [](HostileStage& s) { return wire::reOpened(s.peer.token(), 0, s.xrayId.value(), s.robotId.value()); }},
        {"DisengagementCommit", number::disengagementCommit, token},
        {"ChannelClosed", number::channelClosed, token},
        {"Disengagement of another token", number::disengagement, [](HostileStage& s) { return text(s.peer.token() + 1, "done"); }},
        {"StandBy to the device alone", number::standBy, [](HostileStage& s) { return incident(s, 7); }},
        {"StandByReport to the device alone", number::standByReport,
         [](HostileStage& s) { return wire::standByReport(7, s.xrayId.value(), true, 1); }},
        {"IncidentDismissed to the device alone", number::incidentDismissed,
         [](HostileStage& s) { return Bytes(Words().u64(7).u32(s.xrayId.value()).text("")); }},
        {"Heartbeat to everybody", number::heartbeat, [](HostileStage&) { return wire::heartbeat({.sequence = 9, .state = 2}); }, true},
        {"Rejected to everybody", number::rejected, [](HostileStage& s) { return wire::rejected(s.peer.token(), 8, ""); }, true},
        {"LinkReport to everybody", number::linkReport, [](HostileStage&) { return Bytes(56); }, true},
        {"StandBy of a pair of one", number::standBy,
         [](HostileStage& s) { return wire::standBy(7, s.armId.value(), s.armId.value(), 1, 1, s.armId.value()); }, true},
        {"StandBy without a name", number::standBy, [](HostileStage& s) { return incident(s, 0); }, true},
    };
}

std::vector<Word> wrongWhenOpening()
{
    const auto token = [](HostileStage& s) { return wire::tokenOnly(s.peer.token()); };
    return {
        {"ChannelOpened of another token", number::channelOpened, [](HostileStage& s) { return wire::tokenOnly(s.peer.token() + 1); }},
        {"ChannelReOpened in an opening", number::channelReOpened,
         [](HostileStage& s) { return wire::reOpened(s.peer.token(), 0, s.xrayId.value(), s.robotId.value()); }},
        {"HandshakeCommit to the one who commits", number::handshakeCommit,
         [](HostileStage& s) { return wire::handshakeCommit(s.peer.token(), wire::hashOf(s.peer.role().set)); }},
        {"a request for another set", number::messageSetRequest, [](HostileStage&) { return Bytes(32); }},
        {"Disengagement", number::disengagement, [](HostileStage& s) { return text(s.peer.token(), "done"); }},
        {"ChannelClosed", number::channelClosed, token},
        {"LinkReport", number::linkReport, [](HostileStage&) { return Bytes(56); }},
        {"Abandon", number::abandon, [](HostileStage&) { return wire::abandon(0x200, 1); }},
        {"StandBy", number::standBy, [](HostileStage& s) { return incident(s, 7); }, true},
        {"ChannelReOpened to everybody", number::channelReOpened,
         [](HostileStage& s) { return wire::reOpened(9, 7, s.xrayId.value(), s.armId.value()); }, true},
    };
}

void say(HostileStage& stage, const Word& word)
{
    auto head = stage.peer.header(word.number);
    if (word.toEverybody)
        head.target = wire::everyone;
    stage.peer.send(wire::datagram(head, word.body(stage)));
}

void addRows(const std::vector<Word>& words)
{
    QTest::addColumn<std::size_t>("row");
    for (std::size_t i = 0; i < words.size(); ++i)
        QTest::newRow(words[i].name) << i;
}

void sayToEverybody(HostileStage& stage, std::uint16_t number, const Bytes& body)
{
    auto head = stage.peer.header(number);
    head.target = wire::everyone;
    stage.peer.send(wire::datagram(head, body));
}

} // namespace

class HostileDialogueTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void aWordOutOfPlaceEndsAnOpenSession_data() { addRows(wrongWhenOpen()); }
    void aWordOutOfPlaceEndsAnOpenSession()
    {
        QFETCH(std::size_t, row);
        HostileStage stage;
        stage.openPeer();
        say(stage, wrongWhenOpen()[row]);
        QVERIFY2(eventually([&] { return stage.robot.heard(Kind::Lost, stage.xrayId); }), stage.story().c_str());
        QCOMPARE(words(stage.robot.events(Kind::Lost)[0].diagnosis.cause), words(LossCause::ProtocolViolation));
        QCOMPARE(stage.robot->incidents().size(),
                 std::size_t{1}); // its own, there as soon as it is heard of, and none that the peer invented
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }

    void aWordOutOfPlaceEndsAnOpening()
    {
        HostileStage stage;
        stage.peer.habits.answers = false;
        for (const auto& word : wrongWhenOpening()) {
            const auto failures = stage.robot.events(Kind::OpenFailed, stage.xrayId).size();
            stage.peer.begin(false);
            const auto token = stage.peer.token();
            QVERIFY(stage.peer.waits([&] {
                const auto commits = stage.peer.heard(number::handshakeCommit);
                return !commits.empty() && commits.back().token == token;
            }));
            say(stage, word);
            QVERIFY2(eventually([&] { return stage.robot.events(Kind::OpenFailed, stage.xrayId).size() > failures; }),
                     (word.name + ("\n" + stage.story())).c_str());
            QVERIFY2(stage.robot.events(Kind::OpenFailed).back().reason == RejectReason::ProtocolViolation,
                     (word.name + ("\n" + stage.story())).c_str());
            QVERIFY2(stage.robot.state(stage.xrayId) == SessionState::Closed, word.name);
        }
        QVERIFY(!stage.robot.heard(Kind::Opened, stage.xrayId));
        QVERIFY(stage.robot->incidents().empty());
        stage.peer.habits.answers = true;
        stage.openPeer();
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }

    void reportsAndAbandonsOfNothingChangeNothing()
    {
        HostileStage stage;
        stage.openPeer();
        for (int i = 0; i < 2000; ++i) {
            stage.peer.say(number::linkReport, Bytes(56, static_cast<std::uint8_t>(i)));
            stage.peer.say(number::abandon, wire::abandon(static_cast<std::uint16_t>(i * 31), static_cast<std::uint64_t>(i)));
        }
        QVERIFY(stage.peer.command(0x0103, Words().u32(1).u8(1).u8(1)));
        QVERIFY2(eventually([&] { return !stage.robot.messages("GripperCommand").empty(); }), stage.story().c_str());
        QCOMPARE(words(stage.robot.state(stage.xrayId)), words(SessionState::Open));
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }

    void aRefusalWithForgedLinesStaysOneLine()
    {
        HostileStage stage;
        stage.openPeer();
        const std::string evil = "done\n2026-01-01T00:00:00.000Z info operator confirmed\x1b[2J\r\xe2\x80\xae<img src=x>";
        stage.peer.say(number::rejected, wire::rejected(stage.peer.token(), wire::reason::shuttingDown, evil));
        QVERIFY2(eventually([&] { return stage.robot.heard(Kind::Lost, stage.xrayId); }), stage.story().c_str());
        stage.openPeer();
        stage.peer.say(number::disengagement, text(stage.peer.token(), evil));
        QVERIFY2(eventually([&] { return stage.robot.heard(Kind::Closed, stage.xrayId); }), stage.story().c_str());
        const auto clean = [](const std::string& line) {
            return std::none_of(line.begin(), line.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; });
        };
        for (const auto& line : stage.log())
            QVERIFY2(clean(line), line.c_str());
        QVERIFY(clean(stage.robot.events(Kind::Closed)[0].detail));
        QVERIFY(clean(stage.robot.events(Kind::Lost)[0].diagnosis.detail));
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }

    void theReasonOfADismissalIsMadeSafe()
    {
        HostileStage stage;
        stage.openPeer();
        sayToEverybody(stage, number::standBy, incident(stage, 7));
        sayToEverybody(stage, number::incidentDismissed, Words().u64(7).u32(stage.xrayId.value()).text("gone\n\x1b[31mand more"));
        QVERIFY2(eventually([&] { return stage.robot.heard(Kind::IncidentEnded); }), stage.story().c_str());
        const auto detail = stage.robot.events(Kind::IncidentEnded)[0].detail;
        QVERIFY2(detail.find('\n') == std::string::npos && detail.find('\x1b') == std::string::npos, detail.c_str());
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }

    /// Honest neighbours hand on what they hear: none of them may be blamed for how many incidents a hostile one invents.
    void moreIncidentsThanCanBeHarmNoOtherSession()
    {
        HostileStage stage;
        stage.openPeer();
        for (std::uint64_t i = 1; i <= 300; ++i)
            sayToEverybody(stage, number::standBy, incident(stage, i));
        stage.peer.send(stage.peer.attach(stage.peer.token())); // a violation: one incident more, of the robot itself
        QVERIFY2(eventually([&] { return stage.robot.heard(Kind::Lost, stage.xrayId); }), stage.robot.story().c_str());
        QVERIFY2(eventually([&] { return stage.cockpit->incidents().size() == 256; }), stage.cockpit.story().c_str());
        const auto lost = stage.cockpit.events(Kind::Lost);
        QVERIFY2(lost.empty(), stage.cockpit.story().c_str());
        QCOMPARE(words(stage.cockpit.state(stage.robotId)), words(SessionState::Open));
        QCOMPARE(stage.robot->incidents().size(), std::size_t{257});
        QVERIFY2(stage.toldOf("more incidents"), stage.robot.story().c_str());
    }

    /// Reports, re-openings and incidents by the thousand: neither the books nor the log grow with them, and nobody's session suffers.
    void aFloodOfBroadcastsDisturbsNobody()
    {
        HostileStage stage;
        stage.openPeer();
        sayToEverybody(stage, number::standBy, incident(stage, 1));
        QVERIFY2(eventually([&] { return stage.cockpit->incidents().size() == 1; }), stage.story().c_str());
        const auto lines = stage.log().size();
        const std::array holders{stage.xrayId.value(), stage.armId.value(), stage.cockpitId.value()};
        for (std::uint64_t i = 1; i <= 1000; ++i) {
            sayToEverybody(stage, number::standByReport, wire::standByReport(1, holders.at(i % holders.size()), true, i));
            sayToEverybody(stage, number::channelReOpened,
                           wire::reOpened(1000 + i, 5000 + i, stage.armId.value(), stage.cockpitId.value()));
            sayToEverybody(stage, number::incidentDismissed, Words().u64(9000 + i).u32(1).text("nothing"));
        }
        QVERIFY(stage.peer.say(0x0FFF, {})); // dropped, when all that came before was judged
        QVERIFY2(eventually([&] { return stage.dropped() == 1; }), stage.robot.story().c_str());
        QCOMPARE(stage.robot->incidents().size(), std::size_t{1});
        QVERIFY(stage.robot->incidents()[0].holds.size() <= 256);
        QVERIFY2(stage.log().size() < lines + 50, std::to_string(stage.log().size()).c_str());
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }

    /// What is handed on to every other device has a bound: among four devices 1536 of a kind at once.
    void newsBeyondAllMeasureIsNotHandedOn()
    {
        HostileStage stage;
        stage.openPeer();
        constexpr std::uint64_t sent = 20000;
        for (std::uint64_t i = 1; i <= sent; ++i)
            sayToEverybody(stage, number::channelReOpened,
                           wire::reOpened(100000 + i, 500000 + i, stage.armId.value(), stage.cockpitId.value()));
        QVERIFY2(eventually([&] { return stage.toldOf("more news of incidents"); }), stage.robot.story().c_str());
        QVERIFY(stage.peer.say(0x0FFF, {})); // dropped, when all that came before was judged
        QVERIFY2(eventually([&] { return stage.toldOf("unknown message number"); }), stage.robot.story().c_str());
        // Up to 205 a second come back: a machine on which the flood takes longer than half a minute would show nothing.
        QVERIFY2(stage.dropped() > sent / 2, std::to_string(stage.dropped()).c_str());
        QVERIFY2(stage.cockpit.events(Kind::Lost).empty(), stage.cockpit.story().c_str());
        QCOMPARE(words(stage.cockpit.state(stage.robotId)), words(SessionState::Open));
        sayToEverybody(stage, number::standBy, incident(stage, 1)); // another kind of news, and still heard
        QVERIFY2(eventually([&] { return stage.cockpit->incidents().size() == 1; }), stage.story().c_str());
    }

    void aHoldOfAStrangerIsNotKept()
    {
        HostileStage stage;
        stage.openPeer();
        sayToEverybody(stage, number::standBy, incident(stage, 1));
        for (std::uint32_t stranger = 1; stranger <= 10; ++stranger)
            sayToEverybody(stage, number::standByReport, wire::standByReport(1, stranger, true, 1));
        sayToEverybody(stage, number::standByReport, wire::standByReport(1, stage.xrayId.value(), true, 1));
        QVERIFY2(eventually([&] { return !stage.robot.events(Kind::HoldReported).empty(); }), stage.robot.story().c_str());
        QCOMPARE(stage.robot->incidents()[0].holds.size(), std::size_t{1});
        QVERIFY2(eventually([&] { return stage.dropped() == 10; }), stage.robot.story().c_str());
        QVERIFY2(stage.toldOf("not in the topology"), stage.robot.story().c_str());
    }
};

QTEST_GUILESS_MAIN(HostileDialogueTest)
#include "hostile_dialogue_test.moc"
