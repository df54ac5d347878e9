// The reference picture: last image hold or review, beside the live one and never in its place.
#pragma once

#include "imaging/picture_canvas.hpp"

#include <optional>

namespace console {

/// Dashed frame, and in large letters what the picture is and when it was taken. It knows of no `PictureState`: nothing that is painted
/// here can count as a picture that instruments may be moved by.
class ReferenceImageView : public PictureCanvas {
    Q_OBJECT
public:
    explicit ReferenceImageView(QWidget* parent = nullptr);

    /// A picture that was made to be live is not taken.
    void showPicture(const DisplayPicture& picture);

    /// Where the picture stands in the review, `12 of 180, 11.2 s before the newest`; empty for a hold.
    void setPlace(const QString& place);

    const std::optional<DisplayPicture>& picture() const { return m_picture; }

    /// Every pixel that is not the picture's own.
    QRegion overlayRegion() const { return m_overlay; }

    QSize sizeHint() const override { return {562, 520}; }

protected:
    const DisplayPicture* shown() const override { return m_picture ? &*m_picture : nullptr; }
    void paintEvent(QPaintEvent* event) override;

private:
    void paintNothingYet(QPainter& painter);
    void describe();

    std::optional<DisplayPicture> m_picture;
    QString m_place;
    QRegion m_overlay;
};

} // namespace console
