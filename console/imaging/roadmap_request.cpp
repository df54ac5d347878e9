// Makes the roadmap that a person asked for, on a thread of its own.
#include "imaging/roadmap_request.hpp"

#include "imaging/roadmap_maker.hpp"

namespace console {

RoadmapRequest::RoadmapRequest(const RoadmapMaker& maker, QObject* parent) : QObject(parent), m_maker(maker) {}

RoadmapRequest::~RoadmapRequest()
{
    if (m_thread.joinable())
        m_thread.join();
}

void RoadmapRequest::make()
{
    m_isWanted = true;
    if (!m_isBusy)
        start();
}

void RoadmapRequest::cancel()
{
    m_isWanted = false;
    m_isStale = true;
}

void RoadmapRequest::start()
{
    if (m_thread.joinable())
        m_thread.join(); // it has nothing left to do
    m_isBusy = true;
    m_isStale = false;
    m_thread = std::thread([this] {
        MadeRoadmap made;
        made.roadmap = m_maker.make();
        if (made.roadmap)
            made.vessels = vesselLayer(*made.roadmap);
        QMetaObject::invokeMethod(
            this, [this, made] { finish(made); }, Qt::QueuedConnection);
    });
}

void RoadmapRequest::finish(const MadeRoadmap& made)
{
    m_isBusy = false;
    if (!m_isWanted)
        return;
    if (m_isStale)
        return start();
    m_isWanted = false;
    Q_EMIT answered(made);
}

} // namespace console
