// The vessel tree as shaded tubes.
#pragma once

#include "imaging/vessel_tree.hpp"

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkTubeFilter.h>

namespace console {

class VesselPipeline {
public:
    VesselPipeline();

    void show(const VesselTree& tree);
    vtkActor* actor() { return m_actor; }

private:
    vtkNew<vtkPolyData> m_lines;
    vtkNew<vtkTubeFilter> m_tubes;
    vtkNew<vtkPolyDataMapper> m_mapper;
    vtkNew<vtkActor> m_actor;
};

} // namespace console
