// Which window goes where, and layouts that are kept: odd names, broken files.
#include "app/layout_book.hpp"

#include <QDir>
#include <QFile>
#include <QTemporaryDir>
#include <QTest>

using namespace console;

namespace {

const ScreenLayout three{QStringLiteral("all"), Arrangement::Usual, QStringLiteral("a"), QStringLiteral("b"), QStringLiteral("c")};

struct Folder {
    QTemporaryDir folder;
    QString path = folder.filePath(QStringLiteral("layouts.json"));

    void put(const QByteArray& text) const
    {
        QFile file(path);
        if (!file.open(QIODevice::WriteOnly) || file.write(text) != text.size())
            qFatal("cannot prepare the file");
    }

    static QByteArray contents(const QString& name)
    {
        QFile file(name);
        return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
    }
};

} // namespace

class TestScreenPlan : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void everythingFoldsOntoWhatIsLeftTheCockpitFirst_data()
    {
        QTest::addColumn<QStringList>("screens");
        QTest::addColumn<QStringList>("windows");
        QTest::addColumn<bool>("folded");
        const auto row = [](const char* name, const QString& screens, const QStringList& windows, bool folded) {
            QTest::newRow(name) << screens.split(QLatin1Char(' '), Qt::SkipEmptyParts) << windows << folded;
        };
        const QString a = QStringLiteral("a");
        const QString b = QStringLiteral("b");
        const QString c = QStringLiteral("c");
        row("all there", QStringLiteral("a b c"), {a, b, c}, false);
        row("order is no matter", QStringLiteral("c b a"), {a, b, c}, false);
        row("third gone", QStringLiteral("a b"), {a, b, {}}, true);
        row("second gone", QStringLiteral("a c"), {a, {}, c}, true);
        row("cockpit's gone", QStringLiteral("b c"), {b, {}, c}, true);
        row("cockpit's gone, third primary", QStringLiteral("c b"), {c, b, {}}, true);
        row("one left", QStringLiteral("c"), {c, {}, {}}, true);
        row("another one left", QStringLiteral("x"), {QStringLiteral("x"), {}, {}}, true);
        row("none", QString(), {{}, {}, {}}, true);
    }

    void everythingFoldsOntoWhatIsLeftTheCockpitFirst()
    {
        QFETCH(QStringList, screens);
        QFETCH(QStringList, windows);
        QFETCH(bool, folded);
        const ScreenPlan plan = planFor(three, screens);
        QCOMPARE((QStringList{plan.cockpit, plan.second, plan.third}), windows);
        QCOMPARE(plan.folded, folded);
    }

    void noScreenHasTwoWindows()
    {
        const QStringList names{QStringLiteral("a"), QStringLiteral("b"), QStringLiteral("c"), QString()};
        for (const QString& cockpit : names)
            for (const QString& second : names)
                for (const QString& third : names) {
                    const ScreenPlan plan = planFor({{}, Arrangement::Usual, cockpit, second, third}, {names[0], names[1], names[2]});
                    QVERIFY(!plan.cockpit.isEmpty());
                    QVERIFY(plan.second != plan.cockpit && plan.third != plan.cockpit);
                    QVERIFY(plan.second.isEmpty() || plan.second != plan.third);
                }
    }

    void aKeyPressedAgainTakesBackWhatItDid()
    {
        QVERIFY(swapped(Arrangement::Usual, Arrangement::SceneBeside) == Arrangement::SceneBeside);
        QVERIFY(swapped(Arrangement::SceneBeside, Arrangement::SceneBeside) == Arrangement::Usual);
        QVERIFY(swapped(Arrangement::SceneBeside, Arrangement::ReferenceBeside) == Arrangement::ReferenceBeside);
    }

    void whatIsSavedIsReadAgain_data()
    {
        QTest::addColumn<QString>("name");
        QTest::addColumn<QString>("kept");
        QTest::newRow("plain") << QStringLiteral("Coil") << QStringLiteral("Coil");
        QTest::newRow("quotes and slashes") << QStringLiteral("a/b\\c\"d'{}[],;=%&<b>") << QStringLiteral("a/b\\c\"d'{}[],;=%&<b>");
        QTest::newRow("Chinese") << QStringLiteral("\u4ECB\u5165 \u53CC\u5C4F") << QStringLiteral("\u4ECB\u5165 \u53CC\u5C4F");
        QTest::newRow("spaces and lines") << QStringLiteral("  a \n\t b ") << QStringLiteral("a b");
        QTest::newRow("reversing mark") << QStringLiteral("a\u202Eb") << QStringLiteral("a b");
        QTest::newRow("long") << QString(500, QLatin1Char('x')) << QString(40, QLatin1Char('x'));
        QTest::newRow("half a character") << QString(39, QLatin1Char('x')) + QStringLiteral("\U0001F600") << QString(39, QLatin1Char('x'));
    }

    void whatIsSavedIsReadAgain()
    {
        QFETCH(QString, name);
        QFETCH(QString, kept);
        const Folder at;
        LayoutBook book(at.path);
        ScreenLayout layout = three;
        layout.name = name;
        layout.arrangement = Arrangement::SceneBeside;
        QCOMPARE(book.save(layout), QString());
        LayoutBook again(at.path);
        QVERIFY(again.read().isEmpty());
        layout.name = kept;
        QCOMPARE(again.layouts().size(), std::size_t(1));
        QCOMPARE(again.layouts().front(), layout);
    }

    void aNamelessLayoutIsRefused()
    {
        LayoutBook book(Folder().path);
        QVERIFY(!book.save({QStringLiteral(" \n "), {}, {}, {}, {}}).isEmpty());
        QVERIFY(book.layouts().empty());
    }

    void oneOfTheSameNameTakesItsPlaceAndNineAreTheMost()
    {
        const Folder at;
        LayoutBook book(at.path);
        for (int i = 0; i < 9; ++i)
            QCOMPARE(book.save({QString::number(i), {}, {}, {}, {}}), QString());
        QCOMPARE(book.save({QStringLiteral("4"), Arrangement::SceneBeside, {}, {}, {}}), QString());
        QCOMPARE(book.layouts().size(), LayoutBook::most);
        QVERIFY(book.layouts()[4].arrangement == Arrangement::SceneBeside);
        QVERIFY(book.save({QStringLiteral("ten"), {}, {}, {}, {}}).contains(QStringLiteral("Delete one")));
        QCOMPARE(book.remove(0), QString());
        QCOMPARE(book.remove(99), QString());
        QCOMPARE(book.save({QStringLiteral("ten"), {}, {}, {}, {}}), QString());
        LayoutBook again(at.path);
        again.read();
        QCOMPARE(again.layouts().back().name, QStringLiteral("ten"));
    }

    void aBrokenFileIsSaidAndKept_data()
    {
        QTest::addColumn<QByteArray>("text");
        QTest::newRow("cut") << QByteArray("{\"layouts\": [{\"na");
        QTest::newRow("another thing") << QByteArray("[1, 2]");
        QTest::newRow("no list") << QByteArray("{\"layouts\": 7}");
        QTest::newRow("entry without a name") << QByteArray("{\"layouts\": [{\"arrangement\": \"usual\"}]}");
        QTest::newRow("arrangement of no sense") << QByteArray("{\"layouts\": [{\"name\": \"x\", \"arrangement\": \"live-hidden\"}]}");
        QTest::newRow("too long") << QByteArray(70'000, ' ');
    }

    void aBrokenFileIsSaidAndKept()
    {
        QFETCH(QByteArray, text);
        const Folder at;
        at.put(text);
        LayoutBook book(at.path);
        const QStringList troubles = book.read();
        QCOMPARE(troubles.size(), 1);
        QVERIFY2(troubles.first().contains(at.path), qPrintable(troubles.first()));
        QVERIFY(book.layouts().empty());
        QCOMPARE(Folder::contents(at.path), text);
        QCOMPARE(book.save(three), QString());
        QCOMPARE(Folder::contents(at.path + QStringLiteral(".kept-1")), text);
        LayoutBook again(at.path);
        QVERIFY(again.read().isEmpty());
        QCOMPARE(again.layouts().front(), three);
    }

    /// As the message advises, and OPERATING.
    void aBrokenFileThatWasDeletedIsWrittenAnew()
    {
        const Folder at;
        at.put("{\"layouts\": [{\"na");
        LayoutBook book(at.path);
        QCOMPARE(book.read().size(), 1);
        QVERIFY(QFile::remove(at.path));
        QCOMPARE(book.save(three), QString());
        LayoutBook again(at.path);
        QVERIFY(again.read().isEmpty());
        QCOMPARE(again.layouts().front(), three);
        QVERIFY(!QFile::exists(at.path + QStringLiteral(".kept-1")));
    }

    void whatCannotBeKeptIsSaidAndLastsForThisRun()
    {
        const Folder at;
        QVERIFY(QDir(at.folder.path()).mkdir(QStringLiteral("layouts.json.d")));
        LayoutBook book(at.folder.filePath(QStringLiteral("layouts.json.d"))); // a folder in the file's place
        QVERIFY(!book.save(three).isEmpty());
        QCOMPARE(book.layouts().size(), std::size_t(1));
        LayoutBook fileless({});
        QVERIFY(fileless.save(three).contains(QStringLiteral("this run only")));
        QCOMPARE(fileless.layouts().size(), std::size_t(1));
    }
};

QTEST_GUILESS_MAIN(TestScreenPlan)
#include "test_screen_plan.moc"
