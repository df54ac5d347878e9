// Lets the whole console work for an hour, and says by the minute what it shows, how old that is and how much memory it has:
// `endurance_bench [seconds] [picture's edge] [pictures per second]`.
//
// Console with its window on Qt's offscreen platform, robot, arm and X-ray system in processes of their own on loopback, over TLS. The
// guidewire is moved to and fro all the time. Memory is what is resident; the ring of raw pictures for review fills within its first minute
// or two. A hold is counted, and the hand arms again, as a person would.
#include "model/picture_state.hpp"
#include "percentiles.hpp"
#include "theatre.hpp"
#include "widgets/theme.hpp"

#include <QApplication>
#include <QFile>
#include <QTest>

#include <cstdlib>
#include <unistd.h>

using namespace console;
using console::test::Theatre;

namespace {

constexpr std::chrono::seconds stroke{4};

Instant present() { return std::chrono::steady_clock::now(); }

/// MiB that the process has resident.
double resident(qint64 process)
{
    QFile status(QStringLiteral("/proc/%1/status").arg(process));
    if (!status.open(QIODevice::ReadOnly))
        return 0;
    for (const auto& line : status.readAll().split('\n'))
        if (line.startsWith("VmRSS:"))
            return line.mid(6).trimmed().split(' ').constFirst().toDouble() / 1024;
    return 0;
}

struct Wanted {
    std::chrono::seconds span{3600};
    int edge = 1024;
    double rate = 30;
};

class SilentVoice : public AlarmVoice {
public:
    void play(AlarmPriority) override {}
    void silence() override {}
};

struct Minute {
    double memory = 0;
    double age = 0; ///< ms, median
};

class Endurance {
public:
    Endurance(const Wanted& wanted, AlarmVoice& voice) : m_wanted(wanted), m_theatre(wishes(wanted, voice))
    {
        QObject::connect(&m_theatre.models().picture, &PictureState::painted, &m_theatre.window(), [this] {
            if (const auto age = m_theatre.models().picture.reading(present()).age)
                m_ages.push_back(milliseconds(*age));
        });
    }

    bool work()
    {
        if (!m_theatre.openAll() || !m_theatre.armAndMove())
            return false;
        std::printf("minute  pictures/s   age p50    p99    max ms   console MiB  robot  arm  X-ray  holds\n");
        const auto end = present() + m_wanted.span;
        while (present() < end) {
            m_ages.clear();
            const auto begun = present();
            const auto until = std::min(end, begun + std::chrono::seconds(60));
            while (present() < until)
                if (!moveOnce())
                    return false;
            print(seconds(present() - begun));
        }
        m_theatre.releaseAll();
        m_theatre.release(Qt::Key_Down);
        return true;
    }

    void conclude() const
    {
        if (m_minutes.size() < 4)
            return;
        const auto half = m_minutes.size() / 2;
        std::printf("from minute %zu to the end: memory %+.1f MiB, median age %+.1f ms\n", half + 1,
                    m_minutes.back().memory - m_minutes[half].memory, m_minutes.back().age - m_minutes[half].age);
    }

    QString story() const { return m_theatre.story(); }

private:
    static Theatre::Wishes wishes(const Wanted& wanted, AlarmVoice& voice)
    {
        Theatre::Wishes wishes;
        wishes.window = QSize(1920, 1080);
        wishes.pictureSize = wanted.edge;
        wishes.preferences.pulseRate = wanted.rate;
        wishes.system.timing = R"(heartbeat="20ms" suspect="70ms" lost="110ms" reconnect="500ms")"; // as in topologies/cerebrovascular.xml
        wishes.voice = &voice;
        return wishes;
    }

    /// Forward, then back; armed again when the permit went.
    bool moveOnce()
    {
        for (const auto key : {Qt::Key_Up, Qt::Key_Down}) {
            m_theatre.hold(key);
            (void)QTest::qWaitFor([this] { return m_theatre.phase() != PermitPhase::Engaged; }, int(stroke / std::chrono::milliseconds(1)));
            m_theatre.release(key);
            if (m_theatre.phase() == PermitPhase::Engaged)
                continue;
            ++m_holds;
            std::printf("hold: %s; %s\n", qPrintable(word(m_theatre.models().permit.state().cause)),
                        qPrintable(m_theatre.models().permit.unmetText(9)));
            return m_theatre.armAndMove();
        }
        return true;
    }

    void print(double span)
    {
        if (m_ages.empty())
            return;
        const Minute now{resident(::getpid()), percentileOf(m_ages, 0.5)};
        m_minutes.push_back(now);
        std::printf("%6zu  %10.2f  %8.1f %6.1f %6.1f      %8.1f  %5.1f %4.1f  %5.1f  %d\n", m_minutes.size(), double(m_ages.size()) / span,
                    now.age, percentileOf(m_ages, 0.99), percentileOf(m_ages, 1), now.memory, resident(m_theatre.robot->id()),
                    resident(m_theatre.armDevice->id()), resident(m_theatre.xray->id()), m_holds);
        std::fflush(stdout);
    }

    Wanted m_wanted;
    Theatre m_theatre;
    std::vector<double> m_ages; ///< of this minute, ms
    std::vector<Minute> m_minutes;
    int m_holds = 0;
};

} // namespace

int main(int argc, char* argv[])
{
    if (qEnvironmentVariableIsEmpty("QT_QPA_PLATFORM"))
        qputenv("QT_QPA_PLATFORM", "offscreen");
    QApplication application(argc, argv);
    theme::apply(application);
    Wanted wanted;
    if (argc > 1)
        wanted.span = std::chrono::seconds(std::atoi(argv[1]));
    if (argc > 2)
        wanted.edge = std::atoi(argv[2]);
    if (argc > 3)
        wanted.rate = std::atof(argv[3]);
    if (argc > 4 || wanted.span.count() < 1 || wanted.span.count() > 1000000) {
        std::fprintf(stderr, "endurance_bench [seconds] [256, 512 or 1024] [7.5, 15 or 30]\n");
        return 2;
    }
    SilentVoice voice;
    Endurance endurance(wanted, voice);
    const bool good = endurance.work();
    endurance.conclude();
    if (!good)
        std::fprintf(stderr, "endurance_bench: the state after the last line was not reached: %s\n", qPrintable(endurance.story()));
    return good ? 0 : 1;
}
