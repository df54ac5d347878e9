// Any sequence of events on one session machine in virtual time: after each, what must always hold; in the end, silence ends every session.
#include "fuzz_input.hpp"
#include "session_invariants.hpp"

#include <array>

using namespace liena;
using namespace liena::session;
using namespace liena::fuzz;
using namespace std::chrono_literals;

namespace {

constexpr DeviceId robotId(0x00008208U);
constexpr DeviceId cockpitId(0x40018208U);
const Sha256 topologyHash = Sha256::of(std::string_view("topology"));
const Sha256 ownSet = Sha256::of(std::string_view("own set"));
const Sha256 peerSet = Sha256::of(std::string_view("peer set"));

/// Turns bytes into events as a shell may tell them; the peer may say anything at any time.
class EventSource {
public:
    EventSource(FuzzInput& input, CheckedMachine& machine) : m_input(input), m_machine(machine) {}

    void step()
    {
        switch (m_input.below(24)) {
        case 0:
            return m_machine.pass(1ms * m_input.number<std::uint8_t>());
        case 1:
            return m_machine.passToDeadline();
        case 2:
            return m_machine.handle(Tick{});
        case 3:
            return m_machine.handle(OpenRequested{m_machine.freshToken()});
        case 4:
            return m_machine.handle(ReopenRequested{m_machine.freshToken(), seen()});
        case 5:
            return m_machine.handle(CloseRequested{"closed"});
        case 6:
            return m_machine.handle(OutgoingUp{});
        case 7:
            return m_machine.handle(OutgoingFailed{ProbeResult::ConnectionRefused, "refused"});
        case 8:
            return m_machine.handle(OutgoingLost{ProbeResult::NotProbed, "reset"});
        case 9:
            return incoming(true);
        case 10:
            return incoming(false);
        case 11:
            return handshake();
        case 12:
            return commit();
        case 13:
            return m_machine.handle(SetHeard{standing(), "a set"});
        case 14:
            return m_machine.handle(LifeHeard{static_cast<LifePath>(m_input.below(3))});
        case 15:
            return m_machine.handle(ViolationFound{"a violation"});
        case 16:
            return m_machine.handle(Stalled{100ms});
        case 17:
            return m_machine.handle(IncidentHeld{m_input.flag() ? m_machine->token() : 900 + m_input.below(3)});
        case 18:
            return m_machine.handle(IncidentGone{});
        case 19:
            return m_machine.revoke();
        case 20:
        case 21:
            return heartbeat();
        case 22:
            return wildHeartbeat();
        default:
            return otherMessage();
        }
    }

private:
    SetStanding standing() { return static_cast<SetStanding>(m_input.below(4)); }

    /// What the person was shown: nothing, what is held, or what was held before.
    IncidentId seen()
    {
        const auto choice = m_input.below(4);
        return choice == 0 ? 0 : choice < 3 ? m_machine->incident() : 900 + m_input.below(3);
    }
    std::uint64_t someToken() { return m_input.below(4) == 0 ? 7 : m_machine->token(); }

    /// The shell reads lane 0 of a living session only.
    void incoming(bool up)
    {
        const auto state = m_machine->state();
        if (state == SessionState::Closed || state == SessionState::StandBy)
            return;
        if (up)
            m_machine.handle(IncomingUp{});
        else if (m_machine->isIncomingUp())
            m_machine.handle(IncomingLost{"reset"});
    }

    void handshake()
    {
        const auto choice = m_input.number<std::uint8_t>();
        HandshakeHeard heard;
        heard.connection = m_machine.freshConnection();
        heard.handshake = {m_machine.freshToken(), (choice & 7U) == 7 ? peerSet : topologyHash, peerSet, {"peer"}};
        heard.diagnosis = (choice & 8U) != 0;
        heard.previous = (choice & 16U) == 0 ? 0 : (choice & 32U) == 0 ? m_machine->incident() : m_machine->token();
        heard.standing = static_cast<SetStanding>((choice & 0x80U) != 0 ? choice >> 5U & 3U : 0);
        heard.notAdmitted = choice == 0x07 ? "not now" : "";
        m_machine.handle(heard);
    }

    void commit()
    {
        const auto choice = m_input.number<std::uint8_t>();
        const protocol::HandshakeCommit commit{someToken(), peerSet, (choice & 1U) != 0, {"peer"}};
        m_machine.handle(CommitHeard{commit, (choice & 2U) != 0, (choice & 4U) != 0 ? std::uint64_t{900} : 0,
                                     static_cast<SetStanding>((choice & 8U) != 0 ? choice >> 4U & 3U : 0)});
    }

    /// As an honest peer sends it.
    void heartbeat()
    {
        const auto choice = m_input.number<std::uint8_t>();
        protocol::Heartbeat heartbeat;
        heartbeat.sequence = ++m_sequence;
        heartbeat.sentNs = m_machine.now().wall.ns - 1'000'000;
        heartbeat.echoSequence = m_sequence;
        heartbeat.echoSentNs = heartbeat.sentNs - 2'000'000;
        heartbeat.echoReceivedNs = heartbeat.sentNs - 1'000'000;
        heartbeat.state = (choice & 8U) != 0 ? static_cast<SessionState>(1 + (choice & 7U) % 7) : SessionState::Open;
        heartbeat.epoch = 1 + (choice >> 6U);
        m_machine.handle(LifeHeard{});
        m_machine.handle(SessionMessageHeard{heartbeat});
    }

    /// All that the wire can carry.
    void wildHeartbeat()
    {
        protocol::Heartbeat heartbeat;
        heartbeat.sequence = m_input.number<std::uint32_t>();
        heartbeat.sentNs = m_input.number<std::uint64_t>();
        heartbeat.echoSequence = m_input.number<std::uint32_t>();
        heartbeat.echoSentNs = m_input.number<std::uint64_t>();
        heartbeat.echoReceivedNs = m_input.number<std::uint64_t>();
        heartbeat.datagramsHeard = m_input.number<std::uint8_t>();
        heartbeat.state = static_cast<SessionState>(1 + m_input.below(7));
        heartbeat.epoch = m_input.number<std::uint32_t>();
        m_sequence = std::max(m_sequence, heartbeat.sequence);
        m_machine.handle(SessionMessageHeard{heartbeat});
    }

    void otherMessage()
    {
        using namespace protocol;
        const auto token = someToken();
        const auto reason = static_cast<RejectReason>(1 + m_input.below(12));
        const std::array<SessionMessage, 18> messages{Attach{1, token, 0},
                                                      Handshake{token, topologyHash, peerSet, {"peer"}},
                                                      MessageSetRequest{m_input.flag() ? ownSet : peerSet},
                                                      ChannelOpened{token},
                                                      Rejected{token, reason, {"no"}},
                                                      Disengagement{token, {"bye"}},
                                                      DisengagementCommit{token},
                                                      ChannelClosed{token},
                                                      ChannelReOpened{token, 900, robotId, cockpitId},
                                                      StandBy{900, robotId, cockpitId, LossCause::LocalStall, 1, robotId},
                                                      StandByReport{900, cockpitId, true, 1},
                                                      IncidentDismissed{900, cockpitId, {"gone"}},
                                                      LinkReport{},
                                                      Abandon{0x0200, 1},
                                                      MeasureRequest{1, 1000, 100, 0},
                                                      MeasureAnswer{},
                                                      Probe{},
                                                      ProbeEcho{}};
        m_machine.handle(SessionMessageHeard{messages[m_input.below(messages.size())]});
    }

    FuzzInput& m_input;
    CheckedMachine& m_machine;
    std::uint32_t m_sequence = 0;
};

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    FuzzInput input(data, size);
    const auto choice = input.below(8);
    const bool leads = (choice & 1U) != 0;
    CheckedMachine machine({leads ? robotId : cockpitId, leads ? cockpitId : robotId, LinkTiming(), topologyHash, ownSet, "fuzz"});
    EventSource events(input, machine);
    while (!input.isUsedUp())
        events.step();
    if (choice < 2) // it takes hundreds of Ticks: not each time
        machine.endsInSilence();
    return 0;
}
