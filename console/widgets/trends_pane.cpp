// Courses, limits, and stretches of which nothing is known.
#include "widgets/trends_pane.hpp"

#include "widgets/course_line.hpp"
#include "widgets/figures.hpp"
#include "widgets/theme.hpp"
#include "widgets/touch_button.hpp"

#include <QPainter>
#include <QPainterPath>

#include <algorithm>

namespace console {

using theme::TextRole;
namespace colour = theme::colour;

namespace {

struct Row {
    TrendFigure figure;
    const char* name;
    const char* unit;
    int decimals;
    double leastFullScale; ///< so that a quiet course does not look like a storm
};

constexpr std::array<Row, trendFigures> rows{{
    {TrendFigure::RoundTrip, QT_TRANSLATE_NOOP("console::TrendsPane", "Round trip"), "ms", 1, 5},
    {TrendFigure::Jitter, QT_TRANSLATE_NOOP("console::TrendsPane", "Jitter"), "ms", 1, 5},
    {TrendFigure::Loss, QT_TRANSLATE_NOOP("console::TrendsPane", "Loss"), "%", 1, 10},
    {TrendFigure::Force, QT_TRANSLATE_NOOP("console::TrendsPane", "Force"), "N", 2, 0.5},
    {TrendFigure::PictureAge, QT_TRANSLATE_NOOP("console::TrendsPane", "Picture age"), "ms", 0, 100},
}};

/// Slots further apart than this have a stretch between them in which nobody noted anything: the console itself stood still.
constexpr Duration mostBetween(Duration slot) { return std::max<Duration>(2 * slot, std::chrono::milliseconds(500)); }

double fullScale(const std::deque<TrendSlot>& slots, double least, std::optional<double> limit)
{
    double most = std::max(least, limit.value_or(0));
    for (const TrendSlot& slot : slots)
        most = std::max(most, slot.most.value_or(0));
    return 1.1 * most;
}

} // namespace

TrendsPane::TrendsPane(const TrendBook& book, QWidget* parent) : QFrame(parent), m_book(book), m_spanButton(new TouchButton(this))
{
    setAccessibleName(tr("Trends"));
    theme::setTextRole(this, TextRole::Caption);
    theme::setTextRole(m_spanButton, TextRole::Caption);
    m_spanButton->setAutoDefault(false);
    m_spanButton->setFocusPolicy(Qt::TabFocus); // a click leaves the keys with the hand
    m_spanButton->setText(tr("60 s"));
    m_spanButton->setAccessibleName(tr("Span of the trends"));
    connect(m_spanButton, &QPushButton::clicked, this, &TrendsPane::toggleSpan);
}

TrendsPane::Description TrendsPane::describe(TrendFigure figure)
{
    const Row& row = rows.at(static_cast<std::size_t>(figure));
    return {tr(row.name), QString::fromLatin1(row.unit), row.decimals};
}

void TrendsPane::toggleSpan() { setSpan(m_span == TrendSpan::Minute ? TrendSpan::TenMinutes : TrendSpan::Minute); }

void TrendsPane::setSpan(TrendSpan span)
{
    m_span = span;
    m_spanButton->setText(m_span == TrendSpan::Minute ? tr("60 s") : tr("10 min"));
    placeButton();
    update();
}

void TrendsPane::refresh(const Limits& limits, Instant now)
{
    m_limits = limits;
    m_now = now;
    QStringList words;
    for (const Row& row : rows)
        words << tr(row.name) + QLatin1Char(' ') + figure(valueOf(row.figure), row.decimals, QString::fromLatin1(row.unit));
    setAccessibleDescription(words.join(QStringLiteral(", ")));
    update();
}

double TrendsPane::headHeight() const { return m_spanButton->sizeHint().height(); }

void TrendsPane::resizeEvent(QResizeEvent*) { placeButton(); }

void TrendsPane::placeButton()
{
    const QSize wanted = m_spanButton->sizeHint();
    const int wide = std::max(wanted.width(), theme::px(this, 84)); // both texts, so that it stands still
    m_spanButton->setGeometry(width() - wide - theme::px(this, 8), 2, wide, wanted.height());
}

std::optional<double> TrendsPane::limitOf(TrendFigure figure) const
{
    if (figure == TrendFigure::Force)
        return m_limits.force;
    return figure == TrendFigure::PictureAge ? m_limits.pictureAgeMs : std::nullopt;
}

// A picture grows old until the next one comes: its age is worth as much as the oldest that it became.
std::optional<double> TrendsPane::valueOf(TrendFigure figure) const
{
    return figure == TrendFigure::PictureAge ? m_book.mostOfSecond(figure) : m_book.latest(figure);
}

void TrendsPane::paintEvent(QPaintEvent* event)
{
    QFrame::paintEvent(event);
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(colour::secondary);
    painter.setFont(theme::font(TextRole::Strong, theme::scaleOf(this)));
    const double margin = theme::px(this, 14);
    const double head = headHeight() + 4;
    painter.drawText(QRectF(margin, 2, width(), headHeight()), Qt::AlignLeft | Qt::AlignVCenter, tr("Trends"));
    painter.setFont(theme::font(TextRole::Caption, theme::scaleOf(this)));
    const double room = (height() - head - 4) / double(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
        paintRow(painter, QRectF(margin, head + double(i) * room, width() - 2 * margin, room), i);
}

void TrendsPane::paintRow(QPainter& painter, const QRectF& where, std::size_t index) const
{
    const Row& row = rows.at(index);
    const double nameWidth = painter.fontMetrics().horizontalAdvance(tr("Picture age")) * 1.15;
    const QString widest = QStringLiteral("0000.0 ms");
    const double valueWidth = figuresWidth(painter.font(), widest);
    painter.setPen(colour::secondary);
    painter.drawText(QRectF(where.left(), where.top(), nameWidth, where.height()), Qt::AlignLeft | Qt::AlignVCenter, tr(row.name));
    const auto value = valueOf(row.figure);
    const auto limit = limitOf(row.figure);
    painter.setPen(value ? colour::text : colour::secondary);
    drawFigures(painter, QRectF(where.right() - valueWidth, where.top(), valueWidth, where.height()), Qt::AlignRight | Qt::AlignVCenter,
                figure(value, row.decimals, QString::fromLatin1(row.unit)) +
                    (value && limit && *value > *limit ? QStringLiteral(" \u25B2") : QString()));
    paintCourse(painter, QRectF(where.left() + nameWidth, where.top() + 3, where.width() - nameWidth - valueWidth - 10, where.height() - 6),
                row.figure);
}

/// A line through each slot's middle, and a bar from its least to its most: a peak of a moment is seen on ten minutes, too. Hatched is what
/// was not known, and what nobody noted.
void TrendsPane::paintCourse(QPainter& painter, const QRectF& where, TrendFigure figure) const
{
    const auto& slots = m_book.slots(figure, m_span);
    const auto limit = limitOf(figure);
    const double full = fullScale(slots, rows.at(static_cast<std::size_t>(figure)).leastFullScale, limit);
    const double span = seconds(length(m_span));
    const auto yOf = [&](double value) { return where.bottom() - where.height() * std::clamp(value / full, 0.0, 1.0); };
    painter.save();
    painter.setClipRect(where.adjusted(-1, -1, 1, 1));
    painter.setPen(QPen(colour::line, 1));
    painter.drawLine(where.bottomLeft(), where.bottomRight());
    if (limit) {
        painter.setPen(QPen(colour::strongLine, 1, Qt::DashLine));
        painter.drawLine(QPointF(where.left(), yOf(*limit)), QPointF(where.right(), yOf(*limit)));
    }
    QPainterPath line;
    bool drawing = false;
    const double slotWidth = where.width() / double(TrendBook::mostSlots);
    const Duration slotTime = Duration(length(m_span)) / static_cast<Duration::rep>(TrendBook::mostSlots);
    const auto xOf = [&](Instant at) { return where.right() - where.width() * seconds(m_now - at) / span; };
    const auto paintUnknown = [&](double from, double to) {
        painter.fillRect(QRectF(from, where.top(), to - from, where.height()), QBrush(colour::line, Qt::BDiagPattern));
        drawing = false;
    };
    std::optional<Instant> before;
    for (const TrendSlot& slot : slots) {
        const double x = xOf(slot.begin);
        if (before && slot.begin - *before > mostBetween(slotTime))
            paintUnknown(xOf(*before + slotTime), x);
        before = slot.begin;
        if (!slot.most || !slot.least) {
            paintUnknown(x, x + slotWidth + 1);
            continue;
        }
        const double top = yOf(*slot.most);
        const double bottom = yOf(*slot.least);
        if (bottom - top > 1)
            painter.fillRect(QRectF(x, top, std::max(slotWidth, 1.0), bottom - top), colour::plot);
        const QPointF point(x, (top + bottom) / 2);
        drawing ? line.lineTo(point) : line.moveTo(point);
        drawing = true;
    }
    drawCourse(painter, line);
    painter.restore();
}

} // namespace console
