// No file means one thing to us and another to the next parser: damaged files, held against libxml2.
#include "marked_text.hpp"
#include "xml_oracle.hpp"

#include "liena/message_set.hpp"
#include "topology/xml_document.hpp"

#include <random>

using namespace liena;
using namespace liena::test;

namespace {

constexpr int rounds = 1'000;

/// A few small damages, of the kind that split parsers: cut, doubled, replaced and inserted bytes and tokens.
std::string damaged(std::string xml, std::mt19937& random)
{
    static const std::vector<std::string> tokens{"<",         ">",         "&",     "\"",    "'",          "<!--", "-->",
                                                 "<![CDATA[", "]]>",       "&amp;", "&#65;", "&#x10FFFF;", "&#0;", "/",
                                                 "/>",        "</field>",  "\xC3",  "\xEF",  "\r\n",       "<a/>", "<?x?>",
                                                 " x=\"1\"",  "<b c='>'>", "=",     "\t",    "--",         "&lt",  "\xE2\x82\xAC"};
    const auto below = [&random](std::size_t end) { return std::uniform_int_distribution<std::size_t>(0, end - 1)(random); };
    for (auto damages = 1 + below(3); damages > 0; --damages) {
        const auto at = below(xml.size());
        const auto length = std::min(xml.size() - at, 1 + below(12));
        switch (below(4)) {
        case 0:
            xml.erase(at, length);
            break;
        case 1:
            xml.insert(at, xml.substr(at, length));
            break;
        case 2:
            xml[at] = static_cast<char>(below(256));
            break;
        default:
            xml.insert(at, tokens[below(tokens.size())]);
        }
    }
    return xml;
}

/// Every element and attribute of the oracle is found by the reader, with the same value.
bool sameTree(const Element& element, const OracleNode& node)
{
    if (element.name() != node.name || element.at() == FindingList::wholeFile)
        return false;
    for (const auto& [name, value] : node.attributes) {
        const auto attribute = element.find(name);
        if (!attribute || attribute->value() != value)
            return false;
    }
    std::vector<std::string_view> known;
    for (const auto& child : node.children)
        known.push_back(child.name);
    const auto children = element.children(known);
    if (children.size() != node.children.size())
        return false;
    for (std::size_t i = 0; i < children.size(); ++i)
        if (!sameTree(children[i], node.children[i]))
            return false;
    return true;
}

} // namespace

class XmlAgreementTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void acceptsOnlyWhatLibxml2ReadsTheSameWay_data();
    void acceptsOnlyWhatLibxml2ReadsTheSameWay();
};

void XmlAgreementTest::acceptsOnlyWhatLibxml2ReadsTheSameWay_data()
{
    QTest::addColumn<QByteArray>("path");
    for (const auto* path : {"resources/devices/siat-cockpit.xml", "resources/devices/arm-grasper.xml", "topologies/cerebrovascular.xml"})
        QTest::newRow(path) << QByteArray(path);
}

void XmlAgreementTest::acceptsOnlyWhatLibxml2ReadsTheSameWay()
{
    QFETCH(QByteArray, path);
    const auto original = bytesOf(sourceFile(path.toStdString())).toStdString();
    std::mt19937 random(20'260'101);
    int accepted = 0;
    int refused = 0;
    for (int round = 0; round < rounds; ++round) {
        const auto xml = damaged(original, random);
        FindingList findings("damaged.xml", xml);
        const auto document = XmlDocument::read(xml, findings);
        const auto again = MessageSet::parse(xml, "damaged.xml");
        if (!document) {
            ++refused;
            QVERIFY(findings.hasErrors());
            QVERIFY(!again);
            continue;
        }
        ++accepted;
        const auto oracle = readDocument(xml);
        QVERIFY2(oracle, xml.c_str());
        QVERIFY2(sameTree(document->root(), treeOf(xmlDocGetRootElement(oracle.get()))), xml.c_str());
    }
    QVERIFY(accepted > rounds / 20);
    QVERIFY(refused > rounds / 20);
}

QTEST_APPLESS_MAIN(XmlAgreementTest)
#include "xml_agreement_test.moc"
