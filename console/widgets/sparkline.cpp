// The line, its scale and the hatched stretches.
#include "widgets/sparkline.hpp"

#include "model/session_model.hpp"
#include "widgets/course_line.hpp"
#include "widgets/theme.hpp"

#include <QPainter>
#include <QPainterPath>

#include <algorithm>

namespace console {

namespace colour = theme::colour;

namespace {

// At least this much is the height, so that a quiet line does not look like a storm.
constexpr double leastFullScaleMs = 5.0;

double fullScale(const std::deque<LinkSample>& history)
{
    double most = leastFullScaleMs;
    for (const LinkSample& sample : history)
        most = std::max(most, sample.roundTripMs.value_or(0));
    return most;
}

} // namespace

void drawSparkline(QPainter& painter, const QRectF& where, const std::deque<LinkSample>& history, Instant now)
{
    painter.save();
    painter.setClipRect(where);
    painter.setPen(QPen(colour::line, 1));
    painter.drawLine(where.bottomLeft(), where.bottomRight());
    const double span = seconds(SessionModel::historyLength);
    const auto xOf = [&](Instant at) { return where.right() - where.width() * seconds(now - at) / span; };
    const double top = fullScale(history) * 1.1;
    QPainterPath line;
    bool drawing = false;
    for (const LinkSample& sample : history) {
        const double x = xOf(sample.at);
        const bool quiet = !carriesMessages(sample.state);
        if (quiet)
            painter.fillRect(QRectF(x, where.top(), where.width() * 0.1 / span + 1, where.height()),
                             QBrush(colour::strongLine, Qt::BDiagPattern));
        if (quiet || !sample.roundTripMs) {
            drawing = false;
            continue;
        }
        const QPointF point(x, where.bottom() - 1 - (where.height() - 2) * *sample.roundTripMs / top);
        drawing ? line.lineTo(point) : line.moveTo(point);
        drawing = true;
    }
    drawCourse(painter, line);
    painter.restore();
}

} // namespace console
