// The console's measuring program of alarm and prompt, in its shortest run: one robot that is killed and one that is stopped. No figure is
// judged, and none can be: of so few rounds it tells that it cannot be told.
#include "child_process.hpp"
#include "limits.hpp"
#include "support/sound_room.hpp"

#include <QFile>
#include <QTemporaryDir>
#include <QTest>

using console::test::SoundServer;
using liena::test::ChildProcess;

namespace {

constexpr int patiences = 8; ///< of 30 s each, for one run

int endOf(ChildProcess& program)
{
    int end = program.waitForEnd();
    for (int i = 1; i < patiences && program.isRunning(); ++i)
        end = program.waitForEnd();
    return end;
}

/// The line of the output that begins so, spaces aside.
QString lineOf(const QString& output, const char* beginning)
{
    for (const auto& line : output.split(QLatin1Char('\n')))
        if (line.trimmed().startsWith(QLatin1String(beginning)))
            return line.trimmed();
    return {};
}

} // namespace

class PromptBenchTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase()
    {
        m_path = qgetenv("PATH");
        QVERIFY(m_folder.isValid());
    }

    void cleanup() { qputenv("PATH", m_path); }

    void aKilledAndAStoppedRobotAreMeasured()
    {
        if (const auto missing = SoundServer::missing(); !missing.isEmpty())
            QSKIP(qPrintable(missing));
        ChildProcess rounds(QStringLiteral("prompt_bench"), {QStringLiteral("2")});
        const int end = endOf(rounds);
        const QString output = rounds.output();
        QVERIFY2(end == endNotKept, qPrintable(QStringLiteral("it ended with %1:\n").arg(end) + output));
        QCOMPARE(output.count(QLatin1String(" ms   (1)")), 2 * rows);
        for (const auto* expected : {"process killed, its sockets closed:", "process stopped, silence:", "it takes 100 rounds to tell"})
            QVERIFY2(output.contains(QLatin1String(expected)), qPrintable(output));
        for (const auto* strange : {"not measured", "NOT MEASURED", "NOT KEPT", "stand-in"})
            QVERIFY2(!output.contains(QLatin1String(strange)), qPrintable(output));
    }

    void withoutASoundServerTheRestIsMeasured()
    {
        qputenv("PATH", QFile::encodeName(m_folder.path()));
        ChildProcess rounds(QStringLiteral("prompt_bench"), {QStringLiteral("2")});
        const int end = endOf(rounds);
        const QString output = rounds.output();
        QVERIFY2(end == endNotKept, qPrintable(QStringLiteral("it ended with %1:\n").arg(end) + output));
        QCOMPARE(output.count(QLatin1String(" ms   (1)")), 2 * (rows - rowsOfSound));
        for (const auto* expected : {"sound was NOT MEASURED", "there is no pulseaudio", "it takes a sound server to tell"})
            QVERIFY2(output.contains(QLatin1String(expected)), qPrintable(output));
        QVERIFY2(lineOf(output, sounding).endsWith(QLatin1String("not measured")), qPrintable(output));
    }

    /// The recorder is one that hears nothing.
    void aBurstThatIsNotHeardIsNoMeasurement()
    {
        if (const auto missing = SoundServer::missing(); !missing.isEmpty())
            QSKIP(qPrintable(missing));
        QFile deaf(m_folder.filePath(QStringLiteral("parec")));
        QVERIFY(deaf.open(QIODevice::WriteOnly));
        deaf.write("#!/bin/sh\nwhile head -c 882 /dev/zero; do sleep 0.01; done\n");
        QVERIFY(deaf.setPermissions(QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner));
        deaf.close();
        qputenv("PATH", QFile::encodeName(m_folder.path()) + ':' + m_path);
        ChildProcess rounds(QStringLiteral("prompt_bench"), {QStringLiteral("2")});
        const int end = endOf(rounds);
        const QString output = rounds.output();
        QVERIFY2(end == endNotMeasured, qPrintable(QStringLiteral("it ended with %1:\n").arg(end) + output));
        QVERIFY2(output.contains(QLatin1String("the high burst is not heard at the sound server's output")), qPrintable(output));
        QVERIFY2(lineOf(output, sounding).endsWith(QLatin1String("not measured")), qPrintable(output));
    }

private:
    static constexpr qsizetype rows = 8; ///< for each kind of loss
    static constexpr qsizetype rowsOfSound = 2;
    static constexpr const char* sounding = "gone -> high burst sounds at the sound server's output";

    QByteArray m_path;
    QTemporaryDir m_folder;
};

QTEST_GUILESS_MAIN(PromptBenchTest)
#include "prompt_bench_test.moc"
