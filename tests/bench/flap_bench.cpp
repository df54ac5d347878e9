// Measures whether the window stays responsive while a link is lost and re-opened a thousand times a minute: `flap_bench [flaps]
// [seconds]`.
//
// The window is the whole cockpit at 2560 x 1440 on Qt's offscreen platform, and its models are fed as the link room feeds them. Pictures
// of 512 x 512, lossless, come 30 times a second and go the whole way: decoded on their own thread, kept for review, painted in the live
// pane and drawn in the three-dimensional scene. Alarms are kept in a file, and sounded by a stand-in for the loudspeaker. There is no
// session, and so no loop that asks a robot for anything: nothing is armed. Printed: how often pictures and the window were painted, the
// longest gaps, how often alarms were raised and sounded, and what the process holds in memory.
//
// It ends with 1 where fewer than 29.5 pictures or 30 paints of the window were counted in a second, or memory grew by more than 5 MiB
// after the first two minutes, in which all that is kept of the past fills; also where the run was too short to tell.
#include "app/alarm_service.hpp"
#include "app/interruption_watch.hpp"
#include "app/picture_desk.hpp"
#include "film.hpp"
#include "flapping_link.hpp"
#include "imaging/live_image_view.hpp"
#include "imaging/scene_view.hpp"
#include "limits.hpp"
#include "runner/process_facts.hpp"
#include "sound/alarm_voice.hpp"
#include "widgets/cockpit_window.hpp"
#include "widgets/link_card.hpp"
#include "widgets/theme.hpp"

#include <QApplication>
#include <QTemporaryDir>
#include <QTest>
#include <QTimer>

#include <cstdlib>
#include <unistd.h>

using namespace console;
using namespace console::test;

namespace {

constexpr Film film{512, 8, PixelEncoding::JpegLs, 30};
constexpr std::size_t filled = 120;   ///< seconds until all that is kept of the past has filled
constexpr std::size_t shortest = 150; ///< seconds of which the growth of memory can be told

constexpr Limit pictureLimit{"pictures painted", Bound::AtLeast, film.framesPerSecond - mostLate, "a second", "one picture"};
constexpr Limit windowLimit{"paints of the window", Bound::AtLeast, 30, "a second", "one paint"};
constexpr Limit memoryLimit{"memory from the end of the second minute on", Bound::AtMost, 5, "MiB more", "two and a half minutes"};

Instant present() { return std::chrono::steady_clock::now(); }

double residentMebibytes() { return double(liena::lab::residentKiB(::getpid())) / 1024; }

/// Notes when a window paints what has changed in it.
class PaintWatch : public QObject {
public:
    std::vector<Instant> paints;

    bool eventFilter(QObject*, QEvent* event) override
    {
        if (event->type() == QEvent::UpdateRequest)
            paints.push_back(present());
        return false;
    }
};

/// What a sound server and a loudspeaker add is not measured.
class CountingVoice : public AlarmVoice {
public:
    void play(AlarmPriority) override { ++bursts; }
    void silence() override {}

    int bursts = 0;
};

struct Flapping {
    InventedCockpit cockpit;
    PaintWatch watch;
    PictureDesk desk{Options(), cockpit.models};
    CockpitWindow window{cockpit.models};
    SessionIntake intake{cockpit.models};
    InterruptionWatch interruptions{cockpit.models, [] { return quint64(0); }};
    AlarmWatch alarms{cockpit.models, robotId};
    QTemporaryDir folder;
    CountingVoice voice;
    AlarmService service{cockpit.models, alarms, {folder.path(), QStringLiteral("alarms-flap-bench"), {}, {}, &voice}};
    FlappingLink link{intake};
    SceneView* scene = new SceneView;
    QTimer turns;
    QTimer change;
    QTimer second;
    std::vector<Instant> pictures; ///< when each was painted
    std::vector<double> memory;    ///< MiB after each second
    int changes = 0;

    Flapping(int flaps, double seconds)
    {
        buildPanes();
        window.resize(2560, 1440);
        window.installEventFilter(&watch);
        window.show();
        cockpit.openAll();
        cockpit.models.picture.expect(film.framesPerSecond, present());
        for (QTimer* timer : {&turns, &change, &second})
            timer->setTimerType(Qt::PreciseTimer);
        QObject::connect(&turns, &QTimer::timeout, &window, [this] { alarms.update(present(), 0); });
        QObject::connect(&change, &QTimer::timeout, &window,
                         [this] { ++changes % 2 == 1 ? link.lose(present()) : link.reopen(present()); });
        QObject::connect(&second, &QTimer::timeout, &window, [this] { memory.push_back(residentMebibytes()); });
        turns.setInterval(100);
        second.setInterval(1000);
        change.setInterval(int(seconds * 1000 / (2.0 * flaps)));
    }

    /// Until the last flap; the seconds that it took.
    double run(int flaps)
    {
        const FilmSender sender(film, desk.pipeline());
        watch.paints.clear();
        const auto start = present();
        service.start();
        for (QTimer* timer : {&turns, &change, &second})
            timer->start();
        while (changes < 2 * flaps)
            QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents);
        return console::seconds(present() - start);
    }

private:
    void buildPanes()
    {
        desk.build(window);
        theme::setTextRole(scene, theme::TextRole::Caption);
        window.setSceneView(scene);
        scene->loadVessels(resource(QStringLiteral("vessels/cerebral.swc")));
        scene->showCArm(filmGeometry());
        scene->showCondition(PictureCondition::Live);
        QObject::connect(&desk.pipeline(), &FramePipeline::pictureReady, scene, &SceneView::showPicture);
        QObject::connect(window.findChild<LiveImageView*>(), &LiveImageView::picturePainted, &window,
                         [this] { pictures.push_back(present()); });
    }
};

std::vector<double> gapsOf(const std::vector<Instant>& times)
{
    std::vector<double> gaps;
    for (std::size_t i = 1; i < times.size(); ++i)
        gaps.push_back(milliseconds(times[i] - times[i - 1]));
    return gaps;
}

/// What was measured; true when it is as asked for.
bool conclude(Flapping& stage, double took)
{
    const auto counts = stage.desk.pipeline().counts();
    std::printf("%d flaps in %.1f s, %lld cards; of %llu pictures %llu replaced by newer ones, scene drawn %llu times\n", stage.changes / 2,
                took, static_cast<long long>(stage.window.findChildren<LinkCard*>().size()),
                static_cast<unsigned long long>(counts.received),
                static_cast<unsigned long long>(counts.replacedBeforeDecoding + counts.replacedBeforeShowing),
                static_cast<unsigned long long>(stage.scene->drawings()));
    std::printf("alarms raised %llu times, bursts played %d times\n",
                static_cast<unsigned long long>(stage.cockpit.models.alarms.raisedInAll()), stage.voice.bursts);
    printPercentiles("between two pictures painted", gapsOf(stage.pictures));
    printPercentiles("between two paints of the window", gapsOf(stage.watch.paints));
    if (!stage.memory.empty())
        std::printf("  resident memory %.1f MiB after a second, %.1f MiB at the end\n", stage.memory.front(), stage.memory.back());
    bool kept = judge(pictureLimit, double(stage.pictures.size()) / took);
    kept = judge(windowLimit, double(stage.watch.paints.size()) / took) && kept;
    return judge(memoryLimit, growthSince(stage.memory, filled, shortest)) && kept;
}

} // namespace

int main(int argc, char* argv[])
{
    if (qEnvironmentVariableIsEmpty("QT_QPA_PLATFORM"))
        qputenv("QT_QPA_PLATFORM", "offscreen");
    QApplication application(argc, argv);
    theme::apply(application);
    const int flaps = argc > 1 ? std::atoi(argv[1]) : 5000;
    const double seconds = argc > 2 ? std::atof(argv[2]) : 300;
    if (flaps < 1 || seconds < 1 || seconds * 1000 / (2.0 * flaps) < 1) {
        std::fprintf(stderr,
                     "flap_bench [flaps] [seconds]: at least one flap, and at most 500 in a second; 5000 in 300 s where nothing is said, "
                     "and 150 s are the fewest of which the growth of memory can be told\n");
        return endWrongCall;
    }
    Flapping stage(flaps, seconds);
    if (!QTest::qWaitForWindowActive(&stage.window)) {
        std::fprintf(stderr, "flap_bench: the window does not become active\n");
        return endNotMeasured;
    }
    const double took = stage.run(flaps);
    return conclude(stage, took) ? endKept : endNotKept;
}
