// Every state of a session against everything that can happen to it: one row per cell.
#include "dialogue_cells.hpp"
#include "session_cells.hpp"
#include "session_side.hpp"

#include <QTest>

#include <functional>
#include <map>
#include <set>
#include <sstream>

using namespace liena;
using namespace liena::test;
using namespace liena::session;

namespace {

struct Stage {
    const char* name;
    SessionState state;
    std::function<void(Side&)> reach;
};

const std::vector<Stage>& stages()
{
    static const std::vector<Stage> all{
        {"Closed", SessionState::Closed, [](Side&) {}},
        {"Opening-initiator", SessionState::Opening, [](Side& s) { s.becomeOpening(); }},
        {"Opening-responder", SessionState::Opening, [](Side& s) { s.becomeResponder(); }},
        {"Open", SessionState::Open, [](Side& s) { s.becomeOpen(); }},
        {"Suspect", SessionState::Suspect, [](Side& s) { s.becomeSuspect(); }},
        {"Reconnecting", SessionState::Reconnecting, [](Side& s) { s.becomeReconnecting(); }},
        {"StandBy", SessionState::StandBy, [](Side& s) { s.becomeStandBy(); }},
        {"Reopening-initiator", SessionState::Reopening, [](Side& s) { s.becomeReopening(); }},
        {"Reopening-responder", SessionState::Reopening, [](Side& s) { s.becomeReopeningResponder(); }},
        {"Closing-initiator", SessionState::Closing, [](Side& s) { s.becomeClosing(); }},
        {"Closing-responder", SessionState::Closing, [](Side& s) { s.becomeClosingByPeer(); }},
    };
    return all;
}

struct Event {
    const char* name;
    std::function<SessionInput(Side&)> make;
};

const std::vector<Event>& inputs()
{
    static const std::vector<Event> all{
        {"OpenRequested", [](Side&) { return OpenRequested{900}; }},
        {"ReopenRequested", [](Side&) { return ReopenRequested{900}; }},
        {"CloseRequested", [](Side&) { return CloseRequested{"done"}; }},
        {"OutgoingUp", [](Side&) { return OutgoingUp{}; }},
        {"OutgoingFailed",
         [](Side&) {
             return OutgoingFailed{ProbeResult::ConnectionRefused, "refused"};
         }},
        {"OutgoingLost",
         [](Side&) {
             return OutgoingLost{ProbeResult::NotProbed, "reset"};
         }},
        {"IncomingUp", [](Side&) { return IncomingUp{}; }},
        {"IncomingLost", [](Side&) { return IncomingLost{"reset"}; }},
        {"HandshakeHeard", [](Side& s) { return s.handshake(300); }},
        {"HandshakeHeard-diagnosis", [](Side& s) { return s.handshake(300, true, 100); }},
        {"CommitHeard", [](Side& s) { return s.commit(); }},
        {"CommitHeard-diagnosis", [](Side& s) { return s.commit(true); }},
        {"SetHeard", [](Side&) { return SetHeard{}; }},
        {"LifeHeard", [](Side&) { return LifeHeard{}; }},
        {"ViolationFound", [](Side&) { return ViolationFound{"a violation"}; }},
        {"Stalled", [](Side&) { return Stalled{80ms}; }},
        {"IncidentHeld-this-session", [](Side& s) { return IncidentHeld{s.machine.token() != 0 ? s.machine.token() : 100}; }},
        {"IncidentHeld-an-older", [](Side&) { return IncidentHeld{55}; }},
        {"IncidentGone", [](Side&) { return IncidentGone{}; }},
        {"Tick-nothing-due", [](Side&) { return Tick{}; }},
        {"Tick-after-4s",
         [](Side& s) {
             s.pass(4s);
             return Tick{};
         }},
    };
    return all;
}

/// Each session message as it arrives on lane 0, with the session's own token where it has one.
const std::vector<Event>& messages()
{
    const auto heard = [](const protocol::SessionMessage& message) { return SessionMessageHeard{message}; };
    static const std::vector<Event> all{
        {"Attach",
         [=](Side& s) {
             return heard(protocol::Attach{1, s.machine.token(), 0});
         }},
        {"Handshake", [=](Side& s) { return heard(s.handshake(300).handshake); }},
        {"HandshakeCommit", [=](Side& s) { return heard(s.commit().commit); }},
        {"MessageSetRequest", [=](Side&) { return heard(protocol::MessageSetRequest{robotSet}); }},
        {"MessageSet", [=](Side&) { return heard(protocol::MessageSetAnswer{}); }},
        {"ChannelOpened", [=](Side& s) { return heard(protocol::ChannelOpened{s.machine.token()}); }},
        {"Rejected",
         [=](Side& s) {
             return heard(protocol::Rejected{s.machine.token(), RejectReason::Busy, {"busy"}});
         }},
        {"Heartbeat",
         [=](Side& s) {
             protocol::Heartbeat heartbeat;
             heartbeat.sequence = 1000;
             heartbeat.state = s.peerState;
             heartbeat.epoch = 1;
             return heard(heartbeat);
         }},
        {"Disengagement",
         [=](Side& s) {
             return heard(protocol::Disengagement{s.machine.token(), {"done"}});
         }},
        {"DisengagementCommit", [=](Side& s) { return heard(protocol::DisengagementCommit{s.machine.token()}); }},
        {"ChannelClosed", [=](Side& s) { return heard(protocol::ChannelClosed{s.machine.token()}); }},
        {"DiagnosisHandshake",
         [=](Side& s) {
             return heard(protocol::DiagnosisHandshake{s.handshake(300).handshake, 100});
         }},
        {"DiagnosisHandshakeCommit",
         [=](Side& s) {
             return heard(protocol::DiagnosisHandshakeCommit{s.commit().commit, 100});
         }},
        {"ChannelReOpened",
         [=](Side& s) {
             return heard(protocol::ChannelReOpened{s.machine.token(), 100, robotId, cockpitId});
         }},
        {"StandBy",
         [=](Side&) {
             return heard(protocol::StandBy{55, robotId, cockpitId, LossCause::HeartbeatLost, 1, cockpitId});
         }},
        {"StandByReport",
         [=](Side&) {
             return heard(protocol::StandByReport{55, cockpitId, true, 1});
         }},
        {"IncidentDismissed",
         [=](Side&) {
             return heard(protocol::IncidentDismissed{55, cockpitId, {"gone"}});
         }},
        {"LinkReport", [=](Side&) { return heard(protocol::LinkReport{}); }},
        {"Abandon",
         [=](Side&) {
             return heard(protocol::Abandon{0x0200, 1});
         }},
        {"MeasureRequest",
         [=](Side&) {
             return heard(protocol::MeasureRequest{1, 1000, 0, 0});
         }},
        {"MeasureAnswer", [=](Side&) { return heard(protocol::MeasureAnswer{}); }},
        {"Probe", [=](Side&) { return heard(protocol::Probe{}); }},
        {"ProbeEcho", [=](Side&) { return heard(protocol::ProbeEcho{}); }},
    };
    return all;
}

std::vector<Event> events()
{
    auto all = inputs();
    all.insert(all.end(), messages().begin(), messages().end());
    return all;
}

QString key(const std::string& stage, const std::string& event) { return QString::fromStdString(stage + " × " + event); }

struct Cell {
    std::string state;
    std::string actions;
};

/// `event  state  actions…` per line.
std::map<QString, Cell> cells(std::size_t& lines)
{
    std::map<QString, Cell> all;
    for (const auto* tables : {&dialogueCells, &sessionCells})
        for (const auto& [stage, table] : *tables) {
            std::istringstream text{std::string(table)};
            for (std::string line; std::getline(text, line);) {
                std::istringstream words(line);
                std::string event;
                Cell cell;
                if (!(words >> event >> cell.state))
                    continue;
                for (std::string word; words >> word;)
                    cell.actions += (cell.actions.empty() ? "" : " ") + word;
                all[key(std::string(stage), event)] = cell;
                ++lines;
            }
        }
    return all;
}

} // namespace

class SessionCellsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void reachesEveryState();
    void namesEveryInputAndMessage();
    void leavesNoCellOut();
    void doesWhatTheTableSays_data();
    void doesWhatTheTableSays();
    void tellsEveryChangeOfState_data();
    void tellsEveryChangeOfState();
};

void SessionCellsTest::reachesEveryState()
{
    std::set<SessionState> reached;
    for (const auto& stage : stages()) {
        Side side;
        stage.reach(side);
        QVERIFY2(side.machine.state() == stage.state, stage.name);
        reached.insert(stage.state);
    }
    QCOMPARE(reached.size(), std::size_t{8});
}

void SessionCellsTest::namesEveryInputAndMessage()
{
    std::set<std::size_t> kinds{SessionInput(SessionMessageHeard{}).index()};
    std::set<std::size_t> numbers;
    Side side;
    for (const auto& event : inputs())
        kinds.insert(event.make(side).index());
    for (const auto& event : messages()) {
        const auto input = event.make(side);
        const auto& message = std::get<SessionMessageHeard>(input).message;
        QCOMPARE(std::string(protocol::nameOf(message)), std::string(event.name));
        numbers.insert(message.index());
    }
    QCOMPARE(kinds.size(), std::variant_size_v<SessionInput>);
    QCOMPARE(numbers.size(), std::variant_size_v<protocol::SessionMessage>);
}

void SessionCellsTest::leavesNoCellOut()
{
    std::size_t lines = 0;
    const auto known = cells(lines);
    QCOMPARE(lines, std::size_t{11 * 44});
    QCOMPARE(known.size(), lines);
    for (const auto& stage : stages())
        for (const auto& event : events())
            QVERIFY2(known.contains(key(stage.name, event.name)), qPrintable(key(stage.name, event.name)));
}

void SessionCellsTest::doesWhatTheTableSays_data()
{
    QTest::addColumn<int>("stage");
    QTest::addColumn<int>("event");
    QTest::addColumn<QString>("state");
    QTest::addColumn<QString>("actions");
    std::size_t lines = 0;
    const auto known = cells(lines);
    for (std::size_t s = 0; s < stages().size(); ++s)
        for (std::size_t e = 0; e < events().size(); ++e) {
            const auto name = key(stages()[s].name, events()[e].name);
            const auto found = known.find(name);
            const auto cell = found != known.end() ? found->second : Cell{"(no cell)", {}};
            QTest::newRow(qPrintable(name)) << int(s) << int(e) << QString::fromStdString(cell.state)
                                            << QString::fromStdString(cell.actions);
        }
}

void SessionCellsTest::doesWhatTheTableSays()
{
    QFETCH(int, stage);
    QFETCH(int, event);
    QFETCH(QString, state);
    QFETCH(QString, actions);
    Side side;
    stages()[static_cast<std::size_t>(stage)].reach(side);
    side.pass(1ms);
    const auto input = events()[static_cast<std::size_t>(event)].make(side);
    const auto done = side.handle(input);
    QCOMPARE(QString::fromStdString(nameOf(side.machine.state())), state);
    QCOMPARE(QString::fromStdString(wordsOf(done)), actions);
}

void SessionCellsTest::tellsEveryChangeOfState_data() { doesWhatTheTableSays_data(); }

void SessionCellsTest::tellsEveryChangeOfState()
{
    QFETCH(int, stage);
    QFETCH(int, event);
    Side side;
    stages()[static_cast<std::size_t>(stage)].reach(side);
    side.pass(1ms);
    auto state = side.machine.state();
    for (const auto& action : side.handle(events()[static_cast<std::size_t>(event)].make(side)))
        if (const auto* entered = std::get_if<Entered>(&action)) {
            QVERIFY(entered->from == state && entered->to != state);
            state = entered->to;
        }
    QVERIFY(state == side.machine.state());
    if (state == SessionState::Closed || state == SessionState::StandBy)
        QVERIFY(!side.machine.nextDeadline());
    else
        QVERIFY(side.machine.nextDeadline());
}

QTEST_APPLESS_MAIN(SessionCellsTest)
#include "session_cells_test.moc"
