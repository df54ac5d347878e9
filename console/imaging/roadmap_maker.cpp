// The present run, the last one with contrast in it, and the comparison.
#include "imaging/roadmap_maker.hpp"

#include <utility>

namespace console {

namespace {

constexpr quint64 comparePeriodNs = 500'000'000;

std::shared_ptr<const Roadmap> shared(std::optional<Roadmap> roadmap)
{
    return roadmap ? std::make_shared<const Roadmap>(std::move(*roadmap)) : nullptr;
}

} // namespace

// Only this thread changes `m_run`: it may read it without the lock, and make() with it.
void RoadmapMaker::take(const cv::Mat& stored, const XrayFrame& frame)
{
    std::shared_ptr<const Roadmap> ended;
    if (m_run.endsWith(frame))
        ended = shared(m_run.roadmap());
    std::shared_ptr<const Roadmap> watched;
    {
        const std::lock_guard lock(m_mutex);
        if (std::exchange(m_forgetRun, false))
            m_run = {};
        else if (ended)
            m_last = std::move(ended);
        m_run.take(stored, frame);
        const bool isTime = frame.captureNs < m_comparedNs || frame.captureNs - m_comparedNs >= comparePeriodNs;
        if (isTime)
            watched = m_watched;
    }
    if (!watched)
        return;
    const auto pixels = m_run.displacement(*watched);
    const std::lock_guard lock(m_mutex);
    m_comparedNs = frame.captureNs;
    if (pixels && m_watched == watched)
        m_displacement = Displacement{frame.frame, *pixels};
}

std::shared_ptr<const Roadmap> RoadmapMaker::make() const
{
    Opacification run;
    std::shared_ptr<const Roadmap> last;
    {
        const std::lock_guard lock(m_mutex);
        if (!m_forgetRun)
            run = m_run.copy();
        last = m_last;
    }
    auto present = shared(run.roadmap());
    return present ? present : last;
}

void RoadmapMaker::forget()
{
    const std::lock_guard lock(m_mutex);
    m_forgetRun = true;
    m_last.reset();
}

void RoadmapMaker::watch(std::shared_ptr<const Roadmap> roadmap)
{
    const std::lock_guard lock(m_mutex);
    m_watched = std::move(roadmap);
    m_displacement.reset();
    m_comparedNs = 0;
}

std::optional<RoadmapMaker::Displacement> RoadmapMaker::displacement() const
{
    const std::lock_guard lock(m_mutex);
    return m_displacement;
}

} // namespace console
