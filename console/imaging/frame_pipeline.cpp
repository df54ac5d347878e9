// From the network to the screen: decodes the newest frame on a thread of its own and hands over the newest finished picture.
#include "imaging/frame_pipeline.hpp"

#include "imaging/frame_decoder.hpp"

#include <utility>

namespace console {

// What the decoding thread keeps from one frame to the next.
class FramePipeline::Worker {
public:
    /// A picture, or why there is none.
    QString process(const XrayFrame& frame, DisplayPicture& picture)
    {
        const Instant begun = std::chrono::steady_clock::now();
        if (QString refusal = decodeFrame(frame, m_stored); !refusal.isEmpty())
            return refusal;
        const Instant decoded = std::chrono::steady_clock::now();
        chooseWindow(frame, picture);
        m_table.prepare(picture.window, frame.photometric == Photometric::Monochrome1 ? Polarity::LowIsWhite : Polarity::LowIsBlack);
        picture.image = m_table.apply(m_stored);
        if (picture.image.isNull())
            return tr("there is no memory for it");
        picture.about = frame;
        picture.about.owner.reset();
        picture.about.pixels = {};
        picture.decodeTime = decoded - begun;
        picture.windowTime = std::chrono::steady_clock::now() - decoded;
        return {};
    }

private:
    void chooseWindow(const XrayFrame& frame, DisplayPicture& picture)
    {
        picture.window = {frame.windowCentre, frame.windowWidth};
        picture.windowIsAutomatic = !picture.window.isKnown();
        if (!picture.windowIsAutomatic)
            return;
        if (frame.acquisition != m_acquisition)
            m_autoWindow.reset();
        m_acquisition = frame.acquisition;
        picture.window = m_autoWindow.next(m_stored);
    }

    cv::Mat m_stored;
    WindowLevelTable m_table;
    AutoWindow m_autoWindow;
    quint32 m_acquisition = 0;
};

FramePipeline::FramePipeline(QObject* parent) : QObject(parent), m_thread([this] { run(); }) {}

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
    if (!frame)
        return;
    {
        const std::lock_guard lock(m_mutex);
        ++m_counts.received;
        // The replaced frame is let go outside the lock: its memory may be large.
        std::swap(m_waiting, frame);
        if (frame)
            ++m_counts.replacedBeforeDecoding;
    }
    m_changed.notify_one();
}

FrameCounts FramePipeline::counts() const
{
    const std::lock_guard lock(m_mutex);
    FrameCounts counts = m_counts;
    counts.replacedBeforeShowing = m_finished.replaced();
    return counts;
}

std::shared_ptr<const XrayFrame> FramePipeline::waitForFrame()
{
    std::unique_lock lock(m_mutex);
    m_changed.wait(lock, [this] { return m_stopping || m_waiting; });
    return m_stopping ? nullptr : std::exchange(m_waiting, nullptr);
}

void FramePipeline::run()
{
    Worker worker;
    while (const std::shared_ptr<const XrayFrame> frame = waitForFrame()) {
        DisplayPicture picture;
        const QString refusal = worker.process(*frame, picture);
        if (refusal.isEmpty()) {
            if (m_finished.put(std::move(picture)))
                wakeGuiThread();
            continue;
        }
        {
            const std::lock_guard lock(m_mutex);
            ++m_counts.refused;
        }
        if (m_refused.put({frame->frame, refusal}))
            wakeGuiThread();
    }
}

void FramePipeline::wakeGuiThread()
{
    QMetaObject::invokeMethod(
        this, [this] { deliver(); }, Qt::QueuedConnection);
}

void FramePipeline::deliver()
{
    if (const auto refusal = m_refused.take())
        Q_EMIT pictureRefused(refusal->frame, tr("The picture is refused: %1.").arg(refusal->reason));
    if (const auto picture = m_finished.take()) {
        {
            const std::lock_guard lock(m_mutex);
            ++m_counts.shown;
        }
        Q_EMIT pictureReady(*picture);
    }
}

} // namespace console
