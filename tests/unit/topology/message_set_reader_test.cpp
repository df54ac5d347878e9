// Every rule of protocol section 4 and its rulings for message sets: what is read, and what is refused where.
#include "set_texts.hpp"

using namespace liena;
using namespace liena::test;

class MessageSetReaderTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void refusesWrongRoot_data();
    void refusesWrongRoot();
    void refusesWrongMessages_data();
    void refusesWrongMessages();
    void acceptsUnusualButValid_data();
    void acceptsUnusualButValid();
    void warns_data();
    void warns();
    void readsDurations();
    void derivesStandByFromPriority();
    void readsDescriptions();
    void sortsMessagesByNumber();
    void keepsBytesAndHash();
    void reportsEveryErrorOfAFile();
    void reportsUnreadableFile();

private:
    void columns() const;
};

void MessageSetReaderTest::columns() const
{
    QTest::addColumn<QByteArray>("xml");
    QTest::addColumn<QByteArray>("fragment");
}

void MessageSetReaderTest::refusesWrongRoot_data()
{
    columns();
    const auto rest = QByteArray(" name=\"probe\" version=\"1\" class=\"hand\" manufacturer=\"1\" type=\"2\" device-version=\"3\"/>");
    const auto good = "<message-set xmlns=\"urn:liena:message-set:1\"" + rest;
    const auto row = [](const char* name, QByteArray xml, const char* fragment) { QTest::newRow(name) << xml << QByteArray(fragment); };
    const auto changed = [&good](const char* from, const char* to) { return QByteArray(good).replace(from, to); };
    row("other element", "@@<messages" + rest, "<message-set xmlns=");
    row("topology", "@@<topology xmlns=\"urn:liena:topology:1\"/>", "'topology'");
    row("no namespace", "@@<message-set" + rest, "no namespace");
    row("other namespace", "<message-set xmlns=\"@@urn:liena:message-set:2\"" + rest, "urn:liena:message-set:1");
    row("prefix", "@@<m:message-set xmlns:m=\"urn:liena:message-set:1\"" + rest, "'m:message-set'");
    row("no name", changed("<", "@@<").replace(" name=\"probe\"", ""), "no attribute 'name'");
    row("name with a space", changed("\"probe\"", "\"@@my probe\""), "no name");
    row("name that starts with a digit", changed("\"probe\"", "\"@@1probe\""), "no name");
    row("name that climbs", changed("\"probe\"", "\"@@../../etc\""), "no name");
    row("long name", changed("\"probe\"", "\"@@" + QByteArray(65, 'a') + "\""), "no name");
    row("empty version", changed(" version=\"1\"", " version=\"@@\""), "'version' is empty");
    row("unknown class", changed("\"hand\"", "\"@@foot\""), "hand, eye, brain, arm or special");
    row("manufacturer", changed("manufacturer=\"1\"", "manufacturer=\"@@16384\""), "0 to 16383");
    row("negative manufacturer", changed("manufacturer=\"1\"", "manufacturer=\"@@-1\""), "0 to 16383");
    row("type", changed("type=\"2\"", "type=\"@@64\""), "0 to 63");
    row("device version", changed("device-version=\"3\"", "device-version=\"@@64\""), "0 to 63");
    row("hex where decimal is due", changed("type=\"2\"", "type=\"@@0x2\""), "whole number");
    row("space in a number", changed("type=\"2\"", "type=\"@@ 2\""), "whole number");
    row("misspelt attribute", changed("/>", " @@vendr=\"x\"/>"), "did you mean 'vendor'?");
    row("foreign attribute", changed("/>", " @@colour=\"red\"/>"), "'colour'");
    row("schema location", changed("/>", " @@xsi:schemaLocation=\"x y\"/>"), "references to other files");
    row("misspelt element", inSet("@@<mesage/>"), "did you mean 'message'?");
    row("text", inSet("<!-- c -->  @@hello"), "text inside <message-set>");
    row("CDATA", inSet("<![CDATA[@@hello]]>"), "text inside");
    row("second description", inSet("<description/>@@<description/>"), "second <description>");
    row("element in a description", inSet("<description>a @@<b/></description>"), "text only");
    row("attribute of a description", inSet("<description @@lang=\"en\"/>"), "'lang'");
    row("enum without values", inSet("@@<enum name=\"Mode\"/>"), "no value");
    row("enum with a type's name", inSet("<enum name=\"@@float32\"><value name=\"a\" number=\"0\"/></enum>"), "type of the protocol");
    row("enum twice",
        inSet("<enum name=\"A\"><value name=\"a\" number=\"0\"/></enum>\n<enum name=\"@@A\"><value name=\"a\" number=\"0\"/></enum>"),
        "used already in line 2");
    row("enum of floats", inSet("<enum name=\"A\" base=\"@@float32\"><value name=\"a\" number=\"0\"/></enum>"), "no base");
    row("value's name twice", inSet("<enum name=\"A\"><value name=\"a\" number=\"0\"/>\n<value name=\"@@a\" number=\"1\"/></enum>"),
        "in line 2");
    row("value's number twice", inSet("<enum name=\"A\"><value name=\"a\" number=\"1\"/>\n<value name=\"b\" number=\"@@1\"/></enum>"),
        "in line 2");
    row("value's number twice, written otherwise",
        inSet("<enum name=\"A\"><value name=\"a\" number=\"1\"/><value name=\"b\" number=\"@@01\"/></enum>"), "in line 2");
    row("value beyond uint8", inSet("<enum name=\"A\"><value name=\"a\" number=\"@@256\"/><value name=\"b\" number=\"0\"/></enum>"),
        "0 to 255");
    row("value below int8",
        inSet("<enum name=\"A\" base=\"int8\"><value name=\"a\" number=\"@@-129\"/><value name=\"b\" number=\"0\"/></enum>"),
        "-128 to 127");
}

void MessageSetReaderTest::refusesWrongRoot() { refusesMarkedSet(); }

void MessageSetReaderTest::refusesWrongMessages_data()
{
    columns();
    const auto row = [](const char* name, QByteArray xml, const char* fragment) { QTest::newRow(name) << xml << QByteArray(fragment); };
    const auto message = [](const QByteArray& attributes) { return inSet("<message name=\"A\" " + attributes + "/>"); };
    row("command with a report's number", message("number=\"@@0x0200\" role=\"command\" priority=\"status\""), "0x0100 to 0x01ff");
    row("report with a command's number", message("number=\"@@0x01FF\" role=\"report\" priority=\"status\""), "0x0200 to 0x0fff");
    row("session management's number", message("number=\"@@0x0010\" role=\"command\" priority=\"status\""), "0x0100");
    row("reserved number", message("number=\"@@0x1000\" role=\"report\" priority=\"status\""), "0x0fff");
    row("decimal number", message("number=\"@@512\" role=\"report\" priority=\"status\""), "four hex digits");
    row("short number", message("number=\"@@0x200\" role=\"report\" priority=\"status\""), "four hex digits");
    row("signed number", message("number=\"@@0x+200\" role=\"report\" priority=\"status\""), "four hex digits");
    row("no number", inSet("@@<message name=\"A\" role=\"report\" priority=\"status\"/>"), "'number'");
    row("no role", inSet("@@<message name=\"A\" number=\"0x0200\" priority=\"status\"/>"), "'role'");
    row("no priority", inSet("@@<message name=\"A\" number=\"0x0200\" role=\"report\"/>"), "'priority'");
    row("no name", inSet("@@<message number=\"0x0200\" role=\"report\" priority=\"status\"/>"), "'name'");
    row("unknown role", message("number=\"0x0200\" role=\"@@both\" priority=\"status\""), "command or report");
    row("unknown priority", message("number=\"0x0200\" role=\"report\" priority=\"@@urgent\""), "safety, control, status or bulk");
    row("unknown in-standby", message("number=\"0x0200\" role=\"report\" priority=\"status\" in-standby=\"@@yes\""), "refuse or allow");
    row("unknown path", message("number=\"0x0200\" role=\"report\" priority=\"status\" path=\"@@udp\""), "stream or datagram");
    row("underscore for hyphen", message("number=\"0x0101\" role=\"command\" priority=\"control\" @@max_age=\"1ms\""),
        "did you mean 'max-age'?");
    row("duration without unit", message(control("period=\"@@20\"")), "us, ms or s");
    row("duration with fraction", message(control("deadline=\"@@2.5ms\"")), "us, ms or s");
    row("duration of nothing", message(control("lifespan=\"@@0ms\"")), "above 0");
    row("negative duration", message(control("lifespan=\"@@-1ms\"")), "above 0");
    row("duration in minutes", message(control("lifespan=\"@@1min\"")), "us, ms or s");
    row("duration beyond all clocks", message(control("lifespan=\"@@9999999999s\"")), "nine digits");
    row("history of nothing", message(control("history=\"@@0\"")), "1 to 4294967295");
    row("max-age of a status", message("number=\"0x0200\" role=\"report\" priority=\"status\" @@max-age=\"1ms\""), "control messages only");
    row("max-age of a safety message", message("number=\"0x0101\" role=\"command\" priority=\"safety\" @@max-age=\"1ms\""),
        "control messages only");
    row("datagram without history", message(control("path=\"@@datagram\"")), "history=\"1\"");
    row("datagram with longer history", message(control("history=\"2\" path=\"@@datagram\"")), "history=\"1\"");
    row("name twice",
        inSet("<message name=\"A\" number=\"0x0200\" role=\"report\" priority=\"status\"/>\n"
              "<message name=\"@@A\" number=\"0x0201\" role=\"report\" priority=\"status\"/>"),
        "in line 2");
    row("number twice",
        inSet("<message name=\"A\" number=\"0x020a\" role=\"report\" priority=\"status\"/>\n"
              "<message name=\"B\" number=\"@@0x020A\" role=\"report\" priority=\"status\"/>"),
        "in line 2");
    const auto bytes = [](const char* size) { return QByteArray("<field name=\"b\" type=\"bytes\" max-length=\"") + size + "\"/>"; };
    row("over 32 MiB", inMessage(bytes("33554429")).replace("<message ", "@@<message "), "33554433 bytes");
    row("over 32 MiB in parts",
        inMessage(bytes("20000000") + bytes("20000000").replace("\"b\"", "\"c\"")).replace("<message ", "@@<message "), "at most 33554432");
    row("control over a segment", inMessage(bytes("32748"), control("")).replace("<message ", "@@<message "),
        "32768 bytes with its safety record");
    row("datagram over 1200", inMessage(bytes("1181"), control("history=\"1\" path=\"datagram\"")).replace("<message ", "@@<message "),
        "at most 1200");
}

void MessageSetReaderTest::refusesWrongMessages() { refusesMarkedSet(); }

void MessageSetReaderTest::acceptsUnusualButValid_data()
{
    QTest::addColumn<QByteArray>("xml");
    const auto row = [](const char* name, const QByteArray& xml) { QTest::newRow(name) << xml; };
    const auto bytes = [](const char* size) { return QByteArray("<field name=\"b\" type=\"bytes\" max-length=\"") + size + "\"/>"; };
    row("no messages", inSet(""));
    row("message without fields", inMessage(""));
    row("description last",
        inSet("<message name=\"A\" number=\"0x0200\" role=\"report\" priority=\"status\"/><description>x</description>"));
    row("enum behind its use",
        inSet("<message name=\"A\" number=\"0x0200\" role=\"report\" priority=\"status\"><field name=\"f\" type=\"E\"/></message>"
              "<enum name=\"E\"><value name=\"a\" number=\"0\"/></enum>"));
    row("exactly 32 MiB", inMessage(bytes("33554428")));
    row("control of one segment", inMessage(bytes("32747"), control("")));
    row("datagram of 1200", inMessage(bytes("1180"), control("history=\"1\" path=\"datagram\"")));
    row("longest array", inMessage("<field name=\"f\" type=\"bool[65535]\"/>"));
    row("default at its bound in float32", inMessage("<field name=\"f\" type=\"float32\" min=\"0.1\" max=\"0.1\" default=\"0.1\"/>"));
    row("full range of int64", inMessage("<field name=\"f\" type=\"int64\" min=\"-9223372036854775808\" max=\"9223372036854775807\"/>"));
}

void MessageSetReaderTest::acceptsUnusualButValid()
{
    QFETCH(QByteArray, xml);
    Findings findings;
    QVERIFY2(MessageSet::parse(xml.toStdString(), "set.xml", &findings), listed(findings).c_str());
    QVERIFY2(findings.empty(), listed(findings).c_str());
}

void MessageSetReaderTest::warns_data()
{
    columns();
    QTest::newRow("deadline below period") << inMessage("", control("period=\"20ms\" deadline=\"@@10ms\"")) << QByteArray("always missed");
    QTest::newRow("unbounded control") << inMessage("@@<field name=\"v\" type=\"float32\" min=\"0\"/>", control(""))
                                       << QByteArray("no min and max");
    QTest::newRow("unbounded control sequence")
        << inMessage("@@<field name=\"v\" type=\"uint8[]\" max-count=\"3\"/>", control("")) << QByteArray("no min and max");
    QTest::newRow("control that may be NaN") << inMessage("@@<field name=\"v\" type=\"float32\" min=\"0\" max=\"1\" nonfinite=\"true\"/>",
                                                          control(""))
                                             << QByteArray("may be NaN");
}

void MessageSetReaderTest::warns()
{
    QFETCH(QByteArray, xml);
    QFETCH(QByteArray, fragment);
    const auto input = unmarked(xml.toStdString());
    Findings findings;
    QVERIFY(MessageSet::parse(input.text, "set.xml", &findings));
    QVERIFY2(holds(findings, Severity::Warning, input, fragment.toStdString()), listed(findings).c_str());
}

void MessageSetReaderTest::readsDurations()
{
    using namespace std::chrono_literals;
    const auto set = MessageSet::parse(
        inMessage("", control("period=\"500us\" deadline=\"20ms\" lifespan=\"3s\" max-age=\"50ms\" history=\"4\"")).toStdString(), "x");
    QVERIFY(set);
    const auto& message = set.value()->messages().at(0);
    QVERIFY(message.period == 500us);
    QVERIFY(message.deadline == 20ms);
    QVERIFY(message.lifespan == 3s);
    QVERIFY(message.maxAge == 50ms);
    QCOMPARE(message.history, 4U);
    QVERIFY(message.path == Path::Stream);
}

void MessageSetReaderTest::derivesStandByFromPriority()
{
    const auto allowed = [](const QByteArray& attributes) {
        return MessageSet::parse(inMessage("", attributes).toStdString(), "x").value()->messages().at(0).allowedInStandBy;
    };
    QVERIFY(!allowed(control("")));
    QVERIFY(allowed(control("in-standby=\"allow\"")));
    for (const auto* priority : {"safety", "status", "bulk"}) {
        const auto attributes = QByteArray("number=\"0x0200\" role=\"report\" priority=\"") + priority + "\"";
        QVERIFY(allowed(attributes));
        QVERIFY(!allowed(attributes + " in-standby=\"refuse\""));
    }
}

void MessageSetReaderTest::readsDescriptions()
{
    const auto set = MessageSet::parse(inMessage("<description>\n  Two\n  lines &amp; <![CDATA[<more>]]>. </description>"
                                                 "<field name=\"f\" type=\"bool\"><description>One.</description></field>")
                                           .toStdString(),
                                       "x");
    QVERIFY(set);
    QCOMPARE(set.value()->messages().at(0).description, std::string("Two lines & <more>."));
    QCOMPARE(set.value()->messages().at(0).fields.at(0).description, std::string("One."));
}

void MessageSetReaderTest::sortsMessagesByNumber()
{
    const auto set = MessageSet::parse(inSet("<message name=\"B\" number=\"0x0300\" role=\"report\" priority=\"status\"/>"
                                             "<message name=\"A\" number=\"0x0100\" role=\"command\" priority=\"bulk\"/>"
                                             "<message name=\"C\" number=\"0x0200\" role=\"report\" priority=\"status\"/>")
                                           .toStdString(),
                                       "x")
                         .value();
    QCOMPARE(set->messages()[0].name, std::string("A"));
    QCOMPARE(set->find(0x0300)->name, std::string("B"));
    QCOMPARE(set->find("C")->number, 0x0200);
    QVERIFY(!set->find(0x0101));
    QVERIFY(!set->find("c"));
}

void MessageSetReaderTest::keepsBytesAndHash()
{
    const auto xml = inSet("<!-- as it is -->").toStdString();
    const auto set = MessageSet::parse(xml, "x").value();
    QCOMPARE(set->xml(), xml);
    QVERIFY(set->hash() == Sha256::of(xml));
    QCOMPARE(set->deviceType().toString(), std::string("0x00008418"));
}

void MessageSetReaderTest::reportsEveryErrorOfAFile()
{
    Findings findings;
    const auto xml = inMessage("<field name=\"f\" type=\"flota\"/>\n<field nam=\"g\" type=\"uint8\" min=\"5\" max=\"4\"/>\n<fild/>",
                               "number=\"0x0100\" role=\"report\" priority=\"high\" history=\"none\"");
    const auto set = MessageSet::parse(xml.toStdString(), "set.xml", &findings);
    QVERIFY(!set);
    QVERIFY2(findings.size() == 7, listed(findings).c_str());
    for (std::size_t i = 1; i < findings.size(); ++i)
        QVERIFY(findings[i - 1].line <= findings[i].line);
    QVERIFY2(set.error().what.ends_with("(and 6 more errors)"), set.error().what.c_str());
    QVERIFY(set.error().what.starts_with(findings[0].toString()));
}

void MessageSetReaderTest::reportsUnreadableFile()
{
    Findings findings;
    const auto missing = MessageSet::load("/nonexistent/set.xml", &findings);
    QVERIFY(!missing);
    QVERIFY(missing.error().code == Errc::FileUnreadable);
    QCOMPARE(findings.size(), 1U);
    QCOMPARE(findings[0].line, 0);
    QVERIFY(MessageSet::load("/").error().code == Errc::FileUnreadable);
    QVERIFY(MessageSet::load("/dev/zero").error().what.find("not a regular file") != std::string::npos);
}

QTEST_APPLESS_MAIN(MessageSetReaderTest)
#include "message_set_reader_test.moc"
