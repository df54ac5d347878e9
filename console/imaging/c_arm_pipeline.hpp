// The C-arm as lines: the X-ray source, the detector's edges and the beam between them.
#pragma once

#include "imaging/c_arm_pose.hpp"

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkSphereSource.h>

#include <array>

namespace console {

class CArmPipeline {
public:
    static constexpr float sourceRadius = 12; ///< mm

    CArmPipeline();

    void show(const CArmPose& pose);
    void hide();
    std::array<vtkActor*, 2> actors() { return {m_edges, m_focus}; }

private:
    vtkNew<vtkPolyData> m_lines;
    vtkNew<vtkSphereSource> m_source;
    vtkNew<vtkPolyDataMapper> m_edgeMapper;
    vtkNew<vtkPolyDataMapper> m_focusMapper;
    vtkNew<vtkActor> m_edges;
    vtkNew<vtkActor> m_focus;
};

} // namespace console
