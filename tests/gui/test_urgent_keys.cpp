// Emergency stop, hold and audio pause by key: in every window, whatever has the focus and whatever is held beside them. On invented
// screens.
#include "app/picture_desk.hpp"
#include "app/screen_desk.hpp"
#include "cockpit_stage.hpp"
#include "widgets/log_lines.hpp"
#include "widgets/screens_view.hpp"
#include "widgets/side_window.hpp"
#include "widgets/touch_line.hpp"

#include <QKeyEvent>
#include <QMenu>
#include <QPushButton>
#include <QShortcut>
#include <QSignalSpy>
#include <QWindow>

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

using namespace console;
using namespace console::test;

namespace {

constexpr std::array urgent{Qt::Key_Escape, Qt::Key_F12, Qt::Key_F9};
constexpr std::array modifiers{Qt::ShiftModifier, Qt::ControlModifier, Qt::AltModifier, Qt::MetaModifier, Qt::KeypadModifier};

/// None, each with each, and AltGr.
QList<Qt::KeyboardModifiers> combinations()
{
    QList<Qt::KeyboardModifiers> all{Qt::NoModifier};
    for (const auto modifier : modifiers)
        for (int i = 0, known = int(all.size()); i < known; ++i)
            all << (all[i] | modifier);
    return all << Qt::GroupSwitchModifier;
}

struct Stage : CockpitStage {
    Options options;
    PictureDesk pictures{options, cockpit.models};
    std::unique_ptr<ScreenDesk> desk;
    QSignalSpy stop{&window, &CockpitWindow::emergencyStopRequested};
    QSignalSpy hold{&window, &CockpitWindow::panicHoldRequested};
    QSignalSpy pause{&window, &CockpitWindow::audioPauseRequested};

    Stage() : CockpitStage({1366, 768})
    {
        pictures.build(window);
        desk = std::make_unique<ScreenDesk>(options, cockpit.models, pictures, window);
        desk->begin();
    }

    bool each(qsizetype times) const { return stop.count() == times && hold.count() == times && pause.count() == times; }

    QString counts() const { return QStringLiteral("stop %1, hold %2, pause %3").arg(stop.count()).arg(hold.count()).arg(pause.count()); }

    static bool focus(QWidget* widget)
    {
        if (widget == nullptr)
            return false;
        widget->setFocus(Qt::TabFocusReason);
        return QApplication::focusWidget() == widget;
    }

    /// Active; null when it does not become so.
    static SideWindow* activated(SideWindow* side)
    {
        side->activateWindow();
        return QTest::qWaitForWindowActive(side) ? side : nullptr;
    }

    template <typename Widget>
    static Widget* firstSeen(const QWidget& within)
    {
        const auto all = within.findChildren<Widget*>();
        const auto seen = std::find_if(all.begin(), all.end(), [](const Widget* widget) { return widget->isVisible(); });
        return seen != all.end() ? *seen : nullptr;
    }

    /// The window in which `place` has the focus; null when it cannot have it.
    QWidget* focusOn(const QString& place)
    {
        refresh();
        QWidget* shown = &window;
        bool has = false;
        if (place == QLatin1String("cockpit")) {
            has = focus(&window);
        } else if (place == QLatin1String("button")) {
            has = focus(named<QPushButton>(QStringLiteral("Open all closed links, one after the other")));
        } else if (place == QLatin1String("prompt")) {
            cockpit.openAll();
            cockpit.loseRobot();
            has = QApplication::focusWidget() != nullptr && !window.handHasKeys();
        } else if (place == QLatin1String("line to write in")) {
            window.showView(View::Log);
            has = focus(firstSeen<TouchLine>(*log));
        } else if (place == QLatin1String("list of the second screen")) {
            Q_EMIT window.findChild<ScreensView*>()->secondChosen(QStringLiteral("second"));
            shown = activated(desk->second());
            has = shown != nullptr && focus(firstSeen<LogLines>(*shown));
        } else {
            Q_EMIT window.findChild<ScreensView*>()->thirdChosen(QStringLiteral("third"));
            shown = activated(desk->third());
            has = shown != nullptr;
        }
        return has ? shown : nullptr;
    }
};

void addPlaces()
{
    QTest::addColumn<QString>("place");
    for (const char* place : {"cockpit", "button", "prompt", "line to write in", "list of the second screen", "third screen"})
        QTest::newRow(place) << QString::fromLatin1(place);
}

} // namespace

class TestUrgentKeys : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase()
    {
        theme::apply(*qApp);
        QCOMPARE(QGuiApplication::screens().size(), 3);
        QCOMPARE(combinations().size(), 33);
    }

    void workWithEveryModifier_data() { addPlaces(); }

    /// As the window system sends them: asked for a shortcut first.
    void workWithEveryModifier()
    {
        QFETCH(QString, place);
        Stage stage;
        QVERIFY(stage.ready());
        QWidget* const shown = stage.focusOn(place);
        QVERIFY(shown != nullptr);
        int times = 0;
        for (const Qt::KeyboardModifiers held : combinations()) {
            ++times;
            for (const Qt::Key key : urgent)
                QTest::keyClick(shown->windowHandle(), key, held);
            QVERIFY2(stage.each(times), qPrintable(QStringLiteral("%1: %2").arg(held.toInt(), 0, 16).arg(stage.counts())));
        }
        const bool side = shown != &stage.window;
        for (const auto& told : std::as_const(stage.stop))
            QCOMPARE(told.front().toString().contains(QStringLiteral("further screen")), side);
    }

    void areHeardOnceWhileTheyAreHeld_data() { addPlaces(); }

    void areHeardOnceWhileTheyAreHeld()
    {
        QFETCH(QString, place);
        Stage stage;
        QVERIFY(stage.ready());
        QWidget* const shown = stage.focusOn(place);
        QVERIFY(shown != nullptr);
        QWidget* const target = shown->focusWidget() != nullptr ? shown->focusWidget() : shown;
        for (const Qt::Key key : urgent) {
            const auto send = [target, key](QEvent::Type type, bool repeat) {
                QKeyEvent event(type, key, Qt::ShiftModifier, QString(), repeat);
                QApplication::sendEvent(target, &event);
            };
            send(QEvent::KeyPress, true); // held since before
            send(QEvent::KeyPress, false);
            for (int i = 0; i < 5; ++i) {
                send(QEvent::KeyRelease, true);
                send(QEvent::KeyPress, true);
            }
            send(QEvent::KeyRelease, false);
        }
        QVERIFY2(stage.each(1), qPrintable(stage.counts()));
    }

    void noShortcutTakesThem()
    {
        Stage stage;
        QVERIFY(stage.ready());
        QVERIFY(stage.focusOn(QStringLiteral("cockpit")) != nullptr);
        for (const Qt::Key key : urgent) {
            QShortcut other(QKeySequence(Qt::SHIFT | key), &stage.window);
            const QSignalSpy taken(&other, &QShortcut::activated);
            QTest::keyClick(stage.window.windowHandle(), key, Qt::ShiftModifier);
            QCOMPARE(taken.count(), 0);
        }
        QVERIFY2(stage.each(1), qPrintable(stage.counts()));
    }

    /// There is none. One would have the keyboard for itself.
    void noMenuTakesThem()
    {
        Stage stage;
        QVERIFY(stage.ready());
        QMenu menu(stage.mini);
        menu.addAction(QStringLiteral("An action"));
        menu.popup(stage.window.mapToGlobal(QPoint(300, 300)));
        QVERIFY(menu.isVisible());
        for (const Qt::Key key : urgent)
            QTest::keyClick(&menu, key);
        QVERIFY2(stage.each(1), qPrintable(stage.counts()));
        QVERIFY(menu.isVisible());
    }

    void areNotTakenFromAWindowThatIsNotTheConsoles()
    {
        Stage stage;
        QVERIFY(stage.ready());
        QWidget other;
        other.show();
        other.activateWindow();
        QVERIFY(QTest::qWaitForWindowActive(&other));
        for (const Qt::Key key : urgent)
            QTest::keyClick(&other, key);
        QVERIFY2(stage.each(0), qPrintable(stage.counts()));
    }
};

QTEST_MAIN(TestUrgentKeys)
#include "test_urgent_keys.moc"
