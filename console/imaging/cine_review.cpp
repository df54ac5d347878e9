// Shows the frames of the last minute again.
#include "imaging/cine_review.hpp"

#include <algorithm>

namespace console {

namespace {

constexpr int shortestPause = 15; ///< ms
constexpr int longestPause = 1000;

int pauseBetween(const XrayFrame& before, const XrayFrame& next)
{
    const quint64 apart = next.captureNs > before.captureNs ? next.captureNs - before.captureNs : 0;
    return static_cast<int>(std::clamp<quint64>(apart / 1'000'000, shortestPause, longestPause));
}

} // namespace

CineReview::CineReview(const CineRing& ring, QObject* parent) : QObject(parent), m_ring(ring), m_pipeline(nullptr, PictureRole::Review)
{
    m_timer.setSingleShot(true);
    m_pipeline.setFilterRoom(std::chrono::hours(1)); // what is reviewed is late anyhow
    connect(&m_timer, &QTimer::timeout, this, &CineReview::playOn);
    connect(&m_pipeline, &FramePipeline::pictureReady, this, [this](const DisplayPicture& picture) {
        if (isOpen()) // one may still be on its way when the review is closed
            Q_EMIT pictureReady(picture);
    });
}

bool CineReview::open() { return openAt(std::max<quint64>(m_ring.range().end, 1) - 1); }

bool CineReview::openAt(quint64 number)
{
    if (m_ring.range().isEmpty())
        return false;
    m_timer.stop();
    show(number);
    return true;
}

void CineReview::close()
{
    m_timer.stop();
    m_place.reset();
    m_moment.reset();
    Q_EMIT placeChanged();
}

void CineReview::step(int frames)
{
    if (!m_place)
        return;
    m_timer.stop();
    const auto wanted = static_cast<qint64>(*m_place) + frames;
    show(static_cast<quint64>(std::max<qint64>(wanted, 0)));
}

void CineReview::toOldest()
{
    if (!m_place)
        return;
    m_timer.stop();
    show(m_ring.range().first);
}

void CineReview::setPlaying(bool playing)
{
    if (!m_place || playing == isPlaying())
        return;
    if (!playing) {
        m_timer.stop();
    } else {
        const CineRing::Range range = m_ring.range();
        m_filmEnd = range.end;
        if (m_atEnd)
            show(range.first);
        m_timer.start(shortestPause);
    }
    Q_EMIT placeChanged();
}

void CineReview::playOn()
{
    if (!m_place)
        return;
    const CineRing::Range range = m_ring.range();
    const quint64 number = std::max(*m_place + 1, range.first);
    if (number >= std::min(m_filmEnd, range.end)) { // the film ends; it does not run on into the present
        m_atEnd = true;
        Q_EMIT placeChanged();
        return;
    }
    const auto now = m_ring.at(number);
    const auto next = m_ring.at(number + 1);
    m_timer.start(now && next ? pauseBetween(*now, *next)
                              : shortestPause); // before it is shown: whoever hears of that asks whether it plays
    show(number);
}

void CineReview::show(quint64 number)
{
    const CineRing::Range range = m_ring.range();
    if (range.isEmpty())
        return;
    m_place = std::clamp(number, range.first, range.end - 1);
    m_atEnd = *m_place + 1 == range.end;
    if (const auto frame = m_ring.at(*m_place)) {
        m_arrival = frame->arrival;
        m_moment = m_arrival + CineRing::longestGap;
        if (const auto next = m_ring.at(*m_place + 1))
            endMoment(next->arrival);
        m_pipeline.showFrame(frame);
    }
    Q_EMIT placeChanged();
}

/// What is shown is the newest no more; true when that is sooner than was known.
bool CineReview::endMoment(Instant next)
{
    if (next > *m_moment)
        return false;
    m_moment = next - Instant::duration(1);
    return true;
}

/// It may be in the ring a little later than it is told here; one that came before it is there.
void CineReview::noteNewest(const XrayFrame& frame)
{
    if (!m_place || !m_moment || frame.arrival <= m_arrival)
        return;
    const auto next = m_ring.at(*m_place + 1);
    if (endMoment(next ? std::min(next->arrival, frame.arrival) : frame.arrival))
        Q_EMIT placeChanged();
}

QString CineReview::place() const
{
    const CineRing::Range range = m_ring.range();
    if (!m_place || range.isEmpty())
        return {};
    const quint64 count = range.end - range.first;
    if (*m_place < range.first)
        return tr("older than the %1 frames that are kept").arg(count);
    const auto frame = m_ring.at(*m_place);
    const auto newest = m_ring.at(range.end - 1);
    const double before =
        frame && newest && newest->captureNs > frame->captureNs ? static_cast<double>(newest->captureNs - frame->captureNs) / 1e9 : 0;
    return tr("%1 of %2, %3 s before the newest").arg(*m_place - range.first + 1).arg(count).arg(before, 0, 'f', 1);
}

} // namespace console
