// Makes the roadmap that a person asked for, beside the thread that hears hands and sends motion.
#pragma once

#include "imaging/opacification.hpp"

#include <QImage>
#include <QObject>

#include <memory>
#include <thread>

namespace console {

class RoadmapMaker;

struct MadeRoadmap {
    std::shared_ptr<const Roadmap> roadmap; ///< null: nothing that was taken has contrast in it
    QImage vessels;                         ///< of it, as `vesselLayer()` makes them
};

/// One at a time. GUI thread only; `maker` outlives it. Its destructor waits for the one in work.
class RoadmapRequest : public QObject {
    Q_OBJECT
public:
    explicit RoadmapRequest(const RoadmapMaker& maker, QObject* parent = nullptr);
    ~RoadmapRequest() override;

    /// Once more before the answer, it changes nothing.
    void make();

    /// Something else is wanted, or something moved: what was taken until now answers no request any more.
    void cancel();

Q_SIGNALS:
    /// The answer to each request that was not cancelled, in a later turn of the event loop.
    void answered(const console::MadeRoadmap& made);

private:
    void start();
    void finish(const MadeRoadmap& made);

    const RoadmapMaker& m_maker;
    std::thread m_thread;
    bool m_isBusy = false;
    bool m_isWanted = false;
    bool m_isStale = false; ///< what is in work was cancelled
};

} // namespace console
