// Keeps the last picture of a run when the run is over.
#include "imaging/image_hold.hpp"

namespace console {

ImageHold::ImageHold(QObject* parent) : QObject(parent) {}

void ImageHold::take(const DisplayPicture& picture)
{
    if (picture.role != PictureRole::Live)
        return;
    if (m_last && m_last->about.acquisition != picture.about.acquisition && m_heldRun != m_last->about.acquisition)
        endRun();
    m_last = picture;
    if (m_heldRun == picture.about.acquisition) // it was still on its way when the run ended
        endRun();
}

void ImageHold::endRun()
{
    if (!m_last)
        return;
    m_heldRun = m_last->about.acquisition;
    DisplayPicture hold = *m_last;
    hold.role = PictureRole::Hold;
    Q_EMIT held(hold);
}

} // namespace console
