// The marks that every picture carries.
#include "imaging/picture_marks.hpp"

#include "imaging/c_arm_pose.hpp"
#include "imaging/figure_cells.hpp"
#include "imaging/pane_colours.hpp"
#include "imaging/temporal_filter.hpp"

#include <QCoreApplication>
#include <QDateTime>
#include <QPainter>
#include <QStringList>

#include <algorithm>
#include <cmath>

namespace console {

namespace {

struct Text {
    Q_DECLARE_TR_FUNCTIONS(console::PictureMarks)
};

// What the filter does and not only what was asked of it: it may be bounded by the latency, or just have begun. Of a picture that stands it
// cannot be weakened.
QString noiseWords(int asked, const PictureTreatment& treatment)
{
    const long present = std::lround(strengthOfK(treatment.k));
    if (present >= asked)
        return Text::tr("noise %1 %").arg(present);
    return treatment.filterIsBounded ? Text::tr("noise %1 of %2 %, for latency").arg(present).arg(asked)
                                     : Text::tr("noise %1 of %2 %").arg(present).arg(asked);
}

/// What must be said first: where the room lacks, the last ones are left out.
QStringList treatmentParts(const DisplayPicture& picture)
{
    QStringList parts{picture.isCalibrated ? Text::tr("display calibrated") : Text::tr("display not calibrated")};
    const DisplaySettings& settings = picture.settings;
    if (settings.inverted)
        parts << Text::tr("INVERTED");
    if (settings.noiseReduction > 0)
        parts << noiseWords(settings.noiseReduction, picture.treatment);
    if (settings.edge > 0)
        parts << Text::tr("edge %1 %, %2").arg(settings.edge).arg(word(settings.edgeMethod));
    if (settings.shutter != ShutterShape::None)
        parts << Text::tr("SHUTTER");
    return parts;
}

/// As many of `parts` as there is room for, none of them cut, and the first in any case.
QString asManyAsFit(QStringList parts, const QFont& font, int room)
{
    const QString gap = QStringLiteral("  ");
    QString text = parts.join(gap);
    while (parts.size() > 1 && figuresWidth(font, text) > room) {
        parts.removeLast();
        text = parts.join(gap) + gap + QChar(0x2026);
    }
    return figuresWidth(font, text) <= room ? text : parts.first();
}

} // namespace

QString clockTime(quint64 captureNs)
{
    const qint64 tenths = static_cast<qint64>(captureNs / 100'000'000);
    const QDateTime time = QDateTime::fromMSecsSinceEpoch(tenths * 100);
    return time.toString(QStringLiteral("HH:mm:ss.")) + QString::number(tenths % 10);
}

double scaleBarLength(double pictureWidthMm)
{
    const double wanted = pictureWidthMm / 5;
    if (!(wanted > 0) || !std::isfinite(wanted))
        return 0;
    const double decade = std::pow(10, std::floor(std::log10(wanted)));
    for (const double step : {5.0, 2.0})
        if (wanted >= step * decade)
            return step * decade;
    return decade;
}

QString meanWords(const DisplayPicture& picture) { return picture.meanOf > 1 ? Text::tr("MEAN OF %1").arg(picture.meanOf) : QString(); }

QString roleWords(const DisplayPicture& picture)
{
    const QString mean = meanWords(picture);
    return mean.isEmpty() ? word(picture.role) : QStringLiteral("%1 \u00B7 %2").arg(word(picture.role), mean);
}

QString windowLine(const DisplayPicture& picture)
{
    QString line = Text::tr("C %1  W %2").arg(std::lround(picture.window.centre)).arg(std::lround(picture.window.width));
    if (picture.settings.function != VoiFunction::Linear)
        line += QStringLiteral("  ") + word(picture.settings.function);
    if (picture.windowIsAutomatic)
        line += Text::tr("  AUTO");
    return line;
}

QString treatmentLine(const DisplayPicture& picture) { return treatmentParts(picture).join(QStringLiteral("  ")); }

void placeSides(TextPlates& plates, const QRect& area, const DisplayPicture& picture)
{
    const XrayGeometry& geometry = picture.about.geometry;
    const int middle = area.center().y();
    const int gap = plates.gap();
    // Without a geometry the angles are zeros that nobody measured: a side that is guessed is worse than none.
    if (geometry.sourceDetectorDistance <= 0) {
        plates.add(Text::tr("sides unknown"), {area.left() + gap, middle}, Qt::AlignLeft | Qt::AlignVCenter);
        return;
    }
    const PictureAxes axes = axesOf(geometry.primaryAngle, geometry.secondaryAngle);
    const QFont font = larger(plates.font(), 1.4);
    plates.add(sideLetter(-axes.right), font, {area.left() + gap, middle}, Qt::AlignLeft | Qt::AlignVCenter);
    plates.add(sideLetter(axes.right), font, {area.right() - gap, middle}, Qt::AlignRight | Qt::AlignVCenter);
}

QRect placeScale(TextPlates& plates, const QRect& area, const DisplayPicture& picture, double shownShare)
{
    const int gap = plates.gap();
    const QPoint corner = area.bottomRight() - QPoint(gap, gap);
    const int room = area.width() - 4 * gap;
    const std::optional<double> pixelSize = pixelSizeAtIsocentre(picture.about);
    if (!pixelSize) {
        const QString none = Text::tr("no scale: geometry unknown");
        plates.add(none, fitted(plates.font(), {none}, room), corner, Qt::AlignRight | Qt::AlignBottom);
        return {};
    }
    const double shownWidth = *pixelSize * picture.about.columns * shownShare;
    const double length = scaleBarLength(shownWidth);
    QString words = Text::tr("%1 mm @ isocentre plane (geometry)").arg(length);
    if (figuresWidth(plates.font(), words) > room)
        words = Text::tr("%1 mm @ isocentre").arg(length);
    const QRect label = plates.add(words, fitted(plates.font(), {words}, room), corner, Qt::AlignRight | Qt::AlignBottom);
    const int width = static_cast<int>(std::lround(length / shownWidth * area.width()));
    return {label.right() - width + 1, label.top() - 2 * gap, width, gap};
}

void paintScaleBar(QPainter& painter, const QRect& bar)
{
    if (bar.isEmpty())
        return;
    QColor dark = pane_colours::background;
    dark.setAlpha(200);
    painter.fillRect(bar, dark);
    painter.fillRect(QRect(bar.left(), bar.center().y() - 1, bar.width(), 2), pane_colours::text);
    painter.fillRect(QRect(bar.left(), bar.top(), 2, bar.height()), pane_colours::text);
    painter.fillRect(QRect(bar.right() - 1, bar.top(), 2, bar.height()), pane_colours::text);
}

void placeFacts(TextPlates& plates, const QRect& area, const QRect& bar, const DisplayPicture& picture, double zoom)
{
    const int gap = plates.gap();
    const int room = area.width() - 4 * gap;
    QPoint corner(area.left() + gap, area.bottom() - gap);
    const auto place = [&](const QString& text, const QFont& font) {
        if (const QRect placed = plates.addAbove(text, font, corner, bar, area.top()); !placed.isEmpty())
            corner.setY(placed.top() - 1);
    };
    const QString window = windowLine(picture);
    const QString frame = Text::tr("frame %1  run %2").arg(picture.about.frame).arg(picture.about.acquisition);
    const QString whole = frame + QStringLiteral("  ") + window;
    // The grey values mean nothing without their window: it gives way to nothing, and no number is cut.
    const bool beside = figuresWidth(plates.font(), whole) <= room;
    place(beside ? whole : window, fitted(plates.font(), {beside ? whole : window}, room));
    QStringList treatment = treatmentParts(picture);
    const QFont font = fitted(plates.font(), {treatment.first()}, room);
    if (zoom > 1)
        treatment.insert(1, Text::tr("ZOOM %1\u00D7").arg(zoom, 0, 'f', 1));
    place(asManyAsFit(treatment, font, room), font);
    if (!beside && figuresWidth(plates.font(), frame) <= room)
        place(frame, plates.font());
}

} // namespace console
