// When the cockpit closes and when it stays, and how it comes back to the front.
#include "model/closing_bar.hpp"
#include "widgets/closing_note.hpp"
#include "widgets/cockpit_window.hpp"

#include <QCloseEvent>

namespace console {

/// Whoever asks, a person or a program: there is no dialog, what stands in the way is said, and nothing else changes.
void CockpitWindow::closeEvent(QCloseEvent* event)
{
    const Instant now = std::chrono::steady_clock::now();
    const auto bar = closingBar(m_models, now);
    event->setAccepted(!bar);
    if (!bar) {
        Q_EMIT closed();
        return;
    }
    m_closing->ask(now);
    Q_EMIT closingRefused(bar->why, bar->first);
}

void CockpitWindow::comeToTheFront()
{
    setWindowState((windowState() & ~Qt::WindowMinimized) | Qt::WindowActive);
    show();
    raise();
    activateWindow();
}

} // namespace console
