// What is painted over the live picture: age, source, sides, scale, frame number, liveness, and the look of a picture that is not live.
#include "imaging/picture_overlay.hpp"

#include "imaging/figure_cells.hpp"
#include "imaging/pane_colours.hpp"

#include <QCoreApplication>
#include <QPainter>
#include <QStringList>

#include <algorithm>
#include <array>
#include <cmath>

namespace console {

namespace {

constexpr double veilShare = 0.4;

struct Text {
    Q_DECLARE_TR_FUNCTIONS(console::PictureOverlay)
};

QString wholeMilliseconds(const std::optional<Duration>& duration)
{
    return duration ? QString::number(std::lround(milliseconds(*duration))) : Text::tr("unknown");
}

// The clocks' uncertainty is said where it can be seen in the figure: below ten seconds, and when it is a millisecond or more.
QString ageText(const PictureReading& reading)
{
    if (!reading.age)
        return Text::tr("unknown");
    if (*reading.age >= std::chrono::seconds(10))
        return Text::tr("%1 s").arg(seconds(*reading.age), 0, 'f', 1);
    const long age = std::lround(milliseconds(*reading.age));
    // Rounded up: an uncertainty is never made smaller.
    const auto uncertain = static_cast<long>(std::ceil(milliseconds(reading.uncertainty)));
    return uncertain > 0 ? Text::tr("%1 \u00B1%2 ms").arg(age).arg(uncertain) : Text::tr("%1 ms").arg(age);
}

// LIVE is said of a picture that is live now; what came from a live source and is not is told without that word.
QString sourceLine(PictureSource source, const PictureReading& reading)
{
    if (source != PictureSource::Live || reading.condition == PictureCondition::Live)
        return word(source);
    return word(reading.condition);
}

// Two spaces part the figures of the chip in every language.
QStringList partsOf(const QString& line) { return line.split(QStringLiteral("  ")); }

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
    const auto shown = std::lround(reading.shownPerSecond);
    const auto expected = std::lround(reading.expectedPerSecond);
    return Text::tr("AGE %1  NET %2  PROC %3  %4")
        .arg(ageText(reading), wholeMilliseconds(reading.network), wholeMilliseconds(reading.processing),
             expected > 0 ? Text::tr("%1 of %2 fps").arg(shown).arg(expected) : Text::tr("%1 fps").arg(shown));
}

PictureOverlay::PictureOverlay(QRect area, const DisplayPicture& picture, const PictureReading& reading, quint64 paintedPictures,
                               const QFont& font, double zoom)
    : m_area(area), m_plates(font), m_gap(m_plates.gap()), m_paintedPictures(paintedPictures)
{
    placeHead(picture, reading);
    placeReduction(reductionOf(picture.about), reading.condition != PictureCondition::Held);
    placeSides(m_plates, area, picture);
    placeCondition(reading);
    placeFoot(picture, zoom);
}

void PictureOverlay::placeHead(const DisplayPicture& picture, const PictureReading& reading)
{
    const QRect inner = m_area.adjusted(m_gap, m_gap, -m_gap, -m_gap);
    const QString words = sourceLine(picture.about.source, reading);
    const QFont font = fitted(larger(m_plates.font(), headFactor), {words}, inner.width() - 2 * m_gap);
    const QRect source = m_plates.add(words, font, inner.topLeft(), Qt::AlignLeft | Qt::AlignTop);
    const QRect chip = placeAge(reading, source);
    m_headEnd = std::max(source.bottom(), chip.top() > source.bottom() ? chip.bottom() : source.bottom());
    m_liveness = QRect(0, 0, livenessCells * m_gap, m_gap);
    m_liveness.moveTopRight(chip.bottomRight() + QPoint(0, m_gap));
}

// In the corner; where the source's word leaves no room beside it, below, in two rows at need. Never clipped.
QRect PictureOverlay::placeAge(const PictureReading& reading, const QRect& source)
{
    const QRect inner = m_area.adjusted(m_gap, m_gap, -m_gap, -m_gap);
    const QStringList parts = partsOf(ageLine(reading));
    const QStringList widest = partsOf(Text::tr("AGE 8888 ±88 ms  NET 888  PROC 888  88 of 88 fps"));
    const auto width = [&](const QFont& font, qsizetype first) {
        double sum = 0;
        for (qsizetype i = first; i < parts.size(); ++i)
            sum += std::max(figuresWidth(font, parts[i]), figuresWidth(font, widest.value(i))) + 2 * m_gap;
        return sum;
    };
    QFont font = m_plates.font();
    if (width(font, 0) + source.width() + m_gap <= inner.width())
        return placeRow(parts, widest, font, inner.topRight());
    const QPoint below(inner.right(), source.bottom() + 1);
    if (width(font, 0) <= inner.width())
        return placeRow(parts, widest, font, below);
    while (font.pixelSize() > 1 && std::max(width(font, 1), width(font, 0) - width(font, 1)) > inner.width())
        font.setPixelSize(font.pixelSize() - 1);
    const QRect first = placeRow(parts.mid(0, 1), widest.mid(0, 1), font, below);
    return placeRow(parts.mid(1), widest.mid(1), font, {below.x(), first.bottom() + 1});
}

// From the right, each part in a place of its own: none moves when another one changes.
QRect PictureOverlay::placeRow(const QStringList& parts, const QStringList& widest, const QFont& font, QPoint corner)
{
    QRect row;
    for (qsizetype i = parts.size() - 1; i >= 0; --i) {
        const QRect placed = m_plates.add(parts[i], font, corner, Qt::AlignRight | Qt::AlignTop, widest.value(i, parts[i]));
        corner.setX(placed.left() - 1);
        row |= placed;
    }
    return row;
}

// Never clipped: in two lines when one is too long for the picture, and smaller when that is not enough.
void PictureOverlay::placeReduction(const PictureReduction& reduction, bool isExpected)
{
    if (!reduction.stands())
        return;
    const int room = m_area.width() - 4 * m_gap;
    const QFont wanted = larger(m_plates.font(), 1.2);
    QStringList lines{line(reduction)};
    if (figuresWidth(wanted, lines.front()) > room)
        lines = {rateWords(reduction), encodingWords(reduction)};
    const QFont font = fitted(wanted, lines, room);
    int top = std::max(m_headEnd, m_liveness.bottom()) + m_gap;
    for (const QString& line : lines) {
        const QRect placed = m_plates.add(line, font, {m_area.left() + m_gap, top}, Qt::AlignLeft | Qt::AlignTop);
        if (isExpected && reduction.losesInformation())
            m_plates.setInk(pane_colours::caution);
        top = placed.bottom() + 1;
    }
    m_headEnd = top;
}

void PictureOverlay::placeCondition(const PictureReading& reading)
{
    if (reading.condition == PictureCondition::Live || reading.condition == PictureCondition::None)
        return;
    const QPoint corner(m_area.center().x(), m_headEnd + 3 * m_gap);
    QString line = word(reading.condition);
    QString widest = line;
    const bool fault = reading.condition == PictureCondition::Frozen;
    if (fault) {
        const std::optional<Duration> since = reading.frozenFor ? reading.frozenFor : reading.age;
        line += since ? Text::tr(" %1 s").arg(seconds(*since), 0, 'f', 1) : QString();
        widest += Text::tr(" %1 s").arg(QStringLiteral("888.8"));
    }
    const QFont font = fitted(larger(m_plates.font(), fault ? 1.8 : headFactor), {line, widest}, m_area.width() - 2 * m_gap);
    const QRect first = m_plates.add(line, font, corner, Qt::AlignHCenter | Qt::AlignTop, widest);
    m_plates.add(Text::tr("Picture of %1").arg(clockTime(reading.captureNs)), {corner.x(), first.bottom() + 1},
                 Qt::AlignHCenter | Qt::AlignTop);
}

void PictureOverlay::placeFoot(const DisplayPicture& picture, double zoom)
{
    const std::size_t above = m_plates.plates().size();
    m_scaleBar = placeScale(m_plates, m_area, picture, 1 / zoom);
    placeFacts(m_plates, m_area, m_scaleBar, picture, zoom);
    m_footTop = m_scaleBar.isEmpty() ? m_area.bottom() : m_scaleBar.top();
    for (std::size_t place = above; place < m_plates.plates().size(); ++place)
        m_footTop = std::min(m_footTop, m_plates.plates()[place].rect.top());
}

QRegion PictureOverlay::region() const
{
    QRegion region(m_liveness);
    region += m_scaleBar;
    region += m_plates.region();
    return region;
}

void PictureOverlay::paint(QPainter& painter) const
{
    m_plates.paint(painter);
    painter.fillRect(m_liveness, pane_colours::background); // nothing below it may seem to move it
    const int cell = m_liveness.width() / livenessCells;
    const int place = static_cast<int>(m_paintedPictures % livenessCells);
    painter.fillRect(QRect(m_liveness.left() + place * cell, m_liveness.top(), cell, m_liveness.height()), pane_colours::text);
    paintScaleBar(painter, m_scaleBar);
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

void paintDashedFrame(QPainter& painter, const QRect& pane)
{
    QPen pen(pane_colours::line, 3, Qt::CustomDashLine, Qt::FlatCap);
    pen.setDashPattern({6, 4});
    painter.setPen(pen);
    painter.setBrush(Qt::NoBrush);
    painter.drawRect(pane.adjusted(1, 1, -2, -2));
}

void paintFocusFrame(QPainter& painter, const QRect& pane)
{
    painter.setPen(QPen(pane_colours::focus, 2));
    painter.setBrush(Qt::NoBrush);
    painter.drawRect(pane.adjusted(4, 4, -5, -5));
}

void paintHatchedFrame(QPainter& painter, const QRect& pane)
{
    const QBrush hatch(hatchTile());
    const QRect inner = pane.adjusted(hatchWidth, hatchWidth, -hatchWidth, -hatchWidth);
    for (const QRect& side : QRegion(pane) - QRegion(inner))
        painter.fillRect(side, hatch);
}

} // namespace console
