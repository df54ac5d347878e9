// Keeps the last picture of a run when the run is over.
#include "imaging/image_hold.hpp"

#include "imaging/mean_picture.hpp"

#include <cstddef>
#include <utility>

namespace console {

namespace {

constexpr quint64 latenessNs = 1'000'000'000; ///< a picture that was taken later goes on with a run that had not ended

} // namespace

ImageHold::ImageHold(const CineRing& ring, const TableRest& table, QObject* parent)
    : QObject(parent), m_ring(ring), m_table(table), m_pipeline(nullptr, PictureRole::Hold)
{
    connect(&m_pipeline, &FramePipeline::pictureReady, this, &ImageHold::takeMean);
}

void ImageHold::take(const DisplayPicture& picture)
{
    if (picture.role != PictureRole::Live)
        return;
    const XrayFrame& about = picture.about;
    // An X-ray system that was started anew counts its runs and pictures from the first again.
    const bool another = m_last && (m_last->about.acquisition != about.acquisition || about.frame < m_last->about.frame);
    if (another && !m_heldNs)
        endRun();
    const bool late = !another && m_heldNs && about.captureNs - *m_heldNs < latenessNs; // it was still on its way when the run ended
    m_last = picture;
    if (late)
        tell();
    else
        m_heldNs.reset();
}

void ImageHold::endRun()
{
    if (!m_last || m_heldNs)
        return;
    m_heldNs = m_last->about.captureNs;
    tell();
}

void ImageHold::tell()
{
    if (m_held && m_held->meanOf > 1 && m_last->isSameFrameAs(*m_held))
        return; // its mean stands, and other settings come to that by its own pipeline
    m_held = m_last;
    m_held->role = PictureRole::Hold;
    m_mustMean = m_pictures > 1;
    Q_EMIT held(*m_held);
}

void ImageHold::tableReported()
{
    if (m_mustMean)
        makeMean();
}

void ImageHold::makeMean()
{
    const auto restSince = m_table.since(m_held->about.arrival);
    if (!restSince)
        return;
    SharedFrames frames = framesForMean(m_ring, m_held->about, static_cast<std::size_t>(m_pictures), *restSince);
    if (frames.empty())
        return; // the decoding thread has not written it yet: with the next report
    m_mustMean = false;
    if (frames.size() > 1)
        m_pipeline.showMean(std::move(frames));
}

/// For as long as its last picture is the one that is held; made anew with other settings, too.
void ImageHold::takeMean(const DisplayPicture& mean)
{
    if (mean.meanOf < 2 || !m_held || !mean.isSameFrameAs(*m_held))
        return;
    m_held = mean;
    Q_EMIT held(mean);
}

void ImageHold::setSettings(const DisplaySettings& settings)
{
    DisplaySettings unfiltered = settings;
    // The mean is one of stored values and stands in the filter's place: filtered ones have earlier pictures in them, also those of another
    // exposure or place, and then it would be of more pictures than it says.
    unfiltered.noiseReduction = 0;
    m_pipeline.setSettings(unfiltered);
}

} // namespace console
