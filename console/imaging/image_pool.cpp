// Pictures for the screen that are used again.
#include "imaging/image_pool.hpp"

#include <atomic>

namespace console {

QImage ImagePool::next(QSize size)
{
    for (QImage& image : m_images) {
        if (image.isNull() || image.size() != size || !image.isDetached())
            continue;
        // The last keeper let go on another thread: what it read must be read before this thread writes.
        std::atomic_thread_fence(std::memory_order_acquire);
        // Moved out and back: a copy beside it would make the first stroke of the painter duplicate the whole picture.
        QImage free;
        free.swap(image);
        return free;
    }
    return QImage(size, QImage::Format_RGB32);
}

void ImagePool::keep(const QImage& image)
{
    for (QImage& place : m_images)
        if (place.isNull()) {
            place = image;
            return;
        }
    m_images[m_turn] = image;
    m_turn = (m_turn + 1) % count;
}

} // namespace console
