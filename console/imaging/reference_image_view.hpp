// The reference picture: last image hold, review or roadmap, beside the live one and never in its place.
#pragma once

#include "imaging/picture_canvas.hpp"
#include "imaging/text_plates.hpp"

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

    /// What else is to be said of it: where it stands in the review, `12 of 180, 11.2 s before the newest`, or whose vessels lie over it.
    void setPlace(const QString& place);

    /// Painted over each picture of the role Roadmap, as `vesselLayer()` makes them; null: none.
    void setVessels(const QImage& vessels);
    void setOpacity(double opacity); ///< of the vessels, 0 to 1
    double opacity() const { return m_opacity; }

    /// Of the live picture, which a roadmap shows once more: where that is frozen, this is.
    void setCondition(PictureCondition condition);

    const std::optional<DisplayPicture>& picture() const { return m_picture; }

    /// The same with the vessels of a roadmap in it, for saving; there must be a picture.
    DisplayPicture pictureWithVessels() const;

    /// Every pixel that is not the picture's own.
    QRegion overlayRegion() const { return m_overlay; }

    QSize sizeHint() const override { return {562, 520}; }

protected:
    const DisplayPicture* shown() const override { return m_picture ? &*m_picture : nullptr; }
    void paintEvent(QPaintEvent* event) override;

private:
    QString head() const;
    QPoint placeWords(TextPlates& plates, const QRect& area) const; ///< what comes beneath them has its corner there
    void paintNothingYet(QPainter& painter);
    void describe();

    std::optional<DisplayPicture> m_picture;
    QString m_place;
    QImage m_vessels;
    double m_opacity = 0.6;
    PictureCondition m_condition = PictureCondition::Live;
    QRegion m_overlay;
};

} // namespace console
