// Painting of log lines, the mark before one, and following the newest.
#include "widgets/log_lines.hpp"

#include "model/alarm_list.hpp"
#include "model/event_log.hpp"
#include "model/log_roles.hpp"
#include "widgets/figures.hpp"
#include "widgets/theme.hpp"
#include "widgets/touch_scrolling.hpp"

#include <QDateTime>
#include <QEvent>
#include <QKeyEvent>
#include <QMargins>
#include <QPainter>
#include <QResizeEvent>
#include <QScrollBar>
#include <QStyledItemDelegate>

#include <algorithm>

namespace console {

namespace colour = theme::colour;

namespace {

int lineHeight(const QFont& font) { return QFontMetrics(font).height() + 4; }

double widestKind(const QFontMetricsF& metrics)
{
    double widest = 0;
    for (int kind = 0; kind <= int(LogKind::Trouble); ++kind)
        widest = std::max(widest, metrics.horizontalAdvance(word(LogKind(kind))));
    for (const auto priority : {AlarmPriority::Low, AlarmPriority::Medium, AlarmPriority::High})
        widest = std::max(widest, metrics.horizontalAdvance(word(priority)));
    return widest;
}

/// Times stand in cells of one width; the kind has room for the longest word, and the mark its own before them, so that nothing jumps.
class LineDelegate : public QStyledItemDelegate {
public:
    explicit LineDelegate(LogLines* lines) : QStyledItemDelegate(lines), m_lines(*lines) {}

    QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex&) const override
    {
        return {option.rect.width(), lineHeight(option.font)};
    }

    void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override
    {
        painter->save();
        painter->setFont(option.font);
        const bool chosen = option.state.testFlag(QStyle::State_Selected);
        if (chosen)
            painter->fillRect(option.rect, QColor(0x34, 0x3C, 0x46));
        const QFontMetricsF metrics(option.font);
        const double gap = metrics.height() * 0.8;
        const auto time = QDateTime::fromMSecsSinceEpoch(index.data(LogWallRole).toLongLong());
        const bool today = time.date() == QDate::currentDate();
        const QString clock = time.toString(today ? QStringLiteral("HH:mm:ss.zzz") : QStringLiteral("yyyy-MM-dd HH:mm:ss"));
        QRectF rest = QRectF(option.rect).adjusted(6, 0, -6, 0);
        const double side = metrics.capHeight();
        if (m_lines.marked() == index)
            drawMark(*painter, {rest.left(), rest.center().y() - side / 2, side, side});
        rest.setLeft(rest.left() + side + gap / 2);
        painter->setPen(chosen ? colour::bright : colour::secondary);
        drawFigures(*painter, rest, Qt::AlignLeft | Qt::AlignVCenter, clock);
        rest.setLeft(rest.left() + figuresWidth(option.font, QStringLiteral("0000-00-00 00:00:00")) + gap);
        painter->drawText(rest, Qt::AlignLeft | Qt::AlignVCenter, index.data(LogKindWordRole).toString());
        rest.setLeft(rest.left() + widestKind(metrics) + gap);
        painter->setPen(chosen ? colour::bright : colour::text);
        painter->drawText(rest, Qt::AlignLeft | Qt::AlignVCenter,
                          metrics.elidedText(index.data(LogTextRole).toString(), Qt::ElideRight, rest.width()));
        painter->restore();
    }

private:
    static void drawMark(QPainter& painter, const QRectF& where)
    {
        painter.save();
        painter.setRenderHint(QPainter::Antialiasing);
        painter.setPen(Qt::NoPen);
        painter.setBrush(colour::bright);
        painter.drawPolygon(QPolygonF{where.topLeft(), {where.right(), where.center().y()}, where.bottomLeft()});
        painter.restore();
    }

    const LogLines& m_lines;
};

} // namespace

LogLines::LogLines(QWidget* parent) : QListView(parent)
{
    theme::setTextRole(this, theme::TextRole::Caption);
    setItemDelegate(new LineDelegate(this));
    setUniformItemSizes(true);
    setSelectionMode(QAbstractItemView::SingleSelection);
    setEditTriggers(QAbstractItemView::NoEditTriggers);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    setContextMenuPolicy(Qt::NoContextMenu);
    scrollByTouch(*this);
    connect(verticalScrollBar(), &QScrollBar::valueChanged, this, [this] { m_follows = atNewest(); });
    connect(this, &QAbstractItemView::doubleClicked, this, &LogLines::chosen);
}

void LogLines::setModel(QAbstractItemModel* model)
{
    QListView::setModel(model);
    m_follows = true;
    scrollToBottom();
}

void LogLines::mark(const QModelIndex& line)
{
    if (m_marked == line)
        return;
    m_marked = line;
    viewport()->update();
}

void LogLines::bringMarkIntoView()
{
    if (m_marked.isValid() && isVisible())
        scrollTo(m_marked);
}

bool LogLines::atNewest() const { return verticalScrollBar()->value() >= verticalScrollBar()->maximum(); }

void LogLines::rowsInserted(const QModelIndex& parent, int start, int end)
{
    QListView::rowsInserted(parent, start, end);
    if (m_follows && isVisible() && !m_marked.isValid())
        scrollToBottom();
}

void LogLines::rowsAboutToBeRemoved(const QModelIndex& parent, int start, int end)
{
    const bool follows = m_follows;
    QListView::rowsAboutToBeRemoved(parent, start, end);
    m_follows = follows;
}

void LogLines::showEvent(QShowEvent* event)
{
    QListView::showEvent(event);
    if (m_marked.isValid())
        bringMarkIntoView();
    else if (m_follows)
        scrollToBottom();
}

// A line that is cut in half is not read, and looks as if there were no more.
void LogLines::showWholeLines()
{
    const int room = viewport()->height() + viewportMargins().bottom();
    const int line = lineHeight(font());
    const QMargins margins(0, 0, 0, room > line ? room % line : 0);
    if (margins != viewportMargins())
        setViewportMargins(margins);
}

// What is read whole below takes its room from the lines; the one that is read stays in view.
void LogLines::resizeEvent(QResizeEvent* event)
{
    const bool follows = m_follows && isVisible() && !m_marked.isValid();
    const bool readsHere =
        isVisible() && currentIndex().isValid() && QRect(QPoint(), event->oldSize()).intersects(visualRect(currentIndex()));
    QListView::resizeEvent(event);
    showWholeLines();
    if (follows)
        scrollToBottom();
    if (readsHere)
        scrollTo(currentIndex());
}

// Qt's own `activated` would come of a single click, where the desktop wants it so.
void LogLines::keyPressEvent(QKeyEvent* event)
{
    if (event->key() != Qt::Key_Return && event->key() != Qt::Key_Enter)
        return QListView::keyPressEvent(event);
    event->accept();
    if (!event->isAutoRepeat() && currentIndex().isValid())
        Q_EMIT chosen(currentIndex());
}

// Whoever comes by Tab begins with the line that is marked, or the newest.
void LogLines::focusInEvent(QFocusEvent* event)
{
    if (!currentIndex().isValid() && model() != nullptr && model()->rowCount() > 0)
        setCurrentIndex(m_marked.isValid() ? QModelIndex(m_marked) : model()->index(model()->rowCount() - 1, 0));
    QListView::focusInEvent(event);
}

// The height of a line follows the size of the letters.
void LogLines::changeEvent(QEvent* event)
{
    QListView::changeEvent(event);
    if (event->type() != QEvent::FontChange)
        return;
    scheduleDelayedItemsLayout();
    showWholeLines();
}

} // namespace console
