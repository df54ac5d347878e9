// What a console and its player say to each other.
#include "sound/player_words.hpp"

#include <QTest>

using namespace console;
using Kind = PlayerAnswer::Kind;

class TestPlayerWords : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void anOrderIsWhatWasWished()
    {
        for (const auto priority : {AlarmPriority::Low, AlarmPriority::Medium, AlarmPriority::High})
            QCOMPARE(wished(orderOf(priority)), std::optional(priority));
        QCOMPARE(wished(PlayerOrder::Silence), std::optional<AlarmPriority>());
        QCOMPARE(wished(static_cast<PlayerOrder>('x')), std::optional<AlarmPriority>());
    }

    void anAnswerIsReadAsItWasWritten_data()
    {
        QTest::addColumn<Kind>("kind");
        QTest::addColumn<QByteArray>("text");
        QTest::addColumn<QByteArray>("device");
        QTest::newRow("followed") << Kind::Followed << QByteArray() << QByteArray();
        QTest::newRow("sounded") << Kind::Sounded << QByteArray() << QByteArray();
        QTest::newRow("no trouble") << Kind::Trouble << QByteArray() << QByteArray();
        QTest::newRow("trouble") << Kind::Trouble << QByteArray("no sound") << QByteArray();
        QTest::newRow("trouble of a device") << Kind::Trouble << QByteArray("%1 has failed") << QByteArray("Lautsprecher \xc3\xa4");
    }

    void anAnswerIsReadAsItWasWritten()
    {
        QFETCH(Kind, kind);
        QFETCH(QByteArray, text);
        QFETCH(QByteArray, device);
        const auto read = PlayerAnswer::of(PlayerAnswer{kind, {text, device}}.line());
        QVERIFY(read);
        QCOMPARE(read->kind, kind);
        QCOMPARE(read->trouble.text, text);
        QCOMPARE(read->trouble.device, device);
    }

    /// Its name comes from a sound server.
    void aDevicesNameIsOneLine()
    {
        const auto line = PlayerAnswer{Kind::Trouble, {"%1 has failed", "a\tb\n!c"}}.line();
        QCOMPARE(line.count('\n'), 1);
        const auto read = PlayerAnswer::of(line);
        QVERIFY(read);
        QCOMPARE(read->trouble.device, QByteArray("a b !c"));
    }

    void whatIsNoAnswerIsNone_data()
    {
        QTest::addColumn<QByteArray>("line");
        for (const char* line : {"", "\n", ".", "..\n", "?\n", "~ \n", "!\n", "!no tab\n", "!a\tb"})
            QTest::newRow(line) << QByteArray(line);
    }

    void whatIsNoAnswerIsNone()
    {
        QFETCH(QByteArray, line);
        QVERIFY(!PlayerAnswer::of(line));
    }
};

QTEST_GUILESS_MAIN(TestPlayerWords)
#include "test_player_words.moc"
