// Keys of the views that are added to the cockpit, and what a person set up for it.
#include "widgets/cockpit_window.hpp"
#include "widgets/status_strip.hpp"
#include "widgets/trends_pane.hpp"

#include <QShortcut>

namespace console {

void CockpitWindow::addViewKeys()
{
    const auto bind = [this](Qt::Key key, View view) {
        auto* shortcut = new QShortcut(QKeySequence(key), this);
        shortcut->setAutoRepeat(false);
        connect(shortcut, &QShortcut::activated, this, [this, view] { toggleView(view); });
    };
    bind(Qt::Key_F6, View::Preferences);
    connect(m_strip, &StatusStrip::aboutRequested, this, [this] { toggleView(View::About); });
}

void CockpitWindow::setTrendSpan(TrendSpan span) { m_trends->setSpan(span); }

} // namespace console
