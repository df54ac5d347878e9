// The XSDs accept our files, and agree with the reader wherever XSD 1.0 can express the rule.
#include "marked_text.hpp"
#include "xml_oracle.hpp"

#include "liena/message_set.hpp"
#include "liena/system_topology.hpp"

#include <QDir>

using namespace liena;
using namespace liena::test;

class SchemasTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase();
    void acceptsFilesOfTheRepository_data();
    void acceptsFilesOfTheRepository();
    void agreesWithReaderOnMessageSets_data();
    void agreesWithReaderOnMessageSets();
    void agreesWithReaderOnTopologies_data();
    void agreesWithReaderOnTopologies();
    void leavesToTheReaderWhatItCannotSay();

private:
    const Schema m_sets{sourceFile("resources/schemas/message-set.xsd")};
    const Schema m_topologies{sourceFile("resources/schemas/topology.xsd")};
};

namespace {

constexpr auto setHead =
    "<message-set xmlns=\"urn:liena:message-set:1\" name=\"probe\" version=\"1\" class=\"hand\" manufacturer=\"1\" type=\"2\" "
    "device-version=\"3\">";
constexpr auto messageHead = "<message name=\"M\" number=\"0x0200\" role=\"report\" priority=\"status\">";
constexpr auto topologyHead = "<topology xmlns=\"urn:liena:topology:1\" name=\"probe\" version=\"1\">";

QByteArray set(const QByteArray& content) { return setHead + content + "</message-set>"; }
QByteArray field(const QByteArray& attributes) { return set(QByteArray(messageHead) + "<field name=\"f\" " + attributes + "/></message>"); }
QByteArray message(const QByteArray& attributes) { return set("<message name=\"M\" " + attributes + "/>"); }

const QByteArray a = "<device name=\"a\" id=\"0x40018208\" message-set=\"x\" host=\"10.0.0.1\" port=\"1\"/>";
const QByteArray b = "<device name=\"b\" id=\"0x00008208\" message-set=\"y\" host=\"10.0.0.2\" port=\"2\"/>";
const QByteArray joined = "<link between=\"a b\"/>";

QByteArray topology(const QByteArray& content) { return topologyHead + content + "</topology>"; }
QByteArray device(const char* from, const char* to) { return topology(a + QByteArray(b).replace(from, to)); }

} // namespace

void SchemasTest::initTestCase()
{
    QVERIFY(m_sets.isUsable());
    QVERIFY(m_topologies.isUsable());
}

void SchemasTest::acceptsFilesOfTheRepository_data()
{
    QTest::addColumn<QByteArray>("path");
    QTest::addColumn<bool>("isTopology");
    for (const auto& [folder, isTopology] : {std::pair("resources/devices", false), std::pair("topologies", true)})
        for (const auto& entry : QDir(QString::fromStdString(sourceFile(folder))).entryInfoList({QStringLiteral("*.xml")}, QDir::Files))
            QTest::newRow(qPrintable(entry.fileName())) << entry.absoluteFilePath().toUtf8() << isTopology;
}

void SchemasTest::acceptsFilesOfTheRepository()
{
    QFETCH(QByteArray, path);
    QFETCH(bool, isTopology);
    QVERIFY((isTopology ? m_topologies : m_sets).accepts(bytesOf(path.toStdString()).toStdString()));
    QVERIFY(!(isTopology ? m_sets : m_topologies).accepts(bytesOf(path.toStdString()).toStdString()));
}

void SchemasTest::agreesWithReaderOnMessageSets_data()
{
    QTest::addColumn<QByteArray>("xml");
    QTest::addColumn<bool>("good");
    const auto good = [](const char* name, const QByteArray& xml) { QTest::newRow(name) << xml << true; };
    const auto bad = [](const char* name, const QByteArray& xml) { QTest::newRow(name) << xml << false; };
    const QByteArray report = "number=\"0x0200\" role=\"report\" priority=\"status\" ";
    good("no content", set(""));
    good("description in front", set("<description>x</description>"));
    good("description between",
         set(QByteArray(messageHead) + "</message><description/><enum name=\"E\"><value name=\"a\" number=\"0\"/></enum>"));
    good("field description",
         set(QByteArray(messageHead) + "<field name=\"f\" type=\"bool\"><description>x</description></field></message>"));
    good("message description behind fields", set(QByteArray(messageHead) + "<field name=\"f\" type=\"bool\"/><description/></message>"));
    bad("two descriptions", set("<description/><description/>"));
    bad("description with element", set("<description><b/></description>"));
    bad("no namespace",
        QByteArray("<message-set name=\"p\" version=\"1\" class=\"hand\" manufacturer=\"1\" type=\"2\" device-version=\"3\"/>"));
    bad("unknown element", set("<mesage/>"));
    bad("unknown attribute", set("").replace("version=\"1\"", "version=\"1\" colour=\"\""));
    bad("text", set("hello"));
    for (const auto* attribute :
         {" name=\"probe\"", " version=\"1\"", " class=\"hand\"", " manufacturer=\"1\"", " type=\"2\"", " device-version=\"3\""})
        bad(attribute, set("").replace(attribute, ""));
    bad("empty version", set("").replace(" version=\"1\"", " version=\"\""));
    bad("strange name", set("").replace("probe", "pro be"));
    bad("long name", set("").replace("probe", QByteArray(65, 'a')));
    good("longest name", set("").replace("probe", QByteArray(64, 'a')));
    bad("class", set("").replace("hand", "Hand"));
    good("last manufacturer", set("").replace("manufacturer=\"1\"", "manufacturer=\"16383\""));
    bad("manufacturer", set("").replace("manufacturer=\"1\"", "manufacturer=\"16384\""));
    bad("type", set("").replace("type=\"2\"", "type=\"64\""));
    bad("signed type", set("").replace("type=\"2\"", "type=\"+2\""));
    good("greatest id", set("").replace("type=\"2\" device-version=\"3\"", "type=\"63\" device-version=\"63\""));
    good("enum with base", set("<enum name=\"E\" base=\"int16\"><value name=\"a\" number=\"-5\" title=\"t\"/></enum>"));
    bad("enum of floats", set("<enum name=\"E\" base=\"float32\"><value name=\"a\" number=\"5\"/></enum>"));
    bad("enum without values", set("<enum name=\"E\"/>"));
    bad("enum with title", set("<enum name=\"E\" title=\"x\"><value name=\"a\" number=\"5\"/></enum>"));
    bad("enum twice", set(QByteArray("<enum name=\"E\"><value name=\"a\" number=\"5\"/></enum>").repeated(2)));
    bad("value name twice", set("<enum name=\"E\"><value name=\"a\" number=\"5\"/><value name=\"a\" number=\"6\"/></enum>"));
    bad("value number twice", set("<enum name=\"E\"><value name=\"a\" number=\"5\"/><value name=\"b\" number=\"05\"/></enum>"));
    good("every attribute",
         message("number=\"0x01fF\" role=\"command\" priority=\"control\" in-standby=\"allow\" period=\"1us\" deadline=\"999999999s\" "
                 "lifespan=\"20ms\" history=\"1\" max-age=\"5ms\" path=\"datagram\" title=\"&lt;x&gt;\""));
    bad("number 0x00ff", message("number=\"0x00ff\" role=\"command\" priority=\"status\""));
    bad("number 0x1000", message("number=\"0x1000\" role=\"report\" priority=\"status\""));
    bad("number in decimal", message("number=\"512\" role=\"report\" priority=\"status\""));
    bad("message name twice",
        set(QByteArray(messageHead) + "</message>" + QByteArray(messageHead).replace("0x0200", "0x0201") + "</message>"));
    bad("message number twice",
        set(QByteArray(messageHead) + "</message>" + QByteArray(messageHead).replace("\"M\"", "\"N\"") + "</message>"));
    for (const auto* attribute : {"number=\"0x0200\" ", "role=\"report\" ", "priority=\"status\" "})
        bad(attribute, message(QByteArray(report).replace(attribute, "")));
    bad("priority", message(QByteArray(report).replace("status", "urgent")));
    bad("in-standby", message(report + "in-standby=\"true\""));
    bad("path", message(report + "path=\"udp\""));
    for (const auto* value : {"20", "0ms", "020ms", "1.5ms", "1 ms", "1min", "1000000000ms", "-1ms", ""})
        bad(qPrintable(QStringLiteral("duration %1").arg(QLatin1String(value))), message(report + "period=\"" + value + "\""));
    bad("history of nothing", message(report + "history=\"0\""));
    bad("history of everything", message(report + "history=\"4294967296\""));
    bad("line break in a title", message(report + "title=\"a&#10;b\""));
    for (const auto* type :
         {"bool", "int64", "uint8[]\" max-count=\"3", "float32[65535]", "string\" max-length=\"65535", "bytes\" max-length=\"1"})
        good(type, field(QByteArray("type=\"") + type + "\""));
    for (const auto* type : {"", "uint8[0]", "uint8[", "uint8]", "uint8[3][3]", "uint8[-1]", "uint8 [3]", "3"})
        bad(qPrintable(QStringLiteral("type '%1'").arg(QLatin1String(type))), field(QByteArray("type=\"") + type + "\""));
    bad("field without type", field(""));
    bad("field name twice", set(QByteArray(messageHead) + "<field name=\"f\" type=\"bool\"/><field name=\"f\" type=\"bool\"/></message>"));
    for (const auto* value : {"0", "-1.5", "1e3", "2.5E-3", "00"})
        good(qPrintable(QStringLiteral("bound %1").arg(QLatin1String(value))), field(QByteArray("type=\"float64\" min=\"") + value + "\""));
    for (const auto* value : {"", "+1", ".5", "5.", "1,5", "INF", "NaN", "0x10", "1e", "- 1", "1 "})
        bad(qPrintable(QStringLiteral("bound '%1'").arg(QLatin1String(value))),
            field(QByteArray("type=\"float64\" min=\"") + value + "\""));
    bad("strange default", field("type=\"bool\" default=\"?\""));
    bad("length of nothing", field("type=\"string\" max-length=\"0\""));
    bad("nonfinite", field("type=\"float32\" nonfinite=\"1\""));
    good("nonfinite so", field("type=\"float32\" nonfinite=\"true\" unit=\"mm/s\""));
}

void SchemasTest::agreesWithReaderOnMessageSets()
{
    QFETCH(QByteArray, xml);
    QFETCH(bool, good);
    Findings findings;
    const bool read = MessageSet::parse(xml.toStdString(), "x.xml", &findings).has_value();
    QVERIFY2(read == good, listed(findings).c_str());
    QCOMPARE(m_sets.accepts(xml.toStdString()), good);
}

void SchemasTest::agreesWithReaderOnTopologies_data()
{
    QTest::addColumn<QByteArray>("xml");
    QTest::addColumn<bool>("good");
    const auto good = [](const char* name, const QByteArray& xml) { QTest::newRow(name) << xml << true; };
    const auto bad = [](const char* name, const QByteArray& xml) { QTest::newRow(name) << xml << false; };
    const QByteArray timing = "<timing lost=\"120ms\"/>";
    const QByteArray security = "<security mode=\"none\"/>";
    const QByteArray description = "<description>x</description>";
    good("plain", topology(a + b + joined));
    good("timing, security, description", topology(timing + security + description + a + b + joined));
    good("description, security, timing", topology(a + description + b + security + joined + timing));
    good("security, timing, description", topology(security + a + timing + b + joined + description));
    good("security alone, last", topology(a + b + joined + security));
    bad("two timings", topology(timing + a + b + timing));
    bad("two securities", topology(security + security + a + b));
    bad("two descriptions", topology(description + a + b + description));
    bad("no name", topology(a).replace(" name=\"probe\"", ""));
    bad("no version", topology(a).replace(" version=\"1\"", ""));
    bad("unknown element", topology(a + "<devise/>"));
    bad("unknown attribute", topology(a).replace("version", "verson"));
    bad("security without mode", topology("<security/>" + a));
    bad("mode", topology("<security mode=\"TLS\"/>" + a));
    for (const auto* attribute : {" name=\"b\"", " id=\"0x00008208\"", " message-set=\"y\"", " host=\"10.0.0.2\"", " port=\"2\""})
        bad(attribute, device(attribute, ""));
    for (const auto* id :
         {"0x0000820F", "0x00008207", "0x80008208", "0xD0008208", "0xFFFFFFFF", "0x8208", "00008208", "0X00008208", "0x0000820g"})
        bad(id, device("0x00008208", id));
    for (const auto* id : {"0x0000820e", "0x7FFF8206", "0xE0000000", "0xffFFfFFe", "0x2abcdef9"})
        good(id, device("0x00008208", id));
    for (const auto* port : {"0", "65536", "-1", "x", "+80", ""})
        bad(qPrintable(QStringLiteral("port '%1'").arg(QLatin1String(port))),
            device("port=\"2\"", (QByteArray("port=\"") + port + "\"").constData()));
    for (const auto* host : {"", "a b", "a_b", "a/b", "[::1]"})
        bad(qPrintable(QStringLiteral("host '%1'").arg(QLatin1String(host))), device("10.0.0.2", host));
    good("IPv6", device("10.0.0.2", "2001:db8::1"));
    good("name", device("10.0.0.2", "robot.example"));
    bad("name twice", device("name=\"b\"", "name=\"a\""));
    bad("id twice", device("0x00008208", "0x40018208"));
    bad("endpoint twice", device("host=\"10.0.0.2\" port=\"2\"", "host=\"10.0.0.1\" port=\"1\""));
    good("same host, other port", device("10.0.0.2", "10.0.0.1"));
    bad("link twice", topology(a + b + joined + joined));
    good("link with spaces", topology(a + b + "<link between=\" a  b \"/>"));
    for (const auto* between : {"", "a", "a b c", "a,b", "1 2"})
        bad(qPrintable(QStringLiteral("between '%1'").arg(QLatin1String(between))),
            topology(a + b + "<link between=\"" + between + "\"/>"));
    good("link with all", topology(a + b + "<link between=\"a b\"><flow message=\"M\" from=\"a\"/>" + timing +
                                   "<flow message=\"M\" from=\"b\"/>" + description + "</link>"));
    bad("link with two timings", topology(a + b + "<link between=\"a b\">" + timing + timing + "</link>"));
    bad("flow from a stranger", topology(a + b + "<link between=\"a b\"><flow message=\"M\" from=\"c\"/></link>"));
    bad("flow twice", topology(a + b + "<link between=\"a b\">" + QByteArray("<flow message=\"M\" from=\"a\"/>").repeated(2) + "</link>"));
    bad("flow without message", topology(a + b + "<link between=\"a b\"><flow from=\"a\"/></link>"));
    bad("duration", topology("<timing lost=\"120\"/>" + a));
}

void SchemasTest::agreesWithReaderOnTopologies()
{
    QFETCH(QByteArray, xml);
    QFETCH(bool, good);
    Findings findings;
    const bool read = SystemTopology::parse(xml.toStdString(), "x.xml", &findings).has_value();
    QVERIFY2(read == good, listed(findings).c_str());
    QCOMPARE(m_topologies.accepts(xml.toStdString()), good);
}

void SchemasTest::leavesToTheReaderWhatItCannotSay()
{
    for (const auto& xml : {field("type=\"string\""), field("type=\"float32\" min=\"2\" max=\"1\""), field("type=\"Unknown\""),
                            message("number=\"0x0100\" role=\"report\" priority=\"status\"")}) {
        QVERIFY(m_sets.accepts(xml.toStdString()));
        QVERIFY(!MessageSet::parse(xml.toStdString(), "x.xml"));
    }
    for (const auto& xml : {topology("<timing suspect=\"110ms\"/>" + a), topology(a + "<link between=\"a c\"/>")}) {
        QVERIFY(m_topologies.accepts(xml.toStdString()));
        QVERIFY(!SystemTopology::parse(xml.toStdString(), "x.xml"));
    }
}

QTEST_APPLESS_MAIN(SchemasTest)
#include "schemas_test.moc"
