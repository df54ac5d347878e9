// Screens that really go, with the whole console on them: they are taken away from Qt's offscreen platform, and Qt does what it does in its
// own order (the list of screens, the signal, the move of windows that are left over, the end of the screen).
//
// What is on which screen is tried by gui.screens; what else ends motion, and does not give it back, by system.never_possible.
#include "imaging/scene_view.hpp"
#include "never_possible_stage.hpp"
#include "widgets/choice_row.hpp"
#include "widgets/side_window.hpp"

#include <QElapsedTimer>
#include <QGuiApplication>
#include <QJsonArray>
#include <QJsonObject>
#include <QScopeGuard>
#include <QScreen>
#include <QWindow>

using namespace console;
using console::test::logTells;
using console::test::Theatre;
using Stage = console::test::NeverStage;

/// As much of it as Qt's own tests need to change the screens; its header is in a package of its own.
class Q_DECL_IMPORT QPlatformNativeInterface : public QObject {
public:
    virtual void* nativeResourceForIntegration(const QByteArray& resource);
};

namespace {

constexpr int patience = Theatre::patience;
constexpr int limit = 1000; ///< milliseconds, for everything to be on the screens that are left

/// What the platform was told of its screens.
QJsonObject presentScreens()
{
    using Tell = QJsonObject (*)(QPlatformNativeInterface*);
    auto* platform = QGuiApplication::platformNativeInterface();
    return reinterpret_cast<Tell>(platform->nativeResourceForIntegration("configuration"))(platform);
}

/// Those that are not among them go at once, new ones come.
void setScreens(const QJsonObject& screens)
{
    using Set = void (*)(const QJsonObject&, QPlatformNativeInterface*);
    auto* platform = QGuiApplication::platformNativeInterface();
    reinterpret_cast<Set>(platform->nativeResourceForIntegration("setConfiguration"))(screens, platform);
}

QJsonObject without(QJsonObject screens, const QStringList& names)
{
    const auto key = QStringLiteral("screens");
    const auto all = screens.value(key).toArray();
    QJsonArray left;
    for (const auto& screen : all)
        if (!names.contains(screen.toObject().value(QStringLiteral("name")).toString()))
            left.append(screen);
    screens.insert(key, left);
    return screens;
}

/// In sight, and wholly on that screen.
bool standsOn(const QWidget& window, const QString& screen)
{
    return window.isVisible() && window.windowHandle()->isExposed() && window.screen()->name() == screen &&
           window.screen()->geometry().contains(window.geometry());
}

QStringList shownSideWindows()
{
    QStringList names;
    for (const QWidget* widget : QApplication::topLevelWidgets())
        if (qobject_cast<const SideWindow*>(widget) != nullptr && widget->isVisible())
            names << widget->accessibleName();
    names.sort();
    return names;
}

bool click(QWidget& window, const QString& accessibleName)
{
    QAbstractButton* found = nullptr;
    const auto find = [&] {
        for (auto* button : window.findChildren<QAbstractButton*>())
            if (button->isVisible() && button->isEnabled() && button->accessibleName() == accessibleName)
                found = button;
        return found != nullptr;
    };
    if (!QTest::qWaitFor(find, patience))
        return false;
    QTest::mouseClick(found, Qt::LeftButton);
    return true;
}

/// What F7's view says beside the choice of a second screen.
QString wordsOfSecond(const QWidget& window)
{
    for (const auto* row : window.findChildren<ChoiceRow*>())
        if (row->accessibleName() == QStringLiteral("Second screen"))
            return row->accessibleDescription();
    return {};
}

} // namespace

class VanishedScreenTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase()
    {
        QCOMPARE(QGuiApplication::screens().size(), 3);
        m_all = presentScreens();
        m_stage = console::test::openStage();
        QVERIFY(m_stage);
    }

    void init() { setScreens(m_all); }

    void cleanupTestCase() { m_stage.reset(); }

    // Rule 5, and a second for all to fold.

    void theCockpitsScreenIsPulledOutWhileTheRobotMoves()
    {
        Stage& stage = *m_stage;
        Theatre& theatre = stage.theatre;
        auto& window = theatre.window();
        const auto overview = QStringLiteral("Overview");
        const auto reference = QStringLiteral("Reference picture");
        theatre.strike(Qt::Key_F7);
        QVERIFY(click(window, QStringLiteral("Second screen: second")) && click(window, QStringLiteral("Third screen: third")));
        QTRY_COMPARE(shownSideWindows(), (QStringList{overview, reference}));
        stage.comeToTheFront();
        QVERIFY2(theatre.armAndMove(), qPrintable(theatre.story()));
        QVERIFY(standsOn(window, QStringLiteral("first")) && window.handHasKeys());

        QElapsedTimer since;
        since.start();
        setScreens(without(m_all, {QStringLiteral("first")}));
        QVERIFY2(!stage.mayMove(), qPrintable(theatre.story())); // the event loop has not turned
        const auto folded = [&] { return standsOn(window, QStringLiteral("second")) && shownSideWindows() == QStringList{reference}; };
        QVERIFY(QTest::qWaitFor(folded, limit));
        QVERIFY2(since.elapsed() < limit, qPrintable(QString::number(since.elapsed())));
        QVERIFY(!window.handHasKeys());
        QVERIFY2(logTells(theatre, QStringLiteral("The screen first is gone; the cockpit is on second.")), qPrintable(theatre.story()));

        QVERIFY(stage.settles());
        QVERIFY2(stage.nothingComesBack(), qPrintable(theatre.story()));
        QVERIFY(!window.handHasKeys());
        theatre.releaseAll();
        auto* scene = window.findChild<SceneView*>();
        QVERIFY(scene != nullptr);
        QTest::mouseClick(scene, Qt::LeftButton);
        QTRY_VERIFY(window.handHasKeys());
    }

    /// A dock that is unplugged: the cockpit comes to a screen that goes, too, before the event loop turns.
    void twoScreensThatGoTogetherLeaveTheCockpitOnTheThird_data()
    {
        QTest::addColumn<bool>("whole");
        QTest::newRow("in a window") << false;
        QTest::newRow("on the whole screen") << true;
    }

    void twoScreensThatGoTogetherLeaveTheCockpitOnTheThird()
    {
        QFETCH(bool, whole);
        Theatre& theatre = m_stage->theatre;
        auto& window = theatre.window();
        const auto back = qScopeGuard([&window] { window.showNormal(); });
        if (whole)
            window.showFullScreen();
        const auto one = window.screen()->name();
        QElapsedTimer since;
        since.start();
        setScreens(without(m_all, {one}));
        const auto other = window.screen()->name();
        QVERIFY(other != one);
        setScreens(without(m_all, {one, other}));
        const auto left = QGuiApplication::primaryScreen()->name();
        QVERIFY(QTest::qWaitFor([&] { return standsOn(window, left); }, limit));
        QVERIFY2(since.elapsed() < limit, qPrintable(QString::number(since.elapsed())));
        QTRY_COMPARE(wordsOfSecond(window), QStringLiteral("no further screen is there"));
        QVERIFY(window.isFullScreen() == whole && shownSideWindows().isEmpty() && !window.handHasKeys());
        QVERIFY2(logTells(theatre, QStringLiteral("The screen %1 is gone; the cockpit is on %2.").arg(other, left)),
                 qPrintable(theatre.story()));
    }

private:
    QJsonObject m_all;
    std::unique_ptr<Stage> m_stage;
};

QTEST_MAIN(VanishedScreenTest)
#include "vanished_screen_test.moc"
