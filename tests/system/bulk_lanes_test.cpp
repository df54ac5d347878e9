// Several bulk streams of one device: lanes of their own while they are busy, order within each, and messages given up halfway.
#include "test_system.hpp"

#include <QDir>
#include <QFile>
#include <QTest>

#include <fcntl.h>
#include <netinet/in.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <map>
#include <span>

using namespace liena;
using namespace liena::test;
using Kind = SessionEvent::Kind;

namespace {

constexpr auto planner = R"(<message-set xmlns="urn:liena:message-set:1" name="planner" version="1.0" class="eye" manufacturer="9" type="1"
             device-version="1" vendor="Test" title="Two streams">
  <message number="0x0200" name="Volume" role="report" priority="bulk" title="One stream">
    <field name="number" type="uint32" title="Counts"/>
    <field name="voxels" type="bytes" max-length="16000000" title="Any"/>
  </message>
  <message number="0x0201" name="Mesh" role="report" priority="bulk" title="The other stream">
    <field name="number" type="uint32" title="Counts"/>
    <field name="points" type="bytes" max-length="16000000" title="Any"/>
  </message>
  <message number="0x0202" name="Snapshot" role="report" priority="bulk" lifespan="2ms" title="Old at once">
    <field name="pixels" type="bytes" max-length="16000000" title="Any"/>
  </message>
</message-set>
)";
constexpr auto viewer = R"(<message-set xmlns="urn:liena:message-set:1" name="viewer" version="1.0" class="brain" manufacturer="9" type="1"
             device-version="1" vendor="Test" title="Shows what comes"/>
)";
const DeviceSpec plannerDevice{"planner", "0x20048208", "planner"};
const DeviceSpec viewerDevice{"viewer", "0x40048208", "viewer"};

struct Pair {
    TestSystem system{{plannerDevice, viewerDevice}, {"planner viewer"}};
    DeviceId plannerId = system.idOf("planner");
    DeviceId viewerId = system.idOf("viewer");
    std::unique_ptr<TestDevice> sender;
    std::unique_ptr<TestDevice> receiver;

    PacketMarks marks;

    explicit Pair(const TestDevice::Setup& receiving = {}, PacketMarks chosen = {}) : marks(chosen)
    {
        sender = std::make_unique<TestDevice>(settingsOf("planner"));
        receiver = std::make_unique<TestDevice>(settingsOf("viewer"), receiving);
    }

    Settings settingsOf(const std::string& name)
    {
        const auto folder = system.folder() / "sets";
        QDir().mkpath(QString::fromStdString(folder.string()));
        for (const auto& [file, text] : {std::pair("planner.xml", planner), std::pair("viewer.xml", viewer)}) {
            QFile out(QString::fromStdString((folder / file).string()));
            if (!out.open(QIODevice::WriteOnly) || out.write(text) < 0)
                throw std::runtime_error("cannot write the message sets");
        }
        auto settings = system.settingsOf(name);
        settings.registry = {folder};
        settings.bulkWorkers = 2; // also where processors are few
        settings.marks = marks;
        settings.measuring.inUse.bulkBytesPerSecond = 0; // as much as the path carries
        settings.measuring.share = 1;
        return settings;
    }

    Result<void> send(const char* name, const char* field, std::uint32_t number, std::size_t size)
    {
        const std::vector<std::byte> bytes(size, static_cast<std::byte>(number));
        auto message = (*sender)->report(name).value();
        if (message.definition().indexOf("number"))
            message.set("number", number);
        message.set(field, std::span<const std::byte>(bytes));
        return (*sender)->send(viewerId, std::move(message));
    }

    LinkStatus sending() { return (*sender)->links().front(); }
    LinkStatus receiving() { return (*receiver)->links().front(); }
    std::string story() const { return sender->story() + receiver->story(); }
};

/// How many sockets of this process, which both devices are in, send with each DSCP: connections first, then UDP.
std::array<std::map<int, int>, 2> marksOfSockets()
{
    std::array<std::map<int, int>, 2> marks;
    for (const auto& name : QDir(QStringLiteral("/proc/self/fd")).entryList(QDir::NoDotAndDotDot | QDir::AllEntries | QDir::System)) {
        const int descriptor = name.toInt();
        const auto asked = [descriptor](int level, int option) {
            int value = -1;
            socklen_t size = sizeof value;
            return ::getsockopt(descriptor, level, option, &value, &size) == 0 ? value : -1;
        };
        const int tos = asked(IPPROTO_IP, IP_TOS);
        sockaddr_in peer{};
        socklen_t size = sizeof peer;
        const bool connected = ::getpeername(descriptor, reinterpret_cast<sockaddr*>(&peer), &size) == 0;
        if (tos < 0 || asked(SOL_SOCKET, SO_DOMAIN) != AF_INET)
            continue;
        if (asked(SOL_SOCKET, SO_TYPE) == SOCK_DGRAM)
            ++marks[1][tos >> 2];
        else if (connected)
            ++marks[0][tos >> 2];
    }
    return marks;
}

/// This process gets no further descriptor until the end of the scope.
class NoMoreDescriptors {
public:
    NoMoreDescriptors()
    {
        ::getrlimit(RLIMIT_NOFILE, &m_before);
        const int lowestFree = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
        ::close(lowestFree);
        auto limit = m_before;
        limit.rlim_cur = static_cast<rlim_t>(lowestFree);
        m_reached = lowestFree > 0 && ::setrlimit(RLIMIT_NOFILE, &limit) == 0;
    }
    ~NoMoreDescriptors() { ::setrlimit(RLIMIT_NOFILE, &m_before); }
    NoMoreDescriptors(const NoMoreDescriptors&) = delete;
    NoMoreDescriptors& operator=(const NoMoreDescriptors&) = delete;
    bool reached() const { return m_reached; }

private:
    rlimit m_before{};
    bool m_reached = false;
};

bool isInOrder(const std::vector<Message>& messages)
{
    for (std::size_t i = 0; i < messages.size(); ++i)
        if (messages[i].get<std::uint32_t>("number") != i + 1)
            return false;
    return true;
}

} // namespace

class BulkLanesTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void packetsAreMarkedForTheNetwork_data()
    {
        QTest::addColumn<int>("prompt");
        QTest::addColumn<int>("bulk");
        QTest::newRow("as they come") << 46 << 34;
        QTest::newRow("chosen") << 40 << 10;
        QTest::newRow("none") << 0 << 0;
    }
    void packetsAreMarkedForTheNetwork()
    {
        QFETCH(int, prompt);
        QFETCH(int, bulk);
        Pair pair({}, {static_cast<std::uint8_t>(prompt), static_cast<std::uint8_t>(bulk)});
        QVERIFY((*pair.sender)->openChannel(pair.viewerId));
        QTRY_VERIFY2(pair.receiver->heard(Kind::Opened), pair.story().c_str());
        QVERIFY(pair.send("Volume", "voxels", 1, 1'000'000));
        QTRY_COMPARE(pair.receiver->messages("Volume").size(), std::size_t{1});
        const auto [connections, packets] = marksOfSockets();
        std::map<int, int> expected;
        expected[prompt] += 4; // a lane 0 each way, and both ends of each are here
        expected[bulk] += 2;
        QCOMPARE(connections, expected);
        QCOMPARE(packets, (std::map<int, int>{{prompt, 2}}));
    }

    void streamsGetLanesOfTheirOwnAndKeepTheirOrder()
    {
        Pair pair;
        QVERIFY((*pair.sender)->openChannel(pair.viewerId));
        QTRY_VERIFY2(pair.receiver->heard(Kind::Opened), pair.story().c_str());
        QCOMPARE(pair.sending().bulkLanes, std::uint8_t{0}); // none before there is bulk
        constexpr std::uint32_t count = 12;
        for (std::uint32_t number = 1; number <= count; ++number) {
            QVERIFY(pair.send("Volume", "voxels", number, 1'000'000));
            QVERIFY(pair.send("Mesh", "points", number, 200'000));
        }
        QTRY_COMPARE(pair.sending().bulkLanes, std::uint8_t{2});
        QTRY_COMPARE_WITH_TIMEOUT(pair.receiver->messages("Volume").size(), std::size_t{count}, 20000);
        QTRY_COMPARE(pair.receiver->messages("Mesh").size(), std::size_t{count});
        QVERIFY(isInOrder(pair.receiver->messages("Volume")));
        QVERIFY(isInOrder(pair.receiver->messages("Mesh")));
        // Nothing uses the second any more; the first stays for the next burst.
        QTRY_COMPARE_WITH_TIMEOUT(pair.sending().bulkLanes, std::uint8_t{1}, 20000);
        QCOMPARE(words(pair.sending().state), words(SessionState::Open));
        QVERIFY2(!pair.receiver->heard(Kind::Interrupted) && !pair.receiver->heard(Kind::Lost), pair.story().c_str());
        QVERIFY(pair.send("Mesh", "points", count + 1, 10));
        QTRY_COMPARE(pair.receiver->messages("Mesh").size(), std::size_t{count + 1});
        QCOMPARE(pair.receiving().messagesAbandoned, std::uint64_t{0});
    }

    /// They wait behind others: with a lane of their own they would have half of the path.
    void imagesThatMeasureTakeNoLaneFromOthers()
    {
        Pair pair;
        QVERIFY((*pair.sender)->openChannel(pair.viewerId));
        QTRY_VERIFY2(pair.receiver->heard(Kind::Opened), pair.story().c_str());
        std::uint32_t number = 0;
        const auto stream = [&] { return pair.send("Volume", "voxels", ++number, 1'000'000); };
        QVERIFY(stream());
        QTRY_COMPARE(pair.receiver->messages("Volume").size(), std::size_t{1});
        std::atomic<bool> isOver = false;
        Measurement found;
        QVERIFY(
            (*pair.sender)
                ->measure(pair.viewerId, {{"images", std::chrono::seconds(1), {}, {}, {100, 0, 1'000'000}}}, [&](const Measurement& done) {
                    found = done;
                    isOver = true;
                }));
        std::uint8_t mostLanes = 0;
        std::size_t mostStreams = 0;
        QTRY_VERIFY_WITH_TIMEOUT((mostLanes = std::max(mostLanes, pair.sending().bulkLanes),
                                  mostStreams = std::max(mostStreams, pair.sending().bulkStreams.size()), (void)stream(), isOver.load()),
                                 20000);
        QVERIFY2(found.failure.empty(), found.failure.c_str());
        QVERIFY(found.imagesFlowed);
        QVERIFY(found.phases.at(0).images.echoed > 0);
        QCOMPARE(mostLanes, std::uint8_t{1});
        QCOMPARE(mostStreams, std::size_t{1}); // of which each has the path to itself
        QTRY_COMPARE_WITH_TIMEOUT(pair.receiver->messages("Volume").size(), std::size_t{number}, 20000);
    }

    void laneThatFoundNoDescriptorIsConnectedWhenThereIsOne()
    {
        Pair pair;
        QVERIFY((*pair.sender)->openChannel(pair.viewerId));
        QTRY_VERIFY2(pair.receiver->heard(Kind::Opened), pair.story().c_str());
        {
            const NoMoreDescriptors none;
            QVERIFY(none.reached());
            QVERIFY(pair.send("Volume", "voxels", 1, 1000));
            QTRY_VERIFY(pair.sending().bulkQueuedBytes > 0); // where it waits, its lane was to be connected
        }
        QTRY_COMPARE(pair.receiver->messages("Volume").size(), std::size_t{1});
        QVERIFY2(!pair.receiver->heard(Kind::Interrupted) && !pair.receiver->heard(Kind::Lost), pair.story().c_str());
    }

    void workersComeWithTheLoadAndGo()
    {
        std::atomic<std::uint32_t> arrived = 0;
        std::atomic<bool> inOrder = true;
        Pair pair([&](DistributedSystem& device) {
            (void)device.subscribe("Volume", [&](const Message& volume) {
                const auto bytes = volume.get<std::span<const std::byte>>("voxels");
                const auto number = volume.get<std::uint32_t>("number");
                if (number != ++arrived || bytes.size() != 2'000'000 || bytes.back() != static_cast<std::byte>(number))
                    inOrder = false;
            });
        });
        QVERIFY((*pair.sender)->openChannel(pair.viewerId));
        QTRY_VERIFY2(pair.receiver->heard(Kind::Opened), pair.story().c_str());
        QCOMPARE(pair.sending().bulkWorkers, std::uint8_t{0});
        std::uint32_t sent = 0;
        // A few a turn: where sending takes as long as arriving, filling up to a number on the way would never end.
        const auto refill = [&] {
            for (int i = 0; i < 12 && sent < arrived + 12 && pair.send("Volume", "voxels", sent + 1, 2'000'000); ++i)
                ++sent;
        };
        QTRY_VERIFY_WITH_TIMEOUT((refill(), pair.sending().bulkWorkers > 0), 60000);
        const auto before = sent;
        QTRY_VERIFY_WITH_TIMEOUT((refill(), arrived > before + 12), 60000); // with workers
        QTRY_COMPARE(pair.receiving().bulkLanesIn, std::uint8_t{1});
        QTRY_VERIFY_WITH_TIMEOUT(arrived == sent, 60000);
        QVERIFY(inOrder);
        QTRY_COMPARE_WITH_TIMEOUT(pair.sending().bulkWorkers, std::uint8_t{0}, 20000);
        QTRY_COMPARE_WITH_TIMEOUT(pair.receiving().bulkWorkers, std::uint8_t{0}, 20000);
        QVERIFY2(!pair.receiver->heard(Kind::Interrupted) && !pair.receiver->heard(Kind::Lost), pair.story().c_str());
    }

    void messageThatGrowsOldHalfwayIsAbandoned()
    {
        Pair pair;
        QVERIFY((*pair.sender)->openChannel(pair.viewerId));
        QTRY_VERIFY2(pair.receiver->heard(Kind::Opened), pair.story().c_str());
        QVERIFY(pair.send("Mesh", "points", 1, 10));
        QTRY_COMPARE(pair.receiver->messages("Mesh").size(), std::size_t{1});
        // 16 MB take longer than 2 ms; how far it gets depends on the computer.
        QTRY_VERIFY2_WITH_TIMEOUT((pair.send("Snapshot", "pixels", 7, 15'000'000).has_value() && pair.receiving().messagesAbandoned > 0),
                                  pair.story().c_str(), 20000);
        QTRY_VERIFY2(pair.sender->heard(Kind::SendFailed), pair.story().c_str());
        QVERIFY(pair.receiver->messages("Snapshot").empty());
        QVERIFY(pair.send("Mesh", "points", 2, 10));
        QTRY_COMPARE(pair.receiver->messages("Mesh").size(), std::size_t{2});
        QVERIFY2(!pair.receiver->heard(Kind::Lost), pair.story().c_str());
    }
};

QTEST_GUILESS_MAIN(BulkLanesTest)
#include "bulk_lanes_test.moc"
