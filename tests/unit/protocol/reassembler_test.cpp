// The rules of partial messages: section 2 and rulings B6, A12.
#include "protocol/reassembler.hpp"
#include "support/hex.hpp"

#include <QTest>

using namespace liena;
using namespace liena::protocol;
using namespace liena::test;

namespace {

constexpr std::size_t plenty = 1U << 20U;

DatagramHeader segment(std::uint64_t timestamp, std::size_t length, bool more, std::uint16_t number = 0x0200,
                       DeviceId target = DeviceId(0x40018208U))
{
    return {{DeviceId(0x20010208U), number}, target, Timestamp{timestamp}, static_cast<std::uint16_t>(length), more};
}

struct Lane {
    PartialBudget own;
    Reassembler reassembler;

    Lane() : reassembler(own) {}
    explicit Lane(PartialBudget& shared) : reassembler(shared) {}

    Reassembler::Outcome take(std::uint64_t timestamp, const std::string& text, bool more, std::size_t maximum = plenty,
                              std::uint16_t number = 0x0200)
    {
        return reassembler.take(segment(timestamp, text.size(), more, number), bytesOfText(text), maximum);
    }
};

template <typename T>
bool is(const Reassembler::Outcome& outcome)
{
    return std::holds_alternative<T>(outcome);
}

bool passesOver(const Reassembler::Outcome& outcome, std::size_t bytes, bool first)
{
    const auto* passed = std::get_if<Reassembler::OverBudget>(&outcome);
    return passed != nullptr && passed->bytes == bytes && passed->first == first;
}

std::string textOf(const Reassembler::Outcome& outcome)
{
    const auto* assembled = std::get_if<Reassembler::Assembled>(&outcome);
    if (assembled == nullptr)
        return "(nothing assembled)";
    return {reinterpret_cast<const char*>(assembled->bytes.data()), assembled->bytes.size()};
}

} // namespace

class ReassemblerTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void takesSingleSegmentAsItIs();
    void takesEmptyMessage();
    void putsSegmentsTogether();
    void keepsMessagesOfOneLaneApart();
    void newerSegmentEndsThePartial();
    void newerWholeMessageEndsThePartial();
    void refusesOlderTimestamp();
    void refusesOlderWholeMessage();
    void refusesAnotherTarget();
    void refusesEmptySegmentBeforeTheLast_data();
    void refusesEmptySegmentBeforeTheLast();
    void refusesEmptyLastSegment();
    void refusesMoreThanTheDefinitionAllows_data();
    void refusesMoreThanTheDefinitionAllows();
    void takesExactlyTheMaximum();
    void countsMessageOverTheSharedBudget();
    void laneThatEndsNothingDoesNotKeepOthersOut();
    void recoversFromOverBudget();
    void messageOverBudgetStillHasItsMaximum();
    void givesTheBudgetBack();
    void abandonEndsOnlyItsMessage();
    void clearDropsEverything();
    void lanesEndsGiveTheirBudgetBack();
    void takesBodiesInPieces();
    void judgesABodyBeforeItsPieces();
    void abandonedBetweenPiecesStaysAbandoned();
    void expectsTheNextToBeAsLong();
    void shortMessageAfterALongOneKeepsNoLongBuffer();
    void whatLiesInItsPlaceIsNotCopied();
    void aPlaceOutlivesItsMessage();
};

void ReassemblerTest::takesSingleSegmentAsItIs()
{
    Lane lane;
    QVERIFY(is<Reassembler::Whole>(lane.take(1, "abc", false)));
    QVERIFY(!lane.reassembler.hasPartial());
    QCOMPARE(lane.own.used(), std::size_t{0});
}

void ReassemblerTest::takesEmptyMessage()
{
    Lane lane;
    QVERIFY(is<Reassembler::Whole>(lane.take(1, "", false)));
}

void ReassemblerTest::putsSegmentsTogether()
{
    Lane lane;
    QVERIFY(is<Reassembler::Incomplete>(lane.take(1, "a", true)));
    QVERIFY(is<Reassembler::Incomplete>(lane.take(1, "bcdef", true)));
    QVERIFY(lane.reassembler.hasPartial());
    QVERIFY(lane.own.used() >= 6);
    QCOMPARE(textOf(lane.take(1, "gh", false)), std::string("abcdefgh"));
    QVERIFY(!lane.reassembler.hasPartial());
    QCOMPARE(lane.own.used(), std::size_t{0});
    QCOMPARE(lane.reassembler.abandoned(), std::uint64_t{0});
}

void ReassemblerTest::keepsMessagesOfOneLaneApart()
{
    Lane lane;
    QVERIFY(is<Reassembler::Incomplete>(lane.take(5, "one-", true, plenty, 0x0200)));
    QVERIFY(is<Reassembler::Incomplete>(lane.take(3, "two-", true, plenty, 0x0201)));
    QVERIFY(is<Reassembler::Whole>(lane.take(1, "three", false, plenty, 0x0202)));
    QCOMPARE(textOf(lane.take(5, "end", false, plenty, 0x0200)), std::string("one-end"));
    QCOMPARE(textOf(lane.take(3, "end", false, plenty, 0x0201)), std::string("two-end"));
}

void ReassemblerTest::newerSegmentEndsThePartial()
{
    Lane lane;
    QVERIFY(is<Reassembler::Incomplete>(lane.take(1, "old", true)));
    QVERIFY(is<Reassembler::Incomplete>(lane.take(2, "new", true)));
    QCOMPARE(lane.reassembler.abandoned(), std::uint64_t{1});
    QCOMPARE(textOf(lane.take(2, "er", false)), std::string("newer"));
    QCOMPARE(lane.own.used(), std::size_t{0});
}

void ReassemblerTest::newerWholeMessageEndsThePartial()
{
    Lane lane;
    QVERIFY(is<Reassembler::Incomplete>(lane.take(1, "old", true)));
    QVERIFY(is<Reassembler::Whole>(lane.take(2, "new", false)));
    QCOMPARE(lane.reassembler.abandoned(), std::uint64_t{1});
    QVERIFY(!lane.reassembler.hasPartial());
    QCOMPARE(lane.own.used(), std::size_t{0});
}

void ReassemblerTest::refusesOlderTimestamp()
{
    Lane lane;
    QVERIFY(is<Reassembler::Incomplete>(lane.take(2, "a", true)));
    QVERIFY(is<Reassembler::Violation>(lane.take(1, "b", true)));
}

void ReassemblerTest::refusesOlderWholeMessage()
{
    Lane lane;
    QVERIFY(is<Reassembler::Incomplete>(lane.take(2, "a", true)));
    QVERIFY(is<Reassembler::Violation>(lane.take(1, "b", false)));
}

void ReassemblerTest::refusesAnotherTarget()
{
    Lane lane;
    QVERIFY(is<Reassembler::Incomplete>(lane.take(1, "a", true)));
    const auto other = segment(1, 1, false, 0x0200, DeviceId(0x60008208U));
    QVERIFY(is<Reassembler::Violation>(lane.reassembler.take(other, bytesOf("62"), plenty)));
}

void ReassemblerTest::refusesEmptySegmentBeforeTheLast_data()
{
    QTest::addColumn<bool>("first");
    QTest::newRow("first segment") << true;
    QTest::newRow("middle segment") << false;
}

void ReassemblerTest::refusesEmptySegmentBeforeTheLast()
{
    QFETCH(bool, first);
    Lane lane;
    if (!first)
        QVERIFY(is<Reassembler::Incomplete>(lane.take(1, "a", true)));
    QVERIFY(is<Reassembler::Violation>(lane.take(1, "", true)));
}

void ReassemblerTest::refusesEmptyLastSegment()
{
    Lane lane;
    QVERIFY(is<Reassembler::Incomplete>(lane.take(1, "a", true)));
    QVERIFY(is<Reassembler::Violation>(lane.take(1, "", false)));
}

void ReassemblerTest::refusesMoreThanTheDefinitionAllows_data()
{
    QTest::addColumn<int>("before");
    QTest::addColumn<bool>("more");
    QTest::newRow("in one segment") << 0 << false;
    QTest::newRow("in the first of several") << 0 << true;
    QTest::newRow("in a middle one") << 6 << true;
    QTest::newRow("in the last") << 6 << false;
}

void ReassemblerTest::refusesMoreThanTheDefinitionAllows()
{
    QFETCH(int, before);
    QFETCH(bool, more);
    Lane lane;
    if (before > 0)
        QVERIFY(is<Reassembler::Incomplete>(lane.take(1, std::string(static_cast<std::size_t>(before), 'a'), true, 10)));
    QVERIFY(is<Reassembler::Violation>(lane.take(1, std::string(static_cast<std::size_t>(11 - before), 'b'), more, 10)));
}

void ReassemblerTest::takesExactlyTheMaximum()
{
    Lane lane;
    QVERIFY(is<Reassembler::Whole>(lane.take(1, std::string(10, 'a'), false, 10)));
    QVERIFY(is<Reassembler::Incomplete>(lane.take(2, std::string(6, 'a'), true, 10)));
    QCOMPARE(textOf(lane.take(2, std::string(4, 'a'), false, 10)), std::string(10, 'a'));
}

void ReassemblerTest::countsMessageOverTheSharedBudget()
{
    PartialBudget budget(1500);
    Lane first(budget);
    Lane second(budget);
    QVERIFY(is<Reassembler::Incomplete>(first.take(1, std::string(700, 'a'), true)));
    QVERIFY(is<Reassembler::Incomplete>(second.take(1, std::string(40, 'b'), true)));
    QVERIFY(passesOver(second.take(1, std::string(700, 'b'), true), 740, true));
    QVERIFY(budget.used() <= 1500);
    QVERIFY(passesOver(second.take(1, std::string(11, 'b'), true), 11, false));
    QVERIFY(passesOver(second.take(1, std::string(10, 'b'), false), 10, false));
    QCOMPARE(textOf(first.take(1, "z", false)), std::string(700, 'a') + "z");
    QCOMPARE(budget.used(), std::size_t{0});
}

void ReassemblerTest::laneThatEndsNothingDoesNotKeepOthersOut()
{
    PartialBudget budget(1000);
    Lane greedy(budget);
    Lane other(budget);
    for (std::uint16_t number = 0x0200; number < 0x0220; ++number)
        (void)greedy.take(1, std::string(100, 'a'), true, plenty, number);
    QVERIFY(budget.used() <= 500);
    QVERIFY(is<Reassembler::Incomplete>(other.take(1, std::string(200, 'b'), true)));
    QCOMPARE(textOf(other.take(1, "!", false)), std::string(200, 'b') + "!");
    greedy.reassembler.clear();
    QVERIFY(is<Reassembler::Incomplete>(greedy.take(2, std::string(400, 'a'), true))); // what it held counts no more
}

/// A message that does not fit the budget must not go on for ever.
void ReassemblerTest::recoversFromOverBudget()
{
    PartialBudget budget(100);
    Lane lane(budget);
    QVERIFY(is<Reassembler::OverBudget>(lane.take(1, std::string(200, 'a'), true)));
    QVERIFY(is<Reassembler::Incomplete>(lane.take(2, "fits", true)));
    QCOMPARE(textOf(lane.take(2, "!", false)), std::string("fits!"));
    QCOMPARE(budget.used(), std::size_t{0});
}

void ReassemblerTest::messageOverBudgetStillHasItsMaximum()
{
    PartialBudget budget(100);
    Lane lane(budget);
    QVERIFY(is<Reassembler::OverBudget>(lane.take(1, std::string(200, 'a'), true, 300)));
    QVERIFY(is<Reassembler::OverBudget>(lane.take(1, std::string(100, 'a'), true, 300)));
    QVERIFY(is<Reassembler::Violation>(lane.take(1, "a", true, 300)));
}

void ReassemblerTest::givesTheBudgetBack()
{
    PartialBudget budget(140);
    for (std::uint64_t round = 1; round <= 50; ++round) {
        Lane lane(budget);
        QVERIFY(is<Reassembler::Incomplete>(lane.take(round, std::string(60, 'a'), true)));
        QVERIFY(is<Reassembler::Assembled>(lane.take(round, std::string(10, 'a'), false)));
        QCOMPARE(budget.used(), std::size_t{0});
    }
}

void ReassemblerTest::abandonEndsOnlyItsMessage()
{
    Lane lane;
    QVERIFY(is<Reassembler::Incomplete>(lane.take(7, "a", true)));
    lane.reassembler.abandon(0x0201, Timestamp{7});
    lane.reassembler.abandon(0x0200, Timestamp{6});
    QVERIFY(lane.reassembler.hasPartial());
    lane.reassembler.abandon(0x0200, Timestamp{7});
    QVERIFY(!lane.reassembler.hasPartial());
    QCOMPARE(lane.reassembler.abandoned(), std::uint64_t{1});
    QCOMPARE(lane.own.used(), std::size_t{0});
    QVERIFY(is<Reassembler::Whole>(lane.take(8, "next", false)));
}

void ReassemblerTest::clearDropsEverything()
{
    Lane lane;
    QVERIFY(is<Reassembler::Incomplete>(lane.take(1, "a", true, plenty, 0x0200)));
    QVERIFY(is<Reassembler::Incomplete>(lane.take(1, "b", true, plenty, 0x0201)));
    lane.reassembler.clear();
    QVERIFY(!lane.reassembler.hasPartial());
    QCOMPARE(lane.reassembler.abandoned(), std::uint64_t{2});
    QCOMPARE(lane.own.used(), std::size_t{0});
}

void ReassemblerTest::lanesEndsGiveTheirBudgetBack()
{
    PartialBudget budget(1000);
    {
        Lane lane(budget);
        QVERIFY(is<Reassembler::Incomplete>(lane.take(1, "abc", true)));
        QVERIFY(budget.used() > 0);
    }
    QCOMPARE(budget.used(), std::size_t{0});
}

void ReassemblerTest::takesBodiesInPieces()
{
    Lane lane;
    const auto open = [&](std::size_t length, bool more) { return lane.reassembler.open(segment(7, length, more), length, plenty); };
    QVERIFY(is<Reassembler::Incomplete>(open(5, true)));
    lane.reassembler.add(bytesOfText("ab"));
    lane.reassembler.add(bytesOfText("cde"));
    QVERIFY(is<Reassembler::Incomplete>(lane.reassembler.close()));
    QCOMPARE(lane.own.used(), std::size_t{5});
    QVERIFY(is<Reassembler::Incomplete>(open(3, false)));
    lane.reassembler.add(bytesOfText("fgh"));
    QCOMPARE(textOf(lane.reassembler.close()), std::string("abcdefgh"));
    QCOMPARE(lane.own.used(), std::size_t{0});
    QVERIFY(!lane.reassembler.hasPartial());
}

void ReassemblerTest::judgesABodyBeforeItsPieces()
{
    Lane lane;
    QVERIFY(is<Reassembler::Whole>(lane.reassembler.open(segment(1, 3, false), 3, plenty)));
    QVERIFY(is<Reassembler::Violation>(lane.reassembler.open(segment(1, 11, true), 11, 10)));
    QVERIFY(is<Reassembler::Incomplete>(lane.take(5, "abc", true)));
    QVERIFY(is<Reassembler::Violation>(lane.reassembler.open(segment(5, 8, true), 8, 10)));
    QVERIFY(is<Reassembler::Violation>(lane.reassembler.open(segment(4, 1, true), 1, 10)));
    QVERIFY(is<Reassembler::Incomplete>(lane.reassembler.close())); // nothing was opened
}

void ReassemblerTest::abandonedBetweenPiecesStaysAbandoned()
{
    Lane lane;
    QVERIFY(is<Reassembler::Incomplete>(lane.reassembler.open(segment(7, 5, true), 5, plenty)));
    lane.reassembler.add(bytesOfText("ab"));
    lane.reassembler.abandon(0x0200, Timestamp{7});
    lane.reassembler.add(bytesOfText("cde"));
    QVERIFY(is<Reassembler::Incomplete>(lane.reassembler.close()));
    QCOMPARE(lane.own.used(), std::size_t{0});
    QCOMPARE(lane.reassembler.abandoned(), std::uint64_t{1});
}

/// The buffer of an image is not made anew while it grows.
void ReassemblerTest::expectsTheNextToBeAsLong()
{
    Lane lane;
    const std::string half(30'000, 'x');
    for (std::uint64_t round = 1; round <= 3; ++round) {
        QVERIFY(is<Reassembler::Incomplete>(lane.take(round, half, true)));
        QCOMPARE(lane.own.kept(), round == 1 ? std::size_t{0} : 2 * half.size());
        const auto outcome = lane.take(round, half, false);
        QCOMPARE(textOf(outcome), half + half);
        QCOMPARE(lane.own.kept(), std::size_t{0});
    }
    QVERIFY(is<Reassembler::Incomplete>(lane.take(9, half, true)));
    lane.reassembler.clear(); // what was given up serves the next
    QVERIFY(lane.own.kept() >= 2 * half.size());
}

/// A peer would otherwise fill the memory with messages of a few bytes that are counted as such.
void ReassemblerTest::shortMessageAfterALongOneKeepsNoLongBuffer()
{
    constexpr std::size_t longest = std::size_t{4} << 20U;
    Lane lane;
    const std::string piece(30000, 'a');
    std::size_t sent = 0;
    while (sent + 2 * piece.size() < longest) {
        lane.take(1, piece, true, longest);
        sent += piece.size();
    }
    QVERIFY(is<Reassembler::Assembled>(lane.take(1, piece, false, longest)));
    for (std::uint64_t next = 2; next < 5; ++next) {
        lane.take(next, "short", true, longest);
        const auto outcome = lane.take(next, " one", false, longest);
        QCOMPARE(textOf(outcome), std::string("short one"));
        QVERIFY(std::get<Reassembler::Assembled>(outcome).bytes.capacity() < 65536);
    }
}

void ReassemblerTest::whatLiesInItsPlaceIsNotCopied()
{
    Lane lane;
    auto& reassembler = lane.reassembler;
    QVERIFY(reassembler.place(5).bytes.empty()); // nothing is open
    const std::string half(1000, 'h');
    for (const bool more : {true, false}) {
        QVERIFY(is<Reassembler::Incomplete>(reassembler.open(segment(1, half.size() + 3, more), half.size() + 3, plenty)));
        const auto place = reassembler.place(half.size());
        QCOMPARE(place.bytes.size(), half.size());
        std::copy_n(bytesOfText(half).begin(), half.size(), place.bytes.begin());
        reassembler.add(place.bytes.first(400)); // a read may bring less than there is place for
        QVERIFY(reassembler.place(600).bytes.data() == place.bytes.data() + 400);
        reassembler.add(place.bytes.subspan(400));
        reassembler.add(bytesOfText("end")); // from elsewhere
        const auto outcome = reassembler.close();
        if (!more)
            QCOMPARE(textOf(outcome), half + "end" + half + "end");
    }
    QCOMPARE(lane.own.used(), std::size_t{0});
}

/// AddressSanitizer sees it when it does not.
void ReassemblerTest::aPlaceOutlivesItsMessage()
{
    Lane lane;
    auto& reassembler = lane.reassembler;
    QVERIFY(is<Reassembler::Incomplete>(reassembler.open(segment(1, 60000, true), 60000, plenty)));
    const auto place = reassembler.place(60000);
    reassembler.abandon(0x0200, Timestamp{1}); // while a worker still reads into it
    QVERIFY(reassembler.place(10).bytes.empty());
    std::fill(place.bytes.begin(), place.bytes.end(), std::byte{'x'});
    reassembler.add(place.bytes);
    QVERIFY(is<Reassembler::Incomplete>(reassembler.close()));
    QCOMPARE(lane.own.used(), std::size_t{0});
    QCOMPARE(lane.own.kept(), std::size_t{0}); // nobody else gets that buffer meanwhile
}

QTEST_APPLESS_MAIN(ReassemblerTest)
#include "reassembler_test.moc"
