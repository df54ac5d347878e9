// The C-arm as lines: the X-ray source, the detector's edges and the beam between them.
#include "imaging/c_arm_pipeline.hpp"

#include "imaging/pane_colours.hpp"
#include "imaging/vtk_bridge.hpp"

#include <vtkCellArray.h>
#include <vtkPoints.h>
#include <vtkProperty.h>

namespace console {

CArmPipeline::CArmPipeline()
{
    m_source->SetRadius(sourceRadius);
    m_edgeMapper->SetInputData(m_lines);
    m_focusMapper->SetInputConnection(m_source->GetOutputPort());
    m_edges->SetMapper(m_edgeMapper);
    m_focus->SetMapper(m_focusMapper);
    for (vtkActor* actor : actors()) {
        actor->GetProperty()->SetColor(vtkColour(pane_colours::cArm).data());
        actor->GetProperty()->LightingOff();
    }
    hide();
}

void CArmPipeline::hide()
{
    for (vtkActor* actor : actors())
        actor->VisibilityOff();
}

void CArmPipeline::show(const CArmPose& pose)
{
    const std::array<QVector3D, 5> corners{pose.source, pose.corner(-1, -1), pose.corner(1, -1), pose.corner(1, 1), pose.corner(-1, 1)};
    vtkNew<vtkPoints> points;
    for (const QVector3D& corner : corners)
        points->InsertNextPoint(vtkPoint(corner).data());
    vtkNew<vtkCellArray> lines;
    for (vtkIdType corner = 1; corner <= 4; ++corner) {
        const std::array<vtkIdType, 2> ray{0, corner};
        const std::array<vtkIdType, 2> edge{corner, corner % 4 + 1};
        lines->InsertNextCell(2, ray.data());
        lines->InsertNextCell(2, edge.data());
    }
    m_lines->Initialize();
    m_lines->SetPoints(points);
    m_lines->SetLines(lines);
    m_lines->Modified();
    m_source->SetCenter(vtkPoint(pose.source).data());
    for (vtkActor* actor : actors())
        actor->VisibilityOn();
}

} // namespace console
