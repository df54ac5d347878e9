// The states of the gallery.
#include "gallery_scene.hpp"
#include "imaging/live_image_view.hpp"
#include "imaging/reference_image_view.hpp"
#include "invented_picture.hpp"
#include "model/alarm_rules.hpp"
#include "widgets/log_view.hpp"
#include "widgets/preferences_view.hpp"
#include "widgets/review_controls.hpp"
#include "widgets/screens_view.hpp"
#include "widgets/theme.hpp"

#include <QAbstractButton>
#include <QApplication>
#include <QDateTime>
#include <QTest>

namespace console::test {

using namespace std::chrono_literals;

namespace {

/// As a person does: the test first, and arming uses it up.
void arm(InventedCockpit& cockpit)
{
    cockpit.testAlarms();
    cockpit.arm();
    cockpit.models.selfTest.follow(PermitPhase::Armed, cockpit.now);
}

/// The button with that text, in the language that is spoken.
void press(CockpitWindow& window, const char* part, const char* text)
{
    const auto wanted = QCoreApplication::translate(part, text);
    for (auto* button : window.findChildren<QAbstractButton*>())
        if (button->isVisible() && button->text() == wanted)
            return QTest::mouseClick(button, Qt::LeftButton);
    qFatal("no button says %s", text);
}

void raise(InventedCockpit& c, const AlarmReadings& wrong)
{
    c.models.alarms.update(presentAlarms(wrong), c.now, QDateTime::currentMSecsSinceEpoch());
}

/// It may heal by itself.
void interrupt(InventedCockpit& c)
{
    c.models.sessions.setLinkState(robotId, LinkState::Reconnecting, c.now - 300ms);
    IncidentRecord record;
    record.a = robotId;
    record.b = cockpitId;
    record.peer = robotId;
    record.since = c.now - 300ms;
    record.sinceWallMs = QDateTime::currentMSecsSinceEpoch() - 300;
    c.models.incidents.interrupt(record, c.now);
    c.letReportsAge(300ms);
    auto readings = c.goodReadings();
    readings.robotLink = LinkState::Reconnecting;
    readings.robotFresh = false;
    c.models.permit.check(readings, c.now);
}

void heal(InventedCockpit& c)
{
    c.models.sessions.setLinkState(robotId, LinkState::Open, c.now);
    c.models.incidents.heal(robotId, c.now);
    c.models.permit.check(c.goodReadings(), c.now);
}

/// For the reason that takes the most words.
void failToReopen(InventedCockpit& c)
{
    constexpr const char* reason = "The device shows another message set than the one accepted for its type: a person has to read the "
                                   "changes and accept it (liena sets accept).";
    c.models.incidents.setReopenFailure(0x5eed, QCoreApplication::translate("console::LibraryWords", reason));
}

void stop(InventedCockpit& c)
{
    auto stopped = c.status(RobotState::EmergencyStop);
    stopped.emergencyStopToken = 0x77;
    c.models.instrument.receiveRobot(stopped, c.now - 9ms);
    AlarmReadings wrong;
    wrong.armed = wrong.emergencyStop = true;
    raise(c, wrong);
    auto readings = c.goodReadings();
    readings.robotState = RobotState::EmergencyStop;
    readings.highAlarm = true;
    c.models.permit.check(readings, c.now);
}

void inject(InventedCockpit& c, InjectionProgress progress, double delivered, const QString& reason = {})
{
    const InjectionStatus told{4, delivered, progress, reason};
    c.models.instrument.receiveInjection(told, c.now - 20ms);
    c.models.injection.advance({false, true, true, c.models.instrument.injecting(), 60}, c.now);
}

void observe(InventedCockpit& c, CockpitWindow& w)
{
    c.models.role = OperatorRole::Observer;
    w.setOperator(QStringLiteral("Prof. Dr. Dr. Invented Schmidt-Rottluff"));
    auto readings = c.goodReadings();
    readings.role = OperatorRole::Observer;
    c.models.permit.check(readings, c.now);
}

void beRemote(InventedCockpit& c)
{
    auto readings = c.goodReadings();
    readings.remoteInput = c.models.remoteInput = QStringLiteral("Chrome Remote Desktop");
    c.models.permit.check(readings, c.now);
}

void play(InventedCockpit& c, CockpitWindow& w)
{
    auto* reference = w.findChild<ReferenceImageView*>();
    reference->showPicture(inventedPicture(*c.models.picture.newest(), PictureRole::Review));
    reference->setPlace(QCoreApplication::translate("console::CineReview", "%1 of %2, %3 s before the newest").arg(612).arg(900).arg(19.2));
    w.findChild<ReviewControls*>()->showReview(true, true);
}

/// `turned`: the C-arm has, since.
void map(InventedCockpit& c, CockpitWindow& w, bool turned)
{
    auto picture = inventedPicture(*c.models.picture.newest(), PictureRole::Roadmap);
    auto& roadmap = c.models.roadmap;
    roadmap.begin({picture.about, picture.about.captureNs});
    picture.about.geometry.primaryAngle += turned ? 5 : 0;
    roadmap.checkPicture(picture.about);
    auto* reference = w.findChild<ReferenceImageView*>();
    reference->showPicture(picture);
    reference->setPlace(roadmap.line());
    w.findChild<ReviewControls*>()->showRoadmap(true);
    AlarmReadings wrong;
    wrong.armed = true;
    wrong.roadmapRemoved = roadmap.reason();
    if (turned)
        raise(c, wrong);
}

/// For the reason that takes the most words, and a picture was saved meanwhile.
void refuse(InventedCockpit& c, CockpitWindow& w)
{
    auto* live = w.findChild<LiveImageView*>();
    live->showPicture(inventedPicture(*c.models.picture.newest(), PictureRole::Live));
    live->grab(); // what is refused comes after a picture that was painted
    const auto why = QCoreApplication::translate("console::FrameDecoder", "the JPEG-LS picture is %1 x %2, the message says %3 x %4");
    live->showRefusal(4711, why.arg(1024).arg(1024).arg(512).arg(512));
    const auto path = QStringLiteral("/home/operator/Pictures/liena/liena_2026-03-02T12-03-41.250_live_run3_frame4710");
    live->tell(QCoreApplication::translate("console::PictureDesk", "picture saved: %1").arg(path));
}

/// A distance, by two clicks.
void measure(InventedCockpit& c, CockpitWindow& w)
{
    auto* live = w.findChild<LiveImageView*>();
    live->showPicture(inventedPicture(*c.models.picture.newest(), PictureRole::Live));
    press(w, "console::PictureControls", "Measure");
    const QRect picture = live->pictureRect();
    for (const auto& place : {picture.center(), picture.center() + QPoint(picture.width() / 3, picture.height() / 4)})
        QTest::mouseClick(live, Qt::LeftButton, {}, place);
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
        {"interrupted", [](InventedCockpit& c, CockpitWindow&) { c.openAll(), arm(c), c.engage(), interrupt(c); }},
        {"healed", [](InventedCockpit& c, CockpitWindow&) { c.openAll(), arm(c), interrupt(c), heal(c); }},
        {"notreopened", [](InventedCockpit& c, CockpitWindow&) { c.openAll(), arm(c), c.loseXray(), c.loseRobot(), failToReopen(c); }},
        {"givingup",
         [](InventedCockpit& c, CockpitWindow& w) {
             c.openAll(), c.loseRobot(), w.refresh(c.now);
             press(w, "console::DiagnosisSheet", "Give up link\u2026");
         }},
        {"stopped", [](InventedCockpit& c, CockpitWindow&) { c.openAll(), stop(c); }},
        {"notclosed", [](InventedCockpit& c, CockpitWindow& w) { c.openAll(), arm(c), c.engage(), w.close(); }},
        {"injecting", [](InventedCockpit& c, CockpitWindow&) { c.openAll(), arm(c), inject(c, InjectionProgress::Running, 1.2); }},
        {"notinjected",
         [](InventedCockpit& c, CockpitWindow&) {
             c.openAll(), arm(c);
             inject(c, InjectionProgress::Refused, 0, QStringLiteral("the injector of the robot is not filled"));
         }},
        {"observing", [](InventedCockpit& c, CockpitWindow& w) { c.openAll(), c.testAlarms(), observe(c, w); }},
        {"remote", [](InventedCockpit& c, CockpitWindow&) { c.openAll(), c.testAlarms(), beRemote(c); }},
        {"rehearsal", [](InventedCockpit& c, CockpitWindow& w) { c.openAll(), arm(c), w.setRehearsal(true); }},
        {"playing", [](InventedCockpit& c, CockpitWindow& w) { c.openAll(), c.testAlarms(), play(c, w); }},
        {"roadmap", [](InventedCockpit& c, CockpitWindow& w) { c.openAll(), arm(c), map(c, w, false); }},
        {"noroadmap", [](InventedCockpit& c, CockpitWindow& w) { c.openAll(), arm(c), map(c, w, true); }},
        {"measuring", [](InventedCockpit& c, CockpitWindow& w) { c.openAll(), c.testAlarms(), measure(c, w); }},
        {"refused", [](InventedCockpit& c, CockpitWindow& w) { c.openAll(), arm(c), refuse(c, w); }},
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

} // namespace console::test
