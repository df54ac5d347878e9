// The tracked tip with its direction, and the guidewire that leads to it.
#include "imaging/tip_pipeline.hpp"

#include "imaging/c_arm_pose.hpp"
#include "imaging/pane_colours.hpp"
#include "imaging/vtk_bridge.hpp"

#include <vtkCellArray.h>
#include <vtkPoints.h>
#include <vtkProperty.h>

#include <algorithm>

namespace console {

namespace {

constexpr double ballRadius = 3.0;
constexpr double arrowLength = 9.0;
constexpr double wireRadius = 0.7;

void style(vtkActor& actor, const QColor& colour, bool hollow)
{
    actor.GetProperty()->SetColor(vtkColour(colour).data());
    actor.GetProperty()->SetRepresentation(hollow ? VTK_WIREFRAME : VTK_SURFACE);
    actor.GetProperty()->SetLighting(!hollow);
}

} // namespace

TipPipeline::TipPipeline()
{
    m_sphere->SetThetaResolution(12);
    m_sphere->SetPhiResolution(9);
    m_cone->SetResolution(12);
    m_tube->SetInputData(m_line);
    m_tube->SetRadius(wireRadius);
    m_tube->SetNumberOfSides(8);
    m_ballMapper->SetInputConnection(m_sphere->GetOutputPort());
    m_arrowMapper->SetInputConnection(m_cone->GetOutputPort());
    m_wireMapper->SetInputConnection(m_tube->GetOutputPort());
    m_ball->SetMapper(m_ballMapper);
    m_arrow->SetMapper(m_arrowMapper);
    m_wire->SetMapper(m_wireMapper);
    hide();
}

void TipPipeline::hide()
{
    for (vtkActor* actor : actors())
        actor->VisibilityOff();
}

void TipPipeline::show(const TrackedTip& tip, const std::vector<QVector3D>& way)
{
    m_tip = tip;
    keepVisible(ballRadius);
    const QColor& colour = tip.isStale ? pane_colours::stale : pane_colours::tip;
    style(*m_ball, colour, tip.isStale);
    style(*m_arrow, colour, tip.isStale);
    m_ball->VisibilityOn();
    m_arrow->SetVisibility(!tip.direction.isNull());
    showWire(tip, way);
}

void TipPipeline::keepVisible(double leastRadius)
{
    const double radius = std::max(ballRadius, leastRadius);
    const double length = arrowLength * radius / ballRadius;
    const QVector3D position = toScene(m_tip.position);
    const QVector3D direction = toScene(m_tip.direction).normalized();
    m_sphere->SetRadius(radius);
    m_sphere->SetCenter(vtkPoint(position).data());
    m_cone->SetRadius(radius * 0.7);
    m_cone->SetHeight(length);
    m_cone->SetCenter(vtkPoint(position + direction * static_cast<float>(radius + length / 2)).data());
    m_cone->SetDirection(vtkPoint(direction).data());
}

void TipPipeline::showWire(const TrackedTip& tip, const std::vector<QVector3D>& way)
{
    m_wire->SetVisibility(!way.empty());
    if (way.empty())
        return;
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> lines;
    lines->InsertNextCell(static_cast<int>(way.size()) + 1);
    for (const QVector3D& point : way)
        lines->InsertCellPoint(points->InsertNextPoint(vtkPoint(toScene(point)).data()));
    lines->InsertCellPoint(points->InsertNextPoint(vtkPoint(toScene(tip.position)).data()));
    m_line->Initialize();
    m_line->SetPoints(points);
    m_line->SetLines(lines);
    m_line->Modified();
    style(*m_wire, tip.isStale ? pane_colours::stale : pane_colours::wire, false);
}

} // namespace console
