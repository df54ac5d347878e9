// The three-dimensional pane: shows what the scene's thread draws, and turns the camera by mouse and keyboard.
#include "imaging/scene_view.hpp"

#include "imaging/pane_colours.hpp"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QQuaternion>
#include <QWheelEvent>

#include <array>
#include <cmath>

namespace console {

namespace {

constexpr double degreesPerPixel = 0.4;
constexpr double degreesPerKey = 5;
constexpr double zoomPerStep = 1.15;
constexpr int largestTexture = 512;
constexpr double wholeCArm = 800; // mm from the isocentre to its farthest part

// The tracker's quaternion turns +z to the tip's direction.
QVector3D positionOf(const TipPose& pose)
{
    const auto& p = pose.position;
    return {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
}

QVector3D directionOf(const std::array<double, 4>& q)
{
    const QQuaternion turn(static_cast<float>(q[0]), static_cast<float>(q[1]), static_cast<float>(q[2]), static_cast<float>(q[3]));
    return turn.isNull() ? QVector3D() : turn.normalized().rotatedVector({0, 0, 1});
}

CArmGeometry geometryWith(const XrayGeometry& geometry, QSizeF detectorSize)
{
    const auto [lateral, longitudinal, height] = geometry.table;
    return {geometry.primaryAngle,
            geometry.secondaryAngle,
            geometry.sourceDetectorDistance,
            geometry.sourceObjectDistance,
            detectorSize,
            QVector3D(float(lateral), float(longitudinal), float(height))};
}

} // namespace

SceneView::SceneView(QWidget* parent) : QWidget(parent)
{
    setObjectName(QStringLiteral("scene"));
    setAttribute(Qt::WA_OpaquePaintEvent);
    setFocusPolicy(Qt::StrongFocus);
    setMinimumSize(160, 160);
    setAccessibleName(tr("Three-dimensional scene"));
    describe();
    m_renderer = std::make_unique<SceneRenderer>([this](SceneImage image) {
        if (m_finished.put(std::move(image)))
            QMetaObject::invokeMethod(
                this, [this] { takeDrawing(); }, Qt::QueuedConnection);
    });
}

SceneView::~SceneView() = default;

void SceneView::loadVessels(const QString& path)
{
    VesselTreeResult result = readVesselTree(path);
    m_vesselError = result.error;
    m_state.vessels = result.tree ? std::make_shared<const VesselTree>(std::move(*result.tree)) : nullptr;
    m_focus = focusOf(m_state);
    m_camera = viewOfVessels();
    describe();
    requestDrawing();
    update();
}

void SceneView::showTip(const std::optional<TipPose>& pose, bool isStale)
{
    std::optional<TrackedTip> tip;
    if (pose && pose->valid)
        tip = {positionOf(*pose), directionOf(pose->quaternion), static_cast<float>(pose->error), isStale};
    if (tip == m_state.tip)
        return;
    m_state.tip = tip;
    requestDrawing();
}

void SceneView::showTipBefore(const std::optional<TipPose>& pose)
{
    const auto place = pose && pose->valid ? std::optional(positionOf(*pose)) : std::nullopt;
    if (place == m_tipBefore)
        return;
    m_tipBefore = place;
    update();
}

void SceneView::showCArm(const std::optional<XrayGeometry>& geometry)
{
    m_cArm = geometry;
    const auto arm = geometry ? std::optional(geometryWith(*geometry, m_detectorSize)) : std::nullopt;
    if (arm == m_state.cArm)
        return;
    m_state.cArm = arm;
    requestDrawing();
}

void SceneView::showPicture(const DisplayPicture& picture)
{
    m_state.picture = picture.image;
    if (std::max(picture.image.width(), picture.image.height()) > largestTexture)
        m_state.picture = picture.image.scaled(largestTexture, largestTexture, Qt::KeepAspectRatio, Qt::FastTransformation);
    m_state.pictureGeometry = geometryOf(picture.about);
    m_detectorSize = m_state.pictureGeometry->detectorSize;
    if (m_cArm) {
        m_state.cArm = geometryWith(*m_cArm, m_detectorSize);
        m_state.pictureGeometry->table = m_state.cArm->table; // a picture does not say where the table was
    }
    requestDrawing();
}

void SceneView::showCondition(PictureCondition condition)
{
    if (condition == m_condition)
        return;
    m_condition = condition;
    m_state.pictureIsLive = condition == PictureCondition::Live;
    requestDrawing();
    update();
}

void SceneView::requestDrawing()
{
    if (isVisible() && m_drawn.error.isEmpty())
        m_renderer->draw({m_state, m_camera, size() * devicePixelRatioF()});
}

void SceneView::takeDrawing()
{
    if (auto image = m_finished.take()) {
        m_drawn = std::move(*image);
        m_drawn.image.setDevicePixelRatio(devicePixelRatioF());
        ++m_drawings;
        if (!m_drawn.error.isEmpty())
            describe();
        update();
        Q_EMIT drawn();
    }
}

void SceneView::look(const OrbitCamera& camera)
{
    if (camera == m_camera)
        return;
    m_camera = camera;
    requestDrawing();
}

OrbitCamera SceneView::viewOfVessels() const
{
    OrbitCamera camera;
    camera.fit(reachOf(m_state));
    return camera;
}

// From the side, so that source, patient and detector stand next to each other.
OrbitCamera SceneView::viewOfCArm() const
{
    OrbitCamera camera;
    camera.rotate(-30, 0);
    camera.fit(wholeCArm);
    return camera;
}

void SceneView::paintEvent(QPaintEvent*)
{
    QPainter painter(this);
    painter.fillRect(rect(), pane_colours::background);
    if (!m_drawn.image.isNull()) {
        painter.drawImage(rect(), m_drawn.image);
        paintLetters(painter);
        paintTipBefore(painter);
        paintTipMark(painter);
    }
    paintNotice(painter);
    paintWords(painter);
    paintFrame(painter);
}

void SceneView::paintLetters(QPainter& painter) const
{
    const std::array<QVector3D, 6> sides{QVector3D(1, 0, 0),  QVector3D(-1, 0, 0), QVector3D(0, 1, 0),
                                         QVector3D(0, -1, 0), QVector3D(0, 0, 1),  QVector3D(0, 0, -1)};
    // Far enough from the focus to stand near the pane's edge at any zoom.
    const auto reach = static_cast<float>(m_drawn.camera.distance() * 0.2);
    QFont letters = font();
    letters.setPixelSize(18);
    letters.setWeight(QFont::DemiBold);
    painter.setFont(letters);
    for (const QVector3D& side : sides) {
        const bool faces = QVector3D::dotProduct(side, m_drawn.camera.offset()) > 0;
        painter.setPen(faces ? pane_colours::text : pane_colours::stale);
        if (const auto place = m_drawn.camera.project(side * reach, size()))
            painter.drawText(QRectF(*place - QPointF(12, 12), QSizeF(24, 24)), Qt::AlignCenter, sideLetter(side));
    }
}

void SceneView::paintTipMark(QPainter& painter) const
{
    if (!m_state.tip || !m_state.tip->isStale)
        return;
    const auto place = placeOf(m_state.tip->position);
    if (!place)
        return;
    QFont mark = font();
    mark.setPixelSize(16);
    mark.setWeight(QFont::DemiBold);
    painter.setFont(mark);
    painter.setPen(pane_colours::text);
    painter.drawText(*place + QPointF(14, -10), tr("? LAST KNOWN"));
}

std::optional<QPointF> SceneView::placeOf(const QVector3D& inPatient) const
{
    return m_drawn.camera.project(toScene(inPatient) - m_focus, size());
}

/// A ring where it was, and a dashed line to where it is now.
void SceneView::paintTipBefore(QPainter& painter) const
{
    constexpr double radius = 9;
    const auto before = m_tipBefore ? placeOf(*m_tipBefore) : std::nullopt;
    if (!before)
        return;
    QFont mark = font();
    mark.setPixelSize(16);
    mark.setWeight(QFont::DemiBold);
    painter.setFont(mark);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(pane_colours::text, 2));
    painter.drawEllipse(*before, radius, radius);
    painter.drawText(*before + QPointF(-radius, -radius - 6), tr("BEFORE"));
    const auto now = m_state.tip ? placeOf(m_state.tip->position) : std::nullopt;
    if (!now)
        return;
    painter.drawText(*now + QPointF(radius, 2 * radius + 6), tr("NOW"));
    painter.setPen(QPen(pane_colours::text, 2, Qt::DashLine));
    if (const QLineF way(*before, *now); way.length() > radius)
        painter.drawLine(way.pointAt(radius / way.length()), *now);
}

void SceneView::paintWords(QPainter& painter) const
{
    QStringList words{tr("3-D SCENE")};
    if (!m_state.tip)
        words << tr("tip not tracked");
    else if (m_state.tip->isStale)
        words << tr("tip position stale");
    if (m_state.picture.isNull() || m_condition == PictureCondition::None)
        words << tr("no picture");
    else if (!m_state.pictureIsLive)
        words << tr("picture: %1").arg(word(m_condition));
    else if (!m_state.pictureGeometry || !poseOf(*m_state.pictureGeometry))
        words << tr("picture's place unknown");
    QFont small = font();
    small.setPixelSize(16);
    painter.setFont(small);
    painter.setPen(pane_colours::text);
    painter.drawText(rect().adjusted(12, 10, -12, -10), Qt::AlignLeft | Qt::AlignTop, words.join(QStringLiteral("\n")));
}

// Dashed: not the live pane.
void SceneView::paintFrame(QPainter& painter) const
{
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(hasFocus() ? pane_colours::focus : pane_colours::line, hasFocus() ? 3 : 2, Qt::DashLine));
    painter.drawRect(rect().adjusted(1, 1, -2, -2));
}

void SceneView::paintNotice(QPainter& painter) const
{
    QFont body = font();
    body.setPixelSize(16);
    painter.setFont(body);
    painter.setPen(pane_colours::text);
    painter.drawText(rect().adjusted(24, 80, -24, -24), Qt::AlignCenter | Qt::TextWordWrap, notice());
}

QString SceneView::notice() const
{
    if (!m_drawn.error.isEmpty())
        return tr("3-D not available: %1").arg(m_drawn.error);
    if (m_state.vessels)
        return {};
    return m_vesselError.isEmpty() ? tr("No vessel tree is loaded.") : m_vesselError;
}

void SceneView::describe()
{
    const QString missing = notice();
    setAccessibleDescription(
        missing.isEmpty() ? tr("Vessels, tracked tip and C-arm. Arrows turn, plus and minus zoom, Home shows the vessels, End the C-arm.")
                          : missing);
}

void SceneView::resizeEvent(QResizeEvent* event)
{
    QWidget::resizeEvent(event);
    requestDrawing();
}

void SceneView::showEvent(QShowEvent* event)
{
    QWidget::showEvent(event);
    requestDrawing();
}

void SceneView::mousePressEvent(QMouseEvent* event) { m_lastMouse = event->position().toPoint(); }

void SceneView::mouseMoveEvent(QMouseEvent* event)
{
    if (!(event->buttons() & Qt::LeftButton))
        return;
    const QPoint moved = event->position().toPoint() - m_lastMouse;
    m_lastMouse = event->position().toPoint();
    OrbitCamera camera = m_camera;
    camera.rotate(-moved.x() * degreesPerPixel, moved.y() * degreesPerPixel);
    look(camera);
}

void SceneView::mouseDoubleClickEvent(QMouseEvent*) { look(OrbitCamera()); }

void SceneView::wheelEvent(QWheelEvent* event)
{
    OrbitCamera camera = m_camera;
    camera.zoom(std::pow(zoomPerStep, event->angleDelta().y() / 120.0));
    look(camera);
    event->accept();
}

void SceneView::keyPressEvent(QKeyEvent* event)
{
    OrbitCamera camera = m_camera;
    switch (event->key()) {
    case Qt::Key_Left:
        camera.rotate(-degreesPerKey, 0);
        break;
    case Qt::Key_Right:
        camera.rotate(degreesPerKey, 0);
        break;
    case Qt::Key_Up:
        camera.rotate(0, degreesPerKey);
        break;
    case Qt::Key_Down:
        camera.rotate(0, -degreesPerKey);
        break;
    case Qt::Key_Plus:
    case Qt::Key_Equal:
        camera.zoom(zoomPerStep);
        break;
    case Qt::Key_Minus:
        camera.zoom(1 / zoomPerStep);
        break;
    case Qt::Key_Home:
        camera = viewOfVessels();
        break;
    case Qt::Key_End:
        camera = viewOfCArm();
        break;
    default:
        QWidget::keyPressEvent(event);
        return;
    }
    look(camera);
}

void SceneView::focusInEvent(QFocusEvent* event)
{
    QWidget::focusInEvent(event);
    update();
}

void SceneView::focusOutEvent(QFocusEvent* event)
{
    QWidget::focusOutEvent(event);
    update();
}

} // namespace console
