// Hashes, findings, errors, and peer text made safe to print.
#include "liena/error.hpp"
#include "liena/finding.hpp"
#include "liena/hash.hpp"
#include "liena/log.hpp"

#include <QTest>

#include <set>
#include <string>

using namespace liena;

namespace {

Result<int> halve(int value)
{
    if (value % 2 != 0)
        return fail(Errc::ValueRefused, "the value is odd");
    return value / 2;
}

Result<void> check(bool good)
{
    if (!good)
        return fail(Errc::StandBy, "the system stands by");
    return ok();
}

} // namespace

class TextsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void hashesKnownTexts_data();
    void hashesKnownTexts();
    void readsOnlyWholeLowerCaseHashes();
    void makesPeerTextPrintable_data();
    void makesPeerTextPrintable();
    void cutsPeerTextAtWholeCharacters();
    void neverLeavesAnEscapeHalfWritten();
    void writesFindingsForEditors();
    void tellsErrorsFromWarnings();
    void namesEveryErrorOnce();
    void errorsJoinTheStandardLibrary();
    void resultsCarryValueOrError();
    void ranksLogLevels();
};

void TextsTest::hashesKnownTexts_data()
{
    QTest::addColumn<QString>("text");
    QTest::addColumn<QString>("hash");
    // FIPS 180-2, appendix B.
    QTest::newRow("empty") << QString() << QStringLiteral("e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    QTest::newRow("abc") << QStringLiteral("abc") << QStringLiteral("ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    QTest::newRow("two blocks") << QStringLiteral("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq")
                                << QStringLiteral("248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
}

void TextsTest::hashesKnownTexts()
{
    QFETCH(QString, text);
    QFETCH(QString, hash);
    const auto computed = Sha256::of(text.toStdString());
    QCOMPARE(QString::fromStdString(computed.toHex()), hash);
    QVERIFY(Sha256::fromHex(hash.toStdString()) == computed);
}

void TextsTest::readsOnlyWholeLowerCaseHashes()
{
    const std::string good(64, 'a');
    QVERIFY(Sha256::fromHex(good));
    QVERIFY(!Sha256::fromHex(good.substr(1)));
    QVERIFY(!Sha256::fromHex(good + "a"));
    QVERIFY(!Sha256::fromHex(std::string(64, 'A')));
    QVERIFY(!Sha256::fromHex(std::string(63, 'a') + "g"));
    QVERIFY(!Sha256::fromHex(""));
}

void TextsTest::makesPeerTextPrintable_data()
{
    QTest::addColumn<QByteArray>("raw");
    QTest::addColumn<QByteArray>("safe");
    QTest::newRow("plain") << QByteArray("robot 1") << QByteArray("robot 1");
    QTest::newRow("umlaut") << QByteArray("Gr\xC3\xB6\xC3\x9F"
                                          "e")
                            << QByteArray("Gr\xC3\xB6\xC3\x9F"
                                          "e");
    QTest::newRow("line break") << QByteArray("a\nb") << QByteArray("a\\x0ab");
    QTest::newRow("escape sequence") << QByteArray("\x1b[2J") << QByteArray("\\x1b[2J");
    QTest::newRow("delete") << QByteArray("\x7f") << QByteArray("\\x7f");
    QTest::newRow("zero") << QByteArray("a\0b", 3) << QByteArray("a\\x00b");
    QTest::newRow("C1 control") << QByteArray("\xC2\x9B") << QByteArray("\\xc2\\x9b");
    QTest::newRow("no-break space stays") << QByteArray("\xC2\xA0") << QByteArray("\xC2\xA0");
    QTest::newRow("right-to-left override") << QByteArray("\xE2\x80\xAE") << QByteArray("\\xe2\\x80\\xae");
    QTest::newRow("right-to-left mark") << QByteArray("\xE2\x80\x8F") << QByteArray("\\xe2\\x80\\x8f");
    QTest::newRow("isolate") << QByteArray("\xE2\x81\xA6") << QByteArray("\\xe2\\x81\\xa6");
    QTest::newRow("Arabic letter mark") << QByteArray("\xD8\x9C") << QByteArray("\\xd8\\x9c");
    QTest::newRow("line separator") << QByteArray("\xE2\x80\xA8") << QByteArray("\\xe2\\x80\\xa8");
    QTest::newRow("ellipsis stays") << QByteArray("\xE2\x80\xA6") << QByteArray("\xE2\x80\xA6");
    QTest::newRow("lone continuation") << QByteArray("\x80z") << QByteArray("\\x80z");
    QTest::newRow("cut sequence") << QByteArray("\xE2\x82") << QByteArray("\\xe2\\x82");
    QTest::newRow("overlong slash") << QByteArray("\xC0\xAF") << QByteArray("\\xc0\\xaf");
    QTest::newRow("overlong of three") << QByteArray("\xE0\x80\xAF") << QByteArray("\\xe0\\x80\\xaf");
    QTest::newRow("surrogate") << QByteArray("\xED\xA0\x80") << QByteArray("\\xed\\xa0\\x80");
    QTest::newRow("beyond Unicode") << QByteArray("\xF4\x90\x80\x80") << QByteArray("\\xf4\\x90\\x80\\x80");
    QTest::newRow("emoji stays") << QByteArray("\xF0\x9F\xA4\x96") << QByteArray("\xF0\x9F\xA4\x96");
}

void TextsTest::makesPeerTextPrintable()
{
    QFETCH(QByteArray, raw);
    QFETCH(QByteArray, safe);
    QCOMPARE(QByteArray::fromStdString(printable(raw.toStdString())), safe);
}

void TextsTest::cutsPeerTextAtWholeCharacters()
{
    QCOMPARE(printable("abcdef", 6), std::string("abcdef"));
    QCOMPARE(printable("abcdefg", 6), std::string("abcdef…"));
    QCOMPARE(printable("abcd\xC3\xB6", 5), std::string("abcd…"));
    QCOMPARE(printable("", 0), std::string());
}

void TextsTest::neverLeavesAnEscapeHalfWritten()
{
    QCOMPARE(printable("ab\n", 5), std::string("ab…"));
    QCOMPARE(printable("ab\n", 6), std::string("ab\\x0a"));
}

void TextsTest::writesFindingsForEditors()
{
    Finding finding{Severity::Error, "robot.xml", 12, 5, "the message has no number", "add number=\"0x0101\""};
    QCOMPARE(finding.toString(), std::string("robot.xml:12:5: error: the message has no number; add number=\"0x0101\""));
    finding.severity = Severity::Warning;
    finding.remedy.clear();
    QCOMPARE(finding.toString(), std::string("robot.xml:12:5: warning: the message has no number"));
    finding.line = 0;
    QCOMPARE(finding.toString(), std::string("robot.xml: warning: the message has no number"));
}

void TextsTest::tellsErrorsFromWarnings()
{
    const Finding warning{Severity::Warning, "f", 1, 1, "t", ""};
    const Finding error{Severity::Error, "f", 1, 1, "t", ""};
    QVERIFY(!hasErrors({}));
    QVERIFY(!hasErrors({warning}));
    QVERIFY(hasErrors({warning, error}));
}

void TextsTest::namesEveryErrorOnce()
{
    std::set<std::string> names;
    constexpr int last = static_cast<int>(Errc::Stopped);
    for (int code = 1; code <= last; ++code)
        names.insert(std::string(toString(static_cast<Errc>(code))));
    QCOMPARE(names.size(), static_cast<std::size_t>(last));
    QVERIFY(!names.contains(std::string(toString(static_cast<Errc>(last + 1)))));
}

void TextsTest::errorsJoinTheStandardLibrary()
{
    const std::error_code code = Errc::NoLink;
    QVERIFY(code);
    QCOMPARE(std::string(code.category().name()), std::string("liena"));
    QCOMPARE(code.message(), std::string("no link"));
    QVERIFY(code == make_error_code(Error{Errc::NoLink, "whatever"}));
    QVERIFY(code != make_error_code(Errc::Busy));
}

void TextsTest::resultsCarryValueOrError()
{
    QCOMPARE(halve(8).value(), 4);
    const auto failed = halve(7);
    QVERIFY(!failed);
    QVERIFY((failed.error() == Error{Errc::ValueRefused, "the value is odd"}));
    QVERIFY_EXCEPTION_THROWN(static_cast<void>(failed.value()), std::exception);
    QVERIFY(check(true));
    QVERIFY(check(false).error().code == Errc::StandBy);
}

void TextsTest::ranksLogLevels()
{
    QVERIFY(LogLevel::Debug < LogLevel::Info && LogLevel::Info < LogLevel::Warning && LogLevel::Warning < LogLevel::Error);
    QCOMPARE(std::string(toString(LogLevel::Warning)), std::string("warning"));
}

QTEST_APPLESS_MAIN(TextsTest)
#include "texts_test.moc"
