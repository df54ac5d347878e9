// From the network to the screen: decodes the newest frame on a thread of its own and hands over the newest finished picture.
#include "imaging/frame_pipeline.hpp"

#include "imaging/cine_ring.hpp"
#include "imaging/display_chain.hpp"
#include "imaging/roadmap_maker.hpp"

#include <functional>
#include <string_view>
#include <utility>

namespace console {

namespace {

std::size_t fingerprint(const XrayFrame& frame)
{
    return std::hash<std::string_view>()({reinterpret_cast<const char*>(frame.pixels.data()), frame.pixels.size()});
}

} // namespace

// What the decoding thread keeps from one frame to the next.
class FramePipeline::Worker {
public:
    DisplayChain chain;
    std::optional<std::size_t> newest; ///< fingerprint of the last frame that came
};

FramePipeline::FramePipeline(QObject* parent, PictureRole role) : QObject(parent), m_role(role), m_thread([this] { run(); }) {}

FramePipeline::~FramePipeline()
{
    {
        const std::lock_guard lock(m_mutex);
        m_stopping = true;
    }
    m_changed.notify_all();
    m_thread.join();
}

void FramePipeline::showFrame(std::shared_ptr<const XrayFrame> frame)
{
    if (frame)
        put(std::move(frame), {});
}

void FramePipeline::showMean(std::vector<std::shared_ptr<const XrayFrame>> frames)
{
    auto newest = std::move(frames.front());
    frames.erase(frames.begin());
    put(std::move(newest), std::move(frames));
}

void FramePipeline::put(std::shared_ptr<const XrayFrame> frame, std::vector<std::shared_ptr<const XrayFrame>> earlier)
{
    {
        const std::lock_guard lock(m_mutex);
        ++m_counts.received;
        // What is replaced is let go outside the lock: its memory may be large.
        std::swap(m_next.frame, frame);
        std::swap(m_next.earlier, earlier);
        if (frame)
            ++m_counts.replacedBeforeDecoding;
    }
    m_changed.notify_one();
}

FrameCounts FramePipeline::counts() const
{
    const std::lock_guard lock(m_mutex);
    return m_counts;
}

void FramePipeline::setSettings(const DisplaySettings& settings)
{
    {
        const std::lock_guard lock(m_mutex);
        if (m_next.settings == withinBounds(settings))
            return;
        m_next.settings = withinBounds(settings);
        m_mustRedraw = true;
    }
    m_changed.notify_one();
}

DisplaySettings FramePipeline::settings() const
{
    const std::lock_guard lock(m_mutex);
    return m_next.settings;
}

void FramePipeline::setFilterRoom(Duration room)
{
    const std::lock_guard lock(m_mutex);
    m_next.filterRoom = room;
}

void FramePipeline::setGreyScale(const GreyScale& greyScale)
{
    {
        const std::lock_guard lock(m_mutex);
        m_next.greyScale = greyScale;
        m_mustRedraw = true;
    }
    m_changed.notify_one();
}

void FramePipeline::recordInto(CineRing& ring)
{
    const std::lock_guard lock(m_mutex);
    m_next.ring = &ring;
}

void FramePipeline::mapInto(RoadmapMaker& maker)
{
    const std::lock_guard lock(m_mutex);
    m_next.roadmap = &maker;
}

std::optional<FramePipeline::Work> FramePipeline::waitForWork()
{
    std::unique_lock lock(m_mutex);
    m_changed.wait(lock, [this] { return m_stopping || m_next.frame || m_mustRedraw; });
    if (m_stopping)
        return std::nullopt;
    m_mustRedraw = false;
    Work work = m_next;
    m_next.frame.reset();
    m_next.earlier.clear();
    m_next.greyScale.reset();
    return work;
}

void FramePipeline::run()
{
    Worker worker;
    while (const std::optional<Work> work = waitForWork())
        carryOut(worker, *work);
}

void FramePipeline::carryOut(Worker& worker, const Work& work)
{
    if (work.greyScale)
        worker.chain.setGreyScale(*work.greyScale);
    DisplayPicture picture;
    if (!work.frame) {
        if (worker.chain.redraw(work.settings, picture))
            finish(std::move(picture), true);
        return;
    }
    // Two pulses never give the same bytes, noise alone sees to that: what comes twice was taken once, whatever its number and time say. A
    // recording may hold a picture twice; only rehearsals go by one.
    if (m_role == PictureRole::Live && work.frame->source != PictureSource::Recorded) {
        const auto print = fingerprint(*work.frame);
        if (std::exchange(worker.newest, print) == print) {
            refuse(work.frame->frame, tr("it is the same as the one before it, though it says that it is new"));
            return;
        }
    }
    const QString refusal = worker.chain.process(*work.frame, work.settings, work.filterRoom, picture, work.earlier);
    if (!refusal.isEmpty()) {
        refuse(work.frame->frame, refusal);
        return;
    }
    finish(std::move(picture), false);
    if (work.ring) // after the picture is on its way
        work.ring->add(*work.frame);
    if (work.roadmap)
        work.roadmap->take(worker.chain.stored(), *work.frame);
}

void FramePipeline::finish(DisplayPicture picture, bool isRedrawn)
{
    picture.role = m_role;
    bool mustWake = false;
    {
        const std::lock_guard lock(m_mutex);
        mustWake = !m_finished;
        const bool replacesNew = m_finished && !m_finished->isRedrawn;
        if (replacesNew && !isRedrawn)
            ++m_counts.replacedBeforeShowing;
        // Redrawn before it was delivered: still the same new picture.
        m_finished = Finished{std::move(picture), isRedrawn && !replacesNew};
    }
    if (mustWake)
        wakeGuiThread();
}

void FramePipeline::refuse(quint32 frame, const QString& reason)
{
    {
        const std::lock_guard lock(m_mutex);
        ++m_counts.refused;
    }
    if (m_refused.put({frame, reason}))
        wakeGuiThread();
}

std::optional<FramePipeline::Finished> FramePipeline::takeFinished()
{
    const std::lock_guard lock(m_mutex);
    if (m_finished && !m_finished->isRedrawn)
        ++m_counts.shown;
    return std::exchange(m_finished, std::nullopt);
}

void FramePipeline::wakeGuiThread()
{
    QMetaObject::invokeMethod(
        this, [this] { deliver(); }, Qt::QueuedConnection);
}

void FramePipeline::deliver()
{
    if (const auto refusal = m_refused.take())
        Q_EMIT pictureRefused(refusal->frame, refusal->reason);
    if (const auto finished = takeFinished())
        Q_EMIT pictureReady(finished->picture);
}

} // namespace console
