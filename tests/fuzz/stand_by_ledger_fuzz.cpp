// Any news about incidents from any neighbour: the ledger stays bounded, and its stand-by begins and ends once.
#include "fuzz_input.hpp"
#include "fuzz_target.hpp"
#include "session/stand_by_ledger.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <utility>

using namespace liena;
using namespace liena::session;
using namespace liena::fuzz;
using namespace std::chrono_literals;

namespace {

constexpr std::array devices{DeviceId(0x00008208U), DeviceId(0x20010208U), DeviceId(0x40018208U), DeviceId(0x60008208U)};
constexpr DeviceId self = devices[0];
constexpr std::size_t mostIncidents = 256;

class World {
public:
    void step(FuzzInput& input)
    {
        switch (input.below(10)) {
        case 0:
            return pass(input);
        case 1:
            return check(m_ledger.lost(other(input), ++m_token, cause(input), m_now.wall, m_now));
        case 2:
            return reopened(input);
        case 3:
            return dismiss(input);
        case 4:
            return check(m_ledger.confirmHold(input.flag(), m_now));
        case 5:
            return greet(input);
        case 6:
            return standBy(input);
        case 7:
            return report(input);
        case 8:
            return flood(input);
        default:
            return end(input);
        }
    }

private:
    static DeviceId any(FuzzInput& input) { return devices[input.below(devices.size())]; }
    static DeviceId other(FuzzInput& input) { return devices[1 + input.below(devices.size() - 1)]; }
    static LossCause cause(FuzzInput& input) { return static_cast<LossCause>(1 + input.below(5)); }

    /// One of this device's own, of a few that others name, or of many.
    std::uint64_t incident(FuzzInput& input)
    {
        const auto choice = input.number<std::uint8_t>();
        if (choice < 64)
            return firstToken + choice % 8;
        return choice < 128 ? std::uint64_t{choice} % 8 : 10'000U + input.number<std::uint16_t>();
    }
    Timestamp stamp(FuzzInput& input) { return input.flag() ? m_now.wall : Timestamp{input.number<std::uint64_t>()}; }

    void pass(FuzzInput& input)
    {
        const auto time =
            input.below(32) == 0 ? std::chrono::nanoseconds(25h) : std::chrono::nanoseconds(1ms * input.number<std::uint8_t>());
        m_now.mono += time;
        m_now.wall.ns += static_cast<std::uint64_t>(time.count());
    }

    void dismiss(FuzzInput& input)
    {
        m_mayEnd = incident(input);
        check(m_ledger.dismiss(*m_mayEnd, "a person's reason", m_now));
        m_mayEnd.reset();
    }

    /// A re-opening of this device's own ends all that it held with the peer, but for the loss of the session that it began.
    void reopened(FuzzInput& input)
    {
        m_mayEndAny = true;
        const auto peer = other(input);
        check(m_ledger.reopened(peer, ++m_token, incident(input), m_now));
        for (const auto& held : m_ledger.incidents())
            expect(!(held.a == self && held.b == peer) || held.id == m_token, "a re-opened pair holds no incident");
        m_mayEndAny = false;
    }

    void greet(FuzzInput& input)
    {
        const auto peer = other(input);
        for (const auto& action : m_ledger.greet(peer)) {
            const auto* answer = std::get_if<Answer>(&action);
            expect(answer != nullptr && answer->to == peer, "a greeting is for the one who is greeted");
        }
    }

    void standBy(FuzzInput& input)
    {
        const auto from = other(input);
        const protocol::StandBy message{incident(input), any(input), any(input), cause(input), stamp(input).ns, any(input)};
        hear(from, message);
    }

    void report(FuzzInput& input)
    {
        const auto from = other(input);
        const auto device = input.flag() ? any(input) : DeviceId(input.number<std::uint16_t>());
        const protocol::StandByReport message{incident(input), device, input.flag(), stamp(input).ns};
        hear(from, message);
    }

    /// A neighbour that does not stop: as many incidents, or as many holders of one, as would go over the bounds.
    void flood(FuzzInput& input)
    {
        const auto from = other(input);
        const auto first = incident(input);
        const bool ofHolders = input.flag();
        const unsigned count = std::exchange(m_flooded, true) ? 0 : 2U * input.number<std::uint8_t>();
        for (unsigned i = 0; i < count; ++i) {
            const auto device = DeviceId(0x00108000U + i);
            const protocol::StandBy incident{first + i, devices[1], devices[2], LossCause::HeartbeatLost, m_now.wall.ns, devices[1]};
            const protocol::StandByReport holder{first, device, true, m_now.wall.ns};
            checkActions(ofHolders ? m_ledger.heard(from, holder, m_now) : m_ledger.heard(from, incident, m_now), from);
        }
        checkState();
        checkEach();
    }

    void end(FuzzInput& input)
    {
        const auto from = other(input);
        const auto named = incident(input);
        m_mayEnd = named;
        if (input.flag())
            hear(from, protocol::IncidentDismissed{named, any(input), {"dismissed"}});
        else
            hear(from, protocol::ChannelReOpened{1 + incident(input), named, any(input), any(input)});
        m_mayEnd.reset();
    }

    /// News is handed on once: what comes again is answered at most, else it would go round for ever.
    template <typename News>
    void hear(DeviceId from, const News& news)
    {
        check(m_ledger.heard(from, news, m_now), from);
        const auto again = m_ledger.heard(from, news, m_now);
        const auto isHandedOn = [](const LedgerAction& action) { return std::holds_alternative<Broadcast>(action); };
        expect(std::none_of(again.begin(), again.end(), isHandedOn), "news is handed on once");
        check(again, from);
    }

    void check(const LedgerActions& actions, std::optional<DeviceId> from = std::nullopt)
    {
        checkActions(actions, from);
        checkState();
        if (m_held.size() <= 32) // else it takes too long for each step
            checkEach();
    }

    void checkActions(const LedgerActions& actions, std::optional<DeviceId> from)
    {
        expect(actions.size() <= 8 + 6 * (m_held.size() + 1), "news has a bounded number of consequences");
        for (const auto& action : actions)
            checkAction(action, from);
    }

    void checkState() const
    {
        expect(m_ledger.size() == m_held.size(), "the application hears of every incident that begins and ends");
        expect(m_ledger.size() <= mostIncidents + m_own, "a neighbour cannot fill the memory");
        expect(m_ledger.standsBy() == !m_held.empty() && m_standsBy == m_ledger.standsBy(), "who holds an incident stands by");
    }

    void checkEach() const
    {
        for (const auto& held : m_ledger.incidents()) {
            expect(held.id != 0 && m_held.contains(held.id) && m_ledger.find(held.id) != nullptr, "an incident is found by its name");
            expect(held.holds.size() <= mostIncidents + 1, "nor can reports");
        }
    }

    void checkAction(const LedgerAction& action, std::optional<DeviceId> from)
    {
        if (const auto* tell = std::get_if<Tell>(&action))
            checkEvent(tell->event);
        else if (const auto* broadcast = std::get_if<Broadcast>(&action))
            expect(!broadcast->except || broadcast->except == from, "news goes to everybody but its bringer");
        else if (const auto* answer = std::get_if<Answer>(&action))
            expect(answer->to == from, "an answer is for who asked");
        else if (const auto* violation = std::get_if<LedgerViolation>(&action))
            expect(violation->peer == from, "a violation is its bringer's");
    }

    void checkEvent(const SessionEvent& event)
    {
        using Kind = SessionEvent::Kind;
        switch (event.kind) {
        case Kind::IncidentRaised:
            expect(m_held.insert(event.incident.id).second, "an incident begins once");
            m_own += event.incident.id >= firstToken && event.incident.id <= m_token ? 1U : 0U;
            return;
        case Kind::IncidentEnded:
            expect(m_held.erase(event.incident.id) == 1, "only what began ends");
            expect(m_mayEndAny || m_mayEnd == event.incident.id, "only a re-opening or a dismissal ends an incident, and the one it names");
            return;
        case Kind::StandByBegan:
            expect(!std::exchange(m_standsBy, true), "stand-by begins once");
            return;
        case Kind::StandByEnded:
            expect(std::exchange(m_standsBy, false) && m_held.empty(), "stand-by ends once, with the last incident");
            return;
        default:
            return;
        }
    }

    static constexpr std::uint64_t firstToken = 1'000'001;

    StandByLedger m_ledger{self};
    Now m_now{Instant(1h), Timestamp{1'767'225'600'000'000'000}};
    std::uint64_t m_token = firstToken - 1;
    std::set<IncidentId> m_held;
    std::size_t m_own = 0; ///< incidents of this device's own sessions, as many as it lost
    bool m_standsBy = false;
    std::optional<IncidentId> m_mayEnd; ///< of the event in hand
    bool m_mayEndAny = false;
    bool m_flooded = false; ///< once is enough, and slow
};

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    FuzzInput input(data, size);
    World world;
    while (!input.isUsedUp())
        world.step(input);
    return 0;
}
