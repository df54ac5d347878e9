// Views and their wiring.
#include "app/view_desk.hpp"

#include "widgets/about_view.hpp"
#include "widgets/checklist_view.hpp"
#include "widgets/cockpit_window.hpp"
#include "widgets/plots_view.hpp"
#include "widgets/start_view.hpp"

#include <QCoreApplication>

namespace console {

ViewDesk::ViewDesk(const Options& options, ConsoleModels& models, QObject* parent) : QObject(parent), m_options(options), m_models(models)
{}

void ViewDesk::build(CockpitWindow& window)
{
    const ProgramFacts program{QCoreApplication::applicationVersion(), m_options.user, guide()};
    auto* start = new StartView(m_models, program);
    auto* about = new AboutView(m_models, program);
    window.addView(View::Start, start);
    auto* plots = new PlotsView(m_models);
    window.addView(View::About, about);
    window.addView(View::Plots, plots);
    auto* checklist = new ChecklistView(m_models.permit);
    window.addView(View::Checklist, checklist);
    const auto leave = [&window] { window.showView(View::Cockpit); };
    connect(start, &StartView::leaveRequested, &window, leave);
    connect(about, &AboutView::leaveRequested, &window, leave);
    connect(plots, &PlotsView::leaveRequested, &window, leave);
    connect(checklist, &ChecklistView::leaveRequested, &window, leave);
    connect(start, &StartView::aboutRequested, &window, [&window] { window.showView(View::About); });
}

} // namespace console
