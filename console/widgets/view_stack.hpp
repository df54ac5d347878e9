// The views that lie over regions E, F and G, one at a time, when a function key asks for them.
#pragma once

#include <QWidget>

#include <map>

namespace console {

enum class View { Cockpit, Topology, Plots, Log, Start, About, Preferences, Screens, Checklist };

/// The widgets belong to the window.
class ViewStack {
public:
    void add(View view, QWidget* widget);

    /// Shows the view's widget, hides the others and gives it the focus; false when there is none, as for the cockpit itself.
    bool show(View view);

    View present() const { return m_present; }
    bool isShown(View view) const { return m_present == view; }

    /// The focus is within a view.
    bool holds(const QWidget* focus) const;

    /// Above the regions.
    void raise();

private:
    std::map<View, QWidget*> m_views;
    View m_present = View::Cockpit;
};

} // namespace console
