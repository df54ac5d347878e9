// The arc runs from 0 to a quarter beyond the stop mark.
#include "widgets/force_gauge.hpp"

#include "widgets/course_line.hpp"
#include "widgets/figures.hpp"
#include "widgets/stale_mark.hpp"
#include "widgets/theme.hpp"

#include <QPainter>
#include <QPainterPath>
#include <QtMath>

#include <algorithm>
#include <cmath>

namespace console {

using theme::TextRole;
namespace colour = theme::colour;

namespace {

constexpr double startAngle = 200; // degrees, anticlockwise from three o'clock, as QPainter counts
constexpr double sweep = 220;

} // namespace

ForceGauge::ForceGauge(QWidget* parent) : QWidget(parent)
{
    theme::setTextRole(this, TextRole::Body);
    setAccessibleName(tr("Force on the guidewire"));
}

QSize ForceGauge::sizeHint() const { return {theme::px(this, 350), theme::px(this, 250)}; }

void ForceGauge::setState(const InstrumentState& instrument, Instant now)
{
    const Aged<RobotStatus>& robot = instrument.robot();
    m_freshness = robot.freshness(now, InstrumentState::statusLimit);
    m_age = robot.age(now);
    m_force = robot.value.guidewireForce;
    m_peak = instrument.peakForce();
    m_limits = instrument.limits();
    m_trail = instrument.forceHistory();
    m_now = now;
    const auto shown = m_freshness == Freshness::Unknown ? std::optional<double>() : m_force;
    setAccessibleDescription(tr("%1, peak %2, %3").arg(figure(shown, 2, tr("N")), figure(m_peak, 2, tr("N")), ageText(m_freshness, m_age)));
    update();
}

double ForceGauge::angleOf(double force) const
{
    return startAngle - sweep * std::clamp(std::abs(force) / (m_limits.forceStop * 1.25), 0.0, 1.0);
}

void ForceGauge::paintArc(QPainter& painter, const QRectF& circle) const
{
    const double thick = circle.width() * 0.085;
    painter.setPen(QPen(colour::raised, thick, Qt::SolidLine, Qt::FlatCap));
    painter.drawArc(circle, int(startAngle * 16), int(-sweep * 16));
    if (m_freshness == Freshness::Unknown)
        return;
    const double size = std::abs(m_force);
    QColor ink = size >= m_limits.forceStop ? colour::high : size >= m_limits.forceWarn ? colour::medium : colour::text;
    if (m_freshness == Freshness::Stale)
        ink = colour::stale;
    painter.setPen(QPen(ink, thick, Qt::SolidLine, Qt::FlatCap));
    painter.drawArc(circle, int(startAngle * 16), int((angleOf(m_force) - startAngle) * 16));
    const QLineF peak = QLineF::fromPolar(circle.width() / 2 + thick * 0.7, angleOf(m_peak)).translated(circle.center());
    painter.setPen(QPen(colour::bright, 2));
    painter.drawLine(peak.pointAt(1 - thick * 1.4 / peak.length()), peak.p2());
}

void ForceGauge::paintMark(QPainter& painter, const QRectF& circle, double force, const QString& words) const
{
    const double thick = circle.width() * 0.085;
    const QLineF ray = QLineF::fromPolar(circle.width() / 2 + thick * 0.9, angleOf(force)).translated(circle.center());
    painter.setPen(QPen(colour::text, 2));
    painter.drawLine(ray.pointAt(1 - thick * 1.5 / ray.length()), ray.p2());
    const QFontMetricsF metrics(painter.font());
    const QPointF at = ray.pointAt(1 + metrics.height() * 0.35 / ray.length());
    const double wide = metrics.horizontalAdvance(words);
    const double x = at.x() > circle.center().x() + circle.width() * 0.2 ? at.x() : at.x() - wide / 2;
    painter.drawText(QPointF(x, at.y() + (at.x() > circle.center().x() + circle.width() * 0.2 ? metrics.ascent() / 3 : 0)), words);
}

// Where nothing was heard nothing is drawn.
QPainterPath ForceGauge::trailPath(const QRectF& where) const
{
    const double full = m_limits.forceStop * 1.25;
    QPainterPath line;
    std::optional<Instant> before;
    for (const auto& sample : m_trail) {
        const double x = where.right() - where.width() * seconds(m_now - sample.at) / seconds(InstrumentState::forceTrail);
        if (x < where.left())
            continue;
        const QPointF point(x, where.bottom() - where.height() * std::clamp(std::abs(sample.force) / full, 0.0, 1.0));
        const bool joined = before && sample.at - *before <= InstrumentState::statusLimit;
        joined ? line.lineTo(point) : line.moveTo(point);
        before = sample.at;
    }
    return line;
}

void ForceGauge::paintTrail(QPainter& painter, const QRectF& where) const
{
    painter.setPen(QPen(colour::line, 1));
    painter.drawLine(where.bottomLeft(), where.bottomRight());
    for (const double force : {m_limits.forceWarn, m_limits.forceStop}) {
        const double y = where.bottom() - where.height() * force / (m_limits.forceStop * 1.25);
        painter.setPen(QPen(colour::line, 1, Qt::DashLine));
        painter.drawLine(QPointF(where.left(), y), QPointF(where.right(), y));
    }
    drawCourse(painter, trailPath(where));
}

QRectF ForceGauge::faceCircle() const
{
    const double scale = theme::scaleOf(this);
    const QFontMetricsF caption(theme::font(TextRole::Caption, scale));
    const double room = height() - caption.height() * 5.5;
    const double marks = caption.horizontalAdvance(tr("stop 2 N"));
    const double diameter = std::max(10.0, std::min(room / 0.74, (width() - 2 * marks - 8) / 1.1));
    return {(width() - diameter) / 2, caption.height() * 1.3 + diameter * 0.06, diameter, diameter};
}

/// Below the arc's ends and the words between them.
double ForceGauge::faceFoot(const QRectF& circle) const
{
    const double scale = theme::scaleOf(this);
    const double words =
        QFontMetricsF(theme::font(TextRole::Value, scale)).height() * 0.15 + QFontMetricsF(theme::font(TextRole::Caption, scale)).height();
    return circle.center().y() + std::max(circle.width() * 0.22, words);
}

void ForceGauge::paintWords(QPainter& painter, const QRectF& circle) const
{
    const double scale = theme::scaleOf(this);
    painter.setFont(theme::font(TextRole::Value, scale));
    const double valueHeight = QFontMetricsF(painter.font()).height();
    painter.setPen(valueInk(m_freshness));
    const QRectF centre(circle.left(), circle.center().y() - valueHeight * 0.85, circle.width(), valueHeight);
    const bool known = m_freshness != Freshness::Unknown;
    drawFigures(painter, centre, Qt::AlignHCenter | Qt::AlignVCenter,
                figure(known ? std::optional<double>(std::abs(m_force)) : std::nullopt, 2, tr("N")));
    painter.setFont(theme::font(TextRole::Caption, scale));
    painter.setPen(m_freshness == Freshness::Fresh ? colour::secondary : colour::text);
    const QString words = m_freshness != Freshness::Fresh ? ageText(m_freshness, m_age)
                          : std::abs(m_force) < 0.02      ? tr("no force")
                          : m_force > 0                   ? tr("resistance")
                                                          : tr("pull");
    drawFigures(painter, QRectF(circle.left(), centre.bottom(), circle.width(), QFontMetricsF(painter.font()).height()),
                Qt::AlignHCenter | Qt::AlignVCenter, words);
}

void ForceGauge::paintEvent(QPaintEvent*)
{
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const QFont caption = theme::font(TextRole::Caption, theme::scaleOf(this));
    const double line = QFontMetricsF(caption).height();
    painter.setFont(caption);
    painter.setPen(colour::secondary);
    painter.drawText(QRectF(0, 0, width(), line), Qt::AlignLeft | Qt::AlignVCenter, tr("Force"));
    const QRectF circle = faceCircle();
    paintArc(painter, circle);
    painter.setFont(caption);
    paintMark(painter, circle, m_limits.forceWarn, tr("warn %1").arg(figure(m_limits.forceWarn, 0, tr("N"))));
    paintMark(painter, circle, m_limits.forceStop, tr("stop %1").arg(figure(m_limits.forceStop, 0, tr("N"))));
    paintWords(painter, circle);
    const QRectF legend(0, faceFoot(circle) + line * 0.3, width(), line);
    painter.setFont(caption);
    painter.setPen(colour::secondary);
    const bool known = m_freshness != Freshness::Unknown;
    drawFigures(painter, legend, Qt::AlignLeft | Qt::AlignVCenter,
                tr("peak %1").arg(figure(known ? std::optional<double>(m_peak) : std::nullopt, 2, tr("N"))));
    drawFigures(painter, legend, Qt::AlignRight | Qt::AlignVCenter, tr("10 s"));
    paintTrail(painter, QRectF(1, legend.bottom() + 4, width() - 3, std::max(line, height() - legend.bottom() - 6)));
}

} // namespace console
