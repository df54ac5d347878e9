// Bars and figures of one instrument.
#include "widgets/axis_panel.hpp"

#include "widgets/figures.hpp"
#include "widgets/stale_mark.hpp"
#include "widgets/theme.hpp"

#include <QPainter>
#include <QPainterPath>

#include <algorithm>
#include <cmath>

namespace console {

using theme::TextRole;
namespace colour = theme::colour;

namespace {

constexpr double fullVelocity = 40;  // mm/s, the command's own limit
constexpr double fullRotation = 720; // deg/s
constexpr double stillBelow = 0.05;
constexpr double leastZone = 8; // px, of a soft limit's zone: one that is drawn to scale is not seen
constexpr int speedBarGap = 5;  // px, from the line on which a speed stands to its bar

double markerSize(const QRectF& track) { return track.height() * 0.55; }

double part(double value, const TravelRange& range)
{
    return range.length() > 0 ? std::clamp((value - range.low) / range.length(), 0.0, 1.0) : 0;
}

} // namespace

QString advanceWord(double velocity)
{
    if (std::abs(velocity) < stillBelow)
        return AxisPanel::tr("still");
    return velocity > 0 ? AxisPanel::tr("advance") : AxisPanel::tr("retract");
}

QString turnWord(double rotation)
{
    if (std::abs(rotation) < stillBelow)
        return AxisPanel::tr("still");
    return rotation > 0 ? AxisPanel::tr("clockwise") : AxisPanel::tr("anticlockwise");
}

AxisPanel::AxisPanel(const QString& name, icons::Icon icon, QWidget* parent) : QWidget(parent), m_name(name), m_icon(icon)
{
    theme::setTextRole(this, TextRole::Body);
    setAccessibleName(name);
}

QSize AxisPanel::sizeHint() const
{
    const double scale = theme::scaleOf(this);
    const QFontMetrics value(theme::font(TextRole::Value, scale));
    const QFontMetrics caption(theme::font(TextRole::Caption, scale));
    return {theme::px(this, 600), value.height() + 2 * caption.height() + theme::px(this, 16)};
}

QString AxisPanel::figureText(double value, int decimals, const QString& unit) const
{
    return figure(m_reading.freshness == Freshness::Unknown ? std::optional<double>() : value, decimals, unit);
}

void AxisPanel::setReading(const AxisReading& reading)
{
    m_reading = reading;
    setAccessibleDescription(tr("%1, %2 %3, %4")
                                 .arg(figureText(reading.position, 1, tr("mm")), advanceWord(reading.velocity),
                                      figureText(std::abs(reading.velocity), 1, tr("mm/s")), ageText(reading.freshness, reading.age)) +
                             travelText() + tr("; drives %1, %2").arg(driveText(reading.advance), driveText(reading.turn)));
    update();
}

QString AxisPanel::travelText() const
{
    if (!m_reading.travel)
        return {};
    const auto& [soft, hard] = *m_reading.travel;
    const auto ends = [](const TravelRange& range) {
        return tr("%1 to %2").arg(figure(range.low, 0, {}), figure(range.high, 0, tr("mm")));
    };
    return tr("; soft limits %1, hard limits %2").arg(ends(soft), ends(hard));
}

QString AxisPanel::limitWord(bool soft, bool hard) const { return hard ? tr("HARD LIMIT") : soft ? tr("SOFT LIMIT") : QString(); }

void AxisPanel::paintName(QPainter& painter, const QRectF& where) const
{
    const double scale = theme::scaleOf(this);
    painter.setFont(theme::font(TextRole::Strong, scale));
    const double line = QFontMetricsF(painter.font()).height();
    const double side = line * 1.4;
    icons::draw(painter, QRectF(where.left(), where.top(), side, side), m_icon, colour::text);
    painter.setPen(colour::text);
    painter.drawText(QRectF(where.left() + side * 1.25, where.top(), where.width() - side * 1.25, side), Qt::AlignLeft | Qt::AlignVCenter,
                     m_name);
    painter.setFont(theme::font(TextRole::Caption, scale));
    const bool known = m_reading.freshness != Freshness::Unknown;
    painter.setPen(colour::secondary);
    const QString gripper = !known ? tr("gripper \u2014") : m_reading.gripperClosed ? tr("gripper closed") : tr("gripper open");
    painter.drawText(QRectF(where.left(), where.top() + side, where.width(), line * 1.2), Qt::AlignLeft | Qt::AlignVCenter, gripper);
    const double below = where.top() + side + line * 1.2;
    const double mark = line * 0.8;
    if (m_reading.freshness != Freshness::Fresh)
        drawStaleMark(painter, QRectF(where.left(), below + line * 0.1, mark, mark), m_reading.freshness);
    const double indent = m_reading.freshness == Freshness::Fresh ? 0 : mark * 1.4;
    painter.setFont(theme::font(TextRole::Caption, scale));
    painter.setPen(m_reading.freshness == Freshness::Fresh ? colour::secondary : colour::text);
    drawFigures(painter, QRectF(where.left() + indent, below, where.width() - indent, line), Qt::AlignLeft | Qt::AlignVCenter,
                ageText(m_reading.freshness, m_reading.age));
}

// Of the track, which reaches from hard limit to hard limit; `travel` is known.
AxisPanel::Ends AxisPanel::softEnds(const QRectF& track) const
{
    const auto& travel = *m_reading.travel;
    const double scale = travel.hard.length() > 0 ? track.width() / travel.hard.length() : 0;
    const auto zone = [&](double length) { return length > 0 ? std::min(std::max(length * scale, leastZone), track.width() / 2) : 0.0; };
    return {track.left() + zone(travel.soft.low - travel.hard.low), track.right() - zone(travel.hard.high - travel.soft.high)};
}

// Each of the three stretches has a scale of its own, so that the mark comes to the hatching when the instrument comes to the limit.
double AxisPanel::placeOf(double position, const QRectF& track) const
{
    const auto& [soft, hard] = *m_reading.travel;
    const auto [low, high] = softEnds(track);
    if (position < soft.low)
        return track.left() + (low - track.left()) * part(position, {hard.low, soft.low});
    if (position > soft.high)
        return high + (track.right() - high) * part(position, {soft.high, hard.high});
    return low + (high - low) * part(position, soft);
}

void AxisPanel::paintLimits(QPainter& painter, const QRectF& track) const
{
    painter.setPen(QPen(colour::text, 2.5)); // hard limits: the ends
    painter.drawLine(track.topLeft() - QPointF(0, 3), track.bottomLeft() + QPointF(0, 3));
    painter.drawLine(track.topRight() - QPointF(0, 3), track.bottomRight() + QPointF(0, 3));
    const auto [low, high] = softEnds(track);
    painter.fillRect(QRectF(track.topLeft(), QPointF(low, track.bottom())), QBrush(colour::secondary, Qt::FDiagPattern));
    painter.fillRect(QRectF(QPointF(high, track.top()), track.bottomRight()), QBrush(colour::secondary, Qt::FDiagPattern));
    painter.setPen(QPen(colour::secondary, 1.5)); // soft limits: where motion ends by itself
    painter.drawLine(QPointF(low, track.top()), QPointF(low, track.bottom() + 3));
    painter.drawLine(QPointF(high, track.top()), QPointF(high, track.bottom() + 3));
}

void AxisPanel::paintTrack(QPainter& painter, const QRectF& track) const
{
    QPainterPath outline;
    outline.addRoundedRect(track, 2, 2);
    painter.fillPath(outline, colour::raised);
    painter.setPen(QPen(colour::strongLine, 1));
    painter.drawPath(outline);
    if (!m_reading.travel)
        return;
    const bool fresh = m_reading.freshness == Freshness::Fresh;
    const double x = placeOf(m_reading.position, track);
    const bool known = m_reading.freshness != Freshness::Unknown;
    const QRectF way(track.left(), track.top() + 1, x - track.left(), track.height() - 2);
    if (fresh) {
        painter.fillRect(way, colour::strongLine);
    } else if (known) { // empty: hatching is the limits'
        painter.setPen(QPen(colour::stale, 1));
        painter.setBrush(Qt::NoBrush);
        painter.drawRect(way.adjusted(0.5, 0.5, -0.5, -0.5));
    }
    paintLimits(painter, track);
    if (!known)
        return;
    const double size = markerSize(track);
    QPainterPath marker(QPointF(x, track.top() + size * 0.4));
    marker.lineTo(x - size, track.top() - size);
    marker.lineTo(x + size, track.top() - size);
    marker.closeSubpath();
    painter.setPen(QPen(fresh ? colour::bright : colour::stale, 1.5));
    painter.setBrush(fresh ? QBrush(colour::bright) : QBrush(Qt::NoBrush));
    painter.drawPath(marker);
    painter.drawLine(QPointF(x, track.top()), QPointF(x, track.bottom()));
}

void AxisPanel::paintTrackEnds(QPainter& painter, const QRectF& where) const
{
    const bool hard = m_reading.hardLow || m_reading.hardHigh;
    const auto paint = [&](Qt::Alignment side, const QString& reached, const QString& end) {
        painter.setPen(reached.isEmpty() ? colour::secondary : hard ? colour::medium : colour::low);
        drawFigures(painter, where, side | Qt::AlignVCenter, reached.isEmpty() ? end : reached);
    };
    const auto& travel = m_reading.travel;
    // The lower end names its unit where there is room for both to stand apart.
    const QString high = travel ? figure(travel->hard.high, 0, tr("mm")) : QString();
    QString low = travel ? figure(travel->hard.low, 0, tr("mm")) : tr("limits not reported");
    if (travel && figuresWidth(painter.font(), low + QStringLiteral("   ") + high) > where.width())
        low = figure(travel->hard.low, 0, QString());
    paint(Qt::AlignLeft, limitWord(m_reading.softLow, m_reading.hardLow), low);
    paint(Qt::AlignRight, limitWord(m_reading.softHigh, m_reading.hardHigh), high);
}

// Between the position and its bar: beside the position there is no room for it on most screens. The smallest have less than a line.
void AxisPanel::paintAngle(QPainter& painter, const QRectF& where) const
{
    const double scale = theme::scaleOf(this);
    const QFont strong = theme::font(TextRole::Strong, scale);
    painter.setFont(where.height() > QFontMetricsF(strong).height() * 1.2 ? strong : theme::font(TextRole::Caption, scale));
    const QString angle = figureText(m_reading.angle, 0, tr("\u00B0"));
    const bool worded = figuresWidth(painter.font(), tr("turned %1").arg(figure(-1000, 0, tr("\u00B0")))) <= where.width();
    drawFigures(painter, where, Qt::AlignLeft | Qt::AlignVCenter, worded ? tr("turned %1").arg(angle) : angle);
}

void AxisPanel::paintPosition(QPainter& painter, const QRectF& where) const
{
    const double scale = theme::scaleOf(this);
    painter.setFont(theme::font(TextRole::Value, scale));
    const QFontMetricsF value(painter.font());
    const QFont caption = theme::font(TextRole::Caption, scale);
    const double captionHeight = QFontMetricsF(caption).height();
    painter.setPen(valueInk(m_reading.freshness));
    drawFigures(painter, QRectF(where.left(), where.top(), where.width(), value.height()), Qt::AlignLeft | Qt::AlignVCenter,
                figureText(m_reading.position, 1, tr("mm")));
    const double tall = std::max(8.0, theme::px(this, 16) * 1.0);
    const QRectF track(where.left() + 2, where.bottom() - captionHeight - tall - 3, where.width() - 4, tall);
    const double line = where.top() + value.ascent(); // figures have nothing below it
    paintAngle(painter, QRectF(where.left(), line, where.width(), track.top() - markerSize(track) - line));
    paintTrack(painter, track);
    painter.setFont(caption);
    paintTrackEnds(painter, QRectF(where.left(), track.bottom() + 3, where.width(), captionHeight));
}

QString AxisPanel::driveText(const DriveReading& drive) const
{
    const bool known = m_reading.drives != Freshness::Unknown;
    const auto shown = [known](double value) { return known ? std::optional<double>(value) : std::nullopt; };
    return tr("%1 \u00B7 %2").arg(figure(shown(drive.temperature), 0, tr("°C")), figure(shown(drive.current), 1, tr("A")));
}

// As large as a position where that leaves a line for the drive.
theme::TextRole AxisPanel::speedRole(double height) const
{
    const double scale = theme::scaleOf(this);
    const double needed = QFontMetricsF(theme::font(TextRole::Value, scale)).ascent() + speedBarGap + speedBarHeight() + 3 +
                          QFontMetricsF(theme::font(TextRole::Caption, scale)).height();
    return needed <= height ? TextRole::Value : TextRole::Strong;
}

double AxisPanel::speedBarHeight() const { return std::max(5.0, theme::px(this, 9) * 1.0); }

double AxisPanel::speedWidth(TextRole role) const
{
    const double scale = theme::scaleOf(this);
    const QFont figures = theme::font(role, scale);
    const QFontMetricsF words(theme::font(TextRole::Body, scale));
    const double advance = std::max(words.horizontalAdvance(tr("advance")), words.horizontalAdvance(tr("retract")));
    const double turn = std::max(words.horizontalAdvance(tr("clockwise")), words.horizontalAdvance(tr("anticlockwise")));
    return std::max(advance + figuresWidth(figures, signedFigure(100, 1, tr("mm/s"))),
                    turn + figuresWidth(figures, signedFigure(fullRotation, 1, tr("\u00B0/s")))) +
           theme::px(this, 12);
}

// Figures and words stand on one line; neither has much below it.
void AxisPanel::paintSpeed(QPainter& painter, const QRectF& where, TextRole role, const Speed& speed) const
{
    const double scale = theme::scaleOf(this);
    painter.setFont(theme::font(role, scale));
    const QFontMetricsF figures(painter.font());
    const double line = where.top() + figures.ascent();
    painter.setPen(valueInk(m_reading.freshness));
    drawFigures(painter, QRectF(where.left(), where.top(), where.width(), figures.height()), Qt::AlignRight | Qt::AlignVCenter,
                signedFigure(m_reading.freshness == Freshness::Unknown ? std::optional<double>() : speed.value, 1, speed.unit));
    painter.setFont(theme::font(TextRole::Body, scale));
    if (m_reading.freshness != Freshness::Unknown)
        painter.drawText(QPointF(where.left(), line), speed.words);
    const QRectF track(where.left(), line + speedBarGap, where.width(), speedBarHeight());
    painter.fillRect(track, colour::raised);
    const auto xOf = [&](double v) { return track.center().x() + track.width() / 2 * std::clamp(v / speed.fullScale, -1.0, 1.0); };
    if (m_reading.freshness == Freshness::Fresh) {
        const double x = xOf(speed.value);
        painter.fillRect(QRectF(std::min(x, track.center().x()), track.top(), std::abs(x - track.center().x()), track.height()),
                         colour::text);
    }
    painter.fillRect(QRectF(track.center().x() - 0.75, track.top() - 1, 1.5, track.height() + 2), colour::secondary);
    if (speed.asked) { // the ghost: hollow, so that it is never taken for the instrument itself
        painter.setPen(QPen(colour::armed, 1.6));
        painter.setBrush(Qt::NoBrush);
        painter.drawRect(QRectF(xOf(*speed.asked) - 3, track.top() - 2, 6, track.height() + 4));
    }
    paintDrive(painter, QRectF(where.left(), track.bottom() + 3, where.width(), where.bottom() - track.bottom() - 3), speed.drive);
}

// On the smallest screens there is no line for it.
void AxisPanel::paintDrive(QPainter& painter, const QRectF& where, const DriveReading& drive) const
{
    painter.setFont(theme::font(TextRole::Caption, theme::scaleOf(this)));
    const double line = QFontMetricsF(painter.font()).height();
    if (where.height() < line)
        return;
    painter.setPen(m_reading.drives == Freshness::Fresh ? colour::secondary : colour::stale);
    drawFigures(painter, QRectF(where.topLeft(), QSizeF(where.width(), line)), Qt::AlignRight | Qt::AlignVCenter, driveText(drive));
}

void AxisPanel::paintEvent(QPaintEvent*)
{
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const double gap = theme::px(this, 24);
    const double scale = theme::scaleOf(this);
    const QFontMetricsF strong(theme::font(TextRole::Strong, scale));
    const double nameWidth = std::max(width() * 0.2, strong.horizontalAdvance(tr("Guidewire")) + strong.height() * 1.75 + gap * 0.75);
    const auto role = speedRole(height() / 2.0);
    const double speedRoom = std::max(width() * 0.28, speedWidth(role));
    const QRectF all(rect());
    paintName(painter, QRectF(all.left(), all.top(), nameWidth - gap / 2, all.height()));
    paintPosition(painter, QRectF(all.left() + nameWidth, all.top(), all.width() - nameWidth - speedRoom - gap, all.height()));
    const QRectF speed(all.right() - speedRoom, all.top(), speedRoom, all.height() / 2);
    const AxisReading& r = m_reading;
    paintSpeed(painter, speed, role, {r.velocity, r.askedVelocity, fullVelocity, advanceWord(r.velocity), tr("mm/s"), r.advance});
    paintSpeed(painter, speed.translated(0, speed.height()), role,
               {r.rotation, r.askedRotation, fullRotation, turnWord(r.rotation), tr("\u00B0/s"), r.turn});
}

} // namespace console
