// What a device says of its links, and how `liena monitor` lays it out.
#include "json_value.hpp"
#include "monitor_page.hpp"

#include "system/status_line.hpp"

#include <QTest>

using namespace liena;
using namespace std::chrono_literals;

namespace {

const SystemTopology& pair()
{
    static const auto topology = SystemTopology::parse(R"(<topology xmlns="urn:liena:topology:1" name="pair" version="1">
  <device name="cockpit" id="0x40018208" message-set="siat-cockpit" host="10.0.0.1" port="52100"/>
  <device name="robot" id="0x00008208" message-set="vascular-robot" host="10.0.0.2" port="52100"/>
  <link between="cockpit robot"/>
</topology>)",
                                                       "t.xml")
                                     .value();
    return topology;
}

LinkStatus loaded()
{
    LinkStatus link;
    link.peer = pair().device("robot").value().id;
    link.state = SessionState::Open;
    link.bulkLanes = 3;
    link.bulkLanesIn = 2;
    link.bulkWorkers = 1;
    link.bulkRate = 12.5e6;
    link.bulkRateAge = std::chrono::milliseconds(300);
    link.bulkQueuedBytes = 4'200'000;
    link.messagesSuperseded = 7;
    return link;
}

std::string lineOf(const LinkStatus& link)
{
    cache::LinkBoard board;
    board.show(link);
    const auto self = pair().device("cockpit").value();
    return system::StatusLine(self, pair(), "test 1", board, nullptr).make(std::chrono::steady_clock::now(), {});
}

std::string pageOf(const LinkStatus& link) { return tools::monitorPage(tools::JsonValue::parse(lineOf(link)).value()); }

bool contains(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

} // namespace

class MonitorPageTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void lanesAndWorkersAreInTheLineAndOnThePage()
    {
        const auto links = tools::JsonValue::parse(lineOf(loaded())).value()["links"].items();
        QCOMPARE(links.size(), std::size_t(1));
        for (const auto& [name, expected] : {std::pair{"bulk_lanes", 3.0},
                                             {"bulk_lanes_in", 2.0},
                                             {"bulk_workers", 1.0},
                                             {"bulk_rate", 12.5e6},
                                             {"bulk_rate_age_s", 0.3},
                                             {"bulk_queued_bytes", 4.2e6},
                                             {"superseded", 7.0}})
            QVERIFY2(links[0][name].number() == expected, name);
        const auto page = pageOf(loaded());
        QVERIFY2(contains(page, "bulk: 3 lanes out, 2 in, 1 worker threads, the path carries 12.5 MB/s, 4.2 MB wait, "
                                "7 messages gave way to newer ones\n"),
                 page.c_str());
    }

    void whatAPathCarriedLongAgoIsSaidAsThat()
    {
        auto link = loaded();
        link.bulkRateAge = std::chrono::minutes(190);
        const auto page = pageOf(link);
        QVERIFY2(contains(page, "1 worker threads, the path carried 12.5 MB/s 190 min ago, 4.2 MB wait"), page.c_str());
    }

    void aPathThatIsNotKnownIsNotGuessed()
    {
        auto link = loaded();
        link.bulkRate.reset();
        QVERIFY(tools::JsonValue::parse(lineOf(link)).value()["links"].items()[0]["bulk_rate"].isNull());
        QVERIFY(!contains(pageOf(link), "the path carries"));
        QVERIFY(contains(pageOf(link), "3 lanes out, 2 in"));
    }

    void aLinkWithoutBulkSaysNothingOfIt()
    {
        LinkStatus link = loaded();
        link.bulkLanes = link.bulkLanesIn = 0;
        link.bulkRate.reset();
        const auto page = pageOf(link);
        QVERIFY2(!contains(page, "bulk:"), page.c_str());
        QVERIFY2(contains(page, "  robot         open"), page.c_str());
    }

    /// The socket may be answered by any program.
    void whatIsNoStatusIsAPageAllTheSame()
    {
        for (const char* text : {"null", "[]", "{}", R"({"links":[1,null,{"peer":7,"drops":[{}]}],"incidents":[3],"audit":5})"}) {
            const auto page = tools::monitorPage(tools::JsonValue::parse(text).value());
            QVERIFY2(contains(page, "LINK"), page.c_str());
        }
    }

    void aSilentDeviceIsNamedAndItsLinksAreNotShown()
    {
        const auto page = tools::silentPage(tools::JsonValue::parse(lineOf(loaded())).value(), "0x40018208", 7s);
        QVERIFY2(contains(page, "cockpit (0x40018208)  SAYS NOTHING for 7 s"), page.c_str());
        QVERIFY2(!contains(page, "open"), page.c_str());
        QVERIFY(tools::silentPage({}, "0x40018208", 7s).starts_with("0x40018208  SAYS NOTHING"));
    }

    void aDeviceThatHasGoneIsNamedAndItsLinksAreNotShown()
    {
        const auto page = tools::gonePage(tools::JsonValue::parse(lineOf(loaded())).value(), "0x40018208");
        QVERIFY2(page.starts_with("cockpit (0x40018208)  HAS GONE"), page.c_str());
        QVERIFY2(!contains(page, "open"), page.c_str());
        QVERIFY(tools::gonePage({}, "0x40018208").starts_with("0x40018208  HAS GONE"));
    }

    void namesOfPeersMoveNoCursor()
    {
        const auto page = tools::monitorPage(tools::JsonValue::parse("{\"links\":[{\"peer\":\"a\\u001b[2Jb\"}]}").value());
        QVERIFY2(!contains(page, "\x1b"), page.c_str());
    }
};

QTEST_APPLESS_MAIN(MonitorPageTest)
#include "monitor_page_test.moc"
