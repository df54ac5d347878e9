// Words for people in a message: whatever they are, the message leaves.
#include "support/sample_set.hpp"

#include <QTest>

using namespace liena;
using namespace liena::test;

class PrintableFieldsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    /// The field holds twelve bytes.
    void takesWhateverWords_data()
    {
        QTest::addColumn<QByteArray>("words");
        QTest::addColumn<QByteArray>("held");
        QTest::newRow("none") << QByteArray() << QByteArray();
        QTest::newRow("fit") << QByteArray("smoke, fire!") << QByteArray("smoke, fire!");
        QTest::newRow("one too many") << QByteArray("smoke, fire!!") << QByteArray("smoke, fi…");
        QTest::newRow("Chinese, fit") << QByteArray("出血出血") << QByteArray("出血出血");
        QTest::newRow("Chinese, too many") << QByteArray("出血出血出") << QByteArray("出血出…");
        QTest::newRow("cut in a character") << QByteArray("0123456789血") << QByteArray("012345678…");
        QTest::newRow("GBK") << QByteArray("\xB3\xF6") << QByteArray("\\xb3\\xf6");
        QTest::newRow("GBK, too many") << QByteArray("\xB3\xF6\xB3\xF6") << QByteArray("\\xb3\\xf6…");
        QTest::newRow("Latin-1") << QByteArray("f\xFCr") << QByteArray("f\\xfcr");
        QTest::newRow("half a character") << QByteArray("a\xE8\xA1") << QByteArray("a\\xe8\\xa1");
        QTest::newRow("a line's end") << QByteArray("a\nb") << QByteArray("a\\x0ab");
    }

    void takesWhateverWords()
    {
        QFETCH(QByteArray, words);
        QFETCH(QByteArray, held);
        auto state = sampleMessage(sampleSet(), "State");
        state.set("note", "before").setPrintable("note", words.toStdString()).set("count", 3);
        QVERIFY2(!state.fault(), state.fault() ? state.fault()->what.c_str() : "");
        QCOMPARE(QByteArray::fromStdString(state.get<std::string>("note")), held);
        QCOMPARE(state.get<int>("count"), 3);
    }

    void ofAFieldWithoutRoomForTheMarkNothingIsLeft()
    {
        const auto set = MessageSet::parse(R"(<message-set xmlns="urn:liena:message-set:1" name="narrow" version="1.0" class="hand"
            manufacturer="7" type="3" device-version="1" vendor="Sample" title="A narrow field">
          <message number="0x0100" name="Stop" role="command" priority="safety" title="Stops">
            <field name="reason" type="string" max-length="2" title="Why"/>
          </message></message-set>)",
                                           "narrow.xml");
        QVERIFY(set);
        auto stop = sampleMessage(set.value(), "Stop");
        stop.setPrintable("reason", "ab");
        QVERIFY(stop.get<std::string_view>("reason") == "ab");
        stop.setPrintable("reason", "abc");
        QVERIFY(!stop.fault());
        QVERIFY(stop.get<std::string_view>("reason").empty());
    }

    void whatHoldsNoWordsIsAMistakeOfTheProgram()
    {
        auto state = sampleMessage(sampleSet(), "State");
        QVERIFY_EXCEPTION_THROWN(state.setPrintable("count", "five"), std::logic_error);
        QVERIFY_EXCEPTION_THROWN(state.setPrintable("mode", "fast"), std::logic_error);
        QVERIFY_EXCEPTION_THROWN(state.setPrintable("nothing", "five"), std::logic_error);
    }
};

QTEST_APPLESS_MAIN(PrintableFieldsTest)
#include "printable_fields_test.moc"
