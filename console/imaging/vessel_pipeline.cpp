// The vessel tree as shaded tubes.
#include "imaging/vessel_pipeline.hpp"

#include "imaging/c_arm_pose.hpp"
#include "imaging/pane_colours.hpp"
#include "imaging/vtk_bridge.hpp"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkProperty.h>

namespace console {

namespace {

constexpr double thinnest = 0.15;

std::vector<int> childrenPerPoint(const VesselTree& tree)
{
    std::vector<int> children(tree.points.size(), 0);
    for (const VesselPoint& point : tree.points)
        if (point.parent >= 0)
            ++children[static_cast<std::size_t>(point.parent)];
    return children;
}

// One line from an end point up to the branch point it hangs on, so that a tube runs smoothly through its branch.
void addBranch(const VesselTree& tree, const std::vector<int>& children, std::size_t end, vtkCellArray& lines)
{
    std::vector<vtkIdType> branch{static_cast<vtkIdType>(end)};
    for (int i = tree.points[end].parent; i >= 0; i = tree.points[static_cast<std::size_t>(i)].parent) {
        branch.push_back(i);
        if (children[static_cast<std::size_t>(i)] != 1)
            break;
    }
    if (branch.size() > 1)
        lines.InsertNextCell(static_cast<vtkIdType>(branch.size()), branch.data());
}

} // namespace

VesselPipeline::VesselPipeline()
{
    m_tubes->SetInputData(m_lines);
    m_tubes->SetNumberOfSides(10);
    m_tubes->SetVaryRadiusToVaryRadiusByAbsoluteScalar();
    m_tubes->CappingOn();
    m_mapper->SetInputConnection(m_tubes->GetOutputPort());
    m_mapper->ScalarVisibilityOff();
    m_actor->SetMapper(m_mapper);
    m_actor->GetProperty()->SetColor(vtkColour(pane_colours::vessel).data());
    m_actor->GetProperty()->SetOpacity(0.55);
    m_actor->VisibilityOff();
}

void VesselPipeline::show(const VesselTree& tree)
{
    vtkNew<vtkPoints> points;
    vtkNew<vtkDoubleArray> radii;
    radii->SetName("Radius");
    for (const VesselPoint& point : tree.points) {
        points->InsertNextPoint(vtkPoint(toScene(point.position)).data());
        radii->InsertNextValue(std::max<double>(point.radius, thinnest));
    }
    vtkNew<vtkCellArray> lines;
    const std::vector<int> children = childrenPerPoint(tree);
    for (std::size_t i = 0; i < tree.points.size(); ++i)
        if (children[i] != 1)
            addBranch(tree, children, i, *lines);
    m_lines->Initialize();
    m_lines->SetPoints(points);
    m_lines->SetLines(lines);
    m_lines->GetPointData()->SetScalars(radii);
    m_lines->Modified();
    m_actor->SetVisibility(!tree.isEmpty());
}

} // namespace console
