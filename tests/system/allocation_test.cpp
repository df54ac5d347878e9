// The control path makes no request to the C++ heap and takes no lock, and a picture that is kept is not copied: what is asked for is
// counted while messages pass between two devices. What OpenSSL takes with malloc for its records is not counted.
#include "protocol/datagram.hpp"
#include "protocol/safety_record.hpp"
#include "support/counting_new.hpp"
#include "test_system.hpp"

#include <QDeadlineTimer>
#include <QDir>
#include <QFile>
#include <QTest>

#include <dlfcn.h>
#include <pthread.h>
#include <sys/socket.h>

#include <algorithm>
#include <atomic>
#include <latch>
#include <memory>
#include <mutex>
#include <span>
#include <thread>
#include <utility>
#include <vector>

namespace {

constexpr std::size_t pictureBytes = std::size_t{1} << 20U;

thread_local bool isNetworkThread = false;
thread_local bool watchesLocks = false;
thread_local bool watchesHeap = false;
std::atomic<bool> counting = false;
std::atomic<std::uint64_t> allocations = 0;        ///< by network threads, while it is counted
std::atomic<std::uint64_t> allocationsHere = 0;    ///< by threads that watch their own
std::atomic<std::uint64_t> pictureAllocations = 0; ///< of a picture's size, by any thread
std::atomic<std::uint64_t> locks = 0;
std::atomic<std::size_t> largestWrite = 0; ///< by network threads, while it is counted

} // namespace

void liena::test::heapAsked(std::size_t bytes)
{
    if (watchesHeap)
        ++allocationsHere;
    if (!counting)
        return;
    if (isNetworkThread)
        ++allocations;
    if (bytes >= pictureBytes)
        ++pictureAllocations;
}

/// In the C library's place, and then on to it.
extern "C" int pthread_mutex_lock(pthread_mutex_t* mutex) noexcept
{
    static const auto lock = reinterpret_cast<int (*)(pthread_mutex_t*)>(::dlsym(RTLD_NEXT, "pthread_mutex_lock"));
    if (watchesLocks)
        ++locks;
    return lock(mutex);
}

/// As above.
extern "C" ssize_t send(int socket, const void* bytes, std::size_t size, int flags)
{
    static const auto send = reinterpret_cast<decltype(&::send)>(::dlsym(RTLD_NEXT, "send"));
    if (isNetworkThread && counting)
        largestWrite = std::max(largestWrite.load(), size);
    return send(socket, bytes, size, flags);
}

using namespace liena;
using namespace liena::test;

namespace {

constexpr auto armSet =
    R"(<message-set xmlns="urn:liena:message-set:1" name="probe-arm" version="1.0" class="hand" manufacturer="9" type="1"
             device-version="1" vendor="Test" title="Takes commands">
  <message number="0x0101" name="Move" role="command" priority="control" title="By TCP">
    <field name="number" type="uint32" title="Counts"/>
    <field name="velocity" type="float32" min="-40" max="40" title="Any"/>
  </message>
  <message number="0x0102" name="Steer" role="command" priority="control" path="datagram" history="1" title="By UDP">
    <field name="number" type="uint32" title="Counts"/>
  </message>
  <message number="0x0201" name="State" role="report" priority="status" title="The other way">
    <field name="number" type="uint32" title="Counts"/>
    <field name="force" type="float32[6]" title="Any"/>
  </message>
  <message number="0x0202" name="Picture" role="report" priority="bulk" title="In many segments">
    <field name="number" type="uint32" title="Counts"/>
    <field name="pixels" type="bytes" max-length="4000000" title="Any"/>
  </message>
</message-set>
)";
constexpr auto deskSet = R"(<message-set xmlns="urn:liena:message-set:1" name="desk" version="1.0" class="brain" manufacturer="9" type="1"
             device-version="1" vendor="Test" title="Gives commands"/>
)";
const DeviceSpec arm{"arm", "0x00048208", "probe-arm"};
const DeviceSpec desk{"desk", "0x40048208", "desk"};

Settings settingsOf(TestSystem& system, const std::string& name)
{
    const auto folder = system.folder() / "sets";
    QDir().mkpath(QString::fromStdString(folder.string()));
    for (const auto& [file, text] : {std::pair("probe-arm.xml", armSet), std::pair("desk.xml", deskSet)}) {
        QFile out(QString::fromStdString((folder / file).string()));
        if (!out.open(QIODevice::WriteOnly) || out.write(text) < 0)
            throw std::runtime_error("cannot write the message sets");
    }
    auto settings = system.settingsOf(name);
    settings.registry = {folder};
    settings.log = [](const LogLine&) {};
    return settings;
}

/// What network threads ask of the heap for messages, beside what they ask for heartbeats, reports and figures of the link.
class CountedMessages {
public:
    CountedMessages(TestDevice& one, TestDevice& other) : m_one(one)
    {
        for (auto* device : {&one, &other})
            (*device)->post([] { isNetworkThread = true; });
    }

    /// Without messages.
    void hearTheQuiet()
    {
        constexpr std::uint64_t quietBeats = 40;
        const auto from = beats();
        allocations = 0;
        counting = true;
        QTRY_VERIFY_WITH_TIMEOUT(beats() >= from + quietBeats, 30000);
        counting = false;
        m_quiet = static_cast<double>(allocations.load()) / static_cast<double>(beats() - from);
    }

    void begin()
    {
        m_from = beats();
        allocations = 0;
        counting = true;
    }

    /// True when it was one for a hundred messages at most.
    bool end(std::uint32_t messages)
    {
        counting = false;
        const auto asked = static_cast<double>(allocations.load());
        const auto expected = m_quiet * static_cast<double>(beats() + 1 - m_from);
        qInfo("%.0f allocations beside %u messages, %.0f expected without them", asked, messages, expected);
        return asked < 1.25 * expected + messages / 100.0;
    }

private:
    std::uint64_t beats() const { return m_one->links().front().heartbeatsReceived; }

    TestDevice& m_one;
    double m_quiet = 0;
    std::uint64_t m_from = 0;
};

} // namespace

class AllocationTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void messagesPassWithoutAskingForMemory_data()
    {
        QTest::addColumn<QString>("message");
        QTest::addColumn<bool>("fromDesk");
        QTest::newRow("a command by TCP") << "Move" << true;
        QTest::newRow("a command by UDP") << "Steer" << true;
        QTest::newRow("a report") << "State" << false;
    }

    void messagesPassWithoutAskingForMemory()
    {
        QFETCH(QString, message);
        QFETCH(bool, fromDesk);
        const auto name = message.toStdString();
        constexpr std::uint32_t before = 200;
        constexpr std::uint32_t counted = 1000;
        TestSystem system({arm, desk}, {"arm desk"});
        const auto armId = system.idOf("arm");
        const auto deskId = system.idOf("desk");
        std::atomic<bool> sending = false;
        std::atomic<std::uint32_t> received = 0;
        const auto receive = [&](DistributedSystem& device) {
            if (!device.subscribe(name, [&](const Message& heard) { received = heard.get<std::uint32_t>(std::size_t{0}); }))
                throw std::runtime_error("cannot subscribe");
        };
        const auto send = [&](DistributedSystem& device) {
            device.every(std::chrono::milliseconds(1), [&, next = std::uint32_t{0}]() mutable {
                if (!sending)
                    return;
                auto made = fromDesk ? device.command(armId, name) : device.report(name);
                (void)device.send(fromDesk ? armId : deskId, std::move(made.value().set(std::size_t{0}, ++next)));
            });
        };
        TestDevice armDevice(settingsOf(system, "arm"), fromDesk ? TestDevice::Setup(receive) : TestDevice::Setup(send));
        TestDevice deskDevice(settingsOf(system, "desk"), fromDesk ? TestDevice::Setup(send) : TestDevice::Setup(receive));
        QVERIFY(deskDevice->openChannel(armId));
        QTRY_VERIFY(deskDevice.state(armId) == SessionState::Open && armDevice.state(deskId) == SessionState::Open);
        QTRY_VERIFY(deskDevice->links().front().packetsHeardByPeer > 0 && armDevice->links().front().packetsHeardByPeer > 0);
        CountedMessages count(deskDevice, armDevice);
        count.hearTheQuiet();
        sending = true;
        QTRY_VERIFY_WITH_TIMEOUT(received >= before, 30000);
        const auto first = received.load();
        count.begin();
        QTRY_VERIFY_WITH_TIMEOUT(received >= first + counted, 60000);
        QVERIFY(count.end(received - first));
    }

    /// From a thread of the application into the other application's cache, one after the other.
    void otherThreadsSendAndDrainWithoutAskingForMemory()
    {
        constexpr std::uint32_t before = 200;
        constexpr std::uint32_t counted = 1000;
        constexpr std::uint64_t fewLocks = 4; // the set, the state, the outbox, and Asio's own to wake the network thread
        TestSystem system({arm, desk}, {"arm desk"});
        const auto armId = system.idOf("arm");
        const auto deskId = system.idOf("desk");
        TestDevice armDevice(settingsOf(system, "arm"));
        TestDevice deskDevice(settingsOf(system, "desk"));
        QVERIFY(deskDevice->openChannel(armId));
        QTRY_VERIFY(deskDevice.state(armId) == SessionState::Open && armDevice.state(deskId) == SessionState::Open);
        QTRY_VERIFY(deskDevice->links().front().packetsHeardByPeer > 0 && armDevice->links().front().packetsHeardByPeer > 0);
        CountedMessages count(deskDevice, armDevice);
        count.hearTheQuiet();
        MessageCache::Drained drained;
        drained.events.reserve(16);
        locks = 0;
        for (std::uint32_t number = 1; number <= before + counted; ++number) {
            if (number == before + 1)
                count.begin();
            watchesHeap = watchesLocks = number > before;
            auto made = deskDevice->command(armId, "Move");
            const bool left = deskDevice->send(armId, std::move(made.value().set(std::size_t{0}, number))).has_value();
            watchesLocks = false;
            std::uint32_t heard = 0;
            for (const QDeadlineTimer limit(10000); heard != number && !limit.hasExpired();) {
                std::this_thread::yield();
                armDevice->cache().drain(drained);
                for (const auto& message : drained.messages)
                    heard = message.get<std::uint32_t>(std::size_t{0});
            }
            watchesHeap = false;
            QVERIFY(left);
            QCOMPARE(heard, number);
        }
        QVERIFY(count.end(counted));
        QCOMPARE(allocationsHere.load(), std::uint64_t{0});
        QVERIFY2(locks <= fewLocks * counted, qPrintable(QString::number(locks)));
    }

    void aBurstLeavesInOneWrite()
    {
        constexpr std::uint32_t burst = 50;
        TestSystem system({arm, desk}, {"arm desk"});
        const auto armId = system.idOf("arm");
        std::atomic<std::uint32_t> received = 0;
        TestDevice armDevice(settingsOf(system, "arm"), [&](DistributedSystem& device) {
            QVERIFY(device.subscribe("Move", [&](const Message& heard) { received = heard.get<std::uint32_t>(std::size_t{0}); }));
        });
        TestDevice deskDevice(settingsOf(system, "desk"));
        QVERIFY(deskDevice->openChannel(armId));
        QTRY_VERIFY(deskDevice.state(armId) == SessionState::Open);
        QTRY_VERIFY(deskDevice->links().front().packetsHeardByPeer > 0);
        std::latch allAreSent(1);
        deskDevice->post([&] {
            isNetworkThread = true;
            allAreSent.wait();
        });
        largestWrite = 0;
        counting = true;
        bool allAreTaken = true;
        for (std::uint32_t number = 1; number <= burst; ++number)
            allAreTaken &=
                deskDevice->send(armId, std::move(deskDevice->command(armId, "Move").value().set(std::size_t{0}, number))).has_value();
        allAreSent.count_down();
        QVERIFY(allAreTaken);
        QTRY_COMPARE(received.load(), burst);
        counting = false;
        constexpr auto one = protocol::headerSize + protocol::safetyRecordSize + 8; // and its two fields
        QVERIFY2(largestWrite >= burst * one, qPrintable(QString::number(largestWrite)));
    }

    void commandsLeaveTheNetworkThreadWithoutALock()
    {
        constexpr std::uint32_t enough = 100;
        TestSystem system({arm, desk}, {"arm desk"});
        const auto armId = system.idOf("arm");
        std::atomic<bool> sending = false;
        std::atomic<std::uint32_t> sent = 0;
        std::atomic<std::uint64_t> seenOnTheBoard = 0;
        locks = 0;
        TestDevice armDevice(settingsOf(system, "arm"));
        TestDevice deskDevice(settingsOf(system, "desk"), [&](DistributedSystem& device) {
            device.every(std::chrono::milliseconds(1), [&] {
                if (!sending || sent == enough)
                    return;
                watchesLocks = true;
                const bool left =
                    device.send(armId, std::move(device.command(armId, "Steer").value().set(std::size_t{0}, sent + 1))).has_value();
                watchesLocks = false;
                sent += left ? 1 : 0;
                const auto before = locks.load();
                watchesLocks = true;
                (void)device.links();
                watchesLocks = false;
                seenOnTheBoard += locks.exchange(before) - before;
            });
        });
        QVERIFY(deskDevice->openChannel(armId));
        QTRY_VERIFY(deskDevice.state(armId) == SessionState::Open);
        QTRY_VERIFY(deskDevice->links().front().packetsHeardByPeer > 0); // by TCP the socket's own lock would be counted
        sending = true;
        QTRY_VERIFY_WITH_TIMEOUT(sent == enough, 30000);
        QCOMPARE(locks.load(), std::uint64_t{0});
        QVERIFY(seenOnTheBoard >= enough); // it is counted, so it would have been
    }

    void aPictureThatIsKeptIsNotCopiedAndItsBufferIsUsedAgain()
    {
        constexpr std::uint32_t before = 6;
        constexpr std::uint32_t counted = 20;
        TestSystem system({arm, desk}, {"arm desk"});
        const auto armId = system.idOf("arm");
        const auto deskId = system.idOf("desk");
        const auto pixels = std::make_shared<const std::vector<std::byte>>(pictureBytes, std::byte{7});
        std::atomic<std::uint32_t> wanted = 0;
        std::atomic<const std::byte*> lookedAt = nullptr;
        std::mutex mutex;
        std::shared_ptr<const Message> newest;
        TestDevice armDevice(settingsOf(system, "arm"), [&](DistributedSystem& device) {
            device.every(std::chrono::milliseconds(1), [&, next = std::uint32_t{0}]() mutable {
                if (next == wanted)
                    return;
                auto made = device.report("Picture");
                made.value().set(std::size_t{0}, ++next).lend(std::size_t{1}, pixels, *pixels);
                (void)device.send(deskId, std::move(made.value()));
            });
        });
        TestDevice deskDevice(settingsOf(system, "desk"), [&](DistributedSystem& device) {
            const auto keep = [&](std::shared_ptr<const Message> message) {
                const std::lock_guard lock(mutex);
                newest = std::move(message);
            };
            QVERIFY(device.subscribe("Picture", [&](const Message& message) { lookedAt = message.fieldBytes().data(); }));
            QVERIFY(device.subscribeToKeep("Picture", keep));
            QVERIFY(!device.subscribeToKeep("Picture", keep)); // whose would it be?
            QVERIFY(!device.subscribeToKeep("Nothing", keep));
        });
        const auto taken = [&] {
            const std::lock_guard lock(mutex);
            return std::exchange(newest, nullptr);
        };
        QVERIFY(deskDevice->openChannel(armId));
        QTRY_VERIFY(deskDevice.state(armId) == SessionState::Open && armDevice.state(deskId) == SessionState::Open);
        for (std::uint32_t number = 1; number <= before + counted; ++number) {
            if (number > before)
                counting = true;
            wanted = number;
            std::shared_ptr<const Message> picture;
            QTRY_VERIFY_WITH_TIMEOUT(picture || (picture = taken()), 10000); // it is asked more than once
            QCOMPARE(picture->get<std::uint32_t>(std::size_t{0}), number);
            QVERIFY(picture->fieldBytes().data() == lookedAt);
            QVERIFY(std::ranges::equal(picture->get<std::span<const std::byte>>(std::size_t{1}), *pixels));
        } // this thread lets go of it
        counting = false;
        QVERIFY2(pictureAllocations < counted / 4, qPrintable(QString::number(pictureAllocations)));
    }

    void aPictureMayBeKeptLongerThanTheSystem()
    {
        TestSystem system({arm, desk}, {"arm desk"});
        const auto deskId = system.idOf("desk");
        std::atomic<bool> heard = false;
        std::shared_ptr<const Message> kept;
        {
            TestDevice armDevice(settingsOf(system, "arm"));
            TestDevice deskDevice(settingsOf(system, "desk"), [&](DistributedSystem& device) {
                QVERIFY(device.subscribeToKeep("Picture", [&](std::shared_ptr<const Message> message) {
                    kept = std::move(message);
                    heard = true;
                }));
            });
            QVERIFY(deskDevice->openChannel(system.idOf("arm")));
            QTRY_VERIFY(armDevice.state(deskId) == SessionState::Open);
            const std::vector<std::byte> pixels(pictureBytes, std::byte{7});
            auto picture = armDevice->report("Picture");
            picture.value().set("pixels", std::span<const std::byte>(pixels));
            QVERIFY(armDevice->send(deskId, std::move(picture.value())));
            QTRY_VERIFY(heard);
        }
        QCOMPARE(kept->get<std::span<const std::byte>>("pixels").size(), pictureBytes);
    }
};

QTEST_GUILESS_MAIN(AllocationTest)
#include "allocation_test.moc"
