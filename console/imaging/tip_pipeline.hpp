// The tracked tip with its direction, and the guidewire that leads to it.
#pragma once

#include "imaging/tracked_tip.hpp"

#include <vtkActor.h>
#include <vtkConeSource.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkSphereSource.h>
#include <vtkTubeFilter.h>

#include <array>
#include <vector>

namespace console {

/// A fresh tip is solid; a stale one is a grey wire cage, so that it differs in shape and not by colour alone.
class TipPipeline {
public:
    TipPipeline();

    /// `way`: centre-line points up to the tip, root first; may be empty.
    void show(const TrackedTip& tip, const std::vector<QVector3D>& way);
    void hide();

    /// Draws the ball with this radius, mm, where its own is smaller, and the arrow in proportion; the places stay.
    void keepVisible(double leastRadius);
    std::array<vtkActor*, 3> actors() { return {m_ball, m_arrow, m_wire}; }

private:
    void showWire(const TrackedTip& tip, const std::vector<QVector3D>& way);

    TrackedTip m_tip;
    vtkNew<vtkSphereSource> m_sphere;
    vtkNew<vtkConeSource> m_cone;
    vtkNew<vtkPolyData> m_line;
    vtkNew<vtkTubeFilter> m_tube;
    vtkNew<vtkPolyDataMapper> m_ballMapper;
    vtkNew<vtkPolyDataMapper> m_arrowMapper;
    vtkNew<vtkPolyDataMapper> m_wireMapper;
    vtkNew<vtkActor> m_ball;
    vtkNew<vtkActor> m_arrow;
    vtkNew<vtkActor> m_wire;
};

} // namespace console
