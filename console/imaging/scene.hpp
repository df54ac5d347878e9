// The three-dimensional scene: what is shown, and the VTK objects that draw it.
#pragma once

#include "imaging/c_arm_pose.hpp"
#include "imaging/orbit_camera.hpp"
#include "imaging/tracked_tip.hpp"
#include "imaging/vessel_tree.hpp"
#include "model/xray_frame.hpp"

#include <QImage>
#include <QSize>

#include <memory>
#include <optional>

namespace console {

/// A value; cheap to copy. Positions in the patient frame.
struct SceneState {
    std::shared_ptr<const VesselTree> vessels;
    std::optional<TrackedTip> tip;
    std::optional<CArmGeometry> cArm; ///< Where the C-arm is now.
    QImage picture;                   ///< Null: no picture.
    PictureSource pictureSource = PictureSource::Recorded;
    std::optional<CArmGeometry> pictureGeometry; ///< Where it was when the picture was taken.
    bool pictureIsLive = false;

    /// The place of the picture is known, too.
    bool showsPicture() const;
};

/// The middle of the vessels' bounding box in the scene's frame, the camera's focus; and half of the box's longest edge, 0 without vessels.
QVector3D focusOf(const SceneState& state);
double reachOf(const SceneState& state);

/// From the focus to the farthest part of the C-arm, mm; nothing while its place is not known.
std::optional<double> reachOfCArm(const SceneState& state);

/// Draws off-screen. Make, use and destroy it on one thread.
class OffscreenScene {
public:
    /// Null and a reason when there is no OpenGL.
    static std::unique_ptr<OffscreenScene> create(QString& error);
    ~OffscreenScene();
    OffscreenScene(const OffscreenScene&) = delete;
    OffscreenScene& operator=(const OffscreenScene&) = delete;

    void show(const SceneState& state);

    /// Format_RGB32; null when drawing failed.
    QImage render(const OrbitCamera& camera, QSize size);

private:
    struct Pipelines;
    explicit OffscreenScene(std::unique_ptr<Pipelines> pipelines);

    std::unique_ptr<Pipelines> m_pipelines;
    SceneState m_shown;
    QVector3D m_focus;
};

} // namespace console
