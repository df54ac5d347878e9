// Every control of every state of the gallery: hit by a finger, named, reached by Tab, and seen to have the focus.
#include "gallery_scene.hpp"
#include "imaging/live_image_view.hpp"
#include "imaging/pane_colours.hpp"
#include "imaging/reference_image_view.hpp"
#include "imaging/scene_view.hpp"
#include "widgets/hold_button.hpp"
#include "widgets/motion_bar.hpp"
#include "widgets/review_controls.hpp"
#include "widgets/stop_button.hpp"
#include "widgets/theme.hpp"

#include <QAbstractButton>
#include <QLineEdit>
#include <QSet>
#include <QSlider>
#include <QTest>

#include <algorithm>
#include <cmath>
#include <initializer_list>

using namespace console;
using namespace console::test;

namespace {

/// 27 inches: 597 mm for the width of the reference, whatever the resolution.
double millimetres(double pixels, const QWidget& window) { return pixels * 597 / theme::referenceWidth / theme::scaleFor(window.size()); }

bool isSafety(const QWidget* widget)
{
    return qobject_cast<const HoldButton*>(widget) != nullptr || qobject_cast<const StopButton*>(widget) != nullptr;
}

bool isHit(const QWidget* widget)
{
    return qobject_cast<const QAbstractButton*>(widget) != nullptr || qobject_cast<const QLineEdit*>(widget) != nullptr;
}

QString describe(const QWidget* widget)
{
    return QStringLiteral("%1 \"%2\" %3x%4")
        .arg(QString::fromLatin1(widget->metaObject()->className()), widget->accessibleName())
        .arg(widget->width())
        .arg(widget->height());
}

std::vector<QWidget*> shown(const CockpitWindow& window, bool (*which)(const QWidget*))
{
    std::vector<QWidget*> found;
    for (QWidget* widget : window.findChildren<QWidget*>())
        if (widget->isVisible() && which(widget))
            found.push_back(widget);
    return found;
}

/// Half a pixel less is rounding.
bool reaches(double pixels, double wanted, const QWidget& window) { return millimetres(pixels + 0.5, window) >= wanted; }

QStringList tooSmall(const CockpitWindow& window)
{
    QStringList small;
    for (const QWidget* widget : shown(window, isHit)) {
        const double wanted = isSafety(widget) ? 20 : 12;
        if (!reaches(std::min(widget->width(), widget->height()), wanted, window))
            small << describe(widget);
    }
    return small;
}

QStringList tooClose(const CockpitWindow& window)
{
    auto safety = shown(window, isSafety);
    const auto left = [&window](const QWidget* widget) { return widget->mapTo(&window, QPoint()).x(); };
    std::sort(safety.begin(), safety.end(), [&](const QWidget* a, const QWidget* b) { return left(a) < left(b); });
    QStringList close;
    for (std::size_t i = 1; i < safety.size(); ++i)
        if (!reaches(left(safety[i]) - left(safety[i - 1]) - safety[i - 1]->width(), 5, window))
            close << describe(safety[i - 1]) + QStringLiteral(" / ") + describe(safety[i]);
    return close;
}

bool takesFocus(const QWidget* widget)
{
    const bool control = qobject_cast<const QAbstractButton*>(widget) != nullptr || widget->focusPolicy() != Qt::NoFocus;
    return control && widget->focusProxy() == nullptr;
}

/// By Tab, until the cockpit itself has the focus again, where the way began.
QSet<const QWidget*> reachedByTab(CockpitWindow& window)
{
    QSet<const QWidget*> reached;
    window.setFocus();
    for (int steps = 0; steps < 300; ++steps) {
        QTest::keyClick(QApplication::focusWidget(), Qt::Key_Tab);
        if (QApplication::focusWidget() == &window)
            break;
        reached.insert(QApplication::focusWidget());
    }
    return reached;
}

/// The cockpit with a roadmap, which has a slider, and with a scene of its own where the gallery has an invented picture.
struct WorkedByKeys {
    GalleryScene scene{QSize(1920, 1080)};
    SceneView* space = new SceneView;

    WorkedByKeys() { window().setSceneView(space); }

    bool bring()
    {
        const auto states = galleryStates();
        const auto roadmap = std::find_if(states.begin(), states.end(),
                                          [](const GalleryState& state) { return QLatin1String(state.name) == QLatin1String("roadmap"); });
        return roadmap != states.end() && scene.bring(*roadmap, 0) && live() && reference() && strength();
    }

    CockpitWindow& window() { return scene.window(); }
    LiveImageView* live() { return window().findChild<LiveImageView*>(); }
    ReferenceImageView* reference() { return window().findChild<ReferenceImageView*>(); }
    QSlider* strength() { return window().findChild<ReviewControls*>()->findChild<QSlider*>(); }
};

/// Of the frame round a pane that has the keys, along its upper edge.
int framePixels(QWidget& pane)
{
    const QImage edge = pane.grab(QRect(0, 0, pane.width(), 6)).toImage();
    int count = 0;
    for (int y = 0; y < edge.height(); ++y)
        for (int x = 0; x < edge.width(); ++x)
            count += edge.pixelColor(x, y).rgb() == pane_colours::focus.rgb() ? 1 : 0;
    return count;
}

} // namespace

class TestControls : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase() { theme::apply(*qApp); }

    void aFingerInAGloveHitsEveryControl_data()
    {
        QTest::addColumn<int>("state");
        QTest::addColumn<QSize>("screen");
        int row = 0;
        for (const GalleryState& state : galleryStates()) {
            for (const QSize& screen : {QSize(2560, 1440), QSize(1920, 1080)})
                QTest::addRow("%s at %d", state.name, screen.height()) << row << screen;
            ++row;
        }
    }

    void aFingerInAGloveHitsEveryControl()
    {
        QFETCH(int, state);
        QFETCH(QSize, screen);
        GalleryScene scene(screen);
        QVERIFY(scene.bring(galleryStates().at(std::size_t(state)), 0));
        QStringList wrong;
        QTRY_VERIFY2((wrong = tooSmall(scene.window())).isEmpty(), qPrintable(wrong.join(QStringLiteral("; "))));
        QTRY_VERIFY2((wrong = tooClose(scene.window())).isEmpty(), qPrintable(wrong.join(QStringLiteral("; "))));
        QCOMPARE(shown(scene.window(), isSafety).size(), std::size_t(4));
    }

    void everyControlHasANameAndIsReachedByTab_data()
    {
        QTest::addColumn<int>("state");
        int row = 0;
        for (const GalleryState& state : galleryStates())
            QTest::newRow(state.name) << row++;
    }

    void everyControlHasANameAndIsReachedByTab()
    {
        QFETCH(int, state);
        GalleryScene scene(QSize(1920, 1080));
        QVERIFY(scene.bring(galleryStates().at(std::size_t(state)), 0));
        const auto controls = shown(scene.window(), takesFocus);
        QVERIFY(controls.size() >= 6);
        for (const QWidget* control : controls)
            QVERIFY2(!control->accessibleName().isEmpty(), qPrintable(describe(control)));
        const auto reached = reachedByTab(scene.window());
        for (const QWidget* control : controls)
            if (control->isEnabled() && isHit(control))
                QVERIFY2(reached.contains(control), qPrintable(describe(control)));
    }

    void focusIsSeen_data() { everyControlHasANameAndIsReachedByTab_data(); }

    /// Each kind of control once in a state: what it looks like with the focus, and without.
    void focusIsSeen()
    {
        QFETCH(int, state);
        GalleryScene scene(QSize(1920, 1080));
        QVERIFY(scene.bring(galleryStates().at(std::size_t(state)), 0));
        QSet<QString> kinds;
        for (QWidget* control : shown(scene.window(), isHit)) {
            const auto kind = QString::fromLatin1(control->metaObject()->className()) + control->property("compact").toString() +
                              control->property("slim").toString() + control->property("emphasis").toString();
            if (!control->isEnabled() || kinds.contains(kind))
                continue;
            kinds.insert(kind);
            scene.window().setFocus();
            const QImage without = control->grab().toImage();
            control->setFocus(Qt::TabFocusReason);
            QTRY_VERIFY2(control->grab().toImage() != without, qPrintable(describe(control)));
        }
        QVERIFY(kinds.size() > 3);
    }

    /// No buttons, and worked by keys all the same.
    void picturesSceneAndSliderAreReachedByTab()
    {
        WorkedByKeys cockpit;
        QVERIFY(cockpit.bring());
        const auto reached = reachedByTab(cockpit.window());
        for (const QWidget* part :
             std::initializer_list<const QWidget*>{cockpit.live(), cockpit.reference(), cockpit.space, cockpit.strength()}) {
            QVERIFY2(part->isVisible(), qPrintable(describe(part)));
            QVERIFY2(reached.contains(part), qPrintable(describe(part)));
        }
    }

    void aClickOnThemLeavesTheKeysToTheHand()
    {
        WorkedByKeys cockpit;
        QVERIFY(cockpit.bring());
        cockpit.window().setFocus();
        for (QWidget* part : std::initializer_list<QWidget*>{cockpit.live(), cockpit.reference(), cockpit.space, cockpit.strength()}) {
            QTest::mouseClick(part, Qt::LeftButton, {}, part->rect().center());
            QVERIFY2(QApplication::focusWidget() == &cockpit.window(), qPrintable(describe(part)));
        }
    }

    void paneThatHasTheKeysIsFramed()
    {
        WorkedByKeys cockpit;
        QVERIFY(cockpit.bring());
        for (QWidget* pane : std::initializer_list<QWidget*>{cockpit.live(), cockpit.reference(), cockpit.space}) {
            cockpit.window().setFocus();
            QCOMPARE(framePixels(*pane), 0);
            pane->setFocus(Qt::TabFocusReason);
            QVERIFY2(pane->hasFocus() && framePixels(*pane) > pane->width(), qPrintable(describe(pane)));
        }
    }
};

QTEST_MAIN(TestControls)
#include "test_controls.moc"
