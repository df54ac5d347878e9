// Half a line of a text is worse than none: what is cut by the edge is covered until it is scrolled into view.
#include "widgets/row_area.hpp"

#include "widgets/theme.hpp"
#include "widgets/touch_scrolling.hpp"

#include <QApplication>
#include <QEvent>
#include <QLayout>
#include <QPainter>

namespace console {

namespace {

class Cover : public QWidget {
public:
    using QWidget::QWidget;

    void lie(const QRect& where)
    {
        setGeometry(where);
        setVisible(!where.isEmpty());
        raise();
    }

protected:
    void paintEvent(QPaintEvent*) override { QPainter(this).fillRect(rect(), theme::colour::background); }
};

} // namespace

RowArea::RowArea(const QString& accessibleName, QWidget* parent)
    : QScrollArea(parent), m_above(new Cover(viewport())), m_below(new Cover(viewport()))
{
    setAccessibleName(accessibleName);
    setWidgetResizable(true);
    setFrameShape(QFrame::NoFrame);
    setFocusPolicy(Qt::NoFocus);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    scrollByTouch(*this);
    // Qt's own following begins only when the focus is within already.
    connect(qApp, &QApplication::focusChanged, this, [this](QWidget*, QWidget* now) {
        if (now != nullptr && widget() != nullptr && widget()->isAncestorOf(now))
            showRowOf(now);
    });
}

void RowArea::showRowOf(QWidget* inside)
{
    const QPoint at = inside->mapTo(widget(), inside->rect().center());
    const QLayout* rows = widget()->layout();
    for (int i = 0; rows != nullptr && i < rows->count(); ++i)
        if (const QRect row = rows->itemAt(i)->geometry(); row.contains(at) && row.height() <= viewport()->height())
            return ensureVisible(at.x(), row.center().y(), 0, row.height() / 2 + 1);
    ensureWidgetVisible(inside);
}

void RowArea::coverWhatIsCut()
{
    const QLayout* rows = widget() != nullptr ? widget()->layout() : nullptr;
    const QSize room = viewport()->size();
    int above = 0;
    int below = 0;
    for (int i = 0; rows != nullptr && i < rows->count(); ++i) {
        const QRect row = rows->itemAt(i)->geometry().translated(0, widget()->y());
        if (rows->itemAt(i)->spacerItem() != nullptr || row.height() > room.height())
            continue; // a row that is never whole is shown as far as it goes
        if (row.top() < 0 && row.bottom() >= 0)
            above = row.bottom() + 1;
        if (row.top() < room.height() && row.bottom() >= room.height())
            below = room.height() - row.top();
    }
    static_cast<Cover*>(m_above)->lie({0, 0, room.width(), above});
    static_cast<Cover*>(m_below)->lie({0, room.height() - below, room.width(), below});
}

void RowArea::resizeEvent(QResizeEvent* event)
{
    QScrollArea::resizeEvent(event);
    coverWhatIsCut();
}

void RowArea::scrollContentsBy(int dx, int dy)
{
    QScrollArea::scrollContentsBy(dx, dy);
    coverWhatIsCut();
}

// The rows have their places by then: a layout sees an event before those who watch.
bool RowArea::eventFilter(QObject* watched, QEvent* event)
{
    const bool taken = QScrollArea::eventFilter(watched, event);
    if (watched == widget() && (event->type() == QEvent::Resize || event->type() == QEvent::LayoutRequest))
        coverWhatIsCut();
    return taken;
}

} // namespace console
