// Profiles: those that come with LiENa, and what is said of one that is wrong.
#include "line_profile.hpp"

#include <QTest>

using namespace liena;
using namespace liena::tools;

class LineProfileTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void readsThoseThatComeWithLiena_data()
    {
        QTest::addColumn<QString>("name");
        for (const char* name : {"vascular-robot", "telesurgery", "observation"})
            QTest::newRow(name) << QString::fromLatin1(name);
    }
    void readsThoseThatComeWithLiena()
    {
        QFETCH(QString, name);
        const auto profile = LineProfile::load(LIENA_SOURCE_DIR "/resources/profiles/" + name.toStdString() + ".profile");
        QVERIFY2(profile.has_value(), profile ? "" : profile.error().what.c_str());
        for (const auto& kind : figureKinds) { // each is judged, but the tail of commands that guide no hand
            const bool judged = name != QStringLiteral("observation") || kind.figure != Figure::TailBesideImages;
            QVERIFY2((profile.value().limits.count(kind.figure) > 0) == judged, kind.name.data());
        }
        QVERIFY(!profile.value().title.empty());
        QCOMPARE(QString::fromStdString(profile.value().name), name);
    }

    void namesEachFigureAtItsPlace()
    {
        for (std::size_t place = 0; place < figureKinds.size(); ++place)
            QCOMPARE(static_cast<std::size_t>(figureKinds[place].figure), place);
    }

    void readsEverything()
    {
        const auto profile = LineProfile::parse("title  Eye to eye # not this\n\ncommands 50 /s\r\nframes 7.5 /s\nimage 1.5 MiB\n"
                                                "\tloss 0.1 % 1 %\nimage-rate 20 MB/s 10 MB/s",
                                                "/site/own.profile");
        QVERIFY2(profile.has_value(), profile ? "" : profile.error().what.c_str());
        const auto& read = profile.value();
        QCOMPARE(QString::fromStdString(read.name), QStringLiteral("own"));
        QCOMPARE(QString::fromStdString(read.title), QStringLiteral("Eye to eye"));
        QCOMPARE(read.commandsPerSecond, 50.0);
        QCOMPARE(read.framesPerSecond, 7.5);
        QCOMPARE(read.imageBytes, 1'572'864U);
        QCOMPARE(read.limits.size(), std::size_t{2});
        QCOMPARE(read.limits.at(Figure::Loss).go, 0.1);
        QCOMPARE(read.limits.at(Figure::ImageRate).caution, 10.0);
    }

    void namesLineAndRemedyOfWhatIsWrong_data()
    {
        QTest::addColumn<QString>("line");
        QTest::addColumn<QString>("said");
        const auto row = [](const char* line, const char* said) {
            QTest::newRow(line) << QString::fromLatin1(line) << QString::fromLatin1(said);
        };
        row("jiter 10 ms 20 ms", "it knows title, commands");
        row("jitter 10 ms", "write `jitter 10 ms 20 ms`");
        row("jitter 10 us 20 us", "write `jitter 10 ms 20 ms`");
        row("jitter ten ms 20 ms", "write `jitter 10 ms 20 ms`");
        row("jitter -1 ms 20 ms", "write `jitter 10 ms 20 ms`");
        row("jitter nan ms 20 ms", "write `jitter 10 ms 20 ms`");
        row("jitter inf ms inf ms", "write `jitter 10 ms 20 ms`");
        row("jitter 20 ms 10 ms", "exchange them");
        row("image-rate 10 MB/s 20 MB/s", "exchange them");
        row("loss 0.1 % 1 %", "is there twice");
        row("commands 0 /s", "write `commands 15 /s`");
        row("commands 0.4 /s", "a rate from 1 to 10000"); // which a running device does not take
        row("commands 10001 /s", "a rate from 1 to 10000");
        row("frames 0.05 /s", "a rate from 0.1 to 1000");
        row("frames 2000 /s", "a rate from 0.1 to 1000");
        row("frames 15", "write `frames 15 /s`");
        row("image 9 MiB", "at most 8 MiB");
        row("image", "write `image 1.5 MiB`");
        row("title", "write `title`");
        row("\x1b[31m 1 ms 2 ms", "\\x1b"); // a file cannot paint the terminal
    }
    void namesLineAndRemedyOfWhatIsWrong()
    {
        QFETCH(QString, line);
        QFETCH(QString, said);
        const auto profile = LineProfile::parse("# first\nloss 0.1 % 1 %\n" + line.toStdString() + "\n", "site.profile");
        QVERIFY(!profile);
        const auto what = QString::fromStdString(profile.error().what);
        QVERIFY2(what.startsWith(QStringLiteral("site.profile:3: ")), qPrintable(what));
        QVERIFY2(what.contains(said), qPrintable(what));
    }

    void refusesFilesThatAreNone()
    {
        QVERIFY(!LineProfile::parse("# nothing\n", "empty.profile"));
        const auto unknown = LineProfile::load("brain-surgery");
        QVERIFY(!unknown);
        QVERIFY2(unknown.error().what.find("vascular-robot, telesurgery and observation") != std::string::npos,
                 unknown.error().what.c_str());
        QVERIFY(!LineProfile::load("/no/such/file"));
        QVERIFY(!LineProfile::load("/dev/zero")); // endless
        QVERIFY(!LineProfile::load("/"));
    }

    void readsSizes()
    {
        QVERIFY(imageBytesFrom("512KiB") == 524'288U);
        QVERIFY(imageBytesFrom("2 MiB") == 2'097'152U);
        QVERIFY(imageBytesFrom("1000") == 1000U);
        for (const char* wrong : {"", "0", "-1", "MiB", "8.1MiB", "1e99", "2 MB", "2MiBs"})
            QVERIFY2(!imageBytesFrom(wrong), wrong);
    }
};

QTEST_APPLESS_MAIN(LineProfileTest)
#include "line_profile_test.moc"
