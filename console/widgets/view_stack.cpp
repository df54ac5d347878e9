// Showing and hiding of views.
#include "widgets/view_stack.hpp"

#include <algorithm>

namespace console {

void ViewStack::add(View view, QWidget* widget)
{
    widget->setAutoFillBackground(true);
    widget->hide();
    m_views[view] = widget;
}

/// The new one has the focus before the old one goes: the hand gets no key in between.
bool ViewStack::show(View view)
{
    const auto wanted = m_views.find(view);
    m_present = wanted == m_views.end() ? View::Cockpit : view;
    if (wanted != m_views.end()) {
        wanted->second->show();
        wanted->second->raise();
        wanted->second->setFocus();
    }
    for (const auto& [other, widget] : m_views)
        if (other != m_present)
            widget->hide();
    return wanted != m_views.end();
}

bool ViewStack::holds(const QWidget* focus) const
{
    return std::any_of(m_views.begin(), m_views.end(),
                       [focus](const auto& entry) { return focus == entry.second || entry.second->isAncestorOf(focus); });
}

void ViewStack::raise()
{
    for (const auto& [view, widget] : m_views)
        widget->raise();
}

} // namespace console
