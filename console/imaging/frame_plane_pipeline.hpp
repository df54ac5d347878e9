// The newest X-ray picture on the detector plane, where it belongs in space.
#pragma once

#include "imaging/c_arm_pose.hpp"

#include <QImage>

#include <vtkActor.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPolyDataMapper.h>
#include <vtkTexture.h>

namespace console {

class FramePlanePipeline {
public:
    FramePlanePipeline();

    void showPicture(const QImage& picture);

    /// A picture that is not live is dimmed to 60 %.
    void place(const CArmPose& pose, bool isLive);
    void hide() { m_actor->VisibilityOff(); }
    vtkActor* actor() { return m_actor; }

private:
    vtkNew<vtkImageData> m_picture;
    vtkNew<vtkTexture> m_texture;
    vtkNew<vtkPlaneSource> m_plane;
    vtkNew<vtkPolyDataMapper> m_mapper;
    vtkNew<vtkActor> m_actor;
};

} // namespace console
