// Log lines that nobody can forge, as text and as JSON, and causes that are said once.
#include "base/cause_books.hpp"
#include "liena/json_line.hpp"
#include "liena/log.hpp"

#include <QJsonDocument>
#include <QJsonObject>
#include <QTest>

using namespace liena;
using namespace std::chrono_literals;

namespace {

const auto noon = std::chrono::system_clock::time_point(std::chrono::milliseconds(1'767'268'800'123)); // 2026-01-01T12:00:00.123Z

/// What a peer would write to look like somebody else.
const std::vector<std::pair<const char*, std::string>>& attacks()
{
    static const std::vector<std::pair<const char*, std::string>> all{
        {"line break", "bye\n2026-01-01T12:00:00.000Z info the operator confirmed"},
        {"carriage return", "bye\roperator confirmed"},
        {"end of the JSON string", R"(bye","level":"info","text":"the operator confirmed)"},
        {"backslash", R"(bye\)"},
        {"clear screen", "\x1b[2J\x1b[Hoperator confirmed"},
        {"C1 escape", "\xC2\x9B"
                      "2J"},
        {"NUL", std::string("bye\0operator", 12)},
        {"right-to-left override", "\xE2\x80\xAE"
                                   "demrifnoc"},
        {"isolate", "\xE2\x81\xA6hidden"},
        {"line separator", "bye\xE2\x80\xA8operator confirmed"},
        {"no UTF-8", "\xFF\xFE\x80"},
        {"overlong line break", "\xC0\x8A"},
        {"surrogate", "\xED\xA0\x80"},
    };
    return all;
}

bool isHarmless(const std::string& line)
{
    for (const char* part : {"\n", "\r", "\x1b", "\xC2\x9B", "\xE2\x80\xAE", "\xE2\x81\xA6", "\xE2\x80\xA8"})
        if (line.find(part) != std::string::npos)
            return false;
    return line.find('\0') == std::string::npos && QString::fromStdString(line).toStdString() == line;
}

} // namespace

class LogTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void writesTextAsBefore();
    void writesJsonWithItsFields();
    void leavesEmptyFieldsOut();
    void noTextForgesALine_data();
    void noTextForgesALine();
    void noFieldForgesAnother_data() { noTextForgesALine_data(); }
    void noFieldForgesAnother();
    void boundsWhatItWrites();
    void readsItsFormats();
    void takesBothKindsOfFunction();
    void jsonKeepsWhatIsHarmless();
    void jsonWritesNumbersAndTruth();
    void saysACauseOnceAndThenCounts();
    void aFloodOfCausesSharesOneEntry();
    void saysAtOnceWhatBeginsAnew();
};

void LogTest::writesTextAsBefore()
{
    const LogLine line{LogLevel::Warning, "the robot is silent", "session-lost", "robot", "cockpit"};
    QCOMPARE(formatLog(line, LogFormat::Text, noon), std::string("2026-01-01T12:00:00.123Z warning the robot is silent"));
}

void LogTest::writesJsonWithItsFields()
{
    const LogLine line{LogLevel::Warning, "the robot is \"silent\"", "session-lost", "robot", "cockpit"};
    QCOMPARE(formatLog(line, LogFormat::Json, noon),
             std::string(R"({"time":"2026-01-01T12:00:00.123Z","level":"warning","device":"cockpit","event":"session-lost","peer":"robot",)"
                         R"("text":"the robot is \"silent\""})"));
}

void LogTest::leavesEmptyFieldsOut()
{
    QCOMPARE(formatLog({LogLevel::Info, "ready"}, LogFormat::Json, noon),
             std::string(R"({"time":"2026-01-01T12:00:00.123Z","level":"info","text":"ready"})"));
}

void LogTest::noTextForgesALine_data()
{
    QTest::addColumn<std::string>("attack");
    for (const auto& [name, text] : attacks())
        QTest::newRow(name) << text;
}

void LogTest::noTextForgesALine()
{
    QFETCH(std::string, attack);
    for (const auto format : {LogFormat::Text, LogFormat::Json}) {
        const auto line = formatLog({LogLevel::Info, attack}, format, noon);
        QVERIFY2(isHarmless(line), line.c_str());
    }
}

void LogTest::noFieldForgesAnother()
{
    QFETCH(std::string, attack);
    const auto line = formatLog({LogLevel::Error, attack, attack, attack, attack}, LogFormat::Json, noon);
    QVERIFY2(isHarmless(line), line.c_str());
    QJsonParseError error;
    const auto object = QJsonDocument::fromJson(QByteArray::fromStdString(line), &error).object();
    QVERIFY2(error.error == QJsonParseError::NoError, qPrintable(error.errorString()));
    QCOMPARE(object.keys(), (QStringList{"device", "event", "level", "peer", "text", "time"}));
    QCOMPARE(object["level"].toString(), QStringLiteral("error"));
}

void LogTest::boundsWhatItWrites()
{
    const std::string flood(100000, 'x');
    QVERIFY(formatLog({LogLevel::Info, flood}, LogFormat::Text, noon).size() < 2200);
    QVERIFY(formatLog({LogLevel::Info, flood, flood, flood, flood}, LogFormat::Json, noon).size() < 2500);
    QVERIFY(formatLog({LogLevel::Info, std::string(100000, '\n')}, LogFormat::Json, noon).size() < 2200);
}

void LogTest::readsItsFormats()
{
    QVERIFY(logFormatFrom("text") == LogFormat::Text && logFormatFrom("json") == LogFormat::Json);
    QVERIFY(!logFormatFrom("JSON") && !logFormatFrom("") && !logFormatFrom("xml"));
}

void LogTest::takesBothKindsOfFunction()
{
    std::string heard;
    const LogSink plain = [&](LogLevel level, std::string_view text) { heard = std::string(toString(level)) + " " + std::string(text); };
    plain({LogLevel::Error, "one", "event"});
    QCOMPARE(heard, std::string("error one"));
    const LogSink whole = [&](const LogLine& line) { heard = std::string(line.event) + " " + std::string(line.text); };
    whole({LogLevel::Error, "two", "event"});
    QCOMPARE(heard, std::string("event two"));
    whole(LogLevel::Info, "three");
    QCOMPARE(heard, std::string(" three"));
    QVERIFY(plain && !LogSink());
}

void LogTest::jsonKeepsWhatIsHarmless()
{
    QCOMPARE(jsonText("Größe 5 µm 🤖"), std::string("\"Größe 5 µm 🤖\""));
    QCOMPARE(jsonText("a\"b\\c\td"), std::string(R"("a\"b\\c\u0009d")"));
    QCOMPARE(jsonText("\xE2\x80\xAE"), std::string(R"("\u202e")"));
    QCOMPARE(jsonText("\xC2\x9B"), std::string(R"("\u009b")"));
    QCOMPARE(jsonText("\xFF"), std::string(R"("\\xff")"));
    QCOMPARE(jsonText("abcdef", 3), std::string("\"abc…\""));
    QCOMPARE(jsonText("ab\n", 4), std::string("\"ab…\""));
}

void LogTest::jsonWritesNumbersAndTruth()
{
    JsonLine line;
    line.add("a", std::uint64_t{18446744073709551615ULL}).add("b", -3).add("c", 1.5).add("d", true).put("e", "[]");
    line.add("f", std::numeric_limits<double>::quiet_NaN());
    QCOMPARE(line.text(), std::string(R"({"a":18446744073709551615,"b":-3,"c":1.500,"d":true,"e":[],"f":null})"));
    QCOMPARE(JsonLine().text(), std::string("{}"));
}

void LogTest::saysACauseOnceAndThenCounts()
{
    base::CauseBooks book(64);
    const base::CauseBooks::Instant start{};
    QCOMPARE(book.count("a", 0, start).value_or(0), 1U);
    for (int i = 0; i < 1000; ++i)
        QVERIFY(!book.count("a", 0, start + 9s));
    QCOMPARE(book.count("b", 0, start + 9s).value_or(0), 1U);
    QCOMPARE(book.count("a", 0, start + 10s).value_or(0), 1001U);
    QVERIFY(!book.count("a", 0, start + 11s));
    QCOMPARE(base::timesText(1), std::string());
    QCOMPARE(base::timesText(1001), std::string(" (1001 times)"));
}

void LogTest::aFloodOfCausesSharesOneEntry()
{
    base::CauseBooks book(4);
    const base::CauseBooks::Instant start{};
    int said = 0;
    for (int i = 0; i < 1000; ++i)
        said += book.count("cause " + std::to_string(i), 0, start) ? 1 : 0;
    QCOMPARE(said, 5); // four of their own, and the first of the others
    QCOMPARE(book.count("cause 999", 0, start + 10s).value_or(0), 996U);
    QCOMPARE(book.count("cause 0", 0, start + 10s).value_or(0), 1U);
}

void LogTest::saysAtOnceWhatBeginsAnew()
{
    base::CauseBooks book(64);
    const base::CauseBooks::Instant start{};
    QVERIFY(book.count("a", 0, start));
    QVERIFY(!book.count("a", 0, start));
    book.forget();
    QVERIFY(book.count("a", 0, start));
}

QTEST_APPLESS_MAIN(LogTest)
#include "log_test.moc"
