// Segments of several messages on two lanes with one small budget, held against a second telling of the rules; then messages cut anywhere.
#include "fuzz_input.hpp"
#include "fuzz_target.hpp"
#include "protocol/datagram_encoder.hpp"
#include "protocol/reassembler.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <optional>
#include <vector>

using namespace liena;
using namespace liena::protocol;
using namespace liena::fuzz;

namespace {

constexpr std::size_t budgetLimit = 300;
constexpr std::array<std::size_t, 4> maxima{5, 40, 200, 1000};

using Bytes = std::vector<std::byte>;

/// One lane by the page's words: nothing is reserved, everything is kept and counted.
struct LaneModel {
    struct Partial {
        std::uint64_t timestamp = 0;
        std::uint32_t target = 0;
        Bytes bytes;
        bool passedOver = false;
    };
    std::map<std::uint16_t, Partial> partials;
    std::uint64_t abandoned = 0;

    std::size_t held() const
    {
        return std::accumulate(partials.begin(), partials.end(), std::size_t{0},
                               [](std::size_t sum, const auto& p) { return sum + (p.second.passedOver ? 0 : p.second.bytes.size()); });
    }
    void drop(std::uint16_t number) { abandoned += partials.erase(number); }
};

enum class Kind { Incomplete, Whole, Assembled, OverBudget, Violation };

struct Expected {
    Kind kind = Kind::Incomplete;
    Bytes bytes;
    std::size_t passedOver = 0;
    bool first = false;
};

Expected expectedOf(LaneModel& lane, std::size_t heldElsewhere, const DatagramHeader& header, std::span<const std::byte> body,
                    std::size_t maximum)
{
    auto found = lane.partials.find(header.message.number);
    const bool fresh = found == lane.partials.end() || header.timestamp.ns > found->second.timestamp;
    const std::size_t before = fresh ? 0 : found->second.bytes.size();
    if (body.size() > maximum || (header.moreSegments && body.empty()))
        return {Kind::Violation, {}, 0, false};
    if (!fresh && (header.timestamp.ns < found->second.timestamp || header.target.value() != found->second.target || body.empty() ||
                   before + body.size() > maximum))
        return {Kind::Violation, {}, 0, false};
    if (fresh) {
        lane.drop(header.message.number);
        if (!header.moreSegments)
            return {Kind::Whole, {}, 0, false};
        found =
            lane.partials.emplace(header.message.number, LaneModel::Partial{header.timestamp.ns, header.target.value(), {}, false}).first;
    }
    auto& partial = found->second;
    const bool wasPassedOver = partial.passedOver;
    const std::size_t held = lane.held() + body.size();
    partial.passedOver = wasPassedOver || heldElsewhere + held > budgetLimit || held > budgetLimit - heldElsewhere - held;
    partial.bytes.insert(partial.bytes.end(), body.begin(), body.end());
    Expected expected;
    if (partial.passedOver)
        expected = {Kind::OverBudget, {}, wasPassedOver ? body.size() : partial.bytes.size(), !wasPassedOver};
    else if (!header.moreSegments)
        expected = {Kind::Assembled, partial.bytes, 0, false};
    if (!header.moreSegments)
        lane.partials.erase(found);
    return expected;
}

class Lanes {
public:
    void segment(FuzzInput& input)
    {
        const auto lane = input.below(2);
        const auto kind = input.below(maxima.size());
        const auto choice = input.number<std::uint8_t>();
        DatagramHeader header;
        header.message = {DeviceId(1), static_cast<std::uint16_t>(0x0200 + kind)};
        header.timestamp.ns = choice & 7U;
        header.target = DeviceId((choice & 8U) != 0 ? 2 : 3);
        header.moreSegments = (choice & 16U) != 0;
        Bytes body(input.number<std::uint8_t>());
        for (auto& byte : body)
            byte = static_cast<std::byte>(++m_pattern);
        header.length = static_cast<std::uint16_t>(body.size());
        compare(expectedOf(m_models[lane], m_models[1 - lane].held(), header, body, maxima[kind]),
                (choice & 32U) != 0 ? inPieces(m_lanes[lane], header, body, maxima[kind]) : m_lanes[lane].take(header, body, maxima[kind]));
    }

    /// As from a connection: judged before it comes, and most of it written where it will lie.
    static Reassembler::Outcome inPieces(Reassembler& lane, const DatagramHeader& header, std::span<const std::byte> body,
                                         std::size_t maximum)
    {
        auto outcome = lane.open(header, body.size(), maximum);
        if (std::holds_alternative<Reassembler::Whole>(outcome))
            return lane.take(header, body, maximum);
        if (!std::holds_alternative<Reassembler::Incomplete>(outcome))
            return outcome;
        lane.add(body.first(body.size() / 3));
        const auto rest = body.subspan(body.size() / 3);
        const auto place = lane.place(rest.size());
        expect(place.bytes.empty() || (place.bytes.size() == rest.size() && place.keeper), "a place is kept, and has the size asked for");
        for (std::size_t done = 0; done < rest.size();) {
            const auto step = std::min(rest.size() - done, rest.size() / 2 + 1); // a read brings less than there is room for
            auto piece = rest.subspan(done, step);
            if (!place.bytes.empty()) {
                std::copy(piece.begin(), piece.end(), place.bytes.begin() + static_cast<std::ptrdiff_t>(done));
                piece = place.bytes.subspan(done, step);
            }
            lane.add(piece);
            done += step;
        }
        return lane.close();
    }

    void abandon(FuzzInput& input)
    {
        const auto lane = input.below(2);
        const auto number = static_cast<std::uint16_t>(0x0200 + input.below(maxima.size()));
        const std::uint64_t timestamp = input.below(8);
        m_lanes[lane].abandon(number, {timestamp});
        const auto found = m_models[lane].partials.find(number);
        if (found != m_models[lane].partials.end() && found->second.timestamp == timestamp)
            m_models[lane].drop(number);
    }

    void close(FuzzInput& input)
    {
        const auto lane = input.below(2);
        m_lanes[lane].clear();
        m_models[lane].abandoned += m_models[lane].partials.size();
        m_models[lane].partials.clear();
    }

    void check() const
    {
        expect(m_budget.used() <= budgetLimit, "the budget is never exceeded");
        expect(m_budget.used() == m_models[0].held() + m_models[1].held(), "the budget knows what is held");
        for (std::size_t i = 0; i < 2; ++i) {
            expect(m_lanes[i].hasPartial() == !m_models[i].partials.empty(), "a lane knows whether it holds a partial");
            expect(m_lanes[i].abandoned() == m_models[i].abandoned, "what is given up is counted");
        }
    }

private:
    static void compare(const Expected& expected, const Reassembler::Outcome& outcome)
    {
        expect(std::holds_alternative<Reassembler::Violation>(outcome) == (expected.kind == Kind::Violation), "violations are the page's");
        expect(std::holds_alternative<Reassembler::Whole>(outcome) == (expected.kind == Kind::Whole), "whole messages are the page's");
        const auto* passed = std::get_if<Reassembler::OverBudget>(&outcome);
        expect((passed != nullptr) == (expected.kind == Kind::OverBudget), "too much is said with each segment");
        if (passed != nullptr)
            expect(passed->bytes == expected.passedOver && passed->first == expected.first, "what is passed over is counted once");
        const auto* assembled = std::get_if<Reassembler::Assembled>(&outcome);
        expect((assembled != nullptr) == (expected.kind == Kind::Assembled), "assembled messages are the page's");
        if (assembled != nullptr)
            expect(std::equal(assembled->bytes.begin(), assembled->bytes.end(), expected.bytes.begin(), expected.bytes.end()),
                   "an assembled message is its segments");
    }

    PartialBudget m_budget{budgetLimit};
    std::array<Reassembler, 2> m_lanes{Reassembler(m_budget), Reassembler(m_budget)};
    std::array<LaneModel, 2> m_models;
    unsigned m_pattern = 0;
};

/// A message that is cut anywhere comes out as it went in.
void cutAndJoin(FuzzInput& input)
{
    std::array<std::size_t, 4> cuts{};
    for (auto& cut : cuts)
        cut = 1 + input.below(256);
    const auto content = input.rest();
    const EncodedMessage message{{{DeviceId(1), 0x0200}, DeviceId(2), {7}, 0, false}, FieldBytes(content.begin(), content.end())};
    PartialBudget budget;
    Reassembler reassembler(budget);
    DatagramEncoder encoder;
    bool last = false;
    for (std::size_t i = 0; !last; ++i) {
        std::vector<std::byte> datagram;
        last = encoder.appendSegment(message, cuts[i % cuts.size()], datagram);
        const auto header = decodeHeader(std::span<const std::byte>(datagram).first<headerSize>());
        const auto body = std::span<const std::byte>(datagram).subspan(headerSize);
        expect(header.length == body.size() && header.moreSegments == !last, "a segment's header is its own");
        const auto outcome = reassembler.take(header, body, content.size());
        expect(!std::holds_alternative<Reassembler::Violation>(outcome), "what is cut here is no violation there");
        const auto* assembled = std::get_if<Reassembler::Assembled>(&outcome);
        const bool whole = std::holds_alternative<Reassembler::Whole>(outcome);
        expect(last == (assembled != nullptr || whole), "the last segment completes the message");
        if (assembled != nullptr)
            expect(assembled->bytes == message.part, "a message comes out as it went in");
    }
    expect(budget.used() == 0, "nothing is held in the end");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    FuzzInput input(data, size);
    if (input.flag()) {
        cutAndJoin(input);
        return 0;
    }
    Lanes lanes;
    while (!input.isUsedUp()) {
        const auto action = input.below(16);
        if (action == 0)
            lanes.abandon(input);
        else if (action == 1)
            lanes.close(input);
        else
            lanes.segment(input);
        lanes.check();
    }
    return 0;
}
