// What is painted over the live picture: age, source, sides, scale, frame number, liveness, and the look of a picture that is not live.
#include "imaging/picture_overlay.hpp"

#include "imaging/c_arm_pose.hpp"
#include "imaging/pane_colours.hpp"

#include <QCoreApplication>
#include <QDateTime>
#include <QFontMetrics>
#include <QPainter>
#include <QStringList>

#include <algorithm>
#include <array>
#include <cmath>

namespace console {

namespace {

constexpr double veilShare = 0.4;

QString text(const char* source) { return QCoreApplication::translate("PictureOverlay", source); }

QString wholeMilliseconds(const std::optional<Duration>& duration)
{
    return duration ? QString::number(std::lround(milliseconds(*duration))) : text("unknown");
}

QString ageText(const std::optional<Duration>& age)
{
    if (!age)
        return text("unknown");
    if (*age >= std::chrono::seconds(10))
        return text("%1 s").arg(seconds(*age), 0, 'f', 1);
    return text("%1 ms").arg(std::lround(milliseconds(*age)));
}

QFont larger(QFont font, double factor)
{
    font.setPixelSize(static_cast<int>(std::lround(font.pixelSize() * factor)));
    font.setWeight(QFont::DemiBold);
    return font;
}

QPixmap hatchTile()
{
    QPixmap tile(hatchWidth, hatchWidth);
    tile.fill(pane_colours::background);
    QPainter painter(&tile);
    painter.setPen(QPen(pane_colours::text, hatchWidth / 2.0 / std::sqrt(2.0), Qt::SolidLine, Qt::FlatCap)); // half of a row is light
    painter.setRenderHint(QPainter::Antialiasing);
    for (int shift = -hatchWidth; shift <= hatchWidth; shift += hatchWidth)
        painter.drawLine(shift - hatchWidth, 2 * hatchWidth, shift + 2 * hatchWidth, -hatchWidth);
    return tile;
}

} // namespace

QString ageLine(const PictureReading& reading)
{
    return text("AGE %1  NET %2  PROC %3  %4 fps")
        .arg(ageText(reading.age), wholeMilliseconds(reading.network), wholeMilliseconds(reading.processing))
        .arg(std::lround(reading.shownPerSecond));
}

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

PictureOverlay::PictureOverlay(QRect area, const DisplayPicture& picture, const PictureReading& reading, quint64 paintedPictures,
                               const QString& refusal, const QFont& font)
    : m_area(area), m_font(font), m_gap(font.pixelSize() / 2), m_paintedPictures(paintedPictures)
{
    placeCorners(picture, reading);
    placeReduction(reductionOf(picture.about), reading.condition != PictureCondition::Held);
    placeSides(picture);
    placeCondition(reading);
    placeScale(picture);
    placeRefusal(refusal);
}

QRect PictureOverlay::plate(const QString& text, const QFont& font, QPoint corner, Qt::Alignment alignment, const QString& widest)
{
    const QFontMetrics metrics(font);
    const int width = metrics.horizontalAdvance(widest.isEmpty() ? text : widest) + 2 * m_gap;
    QRect rect(0, 0, std::max(width, metrics.horizontalAdvance(text) + 2 * m_gap), metrics.height() + m_gap);
    if (alignment & Qt::AlignRight)
        rect.moveRight(corner.x());
    else if (alignment & Qt::AlignHCenter)
        rect.moveLeft(corner.x() - rect.width() / 2);
    else
        rect.moveLeft(corner.x());
    if (alignment & Qt::AlignBottom)
        rect.moveBottom(corner.y());
    else if (alignment & Qt::AlignVCenter)
        rect.moveTop(corner.y() - rect.height() / 2);
    else
        rect.moveTop(corner.y());
    m_plates.push_back({rect, text, font, widest.isEmpty() ? Qt::AlignCenter : Qt::AlignLeft | Qt::AlignVCenter, pane_colours::text});
    return rect;
}

void PictureOverlay::placeCorners(const DisplayPicture& picture, const PictureReading& reading)
{
    const QRect inner = m_area.adjusted(m_gap, m_gap, -m_gap, -m_gap);
    const QRect source = plate(word(picture.about.source), larger(m_font, 1.2), inner.topLeft(), Qt::AlignLeft | Qt::AlignTop);
    m_headEnd = source.bottom();
    const QRect chip =
        plate(ageLine(reading), m_font, inner.topRight(), Qt::AlignRight | Qt::AlignTop, text("AGE 8888 ms  NET 888  PROC 888  88 fps"));
    m_liveness = QRect(0, 0, livenessCells * m_gap, m_gap);
    m_liveness.moveTopRight(chip.bottomRight() + QPoint(0, m_gap));
    const QString frame = text("frame %1  run %2").arg(picture.about.frame).arg(picture.about.acquisition);
    const QString window = text("C %1  W %2").arg(std::lround(picture.window.centre)).arg(std::lround(picture.window.width));
    plate(frame + QStringLiteral("  ") + window + (picture.windowIsAutomatic ? text("  AUTO") : QString()), m_font, inner.bottomLeft(),
          Qt::AlignLeft | Qt::AlignBottom);
}

// Never clipped: in two lines when one is too long for the picture, and smaller when that is not enough.
void PictureOverlay::placeReduction(const PictureReduction& reduction, bool isExpected)
{
    if (!reduction.stands())
        return;
    const int room = m_area.width() - 4 * m_gap;
    const auto fits = [room](const QFont& font, const QString& line) { return QFontMetrics(font).horizontalAdvance(line) <= room; };
    QFont font = larger(m_font, 1.2);
    QStringList lines{line(reduction)};
    if (!fits(font, lines.front()))
        lines = {rateWords(reduction), encodingWords(reduction)};
    while (font.pixelSize() > 1 && !std::all_of(lines.begin(), lines.end(), [&](const QString& line) { return fits(font, line); }))
        font.setPixelSize(font.pixelSize() - 1);
    int top = std::max(m_headEnd, m_liveness.bottom()) + m_gap;
    for (const QString& line : lines) {
        const QRect placed = plate(line, font, {m_area.left() + m_gap, top}, Qt::AlignLeft | Qt::AlignTop);
        if (isExpected && reduction.losesInformation())
            m_plates.back().ink = pane_colours::caution;
        top = placed.bottom() + 1;
    }
    m_headEnd = top;
}

void PictureOverlay::placeSides(const DisplayPicture& picture)
{
    const XrayGeometry& geometry = picture.about.geometry;
    const int middle = m_area.center().y();
    // Without a geometry the angles are zeros that nobody measured: a side that is guessed is worse than none.
    if (geometry.sourceDetectorDistance <= 0) {
        plate(text("sides unknown"), m_font, {m_area.left() + m_gap, middle}, Qt::AlignLeft | Qt::AlignVCenter);
        return;
    }
    const PictureAxes axes = axesOf(geometry.primaryAngle, geometry.secondaryAngle);
    const QFont font = larger(m_font, 1.4);
    plate(sideLetter(-axes.right), font, {m_area.left() + m_gap, middle}, Qt::AlignLeft | Qt::AlignVCenter);
    plate(sideLetter(axes.right), font, {m_area.right() - m_gap, middle}, Qt::AlignRight | Qt::AlignVCenter);
}

void PictureOverlay::placeCondition(const PictureReading& reading)
{
    if (reading.condition == PictureCondition::Live || reading.condition == PictureCondition::None)
        return;
    const QPoint corner(m_area.center().x(), m_headEnd + 3 * m_gap);
    QString line = word(reading.condition);
    if (reading.condition == PictureCondition::Frozen) {
        const std::optional<Duration> since = reading.frozenFor ? reading.frozenFor : reading.age;
        line += since ? text(" %1 s").arg(seconds(*since), 0, 'f', 1) : QString();
    }
    const bool fault = reading.condition == PictureCondition::Frozen;
    const QRect first = plate(line, larger(m_font, fault ? 1.8 : 1.3), corner, Qt::AlignHCenter | Qt::AlignTop);
    plate(text("Picture of %1").arg(clockTime(reading.captureNs)), m_font, {corner.x(), first.bottom() + 1},
          Qt::AlignHCenter | Qt::AlignTop);
}

void PictureOverlay::placeScale(const DisplayPicture& picture)
{
    const QPoint corner = m_area.bottomRight() - QPoint(m_gap, m_gap);
    const std::optional<double> pixelSize = pixelSizeAtIsocentre(picture.about);
    if (!pixelSize) {
        plate(text("no scale: geometry unknown"), m_font, corner, Qt::AlignRight | Qt::AlignBottom);
        return;
    }
    const double pictureWidth = *pixelSize * picture.about.columns;
    const double length = scaleBarLength(pictureWidth);
    const QRect label = plate(text("%1 mm @ isocentre plane (geometry)").arg(length), m_font, corner, Qt::AlignRight | Qt::AlignBottom);
    const int width = static_cast<int>(std::lround(length / pictureWidth * m_area.width()));
    m_scaleBar = QRect(label.right() - width + 1, label.top() - 2 * m_gap, width, m_gap);
}

void PictureOverlay::placeRefusal(const QString& refusal)
{
    if (refusal.isEmpty())
        return;
    const QString line = QFontMetrics(m_font).elidedText(refusal, Qt::ElideRight, m_area.width() - 6 * m_gap);
    plate(line, m_font, {m_area.center().x(), m_area.bottom() - 8 * m_gap}, Qt::AlignHCenter | Qt::AlignBottom);
}

QRegion PictureOverlay::region() const
{
    QRegion region(m_liveness);
    region += m_scaleBar;
    for (const OverlayPlate& plate : m_plates)
        region += plate.rect;
    return region;
}

void PictureOverlay::paint(QPainter& painter) const
{
    QColor dark = pane_colours::background;
    dark.setAlpha(200);
    for (const OverlayPlate& plate : m_plates) {
        painter.fillRect(plate.rect, dark);
        painter.setFont(plate.font);
        painter.setPen(plate.ink);
        painter.drawText(plate.rect.adjusted(m_gap, 0, -m_gap, 0), static_cast<int>(plate.alignment) | Qt::TextDontClip, plate.text);
    }
    painter.fillRect(m_liveness, pane_colours::background); // nothing below it may seem to move it
    const int cell = m_liveness.width() / livenessCells;
    const int place = static_cast<int>(m_paintedPictures % livenessCells);
    painter.fillRect(QRect(m_liveness.left() + place * cell, m_liveness.top(), cell, m_liveness.height()), pane_colours::text);
    if (!m_scaleBar.isEmpty()) {
        painter.fillRect(m_scaleBar, dark);
        const int middle = m_scaleBar.center().y();
        painter.fillRect(QRect(m_scaleBar.left(), middle - 1, m_scaleBar.width(), 2), pane_colours::text);
        painter.fillRect(QRect(m_scaleBar.left(), m_scaleBar.top(), 2, m_scaleBar.height()), pane_colours::text);
        painter.fillRect(QRect(m_scaleBar.right() - 1, m_scaleBar.top(), 2, m_scaleBar.height()), pane_colours::text);
    }
}

void paintStaleVeil(QPainter& painter, const QRect& area)
{
    QColor veil = pane_colours::stale;
    veil.setAlphaF(static_cast<float>(veilShare));
    painter.fillRect(area, veil);
}

void paintSolidFrame(QPainter& painter, const QRect& pane)
{
    constexpr int line = 3;
    const QRect inner = pane.adjusted(line, line, -line, -line);
    for (const QRect& side : QRegion(pane) - QRegion(inner))
        painter.fillRect(side, pane_colours::line);
}

void paintHatchedFrame(QPainter& painter, const QRect& pane)
{
    const QBrush hatch(hatchTile());
    const QRect inner = pane.adjusted(hatchWidth, hatchWidth, -hatchWidth, -hatchWidth);
    for (const QRect& side : QRegion(pane) - QRegion(inner))
        painter.fillRect(side, hatch);
}

} // namespace console
