// Draws the scene on a thread of its own: the newest state only, at most 30 pictures a second.
#pragma once

#include "imaging/scene.hpp"

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace console {

struct SceneRequest {
    SceneState state;
    OrbitCamera camera;
    QSize size; ///< Pixels of the device.
};

struct SceneImage {
    QImage image;
    OrbitCamera camera; ///< The one it was drawn with.

    /// Of the X-ray picture in it; nothing: there is none in it. What is said of a picture goes with its drawing.
    std::optional<PictureSource> pictureSource;
    QString error; ///< Why there is no three-dimensional view; then there will be none later either.
};

class SceneRenderer {
public:
    /// Called on the renderer's thread; must not block.
    using Finished = std::function<void(SceneImage)>;

    explicit SceneRenderer(Finished finished);
    ~SceneRenderer();
    SceneRenderer(const SceneRenderer&) = delete;
    SceneRenderer& operator=(const SceneRenderer&) = delete;

    /// Replaces a request that was not begun. Any thread; never waits for drawing.
    void draw(SceneRequest request);

private:
    void run();
    bool waitForRequest(SceneRequest& request, std::chrono::steady_clock::time_point earliest);

    Finished m_finished;
    std::mutex m_mutex;
    std::condition_variable m_changed;
    std::optional<SceneRequest> m_request;
    bool m_stopping = false;
    std::thread m_thread;
};

} // namespace console
