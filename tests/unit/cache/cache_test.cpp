// The seam between the threads: what arrives, what leaves, and what others may see.
#include "cache/link_board.hpp"
#include "cache/message_cache_access.hpp"
#include "cache/outbox.hpp"
#include "protocol/message_access.hpp"
#include "support/hex.hpp"
#include "support/sample_set.hpp"

#include <QTest>

#include <atomic>
#include <thread>

using namespace liena;
using namespace liena::cache;
using namespace liena::test;

namespace {

Outbox::Letters taken(Outbox& outbox)
{
    Outbox::Letters letters;
    outbox.take(letters);
    return letters;
}

constexpr DeviceId robot(0x00008208U);
constexpr DeviceId xray(0x20010208U);

} // namespace

class CacheTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase();
    void notifiesOncePerBurst();
    void mayBeDrainedByTheNotification();
    void givesEverythingInOrder();
    void drainsIntoWhatWasDrainedBefore();
    void keepsTheNewestByHistory();
    void keepsHistoriesOfOriginsApart();
    void keepsMessagesWithoutHistory();
    void isBoundedAndSaysSoOnce();
    void isBoundedInBytes();
    void eventsAreBounded();
    void outboxWakesOncePerBurst();
    void outboxThatWasEmptiedOutOfTurnWakesNobodyTwice();
    void outboxRefusesWhatDoesNotFit();
    void outboxTakesStopsAndCommandsWhateverWaits_data();
    void outboxTakesStopsAndCommandsWhateverWaits();
    void outboxKeepsTheOrder();
    void outboxWakesNobodyAfterItsEnd();
    void boardShowsTheNewest();
    void boardShowsIncidentsAndSets();
    void boardShowsWhetherAMessageMayBeSent();
    void takesFromOtherThreads();

private:
    Message make(std::string_view name, DeviceId origin, int value) const
    {
        auto message = sampleMessage(m_set, name);
        if (name == "State")
            message.set("count", value);
        else if (name == "Log")
            message.set("line", std::to_string(value));
        MessageAccess::setMeta(message, origin, robot, Timestamp{1});
        return message;
    }
    Message picture(std::size_t bytes) const
    {
        auto message = sampleMessage(m_set, "Picture");
        message.set("pixels", filled(bytes, 7));
        return message;
    }

    std::shared_ptr<const MessageSet> m_set;
};

void CacheTest::initTestCase() { m_set = sampleSet(); }

void CacheTest::notifiesOncePerBurst()
{
    MessageCache cache;
    int notified = 0;
    cache.setNotification([&] { ++notified; });
    MessageCacheAccess::put(cache, make("Log", xray, 1));
    MessageCacheAccess::put(cache, SessionEvent{});
    MessageCacheAccess::put(cache, make("Log", xray, 2));
    QCOMPARE(notified, 1);
    QCOMPARE(cache.drain().messages.size(), std::size_t{2});
    QCOMPARE(notified, 1);
    QVERIFY(cache.drain().messages.empty());
    MessageCacheAccess::put(cache, SessionEvent{});
    QCOMPARE(notified, 2);
}

void CacheTest::mayBeDrainedByTheNotification()
{
    MessageCache cache;
    std::size_t drained = 0;
    cache.setNotification([&] { drained += cache.drain().messages.size(); });
    for (int i = 0; i < 3; ++i)
        MessageCacheAccess::put(cache, make("Log", xray, i));
    QCOMPARE(drained, std::size_t{3});
}

void CacheTest::givesEverythingInOrder()
{
    MessageCache cache;
    for (int i = 0; i < 5; ++i) {
        MessageCacheAccess::put(cache, make("Log", xray, i));
        SessionEvent event;
        event.count = static_cast<std::uint64_t>(i);
        MessageCacheAccess::put(cache, event);
    }
    const auto drained = cache.drain();
    QCOMPARE(drained.messages.size(), std::size_t{5});
    QCOMPARE(drained.events.size(), std::size_t{5});
    for (std::size_t i = 0; i < 5; ++i) {
        QVERIFY(drained.messages[i].get<std::string_view>("line") == std::to_string(i));
        QCOMPARE(drained.events[i].count, std::uint64_t{i});
    }
}

void CacheTest::drainsIntoWhatWasDrainedBefore()
{
    MessageCache cache;
    MessageCache::Drained drained;
    for (int round = 0; round < 3; ++round) {
        for (int i = 0; i < 100; ++i)
            MessageCacheAccess::put(cache, make("Log", xray, 100 * round + i));
        MessageCacheAccess::put(cache, SessionEvent{});
        cache.drain(drained);
        QCOMPARE(drained.messages.size(), std::size_t{100});
        QCOMPARE(drained.events.size(), std::size_t{1});
        QVERIFY(drained.messages.front().get<std::string_view>("line") == std::to_string(100 * round));
    }
    cache.drain(drained);
    QVERIFY(drained.messages.empty() && drained.events.empty());
}

void CacheTest::keepsTheNewestByHistory()
{
    MessageCache cache;
    for (int i = 1; i <= 6; ++i)
        MessageCacheAccess::put(cache, make("State", xray, i)); // history 2
    const auto drained = cache.drain();
    QCOMPARE(drained.messages.size(), std::size_t{2});
    QCOMPARE(drained.messages[0].get<int>("count"), 5);
    QCOMPARE(drained.messages[1].get<int>("count"), 6);
    QCOMPARE(cache.superseded(), std::uint64_t{4});
}

void CacheTest::keepsHistoriesOfOriginsApart()
{
    MessageCache cache;
    for (int i = 1; i <= 3; ++i) {
        MessageCacheAccess::put(cache, make("State", xray, i));
        MessageCacheAccess::put(cache, make("State", robot, i));
    }
    QCOMPARE(cache.drain().messages.size(), std::size_t{4});
}

void CacheTest::keepsMessagesWithoutHistory()
{
    MessageCache cache;
    for (int i = 0; i < 100; ++i)
        MessageCacheAccess::put(cache, make("Log", xray, i));
    QCOMPARE(cache.drain().messages.size(), std::size_t{100});
}

void CacheTest::isBoundedAndSaysSoOnce()
{
    MessageCache cache;
    for (std::size_t round = 0; round < 2; ++round) {
        for (std::size_t i = 0; i < MessageCacheAccess::mostMessages + 10; ++i)
            MessageCacheAccess::put(cache, make("Log", xray, static_cast<int>(i)));
        const auto drained = cache.drain();
        QCOMPARE(drained.messages.size(), MessageCacheAccess::mostMessages);
        QVERIFY(drained.messages.front().get<std::string_view>("line") == "10");
        QCOMPARE(drained.events.size(), std::size_t{1});
        QVERIFY(drained.events[0].kind == SessionEvent::Kind::MessagesDropped);
        QVERIFY(drained.events[0].peer == xray && drained.events[0].message == "Log");
        QCOMPARE(drained.events[0].count, std::uint64_t{10});
    }
}

void CacheTest::isBoundedInBytes()
{
    MessageCache cache;
    std::size_t put = 0;
    const auto xml = std::string(sampleSetXml);
    auto loose = xml;
    const auto at = loose.find("history=\"1\" title=\"A picture\"");
    QVERIFY(at != std::string::npos);
    loose.erase(at, std::string("history=\"1\" ").size());
    const auto set = MessageSet::parse(loose, "loose.xml");
    QVERIFY(set);
    auto image = sampleMessage(set.value(), "Picture");
    image.set("pixels", filled(1000000, 7));
    QVERIFY(!image.fault());
    for (std::size_t i = 0; i < MessageCacheAccess::mostBytes / 1000000 + 20; ++i, ++put)
        MessageCacheAccess::put(cache, image);
    const auto drained = cache.drain();
    QVERIFY(drained.messages.size() < put);
    QVERIFY(drained.messages.size() * image.fieldBytes().size() <= MessageCacheAccess::mostBytes);
    QCOMPARE(drained.events.size(), std::size_t{1});
}

void CacheTest::eventsAreBounded()
{
    MessageCache cache;
    for (std::size_t i = 0; i < MessageCacheAccess::mostEvents + 10; ++i)
        MessageCacheAccess::put(cache, SessionEvent{});
    const auto drained = cache.drain();
    QCOMPARE(drained.events.size(), MessageCacheAccess::mostEvents + 1);
    QVERIFY(drained.events[0].kind == SessionEvent::Kind::MessagesDropped); // in the place of what went
    QCOMPARE(drained.events[0].count, std::uint64_t{10});
    QVERIFY(cache.drain().events.empty());
}

void CacheTest::outboxWakesOncePerBurst()
{
    int woken = 0;
    Outbox outbox([&] { ++woken; });
    QVERIFY(outbox.put(robot, make("Log", xray, 1)));
    QVERIFY(outbox.put(robot, make("Log", xray, 2)));
    QCOMPARE(woken, 1);
    QCOMPARE(taken(outbox).size(), std::size_t{2});
    QVERIFY(taken(outbox).empty());
    QVERIFY(outbox.put(robot, make("Log", xray, 3)));
    QCOMPARE(woken, 2);
}

/// Whoever was woken is on its way with memory that there is once.
void CacheTest::outboxThatWasEmptiedOutOfTurnWakesNobodyTwice()
{
    int woken = 0;
    Outbox outbox([&] { ++woken; });
    Outbox::Letters withdrawn;
    outbox.withdraw(withdrawn);
    QVERIFY(withdrawn.empty());
    QVERIFY(outbox.put(robot, make("Log", xray, 1)));
    outbox.withdraw(withdrawn);
    QCOMPARE(withdrawn.size(), std::size_t{1});
    QVERIFY(outbox.put(robot, make("Log", xray, 2)));
    QCOMPARE(woken, 1);
    QCOMPARE(taken(outbox).size(), std::size_t{1});
    QVERIFY(outbox.put(robot, make("Log", xray, 3)));
    QCOMPARE(woken, 2);
}

void CacheTest::outboxRefusesWhatDoesNotFit()
{
    Outbox outbox([] {});
    for (std::size_t i = 0; i < Outbox::mostLetters; ++i)
        QVERIFY(outbox.put(robot, make("Log", xray, 1)));
    QVERIFY(!outbox.put(robot, make("Log", xray, 1)));
    QCOMPARE(taken(outbox).size(), Outbox::mostLetters);
    const auto image = picture(1000000);
    std::size_t put = 0;
    while (outbox.put(robot, image))
        QVERIFY(++put <= Outbox::mostBytes / 1000000);
    QCOMPARE(put, Outbox::mostBytes / image.fieldBytes().size());
    taken(outbox);
    QVERIFY(outbox.put(robot, image));
}

void CacheTest::outboxTakesStopsAndCommandsWhateverWaits_data()
{
    QTest::addColumn<bool>("images");
    QTest::newRow("images of 64 MiB") << true;
    QTest::newRow("so many reports") << false;
}

void CacheTest::outboxTakesStopsAndCommandsWhateverWaits()
{
    QFETCH(const bool, images);
    Outbox outbox([] {});
    const auto other = images ? picture(1000000) : make("Log", xray, 1);
    while (outbox.put(robot, other))
        continue;
    std::size_t fitted = 0;
    for (const char* name : {"Stop", "Move", "Stop", "Move"})
        fitted += outbox.put(robot, sampleMessage(m_set, name)) ? 1 : 0;
    QCOMPARE(fitted, std::size_t{4});
    QVERIFY(!outbox.put(robot, other));
    // Each of them is bounded, too.
    while (outbox.put(robot, sampleMessage(m_set, "Move")))
        QVERIFY(++fitted <= Outbox::mostLetters + 2);
    QCOMPARE(fitted, Outbox::mostLetters + 2);
    QVERIFY(outbox.put(robot, sampleMessage(m_set, "Stop")));
}

void CacheTest::outboxKeepsTheOrder()
{
    Outbox outbox([] {});
    constexpr std::size_t many = 1000; // so that it has to grow
    for (std::size_t i = 0; i < many; ++i)
        outbox.put(i % 2 == 0 ? robot : DeviceId::broadcast(), make("Log", xray, static_cast<int>(i)));
    const auto letters = taken(outbox);
    QCOMPARE(letters.size(), many);
    for (std::size_t i = 0; i < many; ++i) {
        QCOMPARE(letters[i].target.isBroadcast(), i % 2 != 0);
        QVERIFY(letters[i].message.get<std::string_view>("line") == std::to_string(i));
    }
}

void CacheTest::outboxWakesNobodyAfterItsEnd()
{
    int woken = 0;
    Outbox outbox([&] { ++woken; });
    outbox.end();
    outbox.put(robot, make("Log", xray, 1));
    QCOMPARE(woken, 0);
    QCOMPARE(taken(outbox).size(), std::size_t{1});
}

void CacheTest::boardShowsTheNewest()
{
    LinkBoard board;
    QVERIFY(!board.link(robot));
    LinkStatus status;
    status.peer = robot;
    status.state = SessionState::Open;
    board.show(status);
    status.state = SessionState::Suspect;
    board.show(status);
    status.peer = xray;
    board.show(status);
    QCOMPARE(board.links().size(), std::size_t{2});
    QVERIFY(board.link(robot)->state == SessionState::Suspect);
}

void CacheTest::boardShowsIncidentsAndSets()
{
    LinkBoard board;
    QVERIFY(!board.standsBy());
    Incident incident;
    incident.id = 7;
    board.showIncidents({incident});
    QVERIFY(board.standsBy() && board.incidents().front().id == 7);
    QVERIFY(board.sendFacts(robot, robot).standsBy);
    board.showIncidents({});
    QVERIFY(!board.standsBy());
    QVERIFY(board.set(robot) == nullptr);
    board.showSet(robot, m_set);
    QVERIFY(board.set(robot) == m_set);
}

void CacheTest::boardShowsWhetherAMessageMayBeSent()
{
    LinkBoard board;
    auto facts = board.sendFacts(robot, xray);
    QVERIFY(facts.set == nullptr && facts.state == SessionState::Closed && !facts.standsBy);
    LinkStatus status;
    status.peer = robot;
    status.state = SessionState::Open;
    board.show(status);
    board.showSet(xray, m_set);
    facts = board.sendFacts(robot, xray);
    QVERIFY(facts.set == m_set && facts.state == SessionState::Open);
    facts = board.sendFacts(xray, robot);
    QVERIFY(facts.set == nullptr && facts.state == SessionState::Closed);
}

void CacheTest::takesFromOtherThreads()
{
    std::atomic<int> woken = 0;
    Outbox outbox([&] { ++woken; });
    constexpr int each = 500;
    const auto send = [&] {
        for (int i = 0; i < each; ++i)
            outbox.put(robot, make("Log", xray, i));
    };
    std::thread first(send);
    std::thread second(send);
    std::size_t count = 0;
    while (count < 2 * each)
        count += taken(outbox).size();
    first.join();
    second.join();
    QCOMPARE(count, std::size_t{2 * each});
    QVERIFY(woken >= 1 && woken <= 2 * each);
}

QTEST_APPLESS_MAIN(CacheTest)
#include "cache_test.moc"
