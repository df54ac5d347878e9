// The reference picture.
#include "imaging/reference_image_view.hpp"

#include "imaging/pane_colours.hpp"
#include "imaging/picture_marks.hpp"
#include "imaging/picture_overlay.hpp"

#include <QPainter>

#include <algorithm>

namespace console {

ReferenceImageView::ReferenceImageView(QWidget* parent) : PictureCanvas(parent)
{
    setObjectName(QStringLiteral("referenceImage"));
    setMinimumSize(160, 160);
    setAccessibleName(tr("Reference X-ray image"));
    describe();
}

void ReferenceImageView::showPicture(const DisplayPicture& picture)
{
    if (picture.role == PictureRole::Live)
        return;
    m_picture = picture;
    followPicture(picture);
    describe();
}

void ReferenceImageView::setPlace(const QString& place)
{
    if (m_place == place)
        return;
    m_place = place;
    update();
}

void ReferenceImageView::setVessels(const QImage& vessels)
{
    m_vessels = vessels;
    update();
}

void ReferenceImageView::setOpacity(double opacity)
{
    m_opacity = std::clamp(opacity, 0.0, 1.0);
    update();
}

DisplayPicture ReferenceImageView::pictureWithVessels() const
{
    DisplayPicture picture = *m_picture;
    if (picture.role != PictureRole::Roadmap || m_vessels.isNull())
        return picture;
    for (QImage* image : {&picture.image, &picture.presentation}) {
        if (image->isNull())
            continue;
        image->convertTo(QImage::Format_RGB32); // the vessels are not grey
        QPainter painter(image);
        painter.setRenderHint(QPainter::SmoothPixmapTransform);
        painter.setOpacity(m_opacity);
        painter.drawImage(image->rect(), m_vessels);
    }
    return picture;
}

void ReferenceImageView::setCondition(PictureCondition condition)
{
    if (m_condition == condition)
        return;
    m_condition = condition;
    describe();
    update();
}

void ReferenceImageView::paintEvent(QPaintEvent*)
{
    QPainter painter(this);
    painter.fillRect(rect(), pane_colours::background);
    m_overlay = {};
    if (!m_picture) {
        paintNothingYet(painter);
        paintTold(painter);
    } else {
        paintShown(painter);
        const QRect area = pictureRect();
        const bool isRoadmap = m_picture->role == PictureRole::Roadmap;
        if (isRoadmap)
            paintOver(painter, m_vessels, m_opacity);
        if (isRoadmap && (m_condition == PictureCondition::Frozen || m_condition == PictureCondition::Unknown))
            paintStaleVeil(painter, area);
        TextPlates plates(overlayFont());
        const QPoint below = placeWords(plates, area);
        placeSides(plates, area, *m_picture);
        const QRect bar = placeScale(plates, area, *m_picture, 1 / viewport().zoom());
        placeFacts(plates, area, bar, asSeenHere(*m_picture), viewport().zoom());
        plates.paint(painter);
        paintScaleBar(painter, bar);
        m_overlay = plates.region() + bar + paintToldAt(painter, below);
        m_overlay += paintMeasurement(painter, m_overlay);
    }
    paintDashedFrame(painter, rect());
    if (hasFocus())
        paintFocusFrame(painter, rect());
}

/// What it is and when it was taken; below that how it was reduced, which shows in it for good, and its place.
QPoint ReferenceImageView::placeWords(TextPlates& plates, const QRect& area) const
{
    const int gap = plates.gap();
    const int room = area.width() - 4 * gap;
    const QRect top = plates.add(head(), fitted(larger(plates.font(), headFactor), {head()}, room), area.topLeft() + QPoint(gap, gap),
                                 Qt::AlignLeft | Qt::AlignTop);
    QPoint below(top.left(), top.bottom() + 1);
    const auto place = [&](const QStringList& rows) {
        const QFont font = fitted(plates.font(), rows, room);
        for (const QString& row : rows)
            below.setY(plates.add(row, font, below, Qt::AlignLeft | Qt::AlignTop).bottom() + 1);
    };
    place(rowsOf(tr("Picture of %1").arg(clockTime(m_picture->about.captureNs)), plates.font(), room));
    if (const QString reduced = line(reductionOf(m_picture->about)); !reduced.isEmpty())
        place({reduced});
    if (!m_place.isEmpty())
        place(rowsOf(m_place, plates.font(), room));
    return below;
}

/// REVIEW, of how many pictures it is a mean, and SIMULATED or RECORDED when it is that; LIVE is never said here.
QString ReferenceImageView::head() const
{
    QStringList words{roleWords(*m_picture)};
    if (m_picture->about.source != PictureSource::Live)
        words << word(m_picture->about.source);
    if (m_picture->role == PictureRole::Roadmap && m_condition != PictureCondition::Live)
        words << word(m_condition);
    return words.join(QStringLiteral("  "));
}

void ReferenceImageView::paintNothingYet(QPainter& painter)
{
    QFont large = overlayFont(); // nothing else needs the room
    large.setPixelSize(large.pixelSize() * 2);
    painter.setFont(large);
    painter.setPen(pane_colours::secondary);
    painter.drawText(rect().adjusted(30, 30, -30, -30), Qt::AlignCenter | Qt::TextWordWrap,
                     tr("No reference picture yet. The last image of a run is held here, and the last minute can be reviewed."));
}

void ReferenceImageView::describe()
{
    if (!m_picture)
        return setAccessibleDescription(tr("No reference picture yet."));
    const QString words =
        tr("%1; the picture was taken at %2. It is not the live picture.").arg(head(), clockTime(m_picture->about.captureNs));
    const PictureReduction reduction = reductionOf(m_picture->about);
    setAccessibleDescription(reduction.stands() ? tr("%1 %2.").arg(words, line(reduction)) : words);
}

} // namespace console
