// Keys of the views that are added to the cockpit, and what a person set up for it.
#include "widgets/cockpit_window.hpp"
#include "widgets/motion_bar.hpp"
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
    bind(Qt::Key_F3, View::Plots);
    bind(Qt::Key_F6, View::Checklist);
    bind(Qt::Key_F7, View::Screens); // F5 is kept for the editor
    const auto act = [this](const QKeySequence& keys, auto what) {
        auto* shortcut = new QShortcut(keys, this);
        shortcut->setAutoRepeat(false);
        connect(shortcut, &QShortcut::activated, this, what);
    };
    act(Qt::Key_F10, [this] { setArrangement(swapped(m_arrangement, Arrangement::ReferenceBeside)); });
    act(Qt::Key_F11, [this] { setArrangement(swapped(m_arrangement, Arrangement::SceneBeside)); });
    act(Qt::CTRL | Qt::Key_Comma, [this] { toggleView(View::Preferences); });
    for (int place = 0; place < 9; ++place)
        act(QKeySequence(Qt::CTRL | Qt::Key(Qt::Key_1 + place)), [this, place] { Q_EMIT layoutRequested(place); });
    connect(m_strip, &StatusStrip::aboutRequested, this, [this] { toggleView(View::About); });
    connect(m_motion, &MotionBar::checklistRequested, this, [this] { toggleView(View::Checklist); });
}

void CockpitWindow::setKeyLegend(const QString& legend)
{
    m_motion->setKeyLegend({tr("Esc emergency stop \u00B7 F12 hold \u00B7 F9 audio pause"), legend,
                            tr("F1 cockpit \u00B7 F2 topology \u00B7 F3 plots \u00B7 F4 log \u00B7 F6 conditions "
                               "\u00B7 F7 screens \u00B7 F8 alarm test \u00B7 F10 F11 swap \u00B7 Ctrl+, preferences")});
}

void CockpitWindow::setResetHeld(bool held) { m_motion->setResetHeld(held); }

void CockpitWindow::setTrendSpan(TrendSpan span) { m_trends->setSpan(span); }

void CockpitWindow::setArrangement(Arrangement arrangement)
{
    if (arrangement == m_arrangement)
        return;
    m_arrangement = arrangement;
    m_layout->setArrangement(arrangement);
    update();
    Q_EMIT arrangementChanged(arrangement);
}

void CockpitWindow::noteScreenGone()
{
    m_models.screenGone = true;
    updateHandKeys();
}

void CockpitWindow::setUnseen(const QString& why)
{
    m_models.unseen = why;
    updateHandKeys();
    m_motion->setUnseen(!why.isEmpty()); // what the mouse holds is let go, wherever the keys were
}

} // namespace console
