// The cockpit in one of the gallery's states.
#include "gallery_scene.hpp"

#include "editor/topology_canvas.hpp"
#include "editor/topology_view.hpp"
#include "imaging/live_image_view.hpp"
#include "imaging/reference_image_view.hpp"
#include "input/keyboard_master.hpp"
#include "invented_picture.hpp"
#include "widgets/about_view.hpp"
#include "widgets/checklist_view.hpp"
#include "widgets/log_view.hpp"
#include "widgets/picture_controls.hpp"
#include "widgets/picture_pane.hpp"
#include "widgets/plots_view.hpp"
#include "widgets/preferences_view.hpp"
#include "widgets/review_controls.hpp"
#include "widgets/screens_view.hpp"
#include "widgets/start_view.hpp"
#include "widgets/theme.hpp"

#include <QApplication>
#include <QTest>

namespace console::test {

/// Region D and region E with their controls.
struct GalleryScene::PicturePanes {
    PicturePanes(CockpitWindow& window, InventedCockpit& cockpit) : live(new console::LiveImageView(cockpit.models.picture))
    {
        live->setDisplay(&display);
        reference->setDisplay(&display);
        window.setLiveView(new console::PicturePane(live, new console::PictureControls(display)));
        window.setReferenceView(new console::PicturePane(reference, new console::ReviewControls));
    }

    /// As it is at `at`, for as long as the gallery takes.
    void show(const console::PictureState& state, console::Instant at) const
    {
        live->setClock([at] { return at; });
        if (!state.newest())
            return;
        live->showPicture(inventedPicture(*state.newest(), console::PictureRole::Live));
        if (!reference->picture())
            reference->showPicture(inventedPicture(*state.newest(), console::PictureRole::Hold));
    }

    console::DisplayState display;
    console::LiveImageView* live;
    console::ReferenceImageView* reference = new console::ReferenceImageView;
};

GalleryScene::GalleryScene(const QSize& size) : m_panes(std::make_unique<PicturePanes>(m_window, m_cockpit))
{
    m_window.setSceneView(new Stand(QStringLiteral("INVENTED: 3-D scene")));
    auto* mini = new console::TopologyCanvas(m_cockpit.models.sessions, console::TopologyCanvas::Size::Mini);
    auto* topology = new console::TopologyView(m_cockpit.models.sessions);
    m_window.setMiniTopology(mini);
    m_window.setTopologyView(topology);
    auto* log = new console::LogView(m_cockpit.models.log, m_cockpit.models.alarmLog);
    log->setPathSuggestion(
        [](const QString& name) { return QStringLiteral("/home/operator/Documents/liena/%1_2026-03-02T12-03-41.txt").arg(name); });
    m_window.setLogView(log);
    const console::ProgramFacts program{QStringLiteral("0.9.0"), QStringLiteral("Dr Invented"),
                                        QStringLiteral("/usr/share/doc/liena/OPERATING.md")};
    m_window.addView(console::View::Start, new console::StartView(m_cockpit.models, program));
    m_window.addView(console::View::Plots, new console::PlotsView(m_cockpit.models));
    m_window.addView(console::View::Checklist, new console::ChecklistView(m_cockpit.models.permit));
    m_window.addView(console::View::Screens, new console::ScreensView);
    m_window.addView(console::View::Preferences, new console::PreferencesView);
    m_window.addView(console::View::About, new console::AboutView(m_cockpit.models, program));
    m_window.setKeyLegend(KeyboardMaster().legend());
    // Nobody's, and longer than most: what is cut must be a name, and nothing else.
    m_window.setPatient(QStringLiteral("Maximiliana Invented Freifrau von Hohenstein-Wittgenstein"), QStringLiteral("PID-2026-0004711"));
    m_window.setOperator(QStringLiteral("Prof. Dr. Dr. Invented Schmidt-Rottluff"));
    m_window.resize(size);
    m_window.show();
}

GalleryScene::~GalleryScene() { console::theme::setBrightness(*qApp, console::Brightness::Usual); }

bool GalleryScene::bring(const GalleryState& state, int patience)
{
    if (!QTest::qWaitForWindowActive(&m_window))
        return false;
    state.bring(m_cockpit, m_window);
    m_cockpit.models.selfTest.follow(m_cockpit.models.permit.phase(), m_cockpit.now);
    const console::Instant brought = m_cockpit.now;
    QTest::qWait(patience);
    m_cockpit.renew();
    m_panes->show(m_cockpit.models.picture, brought);
    m_window.refresh(m_cockpit.now);
    return true;
}

} // namespace console::test
