// The judge of the simulation is judged: a clean trace passes, and each invariant is shown able to fail.
#include "reference_model.hpp"

#include <QTest>

using namespace liena;
using namespace liena::simulation;
using namespace std::chrono_literals;

namespace {

constexpr HostIndex robot = 0;
constexpr HostIndex cockpit = 1;
constexpr HostIndex stranger = 2;
constexpr std::uint32_t robotId = 0x00008208U;
constexpr std::uint32_t cockpitId = 0x40018208U;

/// A cockpit in session with a robot, commanding; each step is one that a trace may lack or have wrong.
class Trace {
public:
    Trace() : m_model(rules())
    {
        note(Started{robot});
        note(Started{cockpit});
    }

    Trace& note(const Observation& observation)
    {
        m_model.note(m_now, observation);
        return *this;
    }
    Trace& pass(Nanoseconds time)
    {
        m_now += time;
        return *this;
    }

    Trace& open(std::uint64_t token = 7, std::uint32_t epoch = 1)
    {
        note(Requested{cockpit, robot, token, false, true, 0});
        enter(SessionState::Closed, SessionState::Opening, token);
        enter(SessionState::Opening, SessionState::Open, token);
        note(Opened{cockpit, robot, token, false, false, epoch});
        return note(Opened{robot, cockpit, token, false, false, epoch});
    }

    Trace& enter(SessionState from, SessionState to, std::uint64_t token = 7, Nanoseconds silence = 0ns)
    {
        note(Entered{cockpit, robot, from, to, token, silence});
        return note(Entered{robot, cockpit, from, to, token, silence});
    }

    Trace& lose(std::uint64_t token = 7)
    {
        enter(SessionState::Open, SessionState::Reconnecting, token);
        enter(SessionState::Reconnecting, SessionState::StandBy, token);
        note(Lost{robot, cockpit, token}).note(Lost{cockpit, robot, token});
        note(Raised{robot, token, robot, cockpit});
        return note(Raised{cockpit, token, robot, cockpit});
    }

    Trace& compose(std::uint64_t stamp, bool engaged = false) { return note(Composed{cockpit, robot, command(stamp), true, engaged, 5}); }
    Trace& leave(std::uint64_t stamp) { return note(Left{cockpit, robot, command(stamp)}); }
    Trace& deliver(std::uint64_t stamp, std::uint32_t epoch, std::uint32_t sequence)
    {
        Delivered delivered{robot, cockpit, command(stamp), true};
        delivered.epoch = epoch;
        delivered.sequence = sequence;
        delivered.content = 5;
        delivered.refusedInStandBy = true;
        return note(delivered);
    }
    Trace& carry(std::uint64_t stamp, std::uint32_t sequence)
    {
        return compose(stamp, true).leave(stamp).pass(2ms).deliver(stamp, 1, sequence);
    }
    Trace& apply(std::uint64_t stamp) { return note(Applied{robot, cockpit, command(stamp), true}); }
    Trace& drive(bool faster = false) { return note(Drove{robot, true, faster, true, 2ms}); }

    static MessageName command(std::uint64_t stamp) { return {cockpitId, 0x0101, stamp}; }

    QString broken() const
    {
        QStringList names;
        for (const auto& violation : m_model.violations())
            if (const auto name = QString::fromStdString(violation.invariant); !names.contains(name))
                names << name;
        return names.join(QLatin1Char(' '));
    }

private:
    static Rules rules()
    {
        Rules rules;
        rules.links = {{robot, cockpit}};
        rules.ids = {{robot, robotId}, {cockpit, cockpitId}, {stranger, 0x60008208U}};
        rules.largest = {{{robot, 0x0101}, 43}};
        return rules;
    }

    ReferenceModel m_model;
    Instant m_now{std::chrono::hours(1)};
};

} // namespace

class ReferenceModelTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void acceptsACleanSession();
    void acceptsAConfirmedReopening();
    void finds_data();
    void finds();
};

void ReferenceModelTest::acceptsACleanSession()
{
    Trace trace;
    trace.open().carry(1, 1).apply(1).drive(true).carry(2, 2).apply(2).drive();
    trace.compose(3).note(Unsent{cockpit, robot, Trace::command(3), Fate::Discarded});
    trace.pass(10ms).enter(SessionState::Open, SessionState::Reconnecting, 7, 110ms);
    QCOMPARE(trace.broken(), QString());
}

void ReferenceModelTest::acceptsAConfirmedReopening()
{
    Trace trace;
    trace.open().lose().note(Requested{cockpit, robot, 8, true, true, 7});
    trace.enter(SessionState::StandBy, SessionState::Reopening, 8).enter(SessionState::Reopening, SessionState::Open, 8);
    trace.note(Opened{robot, cockpit, 8, true, false, 3}).note(Opened{cockpit, robot, 8, true, false, 3});
    trace.note(Over{robot, 7, false, cockpit}).note(Over{cockpit, 7, false, robot});
    trace.note(Settled{robot, cockpit, SessionState::Open, 8, 3, 3, 0}).note(Settled{cockpit, robot, SessionState::Open, 8, 3, 3, 0});
    QCOMPARE(trace.broken(), QString());
}

void ReferenceModelTest::finds_data()
{
    QTest::addColumn<Trace>("trace");
    QTest::addColumn<QString>("invariant");
    const auto row = [](const char* name, const char* invariant, const auto& make) {
        Trace trace;
        make(trace);
        QTest::newRow(name) << trace << QString::fromLatin1(invariant);
    };
    row("motion without a lease", "I1", [](Trace& t) { t.open().carry(1, 1).apply(1).pass(90ms).drive(); });
    row("speed gained without a lease", "I1", [](Trace& t) { t.open().carry(1, 1).apply(1).pass(60ms).drive(true); });
    row("motion after the session ended", "I1",
        [](Trace& t) { t.open().carry(1, 1).apply(1).enter(SessionState::Open, SessionState::Reconnecting).pass(40ms).drive(); });
    row("motion in stand-by", "I1", [](Trace& t) {
        t.open().carry(1, 1).apply(1);
        t.note(Lost{stranger, cockpit, 9});
        t.note(Raised{robot, 9, cockpit, stranger}).pass(40ms).drive();
    });
    row("applied in stand-by", "I1", [](Trace& t) {
        t.note(Lost{stranger, cockpit, 9});
        t.open().carry(1, 1).note(Raised{robot, 9, cockpit, stranger}).apply(1);
    });
    row("delivered in stand-by", "I1", [](Trace& t) {
        t.note(Lost{stranger, cockpit, 9});
        t.open().note(Raised{robot, 9, cockpit, stranger}).carry(1, 1);
    });
    row("delivered while reconnecting", "I1", [](Trace& t) {
        t.open().compose(1).leave(1).pass(1ms);
        t.note(Entered{robot, cockpit, SessionState::Open, SessionState::Reconnecting, 7, 0ns}).pass(1ms);
        t.note(Composed{cockpit, robot, Trace::command(2), true, false, 5}).deliver(2, 1, 1);
    });
    row("a loss noticed late", "I1", [](Trace& t) { t.open().pass(10ms).enter(SessionState::Open, SessionState::Reconnecting, 7, 112ms); });
    row("a silent peer in an open session", "I1", [](Trace& t) { t.open().pass(1s).note(Holdings{robot, 0, 0, 0, 0, 0, 112ms}); });
    row("delivered twice", "I2", [](Trace& t) { t.open().carry(1, 1).deliver(1, 1, 2); });
    row("the same sequence twice", "I2", [](Trace& t) { t.open().carry(1, 1).carry(2, 1); });
    row("an older epoch after a newer one", "I2", [](Trace& t) { t.open().carry(1, 5).compose(2).leave(2).deliver(2, 0, 6); });
    row("out of order", "I2", [](Trace& t) { t.open().compose(1).compose(2).leave(1).leave(2).deliver(2, 1, 1).deliver(1, 1, 2); });
    row("changed on the way", "I2", [](Trace& t) {
        t.open().note(Composed{cockpit, robot, Trace::command(1), true, true, 6}).leave(1).deliver(1, 1, 1);
    });
    row("from before an interruption", "I2", [](Trace& t) {
        t.open().compose(1).leave(1).pass(1ms);
        t.note(Entered{robot, cockpit, SessionState::Open, SessionState::Reconnecting, 7, 0ns}).pass(1ms);
        t.note(Entered{robot, cockpit, SessionState::Reconnecting, SessionState::Open, 7, 0ns});
        t.note(Opened{robot, cockpit, 7, false, true, 2}).deliver(1, 2, 1);
    });
    row("from before a revocation", "I2",
        [](Trace& t) { t.open().compose(1).leave(1).pass(1ms).note(Revoked{robot}).pass(1ms).deliver(1, 1, 1); });
    row("an epoch opened twice", "I3", [](Trace& t) {
        t.open().enter(SessionState::Open, SessionState::Reconnecting).enter(SessionState::Reconnecting, SessionState::Open);
        t.note(Opened{robot, cockpit, 7, false, true, 1});
    });
    row("one dialogue opened twice", "I3", [](Trace& t) {
        t.open().enter(SessionState::Open, SessionState::Closing).enter(SessionState::Closing, SessionState::Closed);
        t.enter(SessionState::Closed, SessionState::Opening).enter(SessionState::Opening, SessionState::Open);
        t.note(Opened{robot, cockpit, 7, false, false, 2});
    });
    row("re-opened without a person", "I4", [](Trace& t) {
        t.open().lose().note(Requested{cockpit, robot, 8, true, false, 7});
        t.enter(SessionState::StandBy, SessionState::Reopening, 8).enter(SessionState::Reopening, SessionState::Open, 8);
        t.note(Opened{robot, cockpit, 8, true, false, 3});
    });
    row("a token that nobody drew", "I4", [](Trace& t) {
        t.enter(SessionState::Closed, SessionState::Opening, 9).enter(SessionState::Opening, SessionState::Open, 9);
        t.note(Opened{robot, cockpit, 9, false, false, 1});
    });
    row("opened plainly out of stand-by", "I4", [](Trace& t) {
        t.open().lose().note(Requested{cockpit, robot, 8, false, true, 0});
        t.enter(SessionState::StandBy, SessionState::Opening, 8).enter(SessionState::Opening, SessionState::Open, 8);
        t.note(Opened{robot, cockpit, 8, false, false, 3});
    });
    row("a confirmation for what is over", "I4", [](Trace& t) {
        t.open().lose().note(Dismissed{cockpit, 7}).note(Over{cockpit, 7, true, cockpit}).note(Requested{cockpit, robot, 8, true, true, 7});
        t.enter(SessionState::StandBy, SessionState::Reopening, 8).enter(SessionState::Reopening, SessionState::Open, 8);
        t.note(Opened{robot, cockpit, 8, true, false, 3});
    });
    row("older than its age", "I5", [](Trace& t) { t.open().compose(1).leave(1).pass(51ms).deliver(1, 1, 1); });
    row("sent by nobody", "I5", [](Trace& t) { t.open().deliver(1, 1, 1); });
    row("a hand of long ago", "I5",
        [](Trace& t) { t.open().compose(1, true).leave(1).pass(49ms).deliver(1, 1, 1).pass(40ms).apply(1).pass(60ms).drive(); });
    row("an origin that is not the peer", "I6", [](Trace& t) {
        t.open();
        Delivered delivered{robot, cockpit, {0x60008208U, 0x0200, 1}};
        t.note(Composed{stranger, robot, delivered.name, false, false, 0}).note(delivered);
    });
    row("without a link", "I6", [](Trace& t) { t.note(LaneTaken{robot, stranger, 7, 7}); });
    row("a lane of another session", "I6", [](Trace& t) { t.open().note(LaneTaken{robot, cockpit, 6, 7}); });
    row("outside the envelope", "I7", [](Trace& t) { t.open().carry(1, 1).apply(1).note(Drove{robot, true, true, false, 2ms}); });
    row("queued control kept over a loss", "I8",
        [](Trace& t) { t.open().compose(1).enter(SessionState::Open, SessionState::Reconnecting); });
    row("queued before a loss, sent after it", "I8", [](Trace& t) { t.open().compose(1).pass(1ms).note(Revoked{cockpit}).leave(1); });
    row("accepted for a closed session", "I8", [](Trace& t) { t.compose(1); });
    row("more than the budget", "I9", [](Trace& t) { t.note(Holdings{robot, (std::size_t{4} << 20U) + 1, 0, 0, 0, 0, 0ns}); });
    row("a message longer than its definition", "I9", [](Trace& t) {
        t.open().note(Kept{robot, cockpit, 0, Trace::command(1), 43}).note(Kept{robot, cockpit, 0, Trace::command(1), 44});
    });
    row("too many fresh connections", "I9", [](Trace& t) { t.note(Holdings{robot, 0, 0, 5, 0, 0, 0ns}); });
    row("an incident from nowhere", "I10", [](Trace& t) { t.note(Raised{robot, 5, robot, cockpit}); });
    row("an incident that ends by itself", "I10", [](Trace& t) { t.open().lose().note(Over{robot, 7, false, cockpit}); });
    row("stand-by that never ends", "I10", [](Trace& t) { t.open().note(Settled{robot, cockpit, SessionState::Open, 7, 1, 1, 1}); });
    row("two sessions between two ends", "I11", [](Trace& t) {
        t.open().note(Settled{robot, cockpit, SessionState::Open, 7, 1, 1, 0});
        t.note(Settled{cockpit, robot, SessionState::Open, 8, 1, 1, 0});
    });
    row("no agreement on an epoch", "I11", [](Trace& t) {
        t.open().note(Settled{robot, cockpit, SessionState::Open, 7, 2, 1, 0});
        t.note(Settled{cockpit, robot, SessionState::Open, 7, 1, 1, 0});
    });
    row("a heartbeat that says another state", "I11", [](Trace& t) {
        t.open().enter(SessionState::Open, SessionState::Suspect).note(Beat{robot, cockpit, SessionState::Open, 1});
    });
    row("a heartbeat that says an epoch that is over", "I11", [](Trace& t) {
        t.open().enter(SessionState::Open, SessionState::Reconnecting).enter(SessionState::Reconnecting, SessionState::Open);
        t.note(Opened{robot, cockpit, 7, false, true, 2}).note(Beat{robot, cockpit, SessionState::Open, 1});
    });
    row("not open again", "G19", [](Trace& t) { t.note(Settled{robot, cockpit, SessionState::StandBy, 7, 1, 1, 0}); });
}

void ReferenceModelTest::finds()
{
    QFETCH(Trace, trace);
    QFETCH(QString, invariant);
    QCOMPARE(trace.broken(), invariant);
}

QTEST_APPLESS_MAIN(ReferenceModelTest)
#include "reference_model_test.moc"
