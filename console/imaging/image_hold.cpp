// Keeps the last picture of a run when the run is over.
#include "imaging/image_hold.hpp"

namespace console {

namespace {

constexpr quint64 latenessNs = 1'000'000'000; ///< a picture that was taken later goes on with a run that had not ended

} // namespace

ImageHold::ImageHold(QObject* parent) : QObject(parent) {}

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
    if (!m_last)
        return;
    m_heldNs = m_last->about.captureNs;
    tell();
}

void ImageHold::tell()
{
    DisplayPicture hold = *m_last;
    hold.role = PictureRole::Hold;
    Q_EMIT held(hold);
}

} // namespace console
