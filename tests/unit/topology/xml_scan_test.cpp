// Malformed, hostile and oversized XML, each refused before a tree is built, at its place.
#include "marked_text.hpp"

#include "liena/message_set.hpp"
#include "liena/system_topology.hpp"
#include "topology/xml_document.hpp"
#include "topology/xml_text.hpp"

#include <ctime>

using namespace liena;
using namespace liena::test;

class XmlScanTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void refusesMalformedXml_data();
    void refusesMalformedXml();
    void acceptsWellFormedXml_data();
    void acceptsWellFormedXml();
    void reportsSeveralErrorsAtOnce();
    void acceptsFileAtItsLimits_data();
    void acceptsFileAtItsLimits();
    void refusesFileBeyondItsLimits_data();
    void refusesFileBeyondItsLimits();
    void refusesBombs_data();
    void refusesBombs();
    void countsColumnsFromOneInBytes();
    void agreesWithTheTreeOnEveryPlace();
    void quotesNothingThatCouldForgeALine();
};

void XmlScanTest::refusesMalformedXml_data()
{
    QTest::addColumn<QByteArray>("xml");
    QTest::addColumn<QByteArray>("fragment");
    const auto row = [](const char* name, QByteArray xml, const char* fragment) { QTest::newRow(name) << xml << QByteArray(fragment); };
    row("empty", "", "empty");
    row("no element", " \n<!-- nothing -->", "no element");
    row("byte order mark", "@@\xEF\xBB\xBF<a/>", "byte order mark");
    row("UTF-16", QByteArray("@@\xFF\xFE<\0a\0/\0>\0", 12), "UTF-16");
    row("stray continuation byte", "<a>\n@@\x80</a>", "0x80");
    row("overlong slash", "<a b=\"@@\xC0\xAF\"/>", "0xc0");
    row("surrogate", "<a b=\"@@\xED\xA0\x80\"/>", "0xed");
    row("beyond Unicode", "<a b=\"@@\xF4\x90\x80\x80\"/>", "0xf4");
    row("cut character", "<a/>@@\xE2\x82", "0xe2");
    row("NUL", QByteArray("<a>@@\0</a>", 10), "0x00");
    row("control character", "<a b=\"@@\x1b[31m\"/>", "0x1b");
    row("noncharacter", "<a>@@\xEF\xBF\xBE</a>", "0xef");
    row("other encoding", "<?xml version=\"1.0\" encoding=\"@@ISO-8859-1\"?><a/>", "encoding 'ISO-8859-1'");
    row("other version", "<?xml version=\"@@1.1\"?><a/>", "version '1.1'");
    row("declaration without version", "<?xml @@encoding=\"UTF-8\"?><a/>", "declaration");
    row("declaration without parts", "@@<?xml ?><a/>", "no version");
    row("declaration not closed", "@@<?xml version=\"1.0\"><a/>", "not closed");
    row("declaration in wrong order", "<?xml version=\"1.0\" standalone=\"yes\" @@encoding=\"UTF-8\"?><a/>", "declaration");
    row("wrong standalone", "<?xml version=\"1.0\" standalone=\"@@maybe\"?><a/>", "standalone");
    row("late declaration", " @@<?xml version=\"1.0\"?><a/>", "not the first");
    row("document type", "<?xml version=\"1.0\"?>\n@@<!DOCTYPE a [<!ENTITY x \"y\">]><a/>", "document type");
    row("element declaration", "@@<!ELEMENT a><a/>", "not allowed");
    row("processing instruction", "@@<?php x?><a/>", "processing instruction");
    row("style sheet", "<?xml version=\"1.0\"?>\n@@<?xml-stylesheet href=\"x\"?><a/>", "processing instruction");
    row("unknown entity", "<a b=\"x @@&foo; y\"/>", "entity 'foo'");
    row("bare ampersand", "<a b=\"x @@& y\"/>", "&amp;");
    row("reference without end", "<a b=\"@@&#x41\"/>", "'&' without");
    row("reference to NUL", "<a b=\"@@&#0;\"/>", "no character");
    row("reference to surrogate", "<a>@@&#xD800;</a>", "no character");
    row("reference with letters", "<a>@@&#12z;</a>", "no character");
    row("new line in a value by reference", "<a b=\"x@@&#10;error: forged\"/>", "control character");
    row("duplicate attribute", "<a b=\"1\"\n   c=\"2\" @@b=\"3\"/>", "'b' stands twice");
    row("attribute without value", "<a @@b/>", "no value");
    row("attribute without quotes", "<a @@b=1/>", "not in quotes");
    row("attributes without space", "<a b=\"1\"@@c=\"2\"/>", "separated");
    row("value not closed", "<a b=@@\"1/>", "not closed");
    row("less-than in a value", "<a b=\"@@<\"/>", "&lt;");
    row("strange character in a tag", "<a @@%/>", "'%'");
    row("tag not closed", "<r>@@<a b=\"1\"", "not closed");
    row("element not closed", "@@<a>\n", "<a> is not closed");
    row("wrong end tag", "<a>\n<b>\n@@</c></a>", "</b> is due");
    row("end tag without start", "<a/>@@</a>", "nothing is open");
    row("end tag with attribute", "<a>@@</a b=\"1\">", "end tag");
    row("second root", "<a/>\n@@<b/>", "second root");
    row("text before the root", "@@x<a/>", "outside");
    row("text behind the root", "<a/>@@x", "outside");
    row("CDATA outside", "@@<![CDATA[x]]><a/>", "outside");
    row("CDATA not closed", "<a>@@<![CDATA[x]]</a>", "CDATA");
    row("end of CDATA in text", "<a>x@@]]></a>", "]]&gt;");
    row("comment not closed", "<a/>@@<!-- x", "comment");
    row("dashes in a comment", "<!-- x @@-- y --><a/>", "'--'");
    row("less-than in text", "<a>1 @@< 2</a>", "&lt;");
    row("name that starts with a digit", "@@<1a/>", "without an element's name");
    row("long element name", "<@@" + QByteArray(65, 'a') + "/>", "as long as");
    row("long attribute name", "<a @@" + QByteArray(65, 'a') + "=\"\"/>", "as long as");
}

void XmlScanTest::refusesMalformedXml()
{
    QFETCH(QByteArray, xml);
    QFETCH(QByteArray, fragment);
    const auto input = unmarked(xml.toStdString());
    Findings findings;
    const auto set = MessageSet::parse(input.text, "bad.xml", &findings);
    QVERIFY(!set);
    QVERIFY(set.error().code == Errc::XmlInvalid);
    QVERIFY2(holds(findings, Severity::Error, input, fragment.toStdString()), listed(findings).c_str());
    QCOMPARE(findings.size(), 1U);
    QVERIFY(set.error().what.starts_with("bad.xml:"));
    const auto topology = SystemTopology::parse(input.text, "bad.xml");
    QVERIFY(!topology);
    QVERIFY(topology.error().code == Errc::XmlInvalid);
}

void XmlScanTest::acceptsWellFormedXml_data()
{
    QTest::addColumn<QByteArray>("xml");
    const auto row = [](const char* name, QByteArray xml) { QTest::newRow(name) << xml; };
    row("smallest", "<a/>");
    row("declaration", "<?xml version=\"1.0\" encoding=\"UTF-8\" standalone=\"yes\"?><a/>");
    row("declaration in small letters and single quotes", "<?xml version='1.0' encoding='utf-8' ?>\r\n<a/>\r\n");
    row("comments everywhere", "<!-- a --><a><!-- b > & < --></a><!----><!-- c -->");
    row("references", "<a b=\"&amp;&lt;&gt;&quot;&apos;&#65;&#x1F600;\">&#10;&amp;</a>");
    row("greater-than and quotes in values", "<a b='\"' c=\"'>\"/>");
    row("CDATA", "<a><![CDATA[ <b> & ]] ]]></a>");
    row("spaces", "<a  b = \"1\"\n\tc='2' ></a >");
    row("other scripts", "<a b=\"血管 größe 😀\"/>");
}

void XmlScanTest::acceptsWellFormedXml()
{
    QFETCH(QByteArray, xml);
    FindingList findings("good.xml", xml.toStdString());
    QVERIFY2(XmlDocument::read(xml.toStdString(), findings), listed(findings.sorted()).c_str());
    QVERIFY(findings.sorted().empty());
}

void XmlScanTest::reportsSeveralErrorsAtOnce()
{
    const std::string xml = "<a b=\"1\" b=\"2\">\n<?x y?>&foo;\n<c d=\"&\" d=\"\"/></a>";
    FindingList list("bad.xml", xml);
    QVERIFY(!scanXml(xml, list));
    const auto findings = list.sorted();
    QCOMPARE(findings.size(), 5U);
    QCOMPARE(findings[0].column, 10);
    QCOMPARE(findings[1].line, 2);
    QCOMPARE(findings[2].column, 8);
    QCOMPARE(findings[3].line, 3);
}

namespace {

QByteArray elements(int count) { return "<r>" + QByteArray("<e/>").repeated(count - 1) + "</r>"; }
QByteArray levels(int count) { return QByteArray("<l>").repeated(count) + QByteArray("</l>").repeated(count); }
QByteArray padded(int size) { return "<r>" + QByteArray(size - 7, ' ') + "</r>"; }

QByteArray attributes(int count)
{
    QByteArray xml = "<r";
    for (int i = 0; i < count; ++i)
        xml += " a" + QByteArray::number(i) + "=\"\"";
    return xml + "/>";
}

} // namespace

void XmlScanTest::acceptsFileAtItsLimits_data()
{
    QTest::addColumn<QByteArray>("xml");
    QTest::newRow("20 000 elements") << elements(20'000);
    QTest::newRow("8 levels") << levels(8);
    QTest::newRow("16 attributes") << attributes(16);
    QTest::newRow("256 KiB") << padded(262'144);
}

void XmlScanTest::acceptsFileAtItsLimits()
{
    QFETCH(QByteArray, xml);
    FindingList findings("good.xml", xml.toStdString());
    QVERIFY2(scanXml(xml.toStdString(), findings), listed(findings.sorted()).c_str());
}

void XmlScanTest::refusesFileBeyondItsLimits_data()
{
    QTest::addColumn<QByteArray>("xml");
    QTest::addColumn<QByteArray>("fragment");
    QTest::newRow("20 001 elements") << elements(20'001) << QByteArray("bad.xml:1:80000: error: the file has more than 20000 elements");
    QTest::newRow("9 levels") << levels(9) << QByteArray("bad.xml:1:25: error: <l> is nested deeper than 8 levels");
    QTest::newRow("17 attributes") << attributes(17) << QByteArray("more than 16 attributes");
    QTest::newRow("256 KiB and a byte") << padded(262'145) << QByteArray("262145 bytes");
}

void XmlScanTest::refusesFileBeyondItsLimits()
{
    QFETCH(QByteArray, xml);
    QFETCH(QByteArray, fragment);
    const auto set = MessageSet::parse(xml.toStdString(), "bad.xml");
    QVERIFY(!set);
    QVERIFY(set.error().code == Errc::XmlInvalid);
    QVERIFY2(set.error().what.find(fragment.toStdString()) != std::string::npos, set.error().what.c_str());
}

void XmlScanTest::refusesBombs_data()
{
    QTest::addColumn<QByteArray>("xml");
    QByteArray laughs = "<!DOCTYPE a [<!ENTITY a \"ha\">";
    for (char c = 'b'; c <= 'j'; ++c)
        laughs += QByteArray("<!ENTITY ") + c + " \"" + (QByteArray("&") + char(c - 1) + ";").repeated(10) + "\">";
    QTest::newRow("billion laughs") << laughs + "]><a>&j;</a>";
    QTest::newRow("external entity") << QByteArray("<!DOCTYPE a [<!ENTITY x SYSTEM \"file:///etc/passwd\">]><a>&x;</a>");
    QTest::newRow("deep nesting") << levels(40'000);
    QTest::newRow("deep nesting, never closed") << QByteArray("<l>").repeated(80'000);
    QTest::newRow("only elements") << elements(60'000);
    QTest::newRow("only attributes") << "<a" + QByteArray(" b=\"\"").repeated(40'000) + "/>";
    QTest::newRow("one long name") << "<" + QByteArray(250'000, 'a') + "/>";
    QTest::newRow("only ampersands") << "<a>" + QByteArray(250'000, '&') + "</a>";
    QTest::newRow("many megabytes") << QByteArray(20'000'000, '<');
    QTest::newRow("many errors") << QByteArray("<message-set xmlns=\"urn:liena:message-set:1\">") +
                                        QByteArray("<messag x=\"\"/>").repeated(15'000) + "</message-set>";
}

void XmlScanTest::refusesBombs()
{
    QFETCH(QByteArray, xml);
    const auto text = xml.toStdString();
    Findings findings;
    const auto before = std::clock();
    QVERIFY(!MessageSet::parse(text, "bomb.xml", &findings));
    // Of the processor, so that a busy machine fails no test.
    QVERIFY(std::clock() - before < 2 * CLOCKS_PER_SEC);
    QVERIFY(findings.size() <= FindingList::most + 1);
    QVERIFY(hasErrors(findings));
    for (const auto& finding : findings)
        QVERIFY(finding.toString().size() < 600);
}

void XmlScanTest::countsColumnsFromOneInBytes()
{
    const std::string xml = "<a b=\"größe\" c/>";
    Findings findings;
    QVERIFY(!MessageSet::parse(xml, "x.xml", &findings));
    QCOMPARE(findings[0].toString(), std::string("x.xml:1:16: error: the attribute 'c' has no value; write c=\"…\""));
}

void XmlScanTest::agreesWithTheTreeOnEveryPlace()
{
    const std::string xml =
        "<?xml version=\"1.0\"?>\n<!-- <x> -->\n<a one='&#65;&amp;>'><![CDATA[<no>]]><b two=\"&lt;\"/>t&gt;<c><b\n/></c></a>";
    FindingList list("x.xml", xml);
    const auto document = XmlDocument::read(xml, list);
    QVERIFY(document);
    const auto root = document->root();
    QCOMPARE(root.at(), xml.find("<a"));
    const auto one = root.find("one");
    QVERIFY(one);
    QCOMPARE(std::string(one->value()), std::string("A&>"));
    QCOMPARE(one->nameAt(), xml.find("one"));
    QCOMPARE(one->valueAt(), xml.find("&#65;"));
    const auto children = root.children({"b", "c"});
    QCOMPARE(children.size(), 2U);
    QCOMPARE(children[0].find("two")->valueAt(), xml.find("&lt;"));
    QCOMPARE(children[1].at(), xml.find("<c>"));
    QCOMPARE(children[1].children({"b"}).at(0).at(), xml.rfind("<b"));
}

void XmlScanTest::quotesNothingThatCouldForgeALine()
{
    QCOMPARE(inQuotes("plain"), std::string("'plain'"));
    QCOMPARE(inQuotes("a\nb\x1b[0m"), std::string("'a?b?[0m'"));
    QCOMPARE(inQuotes("a\xE2\x80\xAE"
                      "b\xC2\x9B"),
             std::string("'a?b?'"));
    QCOMPARE(inQuotes("\xFFx"), std::string("'?x'"));
    QCOMPARE(inQuotes(std::string(100, 'a')), "'" + std::string(64, 'a') + "…'");
    QCOMPARE(inQuotes("größe"), std::string("'größe'"));
}

QTEST_APPLESS_MAIN(XmlScanTest)
#include "xml_scan_test.moc"
