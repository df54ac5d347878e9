// Tests of the rows of controls under the pictures: every control by mouse and by key, and the keys stay with the hand.
#include "widgets/picture_controls.hpp"
#include "widgets/picture_pane.hpp"
#include "widgets/review_controls.hpp"
#include "widgets/small_button.hpp"
#include "widgets/theme.hpp"

#include <QApplication>
#include <QLabel>
#include <QSignalSpy>
#include <QSlider>
#include <QtTest>

#include <algorithm>
#include <cmath>

using namespace console;

namespace {

template <typename Root>
SmallButton* named(Root& root, const QString& name)
{
    for (SmallButton* button : root.template findChildren<SmallButton*>())
        if (button->accessibleName() == name)
            return button;
    return nullptr;
}

bool isWhole(const QPushButton& button)
{
    return button.fontMetrics().horizontalAdvance(button.text()) <= button.width() - 4 && button.fontMetrics().height() <= button.height();
}

/// From a value to the buttons beside it, and from a button's words to its sides; the least of them.
int leastAir(const PictureControls& controls)
{
    int least = controls.width();
    for (const SmallButton* button : controls.findChildren<SmallButton*>()) {
        if (button->isVisible())
            least = std::min(least, (button->width() - button->fontMetrics().horizontalAdvance(button->text())) / 2);
        for (const QLabel* value : controls.findChildren<QLabel*>()) {
            const int between = button->x() < value->x() ? value->geometry().left() - button->geometry().right()
                                                         : button->geometry().left() - value->geometry().right();
            const int height = value->geometry().center().y();
            if (button->geometry().top() <= height && height <= button->geometry().bottom())
                least = std::min(least, between);
        }
    }
    return least;
}

QStringList notWhole(const PicturePane& pane)
{
    QStringList wrong;
    for (const SmallButton* button : pane.findChildren<SmallButton*>()) {
        const bool inside = pane.rect().contains(QRect(button->mapTo(&pane, QPoint()), button->size()));
        if (button->isVisible() && (!isWhole(*button) || !inside || button->accessibleName().isEmpty()))
            wrong << button->text();
    }
    return wrong;
}

} // namespace

class TestPictureControls : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase() { theme::apply(*qApp); }

    void changeSettings_data()
    {
        QTest::addColumn<QString>("name");
        QTest::newRow("auto") << QStringLiteral("Automatic window");
        QTest::newRow("window") << QStringLiteral("Next window");
        QTest::newRow("invert") << QStringLiteral("Invert");
        QTest::newRow("noise") << QStringLiteral("More noise reduction");
        QTest::newRow("edge") << QStringLiteral("More edge enhancement");
        QTest::newRow("shutter") << QStringLiteral("Shutter");
    }

    void changeSettings()
    {
        QFETCH(QString, name);
        DisplayState display;
        PictureControls controls(display);
        SmallButton* button = named(controls, name);
        QVERIFY(button);
        QTest::mouseClick(button, Qt::LeftButton);
        const DisplaySettings byMouse = display.settings();
        QVERIFY(byMouse != DisplaySettings());
        display.reset();
        QTest::keyClick(button, Qt::Key_Space);
        QCOMPARE(display.settings(), byMouse);
        QTest::mouseClick(named(controls, QStringLiteral("Reset picture")), Qt::LeftButton);
        QCOMPARE(display.settings(), DisplaySettings());
    }

    void askForTheRest()
    {
        DisplayState display;
        PictureControls controls(display);
        QSignalSpy zoom(&controls, &PictureControls::zoomRequested);
        QSignalSpy whole(&controls, &PictureControls::wholeRequested);
        QSignalSpy save(&controls, &PictureControls::saveRequested);
        named(controls, QStringLiteral("More zoom"))->click();
        named(controls, QStringLiteral("Less zoom"))->click();
        QCOMPARE(zoom.at(0).first().toInt(), 1);
        QCOMPARE(zoom.at(1).first().toInt(), -1);
        named(controls, QStringLiteral("Reset picture"))->click();
        QCOMPARE(whole.count(), 1);
        named(controls, QStringLiteral("Save picture"))->click();
        QCOMPARE(save.count(), 1);
        named(controls, QStringLiteral("Measure"))->click();
        QCOMPARE(display.measureMode(), MeasureMode::Distance);
        QCOMPARE(named(controls, QStringLiteral("Measure"))->text(), QStringLiteral("Distance")); // as the labels of the other buttons
        named(controls, QStringLiteral("Measure"))->click();
        QCOMPARE(named(controls, QStringLiteral("Measure"))->text(), QStringLiteral("Angle"));
        named(controls, QStringLiteral("Measure"))->click();
        QCOMPARE(display.measureMode(), MeasureMode::Off);
    }

    void askForCatheterAndPlaneWhileADistanceIsMeasured()
    {
        DisplayState display;
        PicturePane pane(new QWidget, new PictureControls(display));
        auto& controls = *pane.findChild<PictureControls*>();
        pane.resize(852, 852);
        pane.show();
        QVERIFY(QTest::qWaitForWindowExposed(&pane));
        QSignalSpy catheter(&controls, &PictureControls::catheterRequested);
        QSignalSpy plane(&controls, &PictureControls::planeRequested);
        SmallButton* measure = named(controls, QStringLiteral("Measure"));
        SmallButton* width = named(controls, QStringLiteral("Width of a catheter"));
        SmallButton* lengths = named(controls, QStringLiteral("Plane of lengths"));
        QVERIFY(width && lengths && !width->isVisible() && !lengths->isVisible());
        const QRect before = measure->geometry();
        QTest::mouseClick(measure, Qt::LeftButton);
        QVERIFY(width->isVisible() && lengths->isVisible());
        QTRY_VERIFY(std::abs(measure->x() - before.x()) <= 2); // nothing moves from under the finger, which may press again
        for (SmallButton* button : {width, lengths}) {
            QVERIFY(std::min(button->width(), button->height()) >= theme::touchSide(button) && !button->toolTip().isEmpty());
            QTest::mouseClick(button, Qt::LeftButton);
            QTest::keyClick(button, Qt::Key_Space);
        }
        QCOMPARE(catheter.count(), 2);
        QCOMPARE(plane.count(), 2);
        QVERIFY(!lengths->isChecked());
        display.nextPlane();
        QVERIFY(lengths->isChecked());
        QCOMPARE(lengths->accessibleDescription(), QStringLiteral("10.0 cm above the table"));
        width->setFocus(Qt::TabFocusReason);
        QTest::mouseClick(measure, Qt::LeftButton); // an angle has neither
        QVERIFY(!width->isVisible() && !lengths->isVisible());
        QVERIFY(!measure->hasFocus() && !named(controls, QStringLiteral("Save picture"))->hasFocus());
    }

    void showWhatIsInForce()
    {
        DisplayState display;
        PictureControls controls(display);
        SmallButton* automatic = named(controls, QStringLiteral("Automatic window"));
        QVERIFY(!automatic->isChecked());
        display.setAutomatic();
        QVERIFY(automatic->isChecked());
        QTest::mouseClick(automatic, Qt::LeftButton); // it is so already, and stays so
        QVERIFY(automatic->isChecked());
        display.nextWindow();
        QVERIFY(!automatic->isChecked());
        display.stepNoiseReduction(4);
        display.stepEdge(30);
        QStringList texts;
        for (const QLabel* label : controls.findChildren<QLabel*>())
            texts << label->text();
        QVERIFY(texts.contains(QStringLiteral("noise 40")));
        QVERIFY(texts.contains(QStringLiteral("edge 100")));
        controls.showZoom(2.5);
        QCOMPARE(controls.findChildren<QLabel*>().first()->text(), QStringLiteral("2.5\u00D7"));
    }

    void clickLeavesTheKeysToTheHand()
    {
        QWidget window;
        window.setFocusPolicy(Qt::StrongFocus);
        DisplayState display;
        auto* pane = new PicturePane(new QWidget, new PictureControls(display), &window);
        window.resize(900, 600);
        pane->resize(window.size());
        window.show();
        QVERIFY(QTest::qWaitForWindowActive(&window));
        window.setFocus();
        for (SmallButton* button : window.findChildren<SmallButton*>()) {
            if (!button->isVisible())
                continue;
            QTest::mouseClick(button, Qt::LeftButton);
            QVERIFY(window.hasFocus());
            button->setFocus(Qt::TabFocusReason);
            QVERIFY(button->hasFocus());
            window.setFocus();
        }
    }

    void textsAreWhole_data()
    {
        QTest::addColumn<int>("edge");
        QTest::addColumn<double>("scale");
        QTest::newRow("2560x1440") << 1136 << 1.0;
        QTest::newRow("1920x1080") << 852 << 0.75;
        QTest::newRow("1366x768") << 606 << 0.53;
    }

    void textsAreWhole()
    {
        QFETCH(int, edge);
        QFETCH(double, scale);
        DisplayState display;
        PicturePane live(new QWidget, new PictureControls(display));
        PicturePane reference(new QWidget, new ReviewControls);
        display.stepNoiseReduction(10);
        display.stepEdge(10);
        display.nextMeasureMode();
        for (PicturePane* pane : {&live, &reference}) {
            theme::applyScale(pane, scale);
            pane->resize(pane == &live ? edge : edge / 2, edge);
            pane->show();
            QVERIFY(QTest::qWaitForWindowExposed(pane));
            QCOMPARE(pane->width(), pane == &live ? edge : edge / 2); // nothing in it asks for more
            QTRY_COMPARE(notWhole(*pane), QStringList());
        }
        QTRY_VERIFY(leastAir(*live.findChild<PictureControls*>()) >= 5);
        reference.findChild<ReviewControls*>()->showRoadmap(true);
        QVERIFY(named(reference, QStringLiteral("Stronger vessels of the roadmap"))->isVisible());
        QTRY_COMPARE(notWhole(reference), QStringList());
        QVERIFY(reference.findChild<QSlider*>()->width() >= 40); // a way for its handle
    }

    void theVesselsStrengthIsSteppedByTheKeyboard()
    {
        ReviewControls controls;
        controls.showRoadmap(true);
        QSignalSpy opacity(&controls, &ReviewControls::opacityChanged);
        const auto after = [&](const QString& name, int presses) {
            for (int i = 0; i < presses; ++i)
                QTest::keyClick(named(controls, name), Qt::Key_Space);
            return opacity.isEmpty() ? -1 : opacity.last().first().toDouble();
        };
        QCOMPARE(after(QStringLiteral("Stronger vessels of the roadmap"), 1), 0.7);
        QCOMPARE(after(QStringLiteral("Weaker vessels of the roadmap"), 3), 0.4);
        QCOMPARE(after(QStringLiteral("Weaker vessels of the roadmap"), 9), 0.0);
        QCOMPARE(after(QStringLiteral("Stronger vessels of the roadmap"), 11), 1.0);
    }

    void reviewIsSteppedOnlyWhileItIsOpen()
    {
        ReviewControls controls;
        QSignalSpy steps(&controls, &ReviewControls::stepRequested);
        QSignalSpy play(&controls, &ReviewControls::playRequested);
        SmallButton* back = named(controls, QStringLiteral("One picture back"));
        SmallButton* film = named(controls, QStringLiteral("Play"));
        QTest::mouseClick(back, Qt::LeftButton);
        QCOMPARE(steps.count(), 0);
        controls.showReview(true, false);
        QTest::mouseClick(back, Qt::LeftButton);
        QTest::mouseClick(named(controls, QStringLiteral("One picture on")), Qt::LeftButton);
        QCOMPARE(steps.at(0).first().toInt(), -1);
        QCOMPARE(steps.at(1).first().toInt(), 1);
        QTest::mouseClick(film, Qt::LeftButton);
        QCOMPARE(play.last().first().toBool(), true);
        controls.showReview(true, true);
        QCOMPARE(film->text(), QStringLiteral("Stop"));
        QTest::mouseClick(film, Qt::LeftButton);
        QCOMPARE(play.last().first().toBool(), false);
    }
};

QTEST_MAIN(TestPictureControls)
#include "test_picture_controls.moc"
