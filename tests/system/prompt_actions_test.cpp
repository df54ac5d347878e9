// What a person asks for in the prompt of a lost link, by its buttons, through the whole console: seen at its links, at what it shows, in
// its log and on the disk. That the prompt leads to no other device is tried by system.never_by_link.
#include "environment_value.hpp"
#include "theatre.hpp"
#include "widgets/diagnosis_sheet.hpp"
#include "widgets/theme.hpp"

#include <QApplication>
#include <QDir>
#include <QFile>
#include <QLabel>
#include <QStandardPaths>
#include <QTemporaryDir>
#include <QTest>

#include <algorithm>

using namespace console;
using console::test::Theatre;
using liena::test::EnvironmentValue;

namespace {

constexpr int patience = Theatre::patience;

Theatre::Wishes wishes()
{
    Theatre::Wishes value;
    value.arm = false;
    value.preferences.patientSide = QStringLiteral("lab 2, tel. 4711");
    return value;
}

bool logTells(const Theatre& theatre, const QString& start)
{
    const auto& lines = theatre.models().log.lines();
    return std::any_of(lines.begin(), lines.end(), [&start](const LogLine& line) { return line.text.startsWith(start); });
}

/// The loss of the console's link to the robot. That of the X-ray system's may be told as well, in a prompt of its own.
const IncidentRecord* lossOf(const Theatre& theatre)
{
    return theatre.models().incidents.ofPair(theatre.files.idOf("cockpit").value(), theatre.files.idOf("robot").value());
}

ProbeFinding foundFor(const Theatre& theatre)
{
    const auto* loss = lossOf(theatre);
    return loss != nullptr && loss->diagnosis ? loss->diagnosis->probe : ProbeFinding::NotProbed;
}

/// Its prompt; null while that is not shown.
DiagnosisSheet* promptOf(Theatre& theatre)
{
    const auto* loss = lossOf(theatre);
    auto* sheet = theatre.window().findChild<DiagnosisSheet*>();
    return loss != nullptr && sheet != nullptr && sheet->isVisible() && sheet->incident() == loss->id ? sheet : nullptr;
}

bool says(const QWidget* prompt, const QString& words)
{
    if (prompt == nullptr)
        return false;
    const auto labels = prompt->findChildren<QLabel*>();
    return std::any_of(labels.begin(), labels.end(),
                       [&words](const QLabel* label) { return label->isVisible() && label->text().contains(words); });
}

} // namespace

class PromptActionsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase()
    {
        theme::apply(*qobject_cast<QApplication*>(QCoreApplication::instance()));
        m_theatre = std::make_unique<Theatre>(wishes());
        QVERIFY2(m_theatre->openAll(), qPrintable(m_theatre->story()));
        m_theatre->robot->kill();
        // What it finds by itself, once.
        QTRY_VERIFY2_WITH_TIMEOUT(foundFor(*m_theatre) == ProbeFinding::ConnectionRefused && promptOf(*m_theatre) != nullptr,
                                  qPrintable(m_theatre->story()), patience);
    }

    void cleanupTestCase() { m_theatre.reset(); }

    void theReportIsKeptAsAFile()
    {
        Theatre& theatre = *m_theatre;
        const QDir kept(QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation) + QStringLiteral("/liena"));
        QVERIFY2(kept.path().startsWith(m_folder.path()), qPrintable(kept.path()));
        const auto reports = [&kept] { return kept.entryList({QStringLiteral("incident_*.txt")}, QDir::Files); };
        QVERIFY(reports().isEmpty());
        const auto number = QStringLiteral("incident %1").arg(lossOf(theatre)->id, 16, 16, QLatin1Char('0'));
        QVERIFY(theatre.click(QStringLiteral("Save report"), promptOf(theatre)));
        QTRY_COMPARE_WITH_TIMEOUT(reports().size(), 1, patience);
        QFile file(kept.filePath(reports().first()));
        QVERIFY(file.open(QIODevice::ReadOnly));
        const auto report = QString::fromUtf8(file.readAll());
        QVERIFY2(report.startsWith(QStringLiteral("Vascular robot link lost\n")), qPrintable(report));
        QVERIFY2(report.contains(number), qPrintable(report));
        QTRY_VERIFY_WITH_TIMEOUT(says(promptOf(theatre), QStringLiteral("Report saved: ") + file.fileName()), patience);
        QVERIFY2(logTells(theatre, QStringLiteral("report saved: ") + file.fileName()), qPrintable(theatre.story()));
    }

    void aCallOfThePatientSideIsInTheLog()
    {
        Theatre& theatre = *m_theatre;
        QVERIFY(theatre.click(QStringLiteral("Call patient side"), promptOf(theatre)));
        QVERIFY2(logTells(theatre, QStringLiteral("call the patient side: lab 2, tel. 4711")), qPrintable(theatre.story()));
    }

    /// The robot is there again by then, which nobody sees until somebody looks.
    void checksAreRunAnew()
    {
        Theatre& theatre = *m_theatre;
        const auto before = lossOf(theatre)->diagnosis.value();
        QVERIFY(before.cause != LossKind::None && before.heartbeatsExpected > 0);
        theatre.robot = theatre.start("robot");
        QCOMPARE(foundFor(theatre), ProbeFinding::ConnectionRefused);
        QVERIFY(theatre.click(QStringLiteral("Run checks"), promptOf(theatre)));
        QTRY_VERIFY2_WITH_TIMEOUT(foundFor(theatre) == ProbeFinding::Reachable, qPrintable(theatre.story()), patience);
        QTRY_VERIFY_WITH_TIMEOUT(says(promptOf(theatre), QStringLiteral("The device answers again")), patience);
        QTRY_VERIFY_WITH_TIMEOUT(theatre.button(QStringLiteral("Run checks"), promptOf(theatre)) != nullptr, patience); // they are done

        // What is known of the loss is known still.
        const auto& after = *lossOf(theatre)->diagnosis;
        QCOMPARE(after.cause, before.cause);
        QCOMPARE(after.heartbeatsExpected, before.heartbeatsExpected);
        QCOMPARE(after.heartbeatsReceived, before.heartbeatsReceived);
        QVERIFY(after.silence == before.silence && after.lastRoundTrip == before.lastRoundTrip);
        QCOMPARE(theatre.link("robot"), LinkState::StandBy); // looking re-opens nothing
    }

    /// Behind the others: nothing of that loss is left.
    void whatIsGivenUpIsAskedForOnceMoreAndEnds()
    {
        Theatre& theatre = *m_theatre;
        QVERIFY(theatre.click(QStringLiteral("Give up link\u2026"), promptOf(theatre)));
        QVERIFY(says(promptOf(theatre), QStringLiteral("Give it up?")));
        QVERIFY(lossOf(theatre) != nullptr);
        QCOMPARE(theatre.link("robot"), LinkState::StandBy);
        QVERIFY(theatre.click(QStringLiteral("Give up link"), promptOf(theatre)));
        QTRY_VERIFY2_WITH_TIMEOUT(lossOf(theatre) == nullptr && theatre.link("robot") == LinkState::Closed, qPrintable(theatre.story()),
                                  patience);
        QVERIFY2(logTells(theatre, QStringLiteral("give an incident up: given up by the operator")), qPrintable(theatre.story()));
    }

    void allLostLinksAreReopenedByOneButton()
    {
        m_theatre.reset();
        Theatre theatre(wishes());
        QVERIFY2(theatre.openAll(), qPrintable(theatre.story()));
        theatre.robot->kill();
        theatre.xray->kill();
        const auto bothAre = [&theatre](LinkState state) { return theatre.link("robot") == state && theatre.link("xray") == state; };
        QTRY_VERIFY2_WITH_TIMEOUT(bothAre(LinkState::StandBy), qPrintable(theatre.story()), patience);
        theatre.robot = theatre.start("robot");
        theatre.xray = theatre.start("xray", {QStringLiteral("--size"), QStringLiteral("256")});
        QVERIFY2(theatre.click(QStringLiteral("Re-open all lost (2)"), theatre.window().findChild<DiagnosisSheet*>()),
                 qPrintable(theatre.story()));
        QTRY_VERIFY2_WITH_TIMEOUT(bothAre(LinkState::Open), qPrintable(theatre.story()), patience);
        for (const char* line : {"re-open Vascular robot", "re-open C-arm X-ray"})
            QVERIFY2(logTells(theatre, QString::fromLatin1(line)), qPrintable(theatre.story()));
    }

private:
    const QTemporaryDir m_folder;
    const EnvironmentValue m_home{"HOME", m_folder.path()}; // a person's documents are theirs
    const EnvironmentValue m_settings{"XDG_CONFIG_HOME", m_folder.path()};
    std::unique_ptr<Theatre> m_theatre;
};

QTEST_MAIN(PromptActionsTest)
#include "prompt_actions_test.moc"
