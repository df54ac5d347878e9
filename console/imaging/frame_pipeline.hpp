// From the network to the screen: decodes the newest frame on a thread of its own and hands over the newest finished picture.
#pragma once

#include "imaging/display_picture.hpp"
#include "imaging/newest_handover.hpp"
#include "model/frame_sink.hpp"

#include <QObject>

#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>

namespace console {

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
    explicit FramePipeline(QObject* parent = nullptr);
    ~FramePipeline() override;

    void showFrame(std::shared_ptr<const XrayFrame> frame) override;

    FrameCounts counts() const;

Q_SIGNALS:
    void pictureReady(const console::DisplayPicture& picture);

    /// The newest reason; the picture on the screen is untouched and grows old.
    void pictureRefused(quint32 frame, const QString& reason);

private:
    struct Refusal {
        quint32 frame = 0;
        QString reason;
    };
    class Worker;

    void run();
    std::shared_ptr<const XrayFrame> waitForFrame();
    void wakeGuiThread();
    void deliver();

    mutable std::mutex m_mutex;
    std::condition_variable m_changed;
    std::shared_ptr<const XrayFrame> m_waiting;
    FrameCounts m_counts;
    bool m_stopping = false;
    NewestHandover<DisplayPicture> m_finished;
    NewestHandover<Refusal> m_refused;
    std::thread m_thread;
};

} // namespace console
