// Every rule of protocol section 5 and its rulings for topologies: what is read, and what is refused where.
#include "marked_text.hpp"

#include "liena/system_topology.hpp"

using namespace liena;
using namespace liena::test;

namespace {

const QByteArray cockpit = "<device name=\"cockpit\" id=\"0x40018208\" message-set=\"siat-cockpit\" host=\"10.0.0.1\" port=\"52100\"/>\n";
const QByteArray robot = "<device name=\"robot\" id=\"0x00008208\" message-set=\"vascular-robot\" host=\"10.0.0.2\" port=\"52100\"/>\n";
const QByteArray joined = "<link between=\"cockpit robot\"/>\n";

QByteArray inTopology(const QByteArray& content)
{
    return "<topology xmlns=\"urn:liena:topology:1\" name=\"probe\" version=\"1\">\n" + content + "</topology>\n";
}

QByteArray pair(const QByteArray& rest) { return inTopology(cockpit + robot + rest); }
QByteArray withRobot(const char* from, const char* to) { return inTopology(cockpit + QByteArray(robot).replace(from, to) + joined); }

SystemTopology parsed(const QByteArray& xml)
{
    Findings findings;
    auto topology = SystemTopology::parse(xml.toStdString(), "t.xml", &findings);
    if (!topology)
        qFatal("%s", listed(findings).c_str());
    return std::move(topology).value();
}

} // namespace

class TopologyReaderTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void refusesWrongTopology_data();
    void refusesWrongTopology();
    void refusesWrongTiming_data();
    void refusesWrongTiming();
    void acceptsHosts_data();
    void acceptsHosts();
    void refusesHosts_data();
    void refusesHosts();
    void warns_data();
    void warns();
    void fillsInWhatIsLeftOut();
    void readsTheShortestTiming();
    void readsTimingOfLinks();
    void readsFlows();
    void ordersEndsOfLinks();
    void acceptsChildrenInAnyOrder();
    void findsDevicesAndLinks();
    void namesNearestDevice();
    void hashesTheBytes();

private:
    void refuses() const;
};

void TopologyReaderTest::refuses() const
{
    QFETCH(QByteArray, xml);
    QFETCH(QByteArray, fragment);
    const auto input = unmarked(xml.toStdString());
    QVERIFY2(input.line > 0, "the row has no mark");
    Findings findings;
    const auto topology = SystemTopology::parse(input.text, "t.xml", &findings);
    QVERIFY(!topology);
    QVERIFY(topology.error().code == Errc::TopologyInvalid);
    QVERIFY2(holds(findings, Severity::Error, input, fragment.toStdString()), listed(findings).c_str());
    QVERIFY2(findings.size() == 1, listed(findings).c_str());
}

void TopologyReaderTest::refusesWrongTopology_data()
{
    QTest::addColumn<QByteArray>("xml");
    QTest::addColumn<QByteArray>("fragment");
    const auto row = [](const char* name, QByteArray xml, const char* fragment) { QTest::newRow(name) << xml << QByteArray(fragment); };
    row("message set", "@@<message-set xmlns=\"urn:liena:message-set:1\"/>", "'message-set'");
    row("other namespace", "<topology xmlns=\"@@urn:liena:topology\" name=\"a\" version=\"1\"/>", "urn:liena:topology:1");
    row("no device", "@@<topology xmlns=\"urn:liena:topology:1\" name=\"a\" version=\"1\"/>", "no device");
    row("no name", pair(joined).replace("<topology", "@@<topology").replace(" name=\"probe\"", ""), "'name'");
    row("no version", pair(joined).replace("<topology", "@@<topology").replace(" version=\"1\"", ""), "'version'");
    row("misspelt element", pair(joined + "@@<devise/>"), "did you mean 'device'?");
    row("unknown attribute", pair("<link between=\"cockpit robot\" @@beetween=\"\"/>"), "did you mean 'between'?");
    row("text", pair(joined + "@@hello"), "text inside <topology>");
    row("two timings", pair("<timing/>@@<timing/>" + joined), "second <timing>");
    row("two securities", pair("<security mode=\"tls\"/>@@<security mode=\"tls\"/>" + joined), "second <security>");
    row("security without mode", pair("@@<security/>" + joined), "'mode'");
    row("unknown mode", pair("<security mode=\"@@ssl\"/>" + joined), "tls or none");
    row("device without id", inTopology(cockpit + "@@" + QByteArray(robot).replace(" id=\"0x00008208\"", "")), "'id'");
    row("id without 0x", withRobot("0x00008208", "@@0000008208").replace(joined, ""), "eight hex digits");
    row("short id", withRobot("0x00008208", "@@0x8208").replace(joined, ""), "eight hex digits");
    row("reserved index", withRobot("0x00008208", "@@0x0000820f"), "index 0 to 6");
    row("reserved class", withRobot("0x00008208", "@@0x80008208"), "hand, eye");
    row("broadcast", withRobot("0x00008208", "@@0xFFFFFFFF"), "no device can have");
    row("id twice", withRobot("0x00008208", "@@0x40018208").replace(joined, ""), "in line 2");
    row("name twice", withRobot("\"robot\"", "\"@@cockpit\"").replace(joined, ""), "in line 2");
    row("name with a space", withRobot("\"robot\"", "\"@@my robot\"").replace(joined, ""), "no name");
    row("set's name", withRobot("\"vascular-robot\"", "\"@@vascular/robot\""), "no name");
    row("no set", inTopology(cockpit + "@@" + QByteArray(robot).replace(" message-set=\"vascular-robot\"", "")), "'message-set'");
    row("no host", inTopology(cockpit + "@@" + QByteArray(robot).replace(" host=\"10.0.0.2\"", "")), "'host'");
    row("no port", inTopology(cockpit + "@@" + QByteArray(robot).replace(" port=\"52100\"", "")), "'port'");
    row("port 0", withRobot("52100", "@@0"), "1 to 65535");
    row("port 65536", withRobot("52100", "@@65536"), "1 to 65535");
    row("endpoint twice", withRobot("10.0.0.2", "@@10.0.0.1"), "in line 2");
    row("endpoint twice, in other letters",
        inTopology(QByteArray(cockpit).replace("10.0.0.1", "Theatre.local") + QByteArray(robot).replace("10.0.0.2", "@@theatre.LOCAL")),
        "in line 2");
    row("endpoint twice, in other digits",
        inTopology(QByteArray(cockpit).replace("10.0.0.1", "fe80::1") + QByteArray(robot).replace("10.0.0.2", "@@FE80:0:0:0:0:0:0:1")),
        "in line 2");
    row("link without ends", pair("@@<link/>"), "'between'");
    row("link with one end", pair("<link between=\"@@cockpit\"/>"), "both ends");
    row("link with three ends", pair("<link between=\"@@cockpit robot arm\"/>"), "both ends");
    row("link with a comma", pair("<link between=\"@@cockpit,robot\"/>"), "both ends");
    row("link to a stranger", pair("<link between=\"@@cockpit robbot\"/>"), "did you mean 'robot'?");
    row("link to itself", pair("<link between=\"@@robot robot\"/>"), "linked to itself");
    row("link twice", pair(joined + "<link between=\"@@robot cockpit\"/>"), "in line 4");
    row("flow from a stranger", pair("<link between=\"cockpit robot\"><flow message=\"A\" from=\"@@arm\"/></link>"), "no end of this link");
    row("flow from a third",
        inTopology(cockpit + robot + QByteArray(robot).replace("robot\"", "arm\"").replace("8208", "8209").replace("0.2", "0.3") +
                   "<link between=\"arm robot\"/><link between=\"cockpit robot\"><flow message=\"A\" from=\"@@arm\"/></link>"),
        "no end of this link");
    row("flow without message", pair("<link between=\"cockpit robot\">@@<flow from=\"robot\"/></link>"), "'message'");
    row("flow without from", pair("<link between=\"cockpit robot\">@@<flow message=\"A\"/></link>"), "'from'");
    row("flow twice",
        pair("<link between=\"cockpit robot\"><flow message=\"A\" from=\"robot\"/><flow message=\"@@A\" from=\"robot\"/></link>"),
        "in line 4");
}

void TopologyReaderTest::refusesWrongTopology() { refuses(); }

void TopologyReaderTest::refusesWrongTiming_data()
{
    QTest::addColumn<QByteArray>("xml");
    QTest::addColumn<QByteArray>("fragment");
    const auto row = [](const char* name, const char* attributes, const char* fragment) {
        QTest::newRow(name) << pair(QByteArray("<timing ") + attributes + "/>\n" + joined) << QByteArray(fragment);
    };
    row("suspect below 2 heartbeats", "heartbeat=\"20ms\" suspect=\"@@39ms\"", "suspect 39ms is less than 2 heartbeats of 20ms");
    row("lost below 3 heartbeats", "heartbeat=\"20ms\" suspect=\"40ms\" lost=\"@@59ms\"", "less than 3 heartbeats");
    row("heartbeat too long for the default", "heartbeat=\"@@36ms\"", "suspect 70ms is less than 2 heartbeats of 36ms");
    row("suspect as long as lost", "suspect=\"@@110ms\"", "not shorter than lost");
    row("lost as long as reconnect", "lost=\"@@500ms\"", "not shorter than reconnect");
    row("reconnect too short", "reconnect=\"@@100ms\"", "lost 110ms is not shorter than reconnect 100ms");
    row("heartbeats for which no computer has time", "heartbeat=\"@@20us\"", "heartbeat 20us is less than 1ms");
    row("heartbeat just too short", "heartbeat=\"@@999us\"", "heartbeat 999us is less than 1ms");
    row("lost before anything can be heard", "heartbeat=\"1ms\" suspect=\"2ms\" lost=\"@@3ms\" reconnect=\"10ms\"",
        "lost 3ms is less than 10ms");
    row("lost just too short", "heartbeat=\"1ms\" suspect=\"5ms\" lost=\"@@9999us\"", "lost 9999us is less than 10ms");
    row("no unit", "heartbeat=\"@@20\"", "no duration");
    row("nothing", "heartbeat=\"@@0s\"", "no duration");
    row("unknown attribute", "@@heart-beat=\"20ms\"", "did you mean 'heartbeat'?");
    row("longest durations", "heartbeat=\"999999999s\" suspect=\"@@999999998s\" lost=\"999999999s\"", "less than 2");
    QTest::newRow("of a link, against the topology's")
        << pair("<timing heartbeat=\"30ms\" suspect=\"80ms\"/>\n<link between=\"cockpit robot\"><timing suspect=\"@@59ms\"/></link>")
        << QByteArray("less than 2 heartbeats of 30ms");
}

void TopologyReaderTest::refusesWrongTiming()
{
    QFETCH(QByteArray, xml);
    QFETCH(QByteArray, fragment);
    const auto input = unmarked(xml.toStdString());
    Findings findings;
    QVERIFY(!SystemTopology::parse(input.text, "t.xml", &findings));
    QVERIFY2(holds(findings, Severity::Error, input, fragment.toStdString()), listed(findings).c_str());
}

void TopologyReaderTest::acceptsHosts_data()
{
    QTest::addColumn<QByteArray>("host");
    for (const auto* host : {"127.0.0.1", "192.168.10.20", "::1", "fe80::1", "2001:db8::a:1", "localhost", "robot",
                             "robot-2.theatre.hospital.example", "3com.example", "xn--bcher-kva.example", "a.b1"})
        QTest::newRow(host) << QByteArray(host);
}

void TopologyReaderTest::acceptsHosts()
{
    QFETCH(QByteArray, host);
    QCOMPARE(parsed(withRobot("10.0.0.2", host.constData())).find("robot")->host, host.toStdString());
}

void TopologyReaderTest::refusesHosts_data()
{
    QTest::addColumn<QByteArray>("host");
    for (const auto* host :
         {"",        "256.0.0.1",    "10.0.0",       "10.0.0.1.2", "010.0.0.1x.", "0.0.0.0", "255.255.255.255", "224.0.0.1", "::",
          "ff02::1", "fe80::1%eth0", "[::1]",        "a b",        "-robot",      "robot-",  "robot..example",  "robot.",    ".robot",
          "ro_bot",  "robot:52100",  "http://robot", "größe",      "1:2"})
        QTest::newRow(host) << QByteArray(host);
    QTest::newRow("long label") << QByteArray(64, 'a');
    QTest::newRow("long name") << QByteArray("a.").repeated(126) + "aa";
}

void TopologyReaderTest::refusesHosts()
{
    QFETCH(QByteArray, host);
    const auto input = unmarked(withRobot("10.0.0.2", ("@@" + host).constData()).toStdString());
    Findings findings;
    QVERIFY(!SystemTopology::parse(input.text, "t.xml", &findings));
    QVERIFY2(holds(findings, Severity::Error, input, "give the address or the name"), listed(findings).c_str());
}

void TopologyReaderTest::warns_data()
{
    QTest::addColumn<QByteArray>("xml");
    QTest::addColumn<QByteArray>("fragment");
    QTest::newRow("plain beyond loopback") << inTopology("<security mode=\"none\"/>\n" +
                                                         QByteArray(cockpit).replace("10.0.0.1", "127.0.0.1") +
                                                         QByteArray(robot).replace("10.0.0.2", "@@10.0.0.2") + joined)
                                           << QByteArray("not a loopback address");
    QTest::newRow("lone device") << inTopology(QByteArray(cockpit).replace("0x4", "@@0x4")) << QByteArray("no link joins 'cockpit'");
}

void TopologyReaderTest::warns()
{
    QFETCH(QByteArray, xml);
    QFETCH(QByteArray, fragment);
    const auto input = unmarked(xml.toStdString());
    Findings findings;
    QVERIFY(SystemTopology::parse(input.text, "t.xml", &findings));
    QVERIFY2(findings.size() == 1 && holds(findings, Severity::Warning, input, fragment.toStdString()), listed(findings).c_str());
}

void TopologyReaderTest::fillsInWhatIsLeftOut()
{
    const auto topology = parsed(pair(joined));
    QVERIFY(topology.security() == SecurityMode::Tls);
    QVERIFY(topology.links().at(0).timing == LinkTiming{});
    QVERIFY(topology.links().at(0).flows.empty());
    QVERIFY(topology.title().empty() && topology.find("robot")->site.empty());
    QVERIFY(parsed(pair("<security mode=\"none\"/>" + joined)).security() == SecurityMode::None);
}

void TopologyReaderTest::readsTheShortestTiming()
{
    using namespace std::chrono_literals;
    const auto topology = parsed(pair("<timing heartbeat=\"1ms\" suspect=\"5ms\" lost=\"10ms\" reconnect=\"20ms\"/>\n" + joined));
    QVERIFY((topology.links().at(0).timing == LinkTiming{1ms, 5ms, 10ms, 20ms}));
}

void TopologyReaderTest::readsTimingOfLinks()
{
    using namespace std::chrono_literals;
    const auto topology = parsed(pair("<timing heartbeat=\"30ms\" suspect=\"100ms\" lost=\"150ms\" reconnect=\"1s\"/>"
                                      "<link between=\"cockpit robot\"><timing heartbeat=\"25000us\" lost=\"200ms\"/></link>"));
    QVERIFY((topology.links().at(0).timing == LinkTiming{25ms, 100ms, 200ms, 1s}));
}

void TopologyReaderTest::readsFlows()
{
    const auto topology = parsed(pair("<link between=\"cockpit robot\"><flow message=\"RobotStatus\" from=\"robot\"/>"
                                      "<flow message=\"MotionCommand\" from=\"cockpit\"/></link>"));
    const auto& flows = topology.links().at(0).flows;
    QCOMPARE(flows.size(), 2U);
    QCOMPARE(flows[0].message, std::string("RobotStatus"));
    QVERIFY(flows[0].from == DeviceId(0x00008208));
    QVERIFY(flows[1].from == DeviceId(0x40018208));
}

void TopologyReaderTest::ordersEndsOfLinks()
{
    const auto topology = parsed(pair("<link between=\"  cockpit\n  robot \"/>"));
    QVERIFY(topology.links().at(0).a == DeviceId(0x00008208));
    QVERIFY(topology.links().at(0).b == DeviceId(0x40018208));
}

void TopologyReaderTest::acceptsChildrenInAnyOrder()
{
    const auto topology =
        parsed(inTopology(joined + "<security mode=\"tls\"/><description>x</description>" + robot + "<timing lost=\"120ms\"/>" + cockpit));
    QCOMPARE(topology.links().size(), 1U);
    QVERIFY(topology.links().at(0).timing.lost == std::chrono::milliseconds(120));
    QCOMPARE(topology.devices().at(0).name, std::string("robot"));
}

void TopologyReaderTest::findsDevicesAndLinks()
{
    const auto topology = parsed(pair(joined));
    const DeviceId x(0x40018208);
    const DeviceId y(0x00008208);
    QCOMPARE(topology.find(x)->name, std::string("cockpit"));
    QVERIFY(!topology.find(DeviceId(1)));
    QVERIFY(!topology.find("arm"));
    QVERIFY(topology.link(x, y) && topology.link(x, y) == topology.link(y, x));
    QVERIFY(!topology.link(x, x));
    QCOMPARE(topology.linksOf(x).size(), 1U);
    QCOMPARE(topology.device("robot").value().id.value(), 0x00008208U);
    QCOMPARE(topology.device("0x40018208").value().name, std::string("cockpit"));
}

void TopologyReaderTest::namesNearestDevice()
{
    const auto missing = parsed(pair(joined)).device("cokpit");
    QVERIFY(!missing);
    QVERIFY(missing.error().code == Errc::UnknownDevice);
    QCOMPARE(missing.error().what, std::string("'cokpit' is no device of the topology 'probe'; did you mean 'cockpit'?"));
}

void TopologyReaderTest::hashesTheBytes()
{
    const auto xml = pair(joined);
    QVERIFY(parsed(xml).hash() == Sha256::of(xml.toStdString()));
    QVERIFY(parsed(xml + "\n").hash() != parsed(xml).hash());
}

QTEST_APPLESS_MAIN(TopologyReaderTest)
#include "topology_reader_test.moc"
