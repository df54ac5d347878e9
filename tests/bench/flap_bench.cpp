// Measures whether the window stays responsive while a link is lost and re-opened a thousand times in a minute: `flap_bench [flaps]
// [seconds]`.
//
// The window is the whole cockpit at 2560 x 1440 on Qt's offscreen platform, its models are fed as the link room feeds them, and the live
// image asks to be painted 60 times a second. Printed: how often it was painted, the longest gap, and what the process holds in memory.
#include "app/alarm_watch.hpp"
#include "app/interruption_watch.hpp"
#include "flapping_link.hpp"
#include "percentiles.hpp"
#include "widgets/cockpit_window.hpp"
#include "widgets/link_card.hpp"
#include "widgets/theme.hpp"

#include <QApplication>
#include <QFile>
#include <QPainter>
#include <QTest>
#include <QTimer>

#include <cstdlib>

using namespace console;
using namespace console::test;

namespace {

Instant present() { return std::chrono::steady_clock::now(); }

/// As large as the live picture, painted whole each time.
class Live : public QWidget {
public:
    std::vector<Instant> paints;

protected:
    void paintEvent(QPaintEvent*) override
    {
        QPainter(this).fillRect(rect(), QColor::fromHsv(int(paints.size() % 360), 40, 90));
        paints.push_back(present());
    }
};

double residentMegabytes()
{
    QFile file(QStringLiteral("/proc/self/statm"));
    const auto fields = file.open(QIODevice::ReadOnly) ? file.readAll().split(' ') : QList<QByteArray>();
    return fields.size() > 1 ? fields[1].toDouble() * 4096 / 1e6 : 0;
}

struct Flapping {
    InventedCockpit cockpit;
    CockpitWindow window{cockpit.models};
    SessionIntake intake{cockpit.models};
    InterruptionWatch interruptions{cockpit.models, [] { return quint64(0); }};
    AlarmWatch alarms{cockpit.models, robotId};
    FlappingLink link{intake};
    Live* live = new Live;
    QTimer pictures;
    QTimer turns;
    QTimer change;
    int changes = 0;

    Flapping(int flaps, double seconds)
    {
        window.setLiveView(live);
        window.resize(2560, 1440);
        window.show();
        cockpit.openAll();
        for (QTimer* timer : {&pictures, &turns, &change})
            timer->setTimerType(Qt::PreciseTimer);
        QObject::connect(&pictures, &QTimer::timeout, live, [this] { live->update(); });
        QObject::connect(&turns, &QTimer::timeout, live, [this] { alarms.update(present(), 0); });
        QObject::connect(&change, &QTimer::timeout, live, [this] { ++changes % 2 == 1 ? link.lose(present()) : link.reopen(present()); });
        pictures.start(16);
        turns.start(100);
        change.start(int(seconds * 1000 / (2.0 * flaps)));
    }
};

} // namespace

int main(int argc, char* argv[])
{
    if (qEnvironmentVariableIsEmpty("QT_QPA_PLATFORM"))
        qputenv("QT_QPA_PLATFORM", "offscreen");
    QApplication application(argc, argv);
    theme::apply(application);
    const int flaps = argc > 1 ? std::atoi(argv[1]) : 1000;
    const double seconds = argc > 2 ? std::atof(argv[2]) : 60;
    if (flaps < 1 || seconds < 1 || seconds * 1000 / (2.0 * flaps) < 1) {
        std::fprintf(stderr, "flap_bench [flaps] [seconds]: at least one flap, and at most 500 in a second\n");
        return 2;
    }
    Flapping stage(flaps, seconds);
    if (!QTest::qWaitForWindowActive(&stage.window))
        return 1;
    const auto start = present();
    const double before = residentMegabytes();
    while (stage.changes < 2 * flaps)
        QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents);
    const double took = console::seconds(present() - start);
    const double after = residentMegabytes();
    std::vector<double> gaps;
    for (std::size_t i = 1; i < stage.live->paints.size(); ++i)
        gaps.push_back(milliseconds(stage.live->paints[i] - stage.live->paints[i - 1]));
    std::printf("%d flaps in %.1f s, %lld cards\n", flaps, took, static_cast<long long>(stage.window.findChildren<LinkCard*>().size()));
    std::printf("  live image painted %.1f times a second (aim: above 30)\n", double(stage.live->paints.size()) / took);
    printPercentiles("between two paints", gaps);
    std::printf("  resident memory %.1f MB before, %.1f MB after\n", before, after);
    return 0;
}
