// Topologies and message sets checked together.
#include "marked_text.hpp"

#include "liena/system_topology.hpp"

#include <QTemporaryDir>

using namespace liena;
using namespace liena::test;

namespace {

const QByteArray handSet =
    R"(<message-set xmlns="urn:liena:message-set:1" name="hand-set" version="1" class="hand" manufacturer="1" type="1" device-version="1">
<message name="Move" number="0x0100" role="command" priority="control"/>
<message name="Both" number="0x0101" role="command" priority="status"/>
<message name="State" number="0x0200" role="report" priority="status"/>
</message-set>)";

const QByteArray brainSet =
    R"(<message-set xmlns="urn:liena:message-set:1" name="brain-set" version="1" class="brain" manufacturer="3" type="1" device-version="1">
<message name="Show" number="0x0100" role="command" priority="status"/>
<message name="Both" number="0x0200" role="report" priority="status"/>
</message-set>)";

QByteArray topology(const QByteArray& inLink)
{
    return R"(<topology xmlns="urn:liena:topology:1" name="t" version="1">
<device name="brain" id="0x40018208" message-set="brain-set" host="127.0.0.1" port="1"/>
<device name="hand" id="0x00008209" message-set="hand-set" host="127.0.0.1" port="2"/>
<link between="brain hand">)" +
           inLink + "</link>\n</topology>";
}

} // namespace

class CheckFilesTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void checksFlows_data();
    void checksFlows();
    void warnsOfCommandsThatOutliveNoHeartbeat_data();
    void warnsOfCommandsThatOutliveNoHeartbeat();
    void warnsOfDeviceWithoutSet();
    void warnsOfSetWithAnotherName();
    void saysNothingOfSetsWhenNoneAreGiven();
    void refusesSecondSetOfOneDeviceType();
    void countsOneFileGivenTwiceOnce();
    void refusesOtherRootsAndUnreadableFiles();
    void keepsTheOrderOfTheFiles();

private:
    std::filesystem::path write(const char* name, const QByteArray& bytes);
    Findings checked(const std::vector<std::filesystem::path>& files) { return checkFiles(files); }

    QTemporaryDir m_folder;
};

std::filesystem::path CheckFilesTest::write(const char* name, const QByteArray& bytes)
{
    QFile file(m_folder.filePath(QLatin1String(name)));
    if (!file.open(QIODevice::WriteOnly) || file.write(bytes) != bytes.size())
        qFatal("the test's file cannot be written");
    return file.fileName().toStdString();
}

void CheckFilesTest::checksFlows_data()
{
    QTest::addColumn<QByteArray>("flow");
    QTest::addColumn<QByteArray>("fragment");
    const auto row = [](const char* name, const char* flow, const char* fragment) {
        QTest::newRow(name) << QByteArray(flow) << QByteArray(fragment);
    };
    row("report of from", "<flow message=\"State\" from=\"hand\"/>", "");
    row("command of the other", "<flow message=\"Move\" from=\"brain\"/>", "");
    row("command from its own device", "<flow message=\"@@Move\" from=\"hand\"/>", "write from=\"brain\"");
    row("report from the other", "<flow message=\"@@State\" from=\"brain\"/>", "flows from 'hand' to 'brain'");
    row("misspelt", "<flow message=\"@@Stat\" from=\"hand\"/>", "did you mean 'State'?");
    row("unknown", "<flow message=\"@@Weather\" from=\"hand\"/>", "neither a report of 'hand' nor a command of 'brain'");
    row("both", "<flow message=\"@@Both\" from=\"brain\"/>", "both a report of 'brain' and a command of 'hand'");
    row("session management", "<flow message=\"@@Heartbeat\" from=\"hand\"/>", "neither");
}

void CheckFilesTest::checksFlows()
{
    QFETCH(QByteArray, flow);
    QFETCH(QByteArray, fragment);
    const auto input = unmarked(topology(flow).toStdString());
    const auto findings =
        checked({write("t.xml", QByteArray::fromStdString(input.text)), write("hand.xml", handSet), write("brain.xml", brainSet)});
    if (fragment.isEmpty())
        QVERIFY2(findings.empty(), listed(findings).c_str());
    else
        QVERIFY2(findings.size() == 1 && holds(findings, Severity::Error, input, fragment.toStdString()), listed(findings).c_str());
}

void CheckFilesTest::warnsOfCommandsThatOutliveNoHeartbeat_data()
{
    QTest::addColumn<QByteArray>("age");
    QTest::addColumn<QByteArray>("inLink");
    QTest::addColumn<bool>("warned");
    const QByteArray timing = R"(<timing heartbeat="25ms" suspect="70ms" lost="110ms" reconnect="500ms"/>)";
    QTest::newRow("twice as old") << QByteArray("50ms") << timing << false;
    QTest::newRow("nearly") << QByteArray("49ms") << timing << true;
    QTest::newRow("as old as the link's lost") << QByteArray() << timing << false;
    QTest::newRow("does not flow") << QByteArray("20ms") << timing + "<flow message=\"State\" from=\"hand\"/>" << false;
    QTest::newRow("flows") << QByteArray("20ms") << timing + "<flow message=\"Move\" from=\"brain\"/>" << true;
}

void CheckFilesTest::warnsOfCommandsThatOutliveNoHeartbeat()
{
    QFETCH(QByteArray, age);
    QFETCH(QByteArray, inLink);
    QFETCH(bool, warned);
    auto set = handSet;
    if (!age.isEmpty())
        set.replace("priority=\"control\"", "priority=\"control\" max-age=\"" + age + "\"");
    const auto input = unmarked(topology(inLink).replace("<link", "@@<link").toStdString());
    const auto findings =
        checked({write("t.xml", QByteArray::fromStdString(input.text)), write("hand.xml", set), write("brain.xml", brainSet)});
    if (warned)
        QVERIFY2(findings.size() == 1 && holds(findings, Severity::Warning, input, "twice as fast"), listed(findings).c_str());
    else
        QVERIFY2(findings.empty(), listed(findings).c_str());
}

void CheckFilesTest::warnsOfDeviceWithoutSet()
{
    const auto input =
        unmarked(topology("<flow message=\"Anything\" from=\"hand\"/>").replace("id=\"0x00008209", "id=\"@@0x00008209").toStdString());
    const auto findings = checked({write("t.xml", QByteArray::fromStdString(input.text)), write("brain.xml", brainSet)});
    QVERIFY2(findings.size() == 1 && holds(findings, Severity::Warning, input, "no message set among the files describes 0x00008208"),
             listed(findings).c_str());
}

void CheckFilesTest::warnsOfSetWithAnotherName()
{
    const auto input = unmarked(topology("").replace("\"hand-set\"", "\"@@foot-set\"").toStdString());
    const auto findings =
        checked({write("t.xml", QByteArray::fromStdString(input.text)), write("hand.xml", handSet), write("brain.xml", brainSet)});
    QVERIFY2(findings.size() == 1 && holds(findings, Severity::Warning, input, "'hand-set'"), listed(findings).c_str());
}

void CheckFilesTest::saysNothingOfSetsWhenNoneAreGiven()
{
    const auto findings = checked({write("t.xml", topology("<flow message=\"Anything\" from=\"hand\"/>"))});
    QVERIFY2(findings.empty(), listed(findings).c_str());
}

void CheckFilesTest::refusesSecondSetOfOneDeviceType()
{
    const auto first = write("hand.xml", handSet);
    const auto second = write("other.xml", QByteArray(handSet).replace("hand-set", "other-set"));
    const auto findings = checked({first, second});
    QCOMPARE(findings.size(), 1U);
    QCOMPARE(findings[0].file, second.string());
    QCOMPARE(findings[0].line, 1);
    QVERIFY(findings[0].column > 1);
    QVERIFY2(findings[0].text.find(first.string()) != std::string::npos, listed(findings).c_str());
}

void CheckFilesTest::countsOneFileGivenTwiceOnce()
{
    const auto file = write("hand.xml", handSet);
    QVERIFY(checked({file, file, file.parent_path() / "." / file.filename()}).empty());
}

void CheckFilesTest::refusesOtherRootsAndUnreadableFiles()
{
    const auto findings = checked(
        {write("page.xml", "<html/>"), m_folder.filePath(QStringLiteral("missing.xml")).toStdString(), write("broken.xml", "<topology>")});
    QCOMPARE(findings.size(), 3U);
    QVERIFY(findings[0].remedy.find("<message-set> or <topology>") != std::string::npos);
    QVERIFY(findings[1].text.find("cannot be opened") != std::string::npos);
    QVERIFY(findings[2].text.find("not closed") != std::string::npos);
}

void CheckFilesTest::keepsTheOrderOfTheFiles()
{
    const auto wrong = QByteArray(handSet).replace("0x0200", "0x0300x").replace("0x0100", "0x0001");
    const auto findings = checked({write("t.xml", topology("").replace("hand-set", "1")), write("hand.xml", wrong)});
    QCOMPARE(findings.size(), 3U);
    QVERIFY(findings[0].file.ends_with("t.xml"));
    QCOMPARE(findings[1].line, 2);
    QCOMPARE(findings[2].line, 4);
}

QTEST_APPLESS_MAIN(CheckFilesTest)
#include "check_files_test.moc"
