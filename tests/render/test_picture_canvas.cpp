// Tests of a picture pane as a person uses it: mouse, wheel and keys, with a look at the pixels.
#include "imaging/frame_pipeline.hpp"
#include "imaging/live_image_view.hpp"
#include "imaging/picture_overlay.hpp"
#include "sample_frames.hpp"

#include <QSignalSpy>
#include <QWheelEvent>
#include <QtTest>

using namespace console;

namespace {

constexpr QSize frameSize(640, 520);

// A window with the live pane in it, and the chain behind it; the window takes what keys the pane leaves.
class Window : public QWidget {
public:
    QList<int> left;

protected:
    void keyPressEvent(QKeyEvent* event) override
    {
        if (event->key() != Qt::Key_Shift)
            left.push_back(event->key());
    }
};

struct Pane {
    Pane()
    {
        window.setFocusPolicy(Qt::StrongFocus);
        state.setLinkUp(true);
        state.expect(15, std::chrono::steady_clock::now());
        view->setParent(&window);
        view->resize(frameSize + QSize(2 * hatchWidth, 2 * hatchWidth));
        window.resize(view->size());
        view->setDisplay(&display);
        QObject::connect(&display, &DisplayState::changed, &pipeline, &FramePipeline::setSettings);
        QObject::connect(&pipeline, &FramePipeline::pictureReady, view, &LiveImageView::showPicture);
        window.show();
    }

    bool send(quint32 number, QSize size = frameSize)
    {
        auto frame = samples::frame(number, size, 12, PixelEncoding::Raw);
        frame->arrival = std::chrono::steady_clock::now();
        const quint64 before = pipeline.counts().shown;
        pipeline.showFrame(frame);
        return QTest::qWaitFor([&] { return pipeline.counts().shown > before; });
    }

    bool settled() const
    {
        return QTest::qWaitFor([this] { return view->picture() && view->picture()->settings == display.settings(); });
    }

    QImage grab() { return view->grab().toImage().convertToFormat(QImage::Format_RGB32); }
    QPoint middle() const { return view->pictureRect().center(); }

    void wheel(int notches, QPoint at)
    {
        QWheelEvent event(at, view->mapToGlobal(at), {}, {0, 120 * notches}, Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase, false);
        QCoreApplication::sendEvent(view, &event);
    }

    PictureState state;
    DisplayState display;
    FramePipeline pipeline;
    Window window;
    LiveImageView* view = new LiveImageView(state);
};

} // namespace

class TestPictureCanvas : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void dragMovesWindow();
    void aKeyMovesWhatIsShown();
    void keysChangeEverySetting();
    void settingsRedrawTheSamePicture();
    void leavesHandsKeysAlone_data();
    void leavesHandsKeysAlone();
    void clickGivesKeysToWindow();
    void zoomsAboutTheMouse();
    void neverPansBeyondThePicture();
    void dragPans_data();
    void dragPans();
    void showsAPictureOfAnotherSizeWhole();
    void measuresDistanceByMouse();
    void measuresAngleByKeys();
    void setsNoPointWhereNobodySeesIt();
    void showsFocus();
};

void TestPictureCanvas::dragMovesWindow()
{
    Pane pane;
    QVERIFY(pane.send(1));
    QTest::mousePress(pane.view, Qt::LeftButton, {}, pane.middle());
    QTest::mouseMove(pane.view, pane.middle() + QPoint(-52, 0));
    QTest::mouseRelease(pane.view, Qt::LeftButton, {}, pane.middle() + QPoint(-52, 0));
    const DisplaySettings narrower = pane.display.settings();
    QCOMPARE(narrower.window, WindowChoice::Fixed);
    QCOMPARE(narrower.fixed.centre, 2048.0);
    QVERIFY(narrower.fixed.width < 4096 * 0.9);
    QVERIFY(pane.settled());
    QCOMPARE(pane.view->picture()->window, narrower.fixed);
    QTest::mousePress(pane.view, Qt::LeftButton, {}, pane.middle());
    QTest::mouseMove(pane.view, pane.middle() + QPoint(0, 60));
    QTest::mouseRelease(pane.view, Qt::LeftButton, {}, pane.middle() + QPoint(0, 60));
    QVERIFY(pane.display.settings().fixed.centre > 2048);
    QCOMPARE(pane.display.settings().fixed.width, narrower.fixed.width);
}

/// The centre stays among the picture's values: what was pressed beyond them need not be pressed back.
void TestPictureCanvas::aKeyMovesWhatIsShown()
{
    Pane pane;
    QVERIFY(pane.send(1));
    for (int press = 0; press < 60; ++press) {
        QTest::keyClick(pane.view, Qt::Key_X);
        QVERIFY(pane.settled());
    }
    const double farthest = pane.view->picture()->window.centre;
    QTest::keyClick(pane.view, Qt::Key_X);
    QVERIFY(pane.settled());
    QCOMPARE(pane.view->picture()->window.centre, farthest);
    QTest::keyClick(pane.view, Qt::Key_S);
    QVERIFY(pane.settled());
    QVERIFY(pane.view->picture()->window.centre < farthest);
}

void TestPictureCanvas::keysChangeEverySetting()
{
    Pane pane;
    QVERIFY(pane.send(1));
    QTest::keyClick(pane.view, Qt::Key_A);
    QCOMPARE(pane.display.settings().window, WindowChoice::Automatic);
    QVERIFY(pane.settled());
    QVERIFY(pane.view->picture()->windowIsAutomatic);
    QTest::keyClick(pane.view, Qt::Key_P);
    QCOMPARE(pane.display.settings().window, WindowChoice::AsSent);
    QTest::keyClick(pane.view, Qt::Key_P);
    QCOMPARE(pane.display.settings().window, WindowChoice::FullRange);
    QTest::keyClick(pane.view, Qt::Key_N);
    QVERIFY(pane.display.settings().inverted);
    QTest::keyClick(pane.view, Qt::Key_V);
    QCOMPARE(pane.display.settings().function, VoiFunction::LinearExact);
    QTest::keyClick(pane.view, Qt::Key_T);
    QTest::keyClick(pane.view, Qt::Key_T);
    QTest::keyClick(pane.view, Qt::Key_T, Qt::ShiftModifier);
    QCOMPARE(pane.display.settings().noiseReduction, 10);
    QTest::keyClick(pane.view, Qt::Key_E);
    QCOMPARE(pane.display.settings().edge, 10);
    QTest::keyClick(pane.view, Qt::Key_H);
    QCOMPARE(pane.display.settings().shutter, ShutterShape::Circle);
    QVERIFY(pane.settled());
    const double width = pane.view->picture()->window.width;
    QTest::keyClick(pane.view, Qt::Key_W);
    QVERIFY(pane.display.settings().fixed.width > width);
    QTest::keyClick(pane.view, Qt::Key_Q);
    QTest::keyClick(pane.view, Qt::Key_Q);
    QVERIFY(pane.display.settings().fixed.width < width);
    QTest::keyClick(pane.view, Qt::Key_X);
    QVERIFY(pane.display.settings().fixed.centre > 2048);
    QVERIFY(pane.window.left.isEmpty());
}

void TestPictureCanvas::settingsRedrawTheSamePicture()
{
    Pane pane;
    QVERIFY(pane.send(1));
    const QImage before = pane.grab();
    const QRect mark = pane.view->livenessRect();
    QTest::keyClick(pane.view, Qt::Key_N);
    QVERIFY(pane.settled());
    const QImage after = pane.grab();
    const QPoint inside = pane.middle() + QPoint(40, -60);
    QCOMPARE(qGray(before.pixel(inside)) + qGray(after.pixel(inside)), 255);
    // Another look is no sign of life, and no new picture in any book.
    QCOMPARE(before.copy(mark), after.copy(mark));
    QCOMPARE(pane.state.paintedCount(), quint64(1));
    QCOMPARE(pane.pipeline.counts().shown, quint64(1));
}

void TestPictureCanvas::leavesHandsKeysAlone_data()
{
    QTest::addColumn<int>("key");
    for (const int key : {Qt::Key_D, Qt::Key_F, Qt::Key_C, Qt::Key_R, Qt::Key_Up, Qt::Key_Down, Qt::Key_Left, Qt::Key_Right, Qt::Key_I,
                          Qt::Key_K, Qt::Key_J, Qt::Key_L, Qt::Key_PageUp, Qt::Key_PageDown, Qt::Key_Space, Qt::Key_Return, Qt::Key_Escape})
        QTest::newRow(qPrintable(QKeySequence(key).toString())) << key;
}

void TestPictureCanvas::leavesHandsKeysAlone()
{
    QFETCH(int, key);
    Pane pane;
    QVERIFY(pane.send(1));
    for (int mode = 0; mode < 3; ++mode, pane.display.nextMeasureMode()) {
        pane.window.left.clear();
        QTest::keyClick(pane.view, static_cast<Qt::Key>(key));
        QCOMPARE(pane.window.left, QList<int>{key});
        QCOMPARE(pane.display.settings(), DisplaySettings());
    }
}

void TestPictureCanvas::clickGivesKeysToWindow()
{
    Pane pane;
    QVERIFY(QTest::qWaitForWindowActive(&pane.window));
    pane.view->setFocus(Qt::TabFocusReason);
    QVERIFY(pane.view->hasFocus());
    QTest::mouseClick(pane.view, Qt::LeftButton, {}, pane.view->rect().center());
    QVERIFY(!pane.view->hasFocus());
    QVERIFY(pane.window.hasFocus());
}

void TestPictureCanvas::zoomsAboutTheMouse()
{
    Pane pane;
    QVERIFY(pane.send(1));
    const QPoint at = pane.view->pictureRect().topLeft() + QPoint(160, 130);
    const QPointF place = pane.view->viewport().toPicture(at);
    pane.wheel(3, at);
    QVERIFY(std::abs(pane.view->viewport().zoom() - 1.25 * 1.25 * 1.25) < 1e-9);
    const QPointF still = pane.view->viewport().toPicture(at);
    QVERIFY(QLineF(place, still).length() < 1e-6);
    pane.wheel(-30, at);
    QCOMPARE(pane.view->viewport().zoom(), 1.0);
    QCOMPARE(pane.view->viewport().part(), QRectF(QPointF(0, 0), QSizeF(frameSize)));
    QTest::keyClick(pane.view, Qt::Key_Plus);
    QTest::keyClick(pane.view, Qt::Key_Plus);
    QVERIFY(pane.view->viewport().zoom() > 1.5);
    QTest::keyClick(pane.view, Qt::Key_Home);
    QCOMPARE(pane.view->viewport().zoom(), 1.0);
    pane.wheel(100, at);
    QCOMPARE(pane.view->viewport().zoom(), PictureViewport::largestZoom);
}

void TestPictureCanvas::neverPansBeyondThePicture()
{
    Pane pane;
    QVERIFY(pane.send(1));
    const QRectF whole(QPointF(0, 0), QSizeF(frameSize));
    for (const Qt::Key key : {Qt::Key_4, Qt::Key_8, Qt::Key_6, Qt::Key_2}) {
        pane.view->resetView();
        QTest::keyClick(pane.view, key);
        QCOMPARE(pane.view->viewport().part(), whole);
        pane.view->zoomBy(2);
        const QRectF before = pane.view->viewport().part();
        for (int i = 0; i < 30; ++i)
            QTest::keyClick(pane.view, key);
        const QRectF part = pane.view->viewport().part();
        QVERIFY(part != before);
        QVERIFY(whole.adjusted(-1e-6, -1e-6, 1e-6, 1e-6).contains(part));
    }
}

void TestPictureCanvas::dragPans_data()
{
    QTest::addColumn<Qt::MouseButton>("button");
    QTest::addColumn<Qt::KeyboardModifiers>("modifiers");
    QTest::addColumn<bool>("isMeasuring");
    QTest::newRow("middle button") << Qt::MiddleButton << Qt::KeyboardModifiers() << false;
    QTest::newRow("Shift with the left") << Qt::LeftButton << Qt::KeyboardModifiers(Qt::ShiftModifier) << false;
    QTest::newRow("Shift with the left while measuring") << Qt::LeftButton << Qt::KeyboardModifiers(Qt::ShiftModifier) << true;
}

/// And changes nothing else, and ends with the button.
void TestPictureCanvas::dragPans()
{
    QFETCH(Qt::MouseButton, button);
    QFETCH(Qt::KeyboardModifiers, modifiers);
    QFETCH(bool, isMeasuring);
    Pane pane;
    QVERIFY(pane.send(1));
    if (isMeasuring)
        pane.display.nextMeasureMode();
    pane.view->zoomBy(2);
    const QPointF before = pane.view->viewport().part().topLeft();
    for (const auto& [with, keys] : {std::pair(button, modifiers), std::pair(Qt::RightButton, Qt::KeyboardModifiers())}) {
        QTest::mousePress(pane.view, with, keys, pane.middle());
        QTest::mouseMove(pane.view, pane.middle() + QPoint(40, 20));
        QTest::mouseRelease(pane.view, with, keys, pane.middle() + QPoint(40, 20));
    }
    QCOMPARE(pane.view->viewport().part().topLeft(), before - QPointF(20, 10));
    QCOMPARE(pane.display.settings(), DisplaySettings());
    QVERIFY(pane.view->measurement().points().empty());
}

/// And who shows the zoom beside it is told; it does not come back by itself with the first size.
void TestPictureCanvas::showsAPictureOfAnotherSizeWhole()
{
    Pane pane;
    QVERIFY(pane.send(1));
    pane.view->zoomBy(2);
    QSignalSpy changed(pane.view, &PictureCanvas::viewChanged);
    QVERIFY(pane.send(2)); // of the same size it stays
    QCOMPARE(pane.view->viewport().zoom(), 2.0);
    QCOMPARE(changed.count(), 0);
    QVERIFY(pane.send(3, frameSize / 2));
    QCOMPARE(pane.view->viewport().zoom(), 1.0);
    QCOMPARE(changed.count(), 1);
    QVERIFY(pane.send(4));
    QCOMPARE(pane.view->viewport().zoom(), 1.0);
    QCOMPARE(pane.view->viewport().part(), QRectF(QPointF(0, 0), QSizeF(frameSize)));
    QCOMPARE(changed.count(), 1);
}

void TestPictureCanvas::measuresDistanceByMouse()
{
    Pane pane;
    QVERIFY(pane.send(1));
    QTest::keyClick(pane.view, Qt::Key_M);
    QCOMPARE(pane.view->measurement().mode(), MeasureMode::Distance);
    const QPoint corner = pane.view->pictureRect().topLeft();
    QTest::mouseClick(pane.view, Qt::LeftButton, {}, corner + QPoint(100, 100));
    QCOMPARE(pane.view->measurement().text(), QString());
    QTest::mouseClick(pane.view, Qt::LeftButton, {}, corner + QPoint(130, 140));
    // 50 px of 0.3 mm at the detector, SOD 750 of SID 1100.
    QCOMPARE(pane.view->measurement().text(), QStringLiteral("10.2 mm @ isocentre plane (geometry)"));
    QCOMPARE(pane.display.settings(), DisplaySettings()); // it was no window drag
    const QImage marked = pane.grab();
    QTest::keyClick(pane.view, Qt::Key_Delete);
    QVERIFY(pane.view->measurement().points().empty());
    QVERIFY(pane.grab() != marked);
    // Zoomed, the same two places of the picture are as far apart.
    QTest::mouseClick(pane.view, Qt::LeftButton, {}, pane.view->viewport().toPane({100, 100}).toPoint());
    pane.view->zoomBy(2);
    QTest::mouseClick(pane.view, Qt::LeftButton, {}, pane.view->viewport().toPane({300, 250}).toPoint());
    QVERIFY(std::abs(*pane.view->measurement().pixels() - 250) < 1);
    QTest::mouseClick(pane.view, Qt::RightButton, {}, pane.middle());
    QVERIFY(pane.view->measurement().text().endsWith(QStringLiteral("mm (4 F catheter)")));
    QTest::keyClick(pane.view, Qt::Key_B);
    QVERIFY(pane.view->measurement().text().endsWith(QStringLiteral("mm (5 F catheter)")));
}

void TestPictureCanvas::measuresAngleByKeys()
{
    Pane pane;
    QVERIFY(pane.send(1));
    QTest::keyClick(pane.view, Qt::Key_M);
    QTest::keyClick(pane.view, Qt::Key_M);
    QCOMPARE(pane.view->measurement().mode(), MeasureMode::Angle);
    const auto go = [&pane](Qt::Key key, int times) {
        for (int i = 0; i < times; ++i)
            QTest::keyClick(pane.view, key);
    };
    QTest::keyClick(pane.view, Qt::Key_5); // from the middle
    go(Qt::Key_6, 30);
    QTest::keyClick(pane.view, Qt::Key_5);
    go(Qt::Key_2, 30);
    QTest::keyClick(pane.view, Qt::Key_5);
    QCOMPARE(pane.view->measurement().text(), QStringLiteral("90.0\u00B0 in the picture's plane"));
    QVERIFY(pane.window.left.isEmpty());
    QTest::keyClick(pane.view, Qt::Key_M);
    QCOMPARE(pane.view->measurement().mode(), MeasureMode::Off);
}

/// A cursor that is out of sight comes back first.
void TestPictureCanvas::setsNoPointWhereNobodySeesIt()
{
    Pane pane;
    QVERIFY(pane.send(1));
    QTest::keyClick(pane.view, Qt::Key_M);
    const auto goToCorner = [&pane] {
        for (int i = 0; i < 300; ++i) {
            QTest::keyClick(pane.view, Qt::Key_6);
            QTest::keyClick(pane.view, Qt::Key_2);
        }
    };
    const auto seen = [&pane] { return pane.view->viewport().part().contains(pane.view->measurement().points().back()); };
    const auto setPoints = [&pane] {
        QTest::keyClick(pane.view, Qt::Key_5);
        return pane.view->measurement().points().size();
    };
    goToCorner();
    QVERIFY(pane.send(2, frameSize / 2));
    QCOMPARE(setPoints(), std::size_t(0));
    QCOMPARE(setPoints(), std::size_t(1));
    QVERIFY(seen());
    goToCorner();
    pane.view->zoomBy(4); // about the middle
    QCOMPARE(setPoints(), std::size_t(1));
    QCOMPARE(setPoints(), std::size_t(2));
    QVERIFY(seen());
}

void TestPictureCanvas::showsFocus()
{
    Pane pane;
    QVERIFY(QTest::qWaitForWindowActive(&pane.window));
    pane.window.setFocus();
    const QImage without = pane.grab();
    pane.view->setFocus(Qt::TabFocusReason);
    QVERIFY(pane.grab() != without);
}

QTEST_MAIN(TestPictureCanvas)
#include "test_picture_canvas.moc"
