// From the network to the screen: decodes the newest frame on a thread of its own and hands over the newest finished picture.
#pragma once

#include "imaging/display_picture.hpp"
#include "imaging/grey_scale.hpp"
#include "imaging/newest_handover.hpp"
#include "model/display_settings.hpp"
#include "model/frame_sink.hpp"

#include <QObject>

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace console {

class CineRing;
class RoadmapMaker;

/// Where frames went; each one is in exactly one of the last four, or on its way.
struct FrameCounts {
    quint64 received = 0;
    quint64 replacedBeforeDecoding = 0; ///< a newer one came while the decoder worked
    quint64 replacedBeforeShowing = 0;  ///< decoded, and a newer one was ready before the GUI thread came
    quint64 refused = 0;
    quint64 shown = 0;
};

/// Lives on the GUI thread; showFrame() may be called by any thread. Never a queue: at most one frame waits and one is in work.
class FramePipeline : public QObject, public FrameSink {
    Q_OBJECT
public:
    /// Every picture it makes has this role.
    explicit FramePipeline(QObject* parent = nullptr, PictureRole role = PictureRole::Live);
    ~FramePipeline() override;

    void showFrame(std::shared_ptr<const XrayFrame> frame) override;

    /// `frames` are of one run, the newest first, and not none: the picture is that one, with the mean of as many as can go into it for its
    /// values. Any thread.
    void showMean(std::vector<std::shared_ptr<const XrayFrame>> frames);

    FrameCounts counts() const;

    /// From the next picture on; the last one is delivered once more with them, and stays the same picture.
    void setSettings(const DisplaySettings& settings);
    DisplaySettings settings() const;

    /// How much a temporal filter may delay a movement; none before the first word.
    void setFilterRoom(Duration room);

    void setGreyScale(const GreyScale& greyScale);

    /// Every frame that could be decoded is written into `ring` as well, from the decoding thread; the ring outlives the pipeline.
    void recordInto(CineRing& ring);

    /// The same for what a roadmap can be made of.
    void mapInto(RoadmapMaker& maker);

Q_SIGNALS:
    void pictureReady(const console::DisplayPicture& picture);

    /// The newest reason, in words that are no sentence; the picture on the screen is untouched and grows old.
    void pictureRefused(quint32 frame, const QString& reason);

private:
    struct Refusal {
        quint32 frame = 0;
        QString reason;
    };
    /// What the decoding thread is to do next.
    struct Work {
        std::shared_ptr<const XrayFrame> frame;                ///< nothing: the last picture once more
        std::vector<std::shared_ptr<const XrayFrame>> earlier; ///< with which it is to be a mean; none: as it is
        DisplaySettings settings;
        Duration filterRoom{};
        std::optional<GreyScale> greyScale;
        CineRing* ring = nullptr;
        RoadmapMaker* roadmap = nullptr;
    };
    struct Finished {
        DisplayPicture picture;
        bool isRedrawn = false; ///< it was delivered before and is in the books
    };
    class Worker;

    void put(std::shared_ptr<const XrayFrame> frame, std::vector<std::shared_ptr<const XrayFrame>> earlier);
    void run();
    std::optional<Work> waitForWork();
    void carryOut(Worker& worker, const Work& work);
    void finish(DisplayPicture picture, bool isRedrawn);
    void refuse(quint32 frame, const QString& reason);
    std::optional<Finished> takeFinished();
    void wakeGuiThread();
    void deliver();

    const PictureRole m_role;
    mutable std::mutex m_mutex;
    std::condition_variable m_changed;
    Work m_next;
    bool m_mustRedraw = false;
    FrameCounts m_counts;
    bool m_stopping = false;
    std::optional<Finished> m_finished;
    NewestHandover<Refusal> m_refused;
    std::thread m_thread;
};

} // namespace console
