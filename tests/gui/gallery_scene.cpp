// The states of the gallery, and the cockpit in one of them.
#include "gallery_scene.hpp"

#include "editor/topology_canvas.hpp"
#include "editor/topology_view.hpp"
#include "imaging/live_image_view.hpp"
#include "imaging/reference_image_view.hpp"
#include "input/keyboard_master.hpp"
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
#include <QPainter>
#include <QTest>

namespace console::test {

namespace {

/// A grey field with a word, so that nobody takes the gallery for a patient.
class Stand : public QWidget {
public:
    explicit Stand(const QString& text) : m_text(text) { setAccessibleName(text); }

protected:
    void paintEvent(QPaintEvent*) override
    {
        QPainter painter(this);
        QLinearGradient shade(0, 0, width(), height());
        shade.setColorAt(0, QColor(58, 58, 58));
        shade.setColorAt(1, QColor(120, 120, 120));
        painter.fillRect(rect(), shade);
        painter.setPen(Qt::white);
        painter.drawText(rect(), Qt::AlignCenter, m_text);
    }

private:
    QString m_text;
};

/// The invented picture as the newest that the models know: nobody takes it for a patient, and no book counts it twice.
console::DisplayPicture inventedPicture(const console::PictureStamp& newest, console::PictureRole role)
{
    console::DisplayPicture picture;
    picture.role = role;
    picture.about.frame = newest.frame;
    picture.about.acquisition = newest.acquisition;
    picture.about.captureNs = newest.captureNs;
    picture.about.source = newest.source;
    picture.about.rows = picture.about.columns = 1024;
    picture.about.imagerPixelSpacing = 0.3;
    picture.about.geometry.sourceDetectorDistance = 1100;
    picture.about.geometry.sourceObjectDistance = 750;
    picture.window = {2048, 4096};
    picture.image = QImage(1024, 1024, QImage::Format_RGB32);
    Stand stand(QStringLiteral("INVENTED"));
    stand.resize(picture.image.size());
    stand.render(&picture.image);
    return picture;
}

} // namespace

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
        reference->showPicture(inventedPicture(*state.newest(), console::PictureRole::Hold));
    }

    console::DisplayState display;
    console::LiveImageView* live;
    console::ReferenceImageView* reference = new console::ReferenceImageView;
};

namespace {

/// As a person does: the test first, and arming uses it up.
void arm(InventedCockpit& cockpit)
{
    cockpit.testAlarms();
    cockpit.arm();
    cockpit.models.selfTest.follow(PermitPhase::Armed, cockpit.now);
}

} // namespace

std::vector<GalleryState> galleryStates()
{
    return {
        {"idle", [](InventedCockpit&, CockpitWindow&) {}},
        {"haptic", [](InventedCockpit& c, CockpitWindow&) { c.openAll(), arm(c), c.engage(), c.feelForce(); }},
        {"masters",
         [](InventedCockpit& c, CockpitWindow& w) {
             c.openAll(), c.losePad();
             w.setKeyLegend(QCoreApplication::translate(
                 "console::GamePadMaster", "left trigger dead-man \u00B7 sticks guidewire, catheter \u00B7 right shoulder clutch "
                                           "\u00B7 Start arm \u00B7 cross scale \u00B7 B hold \u00B7 F X-ray"));
         }},
        {"selftest",
         [](InventedCockpit& c, CockpitWindow&) {
             c.openAll();
             c.models.selfTest.begin(c.now);
         }},
        {"open", [](InventedCockpit& c, CockpitWindow&) { c.openAll(), c.testAlarms(); }},
        {"armed", [](InventedCockpit& c, CockpitWindow&) { c.openAll(), arm(c); }},
        {"engaged", [](InventedCockpit& c, CockpitWindow&) { c.openAll(), arm(c), c.engage(); }},
        {"frozen", [](InventedCockpit& c, CockpitWindow&) { c.openAll(), arm(c), c.engage(), c.freezePicture(); }},
        {"standby", [](InventedCockpit& c, CockpitWindow&) { c.openAll(), arm(c), c.engage(), c.loseXray(), c.loseRobot(); }},
        {"reopened",
         [](InventedCockpit& c, CockpitWindow&) { c.openAll(), arm(c), c.engage(), c.loseXray(), c.loseRobot(), c.reopenAll(); }},
        {"log",
         [](InventedCockpit& c, CockpitWindow& w) {
             c.openAll(), c.testAlarms(), c.logEvents();
             w.showView(console::View::Log);
         }},
        {"alarmlog",
         [](InventedCockpit& c, CockpitWindow& w) {
             c.openAll(), c.testAlarms(), c.logEvents();
             w.showView(console::View::Log);
             auto* view = w.findChild<console::LogView*>();
             view->showLog(console::LogView::Log::Alarms);
             view->showFailure(
                 QStringLiteral("/media/stick/liena/alarms.txt cannot be written: No space left on device. Nothing was saved; make "
                                "room on the disk or name a file in another folder."));
         }},
        {"topology",
         [](InventedCockpit& c, CockpitWindow& w) {
             c.openAll(), c.loseXray();
             c.models.incidents.setFolded(0xf1a9, true);
             w.showView(console::View::Topology);
         }},
        {"plots", [](InventedCockpit& c, CockpitWindow& w) { c.openAll(), w.showView(console::View::Plots); }},
        {"restingforce", [](InventedCockpit& c, CockpitWindow&) { c.openAll(), c.testAlarms(), c.restWithForce(); }},
        {"conditions", [](InventedCockpit&, CockpitWindow& w) { w.showView(console::View::Checklist); }},
        {"start", [](InventedCockpit&, CockpitWindow& w) { w.showView(console::View::Start); }},
        {"about", [](InventedCockpit&, CockpitWindow& w) { w.showView(console::View::About); }},
        {"preferences", [](InventedCockpit&, CockpitWindow& w) { w.showView(console::View::Preferences); }},
        {"readonly",
         [](InventedCockpit& c, CockpitWindow& w) {
             c.openAll(), arm(c);
             auto* view = w.findChild<console::PreferencesView*>();
             view->setReadOnly(
                 QStringLiteral("Read only: the permit is ARMED. Preferences can be changed when nothing is armed or in hold."));
             view->setOverruled(QStringLiteral("For this run the command line decides on the folder of pictures: /media/stick."));
             w.showView(console::View::Preferences);
         }},
        {"screens",
         [](InventedCockpit&, CockpitWindow& w) {
             w.findChild<console::ScreensView*>()->showState(
                 {console::Arrangement::Usual,
                  QStringLiteral("DP-1"),
                  {QStringLiteral("DP-2 CN41"), QStringLiteral("HDMI-1")},
                  QStringLiteral("DP-2 CN41"),
                  {},
                  {QStringLiteral("Diagnostic"), QStringLiteral("Coil, two screens"), QStringLiteral("\u4ECB\u5165")},
                  {}});
             w.showView(console::View::Screens);
         }},
        {"beside",
         [](InventedCockpit& c, CockpitWindow& w) { c.openAll(), arm(c), w.setArrangement(console::Arrangement::ReferenceBeside); }},
        {"scenebeside",
         [](InventedCockpit& c, CockpitWindow& w) {
             c.openAll(), arm(c), c.engage(), w.setArrangement(console::Arrangement::SceneBeside), c.loseXray(), c.loseRobot();
         }},
        {"besideview",
         [](InventedCockpit& c, CockpitWindow& w) {
             c.openAll(), w.setArrangement(console::Arrangement::ReferenceBeside), w.showView(console::View::Topology);
         }},
        {"dim",
         [](InventedCockpit& c, CockpitWindow&) { c.openAll(), arm(c), console::theme::setBrightness(*qApp, console::Brightness::Dim); }},
        {"bright", [](InventedCockpit& c,
                      CockpitWindow&) { c.openAll(), arm(c), console::theme::setBrightness(*qApp, console::Brightness::Bright); }},
    };
}

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
