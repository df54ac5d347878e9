// The three-dimensional pane: shows what the scene's thread draws, and turns the camera by mouse and keyboard.
#pragma once

#include "imaging/display_picture.hpp"
#include "imaging/newest_handover.hpp"
#include "imaging/scene_renderer.hpp"
#include "model/picture_state.hpp"
#include "model/robot_values.hpp"

#include <QRegion>
#include <QWidget>

#include <memory>
#include <optional>
#include <vector>

namespace console {

class TextPlates;

/// Left button: turn; wheel: zoom; double click: the vessels. Keys while the pane has the focus, none of them one of the hand's: 4 6 8 2
/// turn, + − zoom, Home the vessels, End the C-arm. All other keys are left to the window.
class SceneView : public QWidget {
    Q_OBJECT
public:
    explicit SceneView(QWidget* parent = nullptr);
    ~SceneView() override;

    /// Reads the tree; a failure is written into the pane.
    void loadVessels(const QString& path);

    /// Nothing, and a pose that is not valid: no tip is drawn. `isStale`: drawn hollow, in grey, with a mark.
    void showTip(const std::optional<TipPose>& pose, bool isStale);

    /// Where the tip was before an interruption that nobody has read about yet; nothing when there is none, or it was not known.
    void showTipBefore(const std::optional<TipPose>& pose);

    /// Where the C-arm is now; nothing when it is not known. Its detector is as large as the newest picture's. The pane begins with
    /// vessels and detector in view.
    void showCArm(const std::optional<XrayGeometry>& geometry);

    void showPicture(const DisplayPicture& picture);
    void showCondition(PictureCondition condition);

    const OrbitCamera& camera() const { return m_camera; }

    /// What the next drawing shows.
    const SceneState& state() const { return m_state; }

    /// The newest drawing, null before the first; why there is none.
    const QImage& drawing() const { return m_drawn.image; }
    const QString& unavailable() const { return m_drawn.error; }
    quint64 drawings() const { return m_drawings; }

    /// What is missing and what to do, as the pane shows it; empty when nothing is missing.
    QString notice() const;

    /// What the X-ray picture in the drawing is, as the pane shows it; empty for a live one.
    QString pictureWords() const;

    /// Every pixel that texts took of the last painting.
    QRegion overlayRegion() const { return m_overlay; }

    QSize sizeHint() const override { return {562, 562}; }

Q_SIGNALS:
    void drawn();

protected:
    void paintEvent(QPaintEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void showEvent(QShowEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void focusInEvent(QFocusEvent* event) override;
    void focusOutEvent(QFocusEvent* event) override;

private:
    void placePicture(const XrayFrame& about);
    void requestDrawing();
    void takeDrawing();
    void look(const OrbitCamera& camera);
    void takeFirstView();
    OrbitCamera viewOfVessels() const;
    OrbitCamera viewOfCArm() const;
    void placeWords(TextPlates& plates) const;
    void placeLetters(TextPlates& plates) const;
    void placeTipMark(TextPlates& plates) const;
    void paintTipBefore(QPainter& painter, TextPlates& plates) const;
    std::optional<QPointF> placeOf(const QVector3D& inPatient) const;
    void paintFrame(QPainter& painter) const;
    QRegion paintNotice(QPainter& painter) const;
    void describe();

    SceneState m_state;
    OrbitCamera m_camera;
    bool m_viewIsChosen = false;              ///< by a person: nothing else turns it any more
    std::vector<QVector3D> m_detectorAtFirst; ///< its corners from the focus, where it was when that was first known
    QString m_vesselError;
    QVector3D m_focus;
    QSizeF m_detectorSize;
    std::optional<XrayGeometry> m_cArm;
    std::optional<DisplayPicture> m_shown; ///< without its image
    std::optional<QVector3D> m_tipBefore;  ///< in the patient frame
    PictureCondition m_condition = PictureCondition::None;
    SceneImage m_drawn;
    quint64 m_drawings = 0;
    QRegion m_overlay;
    QPoint m_lastMouse;
    NewestHandover<SceneImage> m_finished;
    std::unique_ptr<SceneRenderer> m_renderer;
};

} // namespace console
