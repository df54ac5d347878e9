// The audit file: what is noticed when somebody or something changes it, and what a crash leaves.
#include "audit/audit_file.hpp"
#include "file_content.hpp"
#include "liena/audit.hpp"

#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>
#include <QTest>

#include <fstream>
#include <memory>
#include <random>
#include <sstream>

#include <sys/stat.h>

using namespace liena;
using namespace liena::audit;
using liena::test::contentOf;
using liena::test::write;

namespace {

std::vector<std::string> linesOf(const std::string& content)
{
    std::vector<std::string> lines;
    std::istringstream stream(content);
    for (std::string line; std::getline(stream, line);)
        lines.push_back(line);
    return lines;
}

std::string joined(const std::vector<std::string>& lines)
{
    std::string content;
    for (const auto& line : lines)
        content += line + "\n";
    return content;
}

Entry entry(const std::string& event, const std::string& text = "a text")
{
    Entry made;
    made.event = event;
    made.text = text;
    made.when = std::chrono::system_clock::time_point(std::chrono::hours(500000));
    return made;
}

} // namespace

class AuditFileTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void init();
    void anEmptyFileIsWhole();
    void writesOneJsonObjectPerLine();
    void goesOnWhereItEnded();
    void hashesAsItsPageSays();
    void namesTheFirstLineThatIsWrong_data();
    void namesTheFirstLineThatIsWrong();
    void everyByteCounts();
    void noticesEntriesCutOffAtTheEnd();
    void noticesCutEntriesByAHashKeptElsewhere();
    void findsAnExpectedHashThatOthersFollow();
    void marksEntriesThatWereCutOffBeforeAStart();
    void goesOnAfterACrashInTheMiddleOfALine_data();
    void goesOnAfterACrashInTheMiddleOfALine();
    void adoptsALineThatOnlyLacksItsEnd();
    void noticesWhoPassesChangesOffAsACrash();
    void noTextForgesALineOrAField();
    void refusesWhatIsNoAuditFile_data();
    void refusesWhatIsNoAuditFile();
    void refusesASecondWriter();
    void refusesToGoOnWhenTheFileWasMoved();
    void isForItsUserAlone();

private:
    /// Five entries, closed.
    void fill(int count = 5)
    {
        auto file = AuditFile::open(m_file, "robot");
        QVERIFY2(file, file ? "" : file.error().what.c_str());
        for (int i = 0; i < count; ++i)
            QVERIFY(file.value().append(entry("session-opened", "number " + std::to_string(i))));
        QVERIFY(file.value().sync());
    }
    AuditVerdict verdict(const std::optional<Sha256>& expected = std::nullopt) const { return verifyAudit(m_file, expected).value(); }

    std::unique_ptr<QTemporaryDir> m_folder;
    std::filesystem::path m_file;
};

void AuditFileTest::init()
{
    m_folder = std::make_unique<QTemporaryDir>();
    m_file = std::filesystem::path(m_folder->path().toStdString()) / "audit.jsonl";
}

void AuditFileTest::anEmptyFileIsWhole()
{
    fill(0);
    QVERIFY(verdict().sound());
    QCOMPARE(verdict().entries, std::uint64_t(0));
    QVERIFY(!verifyAudit(m_file.string() + ".missing"));
}

void AuditFileTest::writesOneJsonObjectPerLine()
{
    auto file = AuditFile::open(m_file, "robot").value();
    auto one = entry("incident-dismissed", "sent to repair");
    one.peer = "cockpit", one.who = "arm", one.incident = 0x1f, one.byApplication = true;
    QVERIFY(file.append(one));
    const auto object = QJsonDocument::fromJson(QByteArray::fromStdString(linesOf(contentOf(m_file)).front())).object();
    QCOMPARE(object["n"].toInt(), 1);
    QCOMPARE(object["event"].toString(), QStringLiteral("incident-dismissed"));
    QCOMPARE(object["device"].toString(), QStringLiteral("robot"));
    QCOMPARE(object["peer"].toString(), QStringLiteral("cockpit"));
    QCOMPARE(object["who"].toString(), QStringLiteral("arm"));
    QCOMPARE(object["incident"].toString(), QStringLiteral("000000000000001f"));
    QCOMPARE(object["by"].toString(), QStringLiteral("application"));
    QCOMPARE(object["text"].toString(), QStringLiteral("sent to repair"));
    QCOMPARE(object["hash"].toString().size(), 64);
}

void AuditFileTest::goesOnWhereItEnded()
{
    fill(3);
    fill(2);
    const auto found = verdict();
    QVERIFY2(found.sound(), found.fault.c_str());
    QCOMPARE(found.entries, std::uint64_t(5));
    QVERIFY(found.remarks.empty());
}

/// Written here again, as another program would do it.
void AuditFileTest::hashesAsItsPageSays()
{
    fill();
    std::string previous(64, '0');
    for (const auto& line : linesOf(contentOf(m_file))) {
        const auto at = line.rfind(",\"hash\":\"");
        const auto hash = line.substr(at + 9, 64);
        QCOMPARE(Sha256::of(previous + line.substr(0, at)).toHex(), hash);
        previous = hash;
    }
    QCOMPARE(verdict().head.toHex(), previous);
}

void AuditFileTest::namesTheFirstLineThatIsWrong_data()
{
    using Lines = std::vector<std::string>;
    QTest::addColumn<std::function<void(Lines&)>>("change");
    QTest::addColumn<int>("line");
    QTest::addColumn<QString>("words");
    const auto row = [](const char* name, std::function<void(Lines&)> change, int line, const char* words) {
        QTest::newRow(name) << std::move(change) << line << QString::fromLatin1(words);
    };
    row(
        "a text changed", [](Lines& l) { l[2].replace(l[2].find("number 2"), 8, "number 9"); }, 3, "was altered");
    row(
        "a hash changed", [](Lines& l) { l[2][l[2].size() - 5] = l[2][l[2].size() - 5] == 'a' ? 'b' : 'a'; }, 3, "was altered");
    row(
        "a line removed", [](Lines& l) { l.erase(l.begin() + 2); }, 3, "entry 3 is missing");
    row(
        "two lines removed", [](Lines& l) { l.erase(l.begin() + 1, l.begin() + 3); }, 2, "entries 2 to 3 are missing");
    row(
        "the first line removed", [](Lines& l) { l.erase(l.begin()); }, 1, "entry 1 is missing");
    row(
        "two lines swapped", [](Lines& l) { std::swap(l[1], l[2]); }, 2, "missing");
    row(
        "a line twice", [](Lines& l) { l.insert(l.begin() + 2, l[1]); }, 3, "again");
    row(
        "a line of garbage", [](Lines& l) { l.insert(l.begin() + 2, "garbage"); }, 3, "is no audit entry");
    row(
        "an empty line", [](Lines& l) { l.insert(l.begin() + 2, ""); }, 3, "is no audit entry");
    row(
        "garbage at the end", [](Lines& l) { l.push_back("garbage"); }, 6, "is no audit entry");
    row(
        "removed and renumbered", [](Lines& l) { l.erase(l.begin() + 2), l[2].replace(0, 6, "{\"n\":3"), l[3].replace(0, 6, "{\"n\":4"); },
        3, "was altered");
}

void AuditFileTest::namesTheFirstLineThatIsWrong()
{
    QFETCH(std::function<void(std::vector<std::string>&)>, change);
    QFETCH(int, line);
    QFETCH(QString, words);
    fill();
    auto lines = linesOf(contentOf(m_file));
    change(lines);
    write(m_file, joined(lines));
    const auto found = verdict();
    QCOMPARE(found.line, static_cast<std::uint64_t>(line));
    QVERIFY2(QString::fromStdString(found.fault).contains(words), found.fault.c_str());
    QCOMPARE(found.entries, static_cast<std::uint64_t>(line > 5 ? 5 : line - 1));
}

void AuditFileTest::everyByteCounts()
{
    fill();
    const auto good = contentOf(m_file);
    std::mt19937 random(20260101);
    for (int i = 0; i < 500; ++i) {
        auto changed = good;
        const auto at = random() % good.size();
        changed[at] = static_cast<char>(changed[at] ^ (1 << random() % 7));
        write(m_file, changed);
        const auto found = verdict();
        const auto line = static_cast<std::uint64_t>(std::count(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(at), '\n') + 1);
        QVERIFY2(!found.sound(), qPrintable(QStringLiteral("byte %1 can be changed").arg(at)));
        QVERIFY(found.line == line || good[at] == '\n' || changed[at] == '\n');
    }
}

void AuditFileTest::noticesEntriesCutOffAtTheEnd()
{
    fill();
    auto lines = linesOf(contentOf(m_file));
    lines.resize(3);
    write(m_file, joined(lines));
    auto found = verdict();
    QCOMPARE(found.line, std::uint64_t(4));
    QVERIFY2(found.fault.find("5 entries had been written and 3 are there") != std::string::npos, found.fault.c_str());
    write(m_file, contentOf(m_file).substr(0, contentOf(m_file).size() - 20));
    found = verdict();
    QCOMPARE(found.line, std::uint64_t(3));
    QVERIFY(found.fault.find("cut off in its middle") != std::string::npos);
}

void AuditFileTest::noticesCutEntriesByAHashKeptElsewhere()
{
    fill();
    const auto head = verdict().head;
    QVERIFY(verdict(head).sound());
    auto lines = linesOf(contentOf(m_file));
    lines.pop_back();
    write(m_file, joined(lines));
    std::filesystem::remove(headFileOf(m_file)); // whoever cuts the file removes that as well
    QVERIFY(verdict().sound());
    QCOMPARE(verdict().remarks.size(), std::size_t(1));
    QVERIFY(!verdict(head).sound());
    // And who writes a whole new history, consistent in itself, with the head file to it:
    std::filesystem::remove(m_file);
    fill();
    write(m_file, contentOf(m_file));
    QVERIFY(verdict().sound());
    std::filesystem::remove(m_file);
    std::filesystem::remove(headFileOf(m_file));
    fill(7);
    QVERIFY(verdict().sound());
    QVERIFY(!verdict(Sha256::of("another")).sound());
}

void AuditFileTest::findsAnExpectedHashThatOthersFollow()
{
    fill(3);
    const auto anchor = verdict().head;
    fill(4);
    const auto found = verdict(anchor);
    QVERIFY2(found.sound(), found.fault.c_str());
    QCOMPARE(found.anchor.value(), std::uint64_t(3));
    QCOMPARE(found.entries, std::uint64_t(7));
}

void AuditFileTest::marksEntriesThatWereCutOffBeforeAStart()
{
    fill();
    auto lines = linesOf(contentOf(m_file));
    lines.resize(3);
    write(m_file, joined(lines));
    {
        const auto file = AuditFile::open(m_file, "robot").value();
        QCOMPARE(file.remarks().size(), std::size_t(1));
    }
    fill(4); // the head file is in step again, and the mark stays
    const auto found = verdict();
    QCOMPARE(found.line, std::uint64_t(4));
    QVERIFY2(found.fault.find("had been cut off before it") != std::string::npos, found.fault.c_str());
}

void AuditFileTest::goesOnAfterACrashInTheMiddleOfALine_data()
{
    QTest::addColumn<QByteArray>("left");
    QTest::newRow("one byte") << QByteArray("{");
    QTest::newRow("half a line") << QByteArray("{\"n\":6,\"time\":\"2026-01-01T12:00:00.000Z\",\"ev");
    QTest::newRow("zeros of a journal") << QByteArray(4096, '\0');
    QTest::newRow("a line that is no entry") << QByteArray("{\"n\":6,\"hash\":\"") + QByteArray(64, 'a') + "\"}";
}

void AuditFileTest::goesOnAfterACrashInTheMiddleOfALine()
{
    QFETCH(QByteArray, left);
    for (const int before : {5, 0}) {
        init();
        fill(before);
        write(m_file, contentOf(m_file) + left.toStdString());
        QVERIFY(!verdict().sound());
        fill(3);
        const auto found = verdict();
        QVERIFY2(found.sound(), found.fault.c_str());
        QCOMPARE(found.entries, static_cast<std::uint64_t>(before + 4)); // and the mark
        QCOMPARE(found.remarks.size(), std::size_t(1));
        QVERIFY(contentOf(m_file).find(left.toStdString()) != std::string::npos);
    }
}

void AuditFileTest::adoptsALineThatOnlyLacksItsEnd()
{
    fill();
    const auto whole = contentOf(m_file);
    write(m_file, whole.substr(0, whole.size() - 1));
    fill(1);
    const auto found = verdict();
    QVERIFY2(found.sound(), found.fault.c_str());
    QCOMPARE(found.entries, std::uint64_t(6));
    QVERIFY(found.remarks.empty());
}

void AuditFileTest::noticesWhoPassesChangesOffAsACrash()
{
    fill();
    write(m_file, contentOf(m_file) + "half a li");
    fill(2);
    QVERIFY(verdict().sound());
    auto lines = linesOf(contentOf(m_file));
    QCOMPARE(lines[5], std::string("half a li"));
    auto changed = lines;
    changed[5] = "half a lie";
    write(m_file, joined(changed));
    QCOMPARE(verdict().line, std::uint64_t(6));
    changed = lines;
    changed.erase(changed.begin() + 5);
    write(m_file, joined(changed));
    QCOMPARE(verdict().line, std::uint64_t(6));
    changed = lines;
    changed[1] = "garbage instead of an entry";
    write(m_file, joined(changed));
    QCOMPARE(verdict().line, std::uint64_t(2));
}

void AuditFileTest::noTextForgesALineOrAField()
{
    const std::string attack =
        "x\n{\"n\":2,\"event\":\"session-reopened\"}\",\"event\":\"recovered\",\"damaged\":\"\xE2\x80\xAE\x1b[2J\",\"hash\":\"" +
        std::string(64, 'a') + "\"}";
    {
        auto file = AuditFile::open(m_file, "robot").value();
        auto one = entry("open-failed", attack);
        one.peer = one.who = attack;
        QVERIFY(file.append(one));
        QVERIFY(file.append(entry("stop")));
        QVERIFY(file.sync());
    }
    const auto found = verdict();
    QVERIFY2(found.sound(), found.fault.c_str());
    QCOMPARE(found.entries, std::uint64_t(2));
    const auto lines = linesOf(contentOf(m_file));
    QCOMPARE(lines.size(), std::size_t(2));
    QVERIFY(lines[0].size() < longestLine);
    QJsonParseError error;
    const auto object = QJsonDocument::fromJson(QByteArray::fromStdString(lines[0]), &error).object();
    QCOMPARE(error.error, QJsonParseError::NoError);
    QCOMPARE(object["event"].toString(), QStringLiteral("open-failed"));
    QVERIFY(!object.contains("damaged"));
}

void AuditFileTest::refusesWhatIsNoAuditFile_data()
{
    QTest::addColumn<QString>("what");
    for (const char* what : {"text", "text without an end", "a long line", "a folder", "a pipe", "a link", "nowhere"})
        QTest::newRow(what) << QString::fromLatin1(what);
}

void AuditFileTest::refusesWhatIsNoAuditFile()
{
    QFETCH(QString, what);
    const std::string text = "root:x:0:0:root:/root:/bin/bash\n";
    const auto other = m_file.string() + ".other";
    if (what == QLatin1String("text"))
        write(m_file, text);
    else if (what == QLatin1String("text without an end"))
        write(m_file, text + text + "last");
    else if (what == QLatin1String("a long line"))
        write(m_file, std::string(200000, 'x'));
    else if (what == QLatin1String("a folder"))
        std::filesystem::create_directory(m_file);
    else if (what == QLatin1String("a pipe"))
        QCOMPARE(::mkfifo(m_file.c_str(), 0600), 0);
    else if (what == QLatin1String("a link"))
        write(other, ""), std::filesystem::create_symlink(other, m_file);
    else
        m_file = m_file.parent_path() / "missing" / "audit.jsonl";
    const auto before = what.startsWith(QLatin1String("text")) ? contentOf(m_file) : std::string();
    const auto opened = AuditFile::open(m_file, "robot");
    QVERIFY(!opened);
    QVERIFY2(opened.error().what.find(m_file.string()) != std::string::npos, opened.error().what.c_str());
    if (!before.empty())
        QCOMPARE(contentOf(m_file), before);
}

void AuditFileTest::refusesASecondWriter()
{
    const auto first = AuditFile::open(m_file, "robot");
    QVERIFY(first);
    const auto second = AuditFile::open(m_file, "arm");
    QVERIFY(!second);
    QVERIFY(second.error().what.find("another program writes it") != std::string::npos);
}

void AuditFileTest::refusesToGoOnWhenTheFileWasMoved()
{
    auto file = AuditFile::open(m_file, "robot").value();
    QVERIFY(file.append(entry("start")));
    const auto away = m_file.string() + ".1";
    std::filesystem::rename(m_file, away);
    const auto refused = file.append(entry("stop"));
    QVERIFY(!refused);
    QVERIFY(refused.error().what.find("moved or removed") != std::string::npos);
    write(m_file, "somebody else's\n");
    QVERIFY(!file.append(entry("stop")));
    std::filesystem::rename(away, m_file);
    QVERIFY(file.append(entry("stop")));
}

void AuditFileTest::isForItsUserAlone()
{
    fill(1);
    for (const auto& one : {m_file, headFileOf(m_file)}) {
        struct stat status {};
        QCOMPARE(::stat(one.c_str(), &status), 0);
        QCOMPARE(static_cast<int>(status.st_mode & 0777U), 0600);
    }
}

QTEST_APPLESS_MAIN(AuditFileTest)
#include "audit_file_test.moc"
