// The end of the whole console by its window: refused while somebody relies on it, and else of the program with every window.
//
// All that somebody relies on, and how it is said, is tried by gui.closing.
#include "model/closing_bar.hpp"
#include "never_possible_stage.hpp"
#include "widgets/side_window.hpp"

#include <QFile>
#include <QScopeGuard>
#include <QTimer>

using namespace console;
using console::test::logTells;
using console::test::Theatre;
using Stage = console::test::NeverStage;

namespace {

constexpr int patience = Theatre::patience;

std::optional<ClosingBar> barOf(const Stage& stage) { return closingBar(stage.theatre.models(), std::chrono::steady_clock::now()); }

SideWindow* shownSideWindow()
{
    for (QWidget* widget : QApplication::topLevelWidgets())
        if (auto* side = qobject_cast<SideWindow*>(widget); side != nullptr && side->isVisible())
            return side;
    return nullptr;
}

QAbstractButton* buttonNamed(const QWidget& window, const QString& accessibleName)
{
    for (auto* button : window.findChildren<QAbstractButton*>())
        if (button->isVisible() && button->isEnabled() && button->accessibleName() == accessibleName)
            return button;
    return nullptr;
}

/// Of a console that meets nobody, and operates itself.
Options unattendedOptions(liena::test::TestSystem& files, const QString& report)
{
    auto options = console::test::cockpitOptions(files);
    options.size = QSize(1366, 768);
    options.master = MasterKind::Recorded;
    options.unattended = UnattendedSettings{1, report, {}};
    return options;
}

} // namespace

class ClosingTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase()
    {
        QCOMPARE(QGuiApplication::screens().size(), 3);
        m_stage = console::test::openStage();
        QVERIFY(m_stage);
    }

    void cleanupTestCase() { m_stage.reset(); }

    void theCockpitStaysWhileTheRobotMoves()
    {
        Stage& stage = *m_stage;
        auto& window = stage.theatre.window();
        QVERIFY2(stage.theatre.armAndMove(), qPrintable(stage.theatre.story()));
        QVERIFY(!window.close()); // the event loop has not turned since it moved
        QVERIFY(window.isVisible());
        QCOMPARE(stage.phase(), PermitPhase::Engaged);
        QVERIFY2(logTells(stage.theatre, QStringLiteral("not closed: the permit is ENGAGED. Press F12")),
                 qPrintable(stage.theatre.story()));
        stage.theatre.strike(Qt::Key_F12);
        stage.theatre.releaseAll();
        QVERIFY2(mayClose(), qPrintable(stage.theatre.story()));
    }

    /// It has ended by then: it latches.
    void theCockpitStaysUnderAHighAlarmThatNobodyHasSeen()
    {
        Stage& stage = *m_stage;
        auto& window = stage.theatre.window();
        QVERIFY2(stage.theatre.armAndMove(), qPrintable(stage.theatre.story()));
        stage.robot.setForce(2.3);
        QTRY_VERIFY2_WITH_TIMEOUT(stage.theatre.models().alarms.unacknowledgedHigh(), qPrintable(stage.theatre.story()), patience);
        stage.robot.setForce(0);
        stage.theatre.releaseAll();
        const auto onlyTheAlarm = [&stage] {
            const auto bar = barOf(stage);
            return bar && bar->why.contains(QStringLiteral("high alarm"));
        };
        QTRY_VERIFY2_WITH_TIMEOUT(onlyTheAlarm(), qPrintable(stage.theatre.story()), patience);
        QVERIFY(!window.close());
        QVERIFY(window.isVisible());
        QVERIFY2(logTells(stage.theatre, QStringLiteral("not closed: a high alarm is not acknowledged")),
                 qPrintable(stage.theatre.story()));
        QVERIFY2(mayClose(), qPrintable(stage.theatre.story()));
    }

    /// Whoever reads its status must not take it for one that has done its work.
    void anUnattendedRunWhoseWindowIsClosedHasFailed()
    {
        const auto back = qScopeGuard([this] { m_stage->comeToTheFront(); });
        namespace reference = liena::test::reference;
        liena::test::TestSystem files({reference::cockpit, reference::robot, reference::xray}, {"cockpit robot", "cockpit xray"});
        const auto path = QString::fromStdString((files.folder() / "report.json").string());
        CockpitApplication console(unattendedOptions(files, path));
        QString error;
        QVERIFY2(console.prepare(&error), qPrintable(error));
        QTimer wish;
        connect(&wish, &QTimer::timeout, &console.window(), &QWidget::close);
        wish.start(100);
        QCOMPARE(console.run(), 1);
        QFile report(path);
        QVERIFY(report.open(QIODevice::ReadOnly));
        QVERIFY(report.readAll().contains("the cockpit's window was closed"));
    }

    /// Last: nothing is left after it.
    void theCockpitsCloseEndsTheProgramBesideAFurtherWindow()
    {
        Stage& stage = *m_stage;
        auto& window = stage.theatre.window();
        stage.theatre.strike(Qt::Key_F7);
        QAbstractButton* second = nullptr;
        QTRY_VERIFY_WITH_TIMEOUT((second = buttonNamed(window, QStringLiteral("Second screen: second"))) != nullptr, patience);
        QTest::mouseClick(second, Qt::LeftButton);
        QTRY_VERIFY(shownSideWindow() != nullptr);
        QTimer wish; // until nothing stands in the way, as a busy computer may make it
        connect(&wish, &QTimer::timeout, &window, [&stage, &window] {
            stage.theatre.acknowledgeAlarms();
            window.close();
        });
        wish.start(100);
        QTimer patienceEnds;
        connect(&patienceEnds, &QTimer::timeout, &window, [] { QCoreApplication::exit(1); });
        patienceEnds.start(patience);
        const int status = QApplication::exec();
        wish.stop();
        QVERIFY2(status == 0, qPrintable(stage.theatre.story()));
        QVERIFY(!window.isVisible());
        const auto& told = stage.theatre.models().alarms.log();
        QVERIFY(std::any_of(told.begin(), told.end(),
                            [](const AlarmLogEntry& entry) { return entry.text.startsWith(QStringLiteral("console closed by")); }));
    }

private:
    /// Nothing stands in the way any more, once the alarms were seen.
    bool mayClose()
    {
        return QTest::qWaitFor(
            [this] {
                m_stage->theatre.acknowledgeAlarms();
                return !barOf(*m_stage);
            },
            patience);
    }

    std::unique_ptr<Stage> m_stage;
};

QTEST_MAIN(ClosingTest)
#include "closing_test.moc"
