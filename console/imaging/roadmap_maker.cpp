// The present run, the last one with contrast in it, and the comparison.
#include "imaging/roadmap_maker.hpp"

namespace console {

namespace {

constexpr quint64 comparePeriodNs = 500'000'000;

std::shared_ptr<const Roadmap> shared(std::optional<Roadmap> roadmap)
{
    return roadmap ? std::make_shared<const Roadmap>(std::move(*roadmap)) : nullptr;
}

} // namespace

void RoadmapMaker::take(const cv::Mat& stored, const XrayFrame& frame)
{
    const std::lock_guard lock(m_mutex);
    if (m_run.endsWith(frame))
        if (auto ended = shared(m_run.roadmap()))
            m_last = std::move(ended);
    m_run.take(stored, frame);
    const bool isTime = frame.captureNs < m_comparedNs || frame.captureNs - m_comparedNs >= comparePeriodNs;
    if (!m_watched || !isTime)
        return;
    m_comparedNs = frame.captureNs;
    if (const auto pixels = m_run.displacement(*m_watched))
        m_displacement = Displacement{frame.frame, *pixels};
}

std::shared_ptr<const Roadmap> RoadmapMaker::make() const
{
    const std::lock_guard lock(m_mutex);
    auto present = shared(m_run.roadmap());
    return present ? present : m_last;
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
