// The newest X-ray picture on the detector plane, where it belongs in space.
#include "imaging/frame_plane_pipeline.hpp"

#include "imaging/vtk_bridge.hpp"

#include <vtkProperty.h>

namespace console {

FramePlanePipeline::FramePlanePipeline()
{
    m_texture->SetInputData(m_picture);
    m_texture->SetColorModeToDirectScalars();
    m_texture->InterpolateOn();
    m_texture->RepeatOff();
    m_mapper->SetInputConnection(m_plane->GetOutputPort());
    m_actor->SetMapper(m_mapper);
    m_actor->SetTexture(m_texture);
    m_actor->GetProperty()->LightingOff();
    hide();
}

void FramePlanePipeline::showPicture(const QImage& picture) { copyToVtk(picture, *m_picture); }

void FramePlanePipeline::place(const CArmPose& pose, bool isLive)
{
    m_plane->SetOrigin(vtkPoint(pose.corner(-1, -1)).data());
    m_plane->SetPoint1(vtkPoint(pose.corner(1, -1)).data());
    m_plane->SetPoint2(vtkPoint(pose.corner(-1, 1)).data());
    const double brightness = isLive ? 1.0 : 0.6;
    m_actor->GetProperty()->SetColor(brightness, brightness, brightness);
    m_actor->VisibilityOn();
}

} // namespace console
