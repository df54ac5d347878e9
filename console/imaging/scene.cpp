// The three-dimensional scene: what is shown, and the VTK objects that draw it.
#include "imaging/scene.hpp"

#include "imaging/c_arm_pipeline.hpp"
#include "imaging/egl_context.hpp"
#include "imaging/frame_plane_pipeline.hpp"
#include "imaging/offscreen_window.hpp"
#include "imaging/pane_colours.hpp"
#include "imaging/tip_pipeline.hpp"
#include "imaging/vessel_pipeline.hpp"
#include "imaging/vtk_bridge.hpp"

#include <QCoreApplication>

#include <vtkCamera.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>

namespace console {

namespace {

// A tip farther than this from every centre line is drawn alone: no vessel is claimed for the wire.
constexpr float wireReach = 8;

// However far away: to be found at a glance, as a share of the picture's height.
constexpr double leastTipDiameter = 0.025;

struct Box {
    QVector3D low;
    QVector3D high;
};

Box boxOf(const SceneState& state)
{
    if (!state.vessels || state.vessels->isEmpty())
        return {};
    Box box{state.vessels->points.front().position, state.vessels->points.front().position};
    for (const VesselPoint& point : state.vessels->points) {
        for (int axis = 0; axis < 3; ++axis) {
            box.low[axis] = std::min(box.low[axis], point.position[axis]);
            box.high[axis] = std::max(box.high[axis], point.position[axis]);
        }
    }
    return box;
}

} // namespace

QVector3D focusOf(const SceneState& state)
{
    const Box box = boxOf(state);
    return toScene((box.low + box.high) / 2);
}

double reachOf(const SceneState& state)
{
    const Box box = boxOf(state);
    const QVector3D size = box.high - box.low;
    return std::max({size.x(), size.y(), size.z()}) / 2;
}

std::optional<double> reachOfCArm(const SceneState& state)
{
    const auto pose = state.cArm ? poseOf(*state.cArm) : std::nullopt;
    if (!pose)
        return std::nullopt;
    const QVector3D focus = focusOf(state);
    float farthest = 0;
    for (const QVector3D& part : {pose->source, pose->corner(-1, -1), pose->corner(1, -1), pose->corner(1, 1), pose->corner(-1, 1)})
        farthest = std::max(farthest, part.distanceToPoint(focus));
    return farthest + CArmPipeline::sourceRadius;
}

bool SceneState::showsPicture() const { return !picture.isNull() && pictureGeometry && poseOf(*pictureGeometry); }

// The context outlives what draws in it: members go in the reverse of this order.
struct OffscreenScene::Pipelines {
    std::unique_ptr<EglContext> context;
    vtkNew<OffscreenWindow> window;
    vtkNew<vtkRenderer> renderer;
    vtkNew<vtkUnsignedCharArray> pixels;
    VesselPipeline vessels;
    CArmPipeline cArm;
    FramePlanePipeline framePlane;
    TipPipeline tip;

    void assemble()
    {
        renderer->SetBackground(vtkColour(pane_colours::background).data());
        renderer->AddActor(vessels.actor());
        renderer->AddActor(framePlane.actor());
        for (vtkActor* actor : cArm.actors())
            renderer->AddActor(actor);
        for (vtkActor* actor : tip.actors())
            renderer->AddActor(actor);
        window->AddRenderer(renderer);
    }

    ~Pipelines() { window->Finalize(); }
};

OffscreenScene::OffscreenScene(std::unique_ptr<Pipelines> pipelines) : m_pipelines(std::move(pipelines)) {}

OffscreenScene::~OffscreenScene() = default;

std::unique_ptr<OffscreenScene> OffscreenScene::create(QString& error)
{
    std::unique_ptr<EglContext> context = EglContext::create(error);
    if (!context)
        return nullptr;
    auto pipelines = std::make_unique<Pipelines>();
    pipelines->context = std::move(context);
    pipelines->window->prepare();
    if (!pipelines->window->isUsable()) {
        error = QCoreApplication::translate("console::Scene", "OpenGL's functions could not be loaded. Check the graphics driver.");
        return nullptr;
    }
    pipelines->assemble();
    return std::unique_ptr<OffscreenScene>(new OffscreenScene(std::move(pipelines)));
}

void OffscreenScene::show(const SceneState& state)
{
    if (state.vessels != m_shown.vessels) {
        m_pipelines->vessels.show(state.vessels ? *state.vessels : VesselTree{});
        m_focus = focusOf(state);
    }
    if (state.tip)
        m_pipelines->tip.show(*state.tip, state.vessels ? state.vessels->wayTo(state.tip->position, wireReach) : std::vector<QVector3D>{});
    else
        m_pipelines->tip.hide();
    if (const auto pose = state.cArm ? poseOf(*state.cArm) : std::nullopt)
        m_pipelines->cArm.show(*pose);
    else
        m_pipelines->cArm.hide();
    if (state.showsPicture()) {
        if (state.picture.cacheKey() != m_shown.picture.cacheKey())
            m_pipelines->framePlane.showPicture(state.picture);
        m_pipelines->framePlane.place(*poseOf(*state.pictureGeometry), state.pictureIsLive);
    } else {
        m_pipelines->framePlane.hide();
    }
    m_shown = state;
}

QImage OffscreenScene::render(const OrbitCamera& camera, QSize size)
{
    if (size.isEmpty() || !m_pipelines->context->isCurrent())
        return {};
    Pipelines& p = *m_pipelines;
    p.window->SetSize(size.width(), size.height());
    vtkCamera* view = p.renderer->GetActiveCamera();
    view->SetViewAngle(OrbitCamera::viewAngle);
    view->SetFocalPoint(vtkPoint(m_focus).data());
    view->SetPosition(vtkPoint(m_focus + camera.offset()).data());
    view->SetViewUp(vtkPoint(camera.up()).data());
    if (m_shown.tip)
        p.tip.keepVisible(leastTipDiameter / 2 * camera.heightAt(toScene(m_shown.tip->position) - m_focus));
    p.renderer->ResetCameraClippingRange();
    p.window->Render();
    p.window->GetRGBACharPixelData(0, 0, size.width() - 1, size.height() - 1, 0, p.pixels);
    return fromRenderedPixels(*p.pixels, size);
}

} // namespace console
