// The three-dimensional pane: shows what the scene's thread draws, and turns the camera by mouse and keyboard.
#include "imaging/scene_view.hpp"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QQuaternion>
#include <QWheelEvent>

#include <algorithm>
#include <array>
#include <cmath>

namespace console {

namespace {

constexpr double degreesPerPixel = 0.4;
constexpr double degreesPerKey = 5;
constexpr double zoomPerStep = 1.15;
constexpr int largestTexture = 512;
constexpr double wholeCArm = 800;    // mm from the isocentre to its farthest part
constexpr double leastVessels = 0.4; // of the pane's height, for which the detector is left out

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
    setFocusPolicy(Qt::TabFocus); // a click leaves the keys to the hand
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
    takeFirstView();
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
    takeFirstView();
    requestDrawing();
}

void SceneView::showPicture(const DisplayPicture& picture)
{
    m_state.picture = picture.image;
    if (std::max(picture.image.width(), picture.image.height()) > largestTexture)
        m_state.picture = picture.image.scaled(largestTexture, largestTexture, Qt::KeepAspectRatio, Qt::FastTransformation);
    m_state.pictureSource = picture.about.source;
    const bool again = m_shown && picture.isSameFrameAs(*m_shown); // with another window, where it was taken
    m_shown.emplace().about = picture.about;
    if (!again)
        placePicture(picture.about);
    requestDrawing();
}

/// A picture does not say where the table was; nor does anybody else while the C-arm is not heard.
void SceneView::placePicture(const XrayFrame& about)
{
    const CArmGeometry geometry = geometryOf(about);
    m_detectorSize = geometry.detectorSize;
    m_state.pictureGeometry.reset();
    if (!m_cArm)
        return;
    m_state.cArm = geometryWith(*m_cArm, m_detectorSize);
    takeFirstView();
    m_state.pictureGeometry = geometry;
    m_state.pictureGeometry->table = m_state.cArm->table;
}

void SceneView::showCondition(PictureCondition condition)
{
    if (condition == m_condition)
        return;
    m_condition = condition;
    m_state.pictureIsLive = condition == PictureCondition::Live;
    describe();
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
        describe();
        update();
        Q_EMIT drawn();
    }
}

// Vessels and detector. It does not follow the C-arm: what turns by itself is no place to look for something.
void SceneView::takeFirstView()
{
    if (m_viewIsChosen || !m_state.vessels)
        return;
    const auto pose = m_state.cArm ? poseOf(*m_state.cArm) : std::nullopt;
    if (pose && m_detectorAtFirst.empty())
        for (const QVector3D& corner : {pose->corner(-1, -1), pose->corner(1, -1), pose->corner(1, 1), pose->corner(-1, 1)})
            m_detectorAtFirst.push_back(corner - m_focus);
    OrbitCamera camera = viewOfVessels();
    camera.keepInSight(m_detectorAtFirst, size());
    m_camera = 2 * reachOf(m_state) < leastVessels * camera.heightAt({}) ? viewOfVessels() : camera;
}

void SceneView::look(const OrbitCamera& camera)
{
    m_viewIsChosen = true;
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

// From the side, so that source, patient and detector stand next to each other; whole in a pane that is higher than wide, too.
OrbitCamera SceneView::viewOfCArm() const
{
    OrbitCamera camera;
    camera.rotate(-30, 0);
    camera.fit(reachOfCArm(m_state).value_or(wholeCArm) * std::max(1.0, double(height()) / std::max(1, width())));
    return camera;
}

QString SceneView::notice() const
{
    if (!m_drawn.error.isEmpty())
        return tr("3-D not available: %1").arg(m_drawn.error);
    if (m_state.vessels)
        return {};
    return m_vesselError.isEmpty() ? tr("No vessel tree is loaded.") : m_vesselError;
}

/// Whatever is drawn on the detector says what it is, unless it is live; a picture that was not yet judged is not.
QString SceneView::pictureWords() const
{
    if (!m_drawn.pictureSource)
        return m_state.picture.isNull() || m_state.showsPicture() ? tr("no picture") : tr("picture's place unknown");
    QStringList words;
    if (*m_drawn.pictureSource != PictureSource::Live)
        words << word(*m_drawn.pictureSource);
    if (m_condition == PictureCondition::None)
        words << word(PictureCondition::Unknown);
    else if (m_condition != PictureCondition::Live)
        words << word(m_condition);
    return words.isEmpty() ? QString() : tr("picture: %1").arg(words.join(QStringLiteral("  ")));
}

void SceneView::describe()
{
    const QString missing = notice();
    const QString keys = tr("Vessels, tracked tip and C-arm. 4 6 8 2 turn, plus and minus zoom, Home shows the vessels, End the C-arm.");
    QString words = missing.isEmpty() ? keys : missing;
    if (const QString picture = pictureWords(); !picture.isEmpty())
        words += QLatin1Char(' ') + picture;
    if (words != accessibleDescription())
        setAccessibleDescription(words);
}

void SceneView::resizeEvent(QResizeEvent* event)
{
    QWidget::resizeEvent(event);
    takeFirstView();
    requestDrawing();
}

void SceneView::showEvent(QShowEvent* event)
{
    QWidget::showEvent(event);
    requestDrawing();
}

void SceneView::mousePressEvent(QMouseEvent* event)
{
    window()->setFocus(Qt::MouseFocusReason); // the keys go back to the hand
    m_lastMouse = event->position().toPoint();
}

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

void SceneView::mouseDoubleClickEvent(QMouseEvent*) { look(viewOfVessels()); }

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
    case Qt::Key_4:
        camera.rotate(-degreesPerKey, 0);
        break;
    case Qt::Key_6:
        camera.rotate(degreesPerKey, 0);
        break;
    case Qt::Key_8:
        camera.rotate(0, degreesPerKey);
        break;
    case Qt::Key_2:
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
