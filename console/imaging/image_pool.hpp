// Pictures for the screen that are used again as soon as nobody looks at them any more.
#pragma once

#include <QImage>

#include <array>
#include <cstddef>

namespace console {

/// The thread that paints into them calls next() and, when it is done, keep(); whoever holds a copy keeps it from being used again. When
/// all are held, a new one takes the place of one of them, which then lives as long as those who hold it.
class ImagePool {
public:
    /// A picture that nobody else holds; null when there is no memory.
    QImage next(QSize size);

    /// When it is painted: from now on it waits until it is free again.
    void keep(const QImage& image);

private:
    static constexpr std::size_t count = 6; ///< one in work, one waiting, two panes, the scene's, one to spare

    std::array<QImage, count> m_images;
    std::size_t m_turn = 0;
};

} // namespace console
