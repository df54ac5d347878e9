// A cockpit window on invented models, shown and active: what the tests act on.
#pragma once

#include "editor/topology_canvas.hpp"
#include "editor/topology_view.hpp"
#include "invented_cockpit.hpp"
#include "widgets/cockpit_window.hpp"
#include "widgets/log_view.hpp"
#include "widgets/plots_view.hpp"
#include "widgets/theme.hpp"

#include <QTest>

namespace console::test {

class Pane : public QWidget {
public:
    explicit Pane(const QString& name) { setAccessibleName(name); }
};

struct CockpitStage {
    InventedCockpit cockpit;
    CockpitWindow window{cockpit.models};
    QWidget* live = new Pane(QStringLiteral("Live image"));
    TopologyCanvas* mini = new TopologyCanvas(cockpit.models.sessions, TopologyCanvas::Size::Mini);
    TopologyView* topology = new TopologyView(cockpit.models.sessions);
    LogView* log = new LogView(cockpit.models.log, cockpit.models.alarmLog);

    explicit CockpitStage(const QSize& size = {1920, 1080})
    {
        window.setLiveView(live);
        window.setSceneView(new Pane(QStringLiteral("Scene")));
        window.setMiniTopology(mini);
        window.setTopologyView(topology);
        window.setLogView(log);
        window.addView(View::Plots, new PlotsView(cockpit.models));
        QObject::connect(mini, &TopologyCanvas::chosen, &window, [this] { window.showView(View::Topology); });
        window.resize(size);
        window.show();
    }

    bool ready() { return QTest::qWaitForWindowActive(&window); }

    template <typename Widget>
    Widget* named(const QString& accessibleName) const
    {
        for (Widget* widget : window.findChildren<Widget*>())
            if (widget->isVisible() && widget->accessibleName() == accessibleName)
                return widget;
        return nullptr;
    }

    /// Of a descendant, in the window's coordinates, cut to what can be seen of it.
    QRect seen(const QWidget* widget) const { return widget->visibleRegion().boundingRect().translated(widget->mapTo(&window, QPoint())); }

    void refresh() { window.refresh(std::chrono::steady_clock::now()); }
};

} // namespace console::test
