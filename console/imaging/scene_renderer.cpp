// Draws the scene on a thread of its own: the newest state only, at most 30 pictures a second.
#include "imaging/scene_renderer.hpp"

#include <QCoreApplication>

#include <chrono>

namespace console {

namespace {

constexpr std::chrono::milliseconds shortestPause{33};

} // namespace

SceneRenderer::SceneRenderer(Finished finished) : m_finished(std::move(finished)), m_thread([this] { run(); }) {}

SceneRenderer::~SceneRenderer()
{
    {
        const std::lock_guard lock(m_mutex);
        m_stopping = true;
    }
    m_changed.notify_all();
    m_thread.join();
}

void SceneRenderer::draw(SceneRequest request)
{
    {
        const std::lock_guard lock(m_mutex);
        m_request = std::move(request);
    }
    m_changed.notify_all();
}

bool SceneRenderer::waitForRequest(SceneRequest& request, std::chrono::steady_clock::time_point earliest)
{
    std::unique_lock lock(m_mutex);
    m_changed.wait(lock, [this] { return m_stopping || m_request; });
    m_changed.wait_until(lock, earliest, [this] { return m_stopping; });
    if (m_stopping)
        return false;
    request = std::move(*m_request);
    m_request.reset();
    return true;
}

void SceneRenderer::run()
{
    QString error;
    const std::unique_ptr<OffscreenScene> scene = OffscreenScene::create(error);
    if (!scene) {
        m_finished({{}, {}, {}, error});
        return;
    }
    SceneRequest request;
    auto earliest = std::chrono::steady_clock::now();
    while (waitForRequest(request, earliest)) {
        earliest = std::chrono::steady_clock::now() + shortestPause;
        scene->show(request.state);
        QImage image = scene->render(request.camera, request.size);
        if (image.isNull() && !request.size.isEmpty()) {
            m_finished(
                {{}, {}, {}, QCoreApplication::translate("console::SceneRenderer", "OpenGL drew no picture. Check the graphics driver.")});
            return;
        }
        const auto source = request.state.showsPicture() ? std::optional(request.state.pictureSource) : std::nullopt;
        m_finished({std::move(image), request.camera, source, {}});
    }
}

} // namespace console
