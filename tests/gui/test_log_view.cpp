// F4: the logs on the screen, by mouse and by keys, and what the view must never take away.
#include "cockpit_stage.hpp"
#include "widgets/log_lines.hpp"
#include "widgets/sheet_button.hpp"

#include <QContextMenuEvent>
#include <QLabel>
#include <QLineEdit>
#include <QScrollBar>
#include <QSignalSpy>

#include <algorithm>

using namespace console;
using namespace console::test;

namespace {

struct Shown : CockpitStage {
    explicit Shown(const QSize& size = {1920, 1080}) : CockpitStage(size)
    {
        auto& models = cockpit.models;
        models.log.append(LogKind::Link, QStringLiteral("Robot: open"), 1000);
        models.log.append(LogKind::Trouble, QStringLiteral("Robot: lost"), 2000);
        models.log.append(LogKind::Permit, QStringLiteral("READY -> ARMING"), 3000);
        models.alarms.restoreLog({{500, AlarmPriority::High, QStringLiteral("raised: FORCE STOP")}});
        models.alarms.note(4000, QStringLiteral("console started."));
    }

    bool open()
    {
        if (!ready())
            return false;
        QTest::keyClick(&window, Qt::Key_F4);
        return log->isVisible();
    }

    QPushButton* button(const QString& text) const
    {
        for (QPushButton* candidate : log->findChildren<QPushButton*>())
            if (candidate->isVisible() && candidate->text() == text)
                return candidate;
        return nullptr;
    }

    LogLines* lines() const { return log->findChild<LogLines*>(); }
    QLineEdit* edit(const char* name) const { return named<QLineEdit>(QString::fromLatin1(name)); }
    bool says(const QString& words) const
    {
        for (const QLabel* label : log->findChildren<QLabel*>())
            if (label->isVisible() && label->text().contains(words))
                return true;
        return false;
    }

    /// A line's text below the lines, with all the room that it takes.
    bool showsWhole(const QString& words) const
    {
        for (const QLabel* label : log->findChildren<QLabel*>())
            if (label->isVisible() && label->text().endsWith(words))
                return label->height() >= label->heightForWidth(label->width());
        return false;
    }
};

} // namespace

class TestLogView : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase() { theme::apply(*qApp); }

    void opensByItsKeyAndGoesByItOrByF1()
    {
        Shown stage;
        QVERIFY(stage.open());
        QCOMPARE(stage.window.view(), View::Log);
        QTest::keyClick(QApplication::focusWidget(), Qt::Key_F4);
        QVERIFY(!stage.log->isVisible());
        QVERIFY(stage.window.handHasKeys());
        QTest::keyClick(&stage.window, Qt::Key_F4);
        QTest::keyClick(QApplication::focusWidget(), Qt::Key_F1);
        QVERIFY(!stage.log->isVisible());
        QCOMPARE(QApplication::focusWidget(), static_cast<QWidget*>(&stage.window));
    }

    void oneViewTakesTheOthersPlace()
    {
        Shown stage;
        QVERIFY(stage.open());
        QSignalSpy hand(&stage.window, &CockpitWindow::handFocusChanged);
        QTest::keyClick(QApplication::focusWidget(), Qt::Key_F2);
        QVERIFY(stage.topology->isVisible() && !stage.log->isVisible());
        QTest::keyClick(QApplication::focusWidget(), Qt::Key_F4);
        QVERIFY(!stage.topology->isVisible() && stage.log->isVisible());
        QCOMPARE(hand.count(), 0); // the hand had no key in between
    }

    void leavesImageAlarmsAndMotion_data()
    {
        QTest::addColumn<QSize>("screen");
        QTest::newRow("reference") << QSize(2560, 1440);
        QTest::newRow("full HD") << QSize(1920, 1080);
        QTest::newRow("small") << QSize(1366, 768);
    }

    void leavesImageAlarmsAndMotion()
    {
        QFETCH(QSize, screen);
        Shown stage(screen);
        QVERIFY(stage.open());
        const QRect seen = stage.seen(stage.log);
        for (const Region region : {Region::Alarm, Region::Live, Region::Motion, Region::Status})
            QVERIFY(!seen.intersects(stage.window.regionGeometry(region)));
        for (QWidget* part : stage.log->findChildren<QWidget*>(Qt::FindDirectChildrenOnly))
            if (part->isVisible())
                QVERIFY2(stage.log->rect().contains(part->geometry()), qPrintable(part->accessibleName()));
    }

    void handHasNoKeysWhileSomebodyTypes()
    {
        Shown stage;
        QVERIFY(stage.open());
        auto* words = stage.edit("Only lines with these words");
        words->setFocus();
        QVERIFY(!stage.window.handHasKeys());
        QSignalSpy pressed(&stage.window, &CockpitWindow::handKeyPressed);
        QTest::keyClicks(words, QStringLiteral("dr"));
        QTest::keyClick(words, Qt::Key_Return);
        QCOMPARE(pressed.count(), 0);
        QCOMPARE(words->text(), QStringLiteral("dr"));
    }

    void holdAndEmergencyStopWorkFromEveryPartOfIt()
    {
        Shown stage;
        QVERIFY(stage.open());
        QSignalSpy panic(&stage.window, &CockpitWindow::panicHoldRequested);
        QSignalSpy stop(&stage.window, &CockpitWindow::emergencyStopRequested);
        int parts = 0;
        for (QWidget* part : stage.log->findChildren<QWidget*>()) {
            if (!part->isVisible() || !part->isEnabled() || (part->focusPolicy() & Qt::TabFocus) == 0)
                continue;
            part->setFocus();
            if (QApplication::focusWidget() != part)
                continue;
            ++parts;
            QTest::keyClick(part, Qt::Key_F12);
            QTest::keyClick(part, Qt::Key_Escape);
            QCOMPARE(panic.count(), parts);
            QCOMPARE(stop.count(), parts);
            QVERIFY(stage.log->isVisible());
        }
        QVERIFY2(parts >= 10, qPrintable(QString::number(parts)));
    }

    void everythingIsReachedByTabAndHasAName()
    {
        Shown stage;
        QVERIFY(stage.open());
        QSet<QWidget*> reached;
        for (int i = 0; i < 60; ++i) {
            QWidget* focus = QApplication::focusWidget();
            QVERIFY(focus);
            if (stage.log->isAncestorOf(focus))
                reached.insert(focus);
            QTest::keyClick(focus, Qt::Key_Tab);
        }
        for (QWidget* part : stage.log->findChildren<QWidget*>())
            if (part->isVisible() && part->focusPolicy() == Qt::StrongFocus && !qobject_cast<QScrollBar*>(part)) {
                QVERIFY2(reached.contains(part), qPrintable(part->accessibleName()));
                QVERIFY2(!part->accessibleName().isEmpty(), part->metaObject()->className());
            }
    }

    void kindAndWordsNarrowWhatIsShown()
    {
        Shown stage;
        QVERIFY(stage.open());
        QCOMPARE(stage.lines()->model()->rowCount(), 3);
        QTest::mouseClick(stage.button(QStringLiteral("trouble")), Qt::LeftButton);
        QCOMPARE(stage.lines()->model()->rowCount(), 1);
        QVERIFY(stage.says(QStringLiteral("1 of 3 lines")));
        QTest::mouseClick(stage.button(QStringLiteral("link")), Qt::LeftButton);
        QCOMPARE(stage.lines()->model()->rowCount(), 2);
        QTest::keyClicks(stage.edit("Only lines with these words"), QStringLiteral("LOST"));
        QCOMPARE(stage.lines()->model()->rowCount(), 1);
    }

    void alarmsAreTheOtherLog()
    {
        Shown stage;
        QVERIFY(stage.open());
        QTest::mouseClick(stage.button(QStringLiteral("trouble")), Qt::LeftButton);
        QTest::mouseClick(stage.button(QStringLiteral("Alarms")), Qt::LeftButton);
        QCOMPARE(stage.lines()->model()->rowCount(), 2);
        QVERIFY(!stage.button(QStringLiteral("trouble")));
        auto* high = stage.button(QStringLiteral("high"));
        high->setFocus();
        QTest::keyClick(high, Qt::Key_Return);
        QCOMPARE(stage.lines()->model()->rowCount(), 1);
        stage.cockpit.models.alarms.update({{AlarmCondition::ForceStop, 0, AlarmPriority::High, true, QStringLiteral("FORCE"), {}}},
                                           stage.cockpit.now, 5000);
        QCOMPARE(stage.lines()->model()->rowCount(), 2);
    }

    void theChosenLineIsReadWhole()
    {
        Shown stage;
        QVERIFY(stage.open());
        const QString story = QStringLiteral("long ").repeated(200) + QStringLiteral("end");
        stage.cockpit.models.log.append(LogKind::Note, story, 4000);
        stage.lines()->setFocus();
        QTest::keyClick(stage.lines(), Qt::Key_End);
        QVERIFY(stage.says(QStringLiteral("long end")));
    }

    void followsTheNewestUntilSomebodyLooksBack()
    {
        Shown stage;
        QVERIFY(stage.open());
        auto& log = stage.cockpit.models.log;
        auto* bar = stage.lines()->verticalScrollBar();
        for (int i = 0; i < 300; ++i)
            log.append(LogKind::Note, QString::number(i), 5000);
        QTRY_VERIFY(bar->maximum() > 0 && bar->value() == bar->maximum());
        bar->setValue(0);
        log.append(LogKind::Note, QStringLiteral("new"), 6000);
        QTest::qWait(0);
        QCOMPARE(bar->value(), 0);
    }

    /// What is read of it below the lines takes its room from them.
    void opensWithTheNewestLineInView()
    {
        Shown stage;
        auto& log = stage.cockpit.models.log;
        for (int i = 0; i < 300; ++i)
            log.append(LogKind::Note, QString::number(i), 5000);
        log.append(LogKind::Note, QStringLiteral("long ").repeated(60) + QStringLiteral("end"), 6000);
        QVERIFY(stage.open());
        QTRY_VERIFY(stage.showsWhole(QStringLiteral("long end")));
        auto* bar = stage.lines()->verticalScrollBar();
        QVERIFY(bar->maximum() > 0);
        QTRY_COMPARE(bar->value(), bar->maximum());
    }

    /// However tall the room for them is, the last one in it is not cut.
    void showsWholeLinesOnly()
    {
        Shown stage;
        auto& log = stage.cockpit.models.log;
        for (int i = 0; i < 300; ++i)
            log.append(LogKind::Note, QString::number(i), 5000);
        QVERIFY(stage.open());
        const auto* lines = stage.lines();
        const auto last = [lines] { return lines->visualRect(lines->model()->index(lines->model()->rowCount() - 1, 0)); };
        for (const int tall : {1080, 1083, 1086, 1090, 1440}) {
            stage.window.resize(1920, tall);
            QTRY_COMPARE(lines->verticalScrollBar()->value(), lines->verticalScrollBar()->maximum());
            QTRY_COMPARE(lines->viewport()->height() % std::max(1, last().height()), 0);
            QTRY_VERIFY(last().bottom() < lines->viewport()->height());
        }
    }

    void anOlderLineThatIsChosenStaysInView()
    {
        Shown stage;
        auto& log = stage.cockpit.models.log;
        for (int i = 0; i < 300; ++i)
            log.append(LogKind::Note, QStringLiteral("long ").repeated(60) + QString::number(i), 5000);
        log.append(LogKind::Note, QStringLiteral("short"), 6000);
        QVERIFY(stage.open());
        QTRY_VERIFY(stage.showsWhole(QStringLiteral("short")));
        const QPoint top(20, 4);
        const QPersistentModelIndex chosen = stage.lines()->indexAt(top);
        QTest::mouseClick(stage.lines()->viewport(), Qt::LeftButton, {}, top);
        QTRY_VERIFY(stage.showsWhole(QStringLiteral("long ") + chosen.data().toString().section(QLatin1Char(' '), -1)));
        QVERIFY(stage.lines()->viewport()->rect().intersects(stage.lines()->visualRect(chosen)));
    }

    void savesWhatIsShown()
    {
        Shown stage;
        stage.log->setPathSuggestion([](const QString& log) { return QStringLiteral("/x/") + log; });
        QVERIFY(stage.open());
        QSignalSpy save(stage.log, &LogView::saveRequested);
        QTest::mouseClick(stage.button(QStringLiteral("trouble")), Qt::LeftButton);
        QTest::mouseClick(stage.button(QStringLiteral("Save lines shown")), Qt::LeftButton);
        QCOMPARE(save.count(), 1);
        QVERIFY(save.first().first().toByteArray().contains("# 1 of 3 lines"));
        QVERIFY(save.first().first().toByteArray().contains("Robot: lost"));
        QCOMPARE(save.first().at(1).toString(), QStringLiteral("/x/events"));
        QVERIFY(stage.says(QStringLiteral("Writing")));
        stage.log->showFailure(QStringLiteral("/x/events cannot be written: full. Make room."));
        QVERIFY(stage.says(QStringLiteral("/x/events cannot be written")));
    }

    void nothingInItOpensAWindow()
    {
        Shown stage;
        QVERIFY(stage.open());
        for (QWidget* part : stage.log->findChildren<QWidget*>())
            if (part->isVisible()) {
                QContextMenuEvent menu(QContextMenuEvent::Mouse, QPoint(3, 3), part->mapToGlobal(QPoint(3, 3)));
                QCoreApplication::sendEvent(part, &menu);
                QVERIFY(QApplication::activePopupWidget() == nullptr);
            }
    }
};

QTEST_MAIN(TestLogView)
#include "test_log_view.moc"
