// A pane with an X-ray picture in it: mouse and keys.
#include "imaging/picture_canvas.hpp"

#include "imaging/pane_colours.hpp"
#include "imaging/picture_overlay.hpp"
#include "imaging/text_plates.hpp"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace console {

namespace {

constexpr std::chrono::seconds tellingTime{5};
constexpr int largestText = 32; ///< pixels
constexpr double zoomStep = 1.25;
constexpr double keyShare = 0.05; ///< of the window's width, for one key
constexpr double panStep = 40;    ///< pixels of the pane
constexpr double cursorStep = 1;  ///< pixels of the pane: points are set exactly

} // namespace

PictureCanvas::PictureCanvas(QWidget* parent) : QWidget(parent)
{
    setAttribute(Qt::WA_OpaquePaintEvent);
    setFocusPolicy(Qt::TabFocus); // a click leaves the keys to the hand
    m_tellingEnds.setSingleShot(true);
    m_tellingEnds.setInterval(tellingTime);
    connect(&m_tellingEnds, &QTimer::timeout, this, [this] {
        m_told.clear();
        update();
    });
}

void PictureCanvas::setDisplay(DisplayState* display)
{
    m_display = display;
    m_measurement.setMode(display->measureMode());
    m_measurement.setPlane(display->plane());
    connect(display, &DisplayState::measureModeChanged, this, [this](MeasureMode mode) {
        m_measurement.setMode(mode);
        m_cursor.reset();
        update();
    });
    connect(display, &DisplayState::planeChanged, this, [this](const MeasurePlane& plane) {
        m_measurement.setPlane(plane);
        update();
    });
}

DisplayPicture PictureCanvas::asSeenHere(DisplayPicture picture) const
{
    picture.isCalibrated = picture.isCalibrated && (!m_measuredScreen || *m_measuredScreen == screen());
    return picture;
}

bool PictureCanvas::event(QEvent* event)
{
    if (event->type() == QEvent::ScreenChangeInternal) // it says whether it is calibrated
        update();
    return QWidget::event(event);
}

PictureViewport PictureCanvas::viewport() const
{
    PictureViewport viewport = m_viewport;
    const DisplayPicture* picture = shown();
    viewport.fit(rect().adjusted(hatchWidth, hatchWidth, -hatchWidth, -hatchWidth), picture ? picture->image.size() : QSize(0, 0));
    return viewport;
}

QRect PictureCanvas::pictureRect() const { return shown() ? viewport().target() : QRect(); }

QFont PictureCanvas::overlayFont() const
{
    // Larger in a large pane; in a small one as large as everything else that is read from the same distance.
    QFont overlay = paneFont(*this);
    const int wanted = std::min(largestText, static_cast<int>(std::lround(std::min(width(), height()) / 56.0)));
    overlay.setPixelSize(std::max(overlay.pixelSize(), wanted));
    return overlay;
}

void PictureCanvas::followPicture(const DisplayPicture& picture)
{
    if (m_table != nullptr)
        m_measurement.follow(picture.about, *m_table);
    else
        m_measurement.follow(picture.about);
    const double zoom = m_viewport.zoom();
    m_viewport = viewport();
    update();
    if (m_viewport.zoom() != zoom)
        Q_EMIT viewChanged();
}

void PictureCanvas::followTable()
{
    const DisplayPicture* picture = shown();
    if (m_table == nullptr || picture == nullptr)
        return;
    const PixelCalibration before = m_measurement.calibration();
    m_measurement.follow(picture->about, *m_table);
    if (m_measurement.calibration() != before)
        update();
}

void PictureCanvas::zoomBy(double factor)
{
    m_viewport = viewport();
    m_viewport.zoomBy(factor, m_viewport.target().center());
    update();
    Q_EMIT viewChanged();
}

void PictureCanvas::resetView()
{
    m_viewport = viewport();
    m_viewport.reset();
    update();
    Q_EMIT viewChanged();
}

void PictureCanvas::clearMeasurement()
{
    m_measurement.clear();
    update();
}

void PictureCanvas::nextCatheter()
{
    if (m_measurement.mode() == MeasureMode::Distance && !(m_measurement.pixels().value_or(0) > 0))
        tell(tr("First set two points, as far from each other as the catheter is wide."));
    m_measurement.nextCatheter();
    update();
}

void PictureCanvas::nextPlane()
{
    if (!m_display)
        return;
    m_display->nextPlane();
    tell(planeText(m_display->plane()));
}

void PictureCanvas::tell(const QString& what)
{
    m_told = what;
    m_tellingEnds.start();
    update();
}

void PictureCanvas::moveWindow(double centreShare, double widthShare)
{
    const DisplayPicture* picture = shown();
    if (!m_display || !picture)
        return;
    // What the settings already ask for may not be on the screen yet.
    const DisplaySettings& settings = m_display->settings();
    const WindowBasis basis = basisOf(picture->about);
    const bool asked = settings.window == WindowChoice::Fixed && picture->settings != settings;
    const GreyWindow from = asked ? carriedOver(settings.fixed, settings.fixedOn, basis) : picture->window;
    m_display->setWindow(moved(from, centreShare, widthShare), basis);
}

void PictureCanvas::addPoint(QPointF picture)
{
    m_measurement.add(picture);
    update();
    Q_EMIT pointSet();
}

void PictureCanvas::mousePressEvent(QMouseEvent* event)
{
    window()->setFocus(Qt::MouseFocusReason); // the keys go back to the hand
    const DisplayPicture* picture = shown();
    if (!picture)
        return;
    const bool left = event->button() == Qt::LeftButton;
    m_dragStart = m_dragLast = event->position();
    if (event->button() == Qt::MiddleButton || (left && event->modifiers().testFlag(Qt::ShiftModifier))) {
        m_drag = Drag::Pan;
    } else if (event->button() == Qt::RightButton) {
        if (m_measurement.mode() == MeasureMode::Distance && event->modifiers().testFlag(Qt::ShiftModifier))
            nextPlane();
        else if (m_measurement.mode() == MeasureMode::Distance)
            nextCatheter();
    } else if (left && m_measurement.mode() != MeasureMode::Off) {
        if (viewport().target().contains(event->position().toPoint()))
            addPoint(viewport().toPicture(event->position()));
    } else if (left && m_display) {
        m_drag = Drag::Window;
        m_dragWindow = picture->window;
        m_dragBasis = basisOf(picture->about);
    }
}

void PictureCanvas::mouseMoveEvent(QMouseEvent* event)
{
    const QPointF moved = event->position() - m_dragLast;
    m_dragLast = event->position();
    if (m_drag == Drag::Pan) {
        m_viewport = viewport();
        m_viewport.panBy(moved);
        update();
        Q_EMIT viewChanged();
    } else if (m_drag == Drag::Window && m_display) {
        const QPointF all = event->position() - m_dragStart;
        const double edge = std::max(1, std::min(width(), height()));
        m_display->setWindow(console::moved(m_dragWindow, all.y() / edge, 2 * all.x() / edge), m_dragBasis);
    }
}

void PictureCanvas::mouseReleaseEvent(QMouseEvent*) { m_drag = Drag::None; }

void PictureCanvas::wheelEvent(QWheelEvent* event)
{
    if (!shown() || event->angleDelta().y() == 0)
        return;
    m_viewport = viewport();
    m_viewport.zoomBy(std::pow(zoomStep, event->angleDelta().y() / 120.0), event->position());
    update();
    Q_EMIT viewChanged();
}

void PictureCanvas::keyPressEvent(QKeyEvent* event)
{
    const int key = event->key();
    const bool shift = event->modifiers().testFlag(Qt::ShiftModifier);
    const bool other = event->modifiers() & (Qt::ControlModifier | Qt::AltModifier | Qt::MetaModifier);
    if (other || !(takeMeasureKey(key) || takeViewKey(key) || takeWindowKey(key) || takeDisplayKey(key, shift)))
        event->ignore();
}

bool PictureCanvas::step(int key, QPointF& by) const
{
    switch (key) {
    case Qt::Key_4:
        by = {-1, 0};
        return true;
    case Qt::Key_6:
        by = {1, 0};
        return true;
    case Qt::Key_8:
        by = {0, -1};
        return true;
    case Qt::Key_2:
        by = {0, 1};
        return true;
    default:
        return false;
    }
}

bool PictureCanvas::takeMeasureKey(int key)
{
    if (m_measurement.mode() == MeasureMode::Off || !shown())
        return false;
    QPointF by;
    const PictureViewport view = viewport();
    const QPointF cursor = m_cursor.value_or(view.toPicture(view.target().center()));
    if (step(key, by)) {
        const QPointF moved = view.toPane(cursor) + by * (m_cursor ? cursorStep : 0);
        m_cursor = view.toPicture(QPointF(std::clamp<double>(moved.x(), view.target().left(), view.target().right()),
                                          std::clamp<double>(moved.y(), view.target().top(), view.target().bottom())));
        update();
    } else if (key == Qt::Key_5) {
        const bool isSeen = view.target().contains(view.toPane(cursor).toPoint());
        m_cursor = isSeen ? cursor : view.toPicture(view.target().center()); // first to where a person sees it
        if (isSeen)
            addPoint(cursor);
        update();
    } else if (key == Qt::Key_Delete || key == Qt::Key_Backspace) {
        clearMeasurement();
    } else if (key == Qt::Key_B) {
        nextCatheter();
    } else if (key == Qt::Key_O && m_measurement.mode() == MeasureMode::Distance) {
        nextPlane();
    } else {
        return false;
    }
    return true;
}

bool PictureCanvas::takeViewKey(int key)
{
    QPointF by;
    if (key == Qt::Key_Plus || key == Qt::Key_Equal) {
        zoomBy(zoomStep);
    } else if (key == Qt::Key_Minus || key == Qt::Key_Underscore) {
        zoomBy(1 / zoomStep);
    } else if (key == Qt::Key_Home) {
        resetView();
    } else if (step(key, by)) {
        m_viewport = viewport();
        m_viewport.panBy(-by * panStep);
        update();
        Q_EMIT viewChanged();
    } else {
        return false;
    }
    return true;
}

bool PictureCanvas::takeWindowKey(int key)
{
    switch (key) {
    case Qt::Key_Q:
        moveWindow(0, -keyShare);
        return true;
    case Qt::Key_W:
        moveWindow(0, keyShare);
        return true;
    case Qt::Key_S:
        moveWindow(-keyShare, 0);
        return true;
    case Qt::Key_X:
        moveWindow(keyShare, 0);
        return true;
    default:
        return false;
    }
}

bool PictureCanvas::takeDisplayKey(int key, bool shift)
{
    if (!m_display)
        return false;
    switch (key) {
    case Qt::Key_A:
        m_display->setAutomatic();
        return true;
    case Qt::Key_P:
        m_display->nextWindow();
        return true;
    case Qt::Key_V:
        m_display->nextFunction();
        return true;
    case Qt::Key_N:
        m_display->toggleInverted();
        return true;
    case Qt::Key_T:
        m_display->stepNoiseReduction(shift ? -1 : 1);
        return true;
    case Qt::Key_E:
        m_display->stepEdge(shift ? -1 : 1);
        return true;
    case Qt::Key_H:
        m_display->nextShutter();
        return true;
    case Qt::Key_M:
        m_display->nextMeasureMode();
        return true;
    default:
        return false;
    }
}

void PictureCanvas::focusInEvent(QFocusEvent*) { update(); }

void PictureCanvas::focusOutEvent(QFocusEvent*) { update(); }

} // namespace console
