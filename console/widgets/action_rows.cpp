// Actions in one row, or in two where one has no room for them.
#include "widgets/action_rows.hpp"

#include <QEvent>
#include <QHBoxLayout>

namespace console {

ActionRows::ActionRows(QWidget* parent)
    : QWidget(parent), m_rows(new QBoxLayout(QBoxLayout::LeftToRight, this)), m_first(new QHBoxLayout), m_second(new QHBoxLayout)
{
    constexpr int gap = 12;
    m_rows->setContentsMargins(0, 0, 0, 0);
    for (QBoxLayout* row : {m_rows, m_first, m_second})
        row->setSpacing(gap);
    m_rows->addLayout(m_first);
    m_rows->addLayout(m_second, 1);
}

/// What is written on an action has changed, or one has come or gone.
bool ActionRows::event(QEvent* event)
{
    if (event->type() == QEvent::LayoutRequest)
        arrange();
    return QWidget::event(event);
}

void ActionRows::resizeEvent(QResizeEvent*) { arrange(); }

void ActionRows::arrange()
{
    const int needed = m_first->sizeHint().width() + m_rows->spacing() + m_second->sizeHint().width();
    m_rows->setDirection(needed > width() ? QBoxLayout::TopToBottom : QBoxLayout::LeftToRight);
}

} // namespace console
