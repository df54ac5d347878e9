// Control messages and heartbeats over a line that delays, repeats, reorders and damages: what is delivered is fresh, new and whole.
#include "fuzz_input.hpp"
#include "fuzz_target.hpp"
#include "session/control_guard.hpp"

#include <array>
#include <deque>
#include <set>
#include <vector>

using namespace liena;
using namespace liena::protocol;
using namespace liena::session;
using namespace liena::fuzz;
using namespace std::chrono_literals;

namespace {

constexpr auto maxAge = 50ms;

struct Heartbeat {
    std::uint32_t epoch = 0;
    std::uint32_t sequence = 0;
    Instant sent;
};

struct Command {
    DatagramHeader header;
    SafetyRecord record;
    std::vector<std::byte> fields;
    Heartbeat echoed;              ///< the newest that its sender had heard
    std::uint32_t life = 0;        ///< of the epoch and session in which it was composed
    std::size_t order = 0;         ///< of the sending
    std::set<std::size_t> flipped; ///< bits
};

class World {
public:
    void step(FuzzInput& input)
    {
        switch (input.below(9)) {
        case 0:
            return pass(input);
        case 1:
            return beat();
        case 2:
            return hear();
        case 3:
        case 4:
            return send(input);
        case 5:
        case 6:
            return deliver(input);
        case 7:
            return damage(input);
        default:
            return end(input);
        }
    }

private:
    void pass(FuzzInput& input) { m_now += std::chrono::microseconds(200) * input.number<std::uint8_t>(); }

    void beat()
    {
        const Heartbeat heartbeat{m_guard.epoch(), ++m_sequence, m_now};
        m_guard.sentHeartbeat(heartbeat.sequence, m_now);
        m_heartbeats.push_back(heartbeat);
    }

    void hear()
    {
        if (m_heartbeats.empty())
            return;
        m_newest = m_heartbeats.front();
        m_heartbeats.pop_front();
        m_stamper.heardHeartbeat(m_newest.epoch, m_newest.sequence);
        expect(m_stamper.ready(), "a heartbeat makes the sender ready");
    }

    void send(FuzzInput& input)
    {
        if (!m_stamper.ready() || m_line.size() >= 64)
            return;
        Command command;
        command.header.message = {DeviceId(0x40018208U), static_cast<std::uint16_t>(0x0100 + input.below(2))};
        command.header.target = DeviceId(0x00008208U);
        command.header.timestamp.ns = ++m_stamp;
        const auto fields = input.take(input.below(40));
        command.fields.assign(fields.begin(), fields.end());
        command.header.length = static_cast<std::uint16_t>(safetyRecordSize + fields.size());
        command.record = *m_stamper.next(command.header, command.fields);
        command.echoed = m_newest;
        command.life = m_newest.epoch == m_guard.epoch() ? m_life : 0;
        command.order = ++m_order;
        const auto bytes = encodeSafetyRecord(command.record);
        expect(decodeSafetyRecord(bytes) == command.record, "a record is read as it was written");
        m_line.push_back(command);
    }

    /// Any message on the line, and it stays there: it may come again.
    void deliver(FuzzInput& input)
    {
        if (m_line.empty())
            return;
        const auto& command = m_line[input.below(m_line.size())];
        const auto fault = m_guard.judge(command.header, command.record, command.fields, maxAge, m_now);
        if (fault == ControlFault::None)
            accepted(command);
        else
            refused(fault);
        if (!command.flipped.empty())
            expect(fault == ControlFault::Crc, "a message with up to five flipped bits is never delivered");
    }

    void accepted(const Command& command)
    {
        expect(command.life == m_life, "nothing from before the epoch rose or of another session is delivered");
        expect(m_now - command.echoed.sent <= maxAge, "nothing older than its max-age is delivered");
        auto& last = m_lastOrder[command.header.message.number & 1U];
        expect(command.order > last, "nothing is delivered twice or out of order");
        last = command.order;
    }

    void refused(ControlFault fault)
    {
        remember(m_refusals);
        if (fault == ControlFault::Crc)
            remember(m_damaged);
        if (m_guard.isExceeded(m_now))
            expect(m_refusals.size() > 10, "ten refusals in a second are borne");
        if (fault == ControlFault::Crc && m_damaged.size() > 10)
            expect(m_guard.isExceeded(m_now), "more than ten damaged messages in a second are not");
    }

    /// The moments of the last second.
    void remember(std::deque<Instant>& moments)
    {
        moments.push_back(m_now);
        while (m_now - moments.front() > 1s)
            moments.pop_front();
    }

    /// Flips one bit of a message on the line; five at most in all, which CRC-32C always sees at this length.
    void damage(FuzzInput& input)
    {
        if (m_line.empty())
            return;
        auto& command = m_line[input.below(m_line.size())];
        const auto bit = input.number<std::uint8_t>();
        if (command.flipped.size() < 5 && !command.flipped.contains(bit) && flip(command, bit))
            command.flipped.insert(bit);
    }

    /// False when the message has no such bit.
    static bool flip(Command& command, std::size_t bit)
    {
        if (bit < 64)
            command.header.timestamp.ns ^= std::uint64_t{1} << bit;
        else if (bit < 96)
            command.record.epoch ^= 1U << (bit - 64);
        else if (bit < 128)
            command.record.sequence ^= 1U << (bit - 96);
        else if (bit < 160)
            command.record.echo ^= 1U << (bit - 128);
        else if (bit < 192)
            command.record.crc ^= 1U << (bit - 160);
        else if (const auto at = (bit - 192) / 8; at < command.fields.size())
            command.fields[at] ^= static_cast<std::byte>(1U << (bit % 8));
        else
            return false;
        return true;
    }

    void end(FuzzInput& input)
    {
        const auto before = m_guard.epoch();
        m_guard.raiseEpoch(m_now);
        ++m_life;
        expect(m_guard.epoch() > before, "the epoch rises");
        if (!input.flag())
            return;
        m_guard.reset(); // a new session: connections and heartbeats of the old one are gone
        m_stamper.reset();
        m_heartbeats.clear();
        m_newest = {};
        m_sequence = 0;
        m_refusals.clear();
        m_damaged.clear();
        expect(!m_stamper.ready(), "a new session has heard nothing");
        expect(m_guard.epoch() > before, "the epoch outlives the session");
    }

    Instant m_now{1h};
    ControlGuard m_guard{LinkTiming()};
    ControlStamper m_stamper;
    std::deque<Heartbeat> m_heartbeats; ///< on their way
    Heartbeat m_newest;
    std::vector<Command> m_line;
    std::array<std::size_t, 2> m_lastOrder{};
    std::deque<Instant> m_refusals;
    std::deque<Instant> m_damaged;
    std::uint32_t m_sequence = 0;
    std::uint32_t m_life = 1;
    std::uint64_t m_stamp = 0;
    std::size_t m_order = 0;
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
