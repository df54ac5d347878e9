// Lets the whole console work for an hour, and says by the minute what it shows, how old that is and how much memory it has:
// `endurance_bench [seconds] [picture's edge] [pictures per second]`.
//
// Console with its window on Qt's offscreen platform, robot, arm and X-ray system in processes of their own on loopback, over TLS. The
// guidewire is moved to and fro all the time. Memory is what is resident; the ring of raw pictures for review fills within its first minute
// or two. A hold is counted, and the hand arms again, as a person would.
//
// It ends with 1 where from half time on the memory of the console grew by more than 20 MiB or its pictures' median age by more than 5 ms,
// or the run had fewer than four minutes, of which that cannot be told; with 3 where the console did not do what was asked of it.
#include "limits.hpp"
#include "model/picture_state.hpp"
#include "runner/process_facts.hpp"
#include "theatre.hpp"
#include "widgets/theme.hpp"

#include <QApplication>
#include <QTest>

#include <algorithm>
#include <cstdlib>
#include <unistd.h>

using namespace console;
using console::test::Theatre;

namespace {

constexpr std::chrono::seconds stroke{4};

constexpr std::size_t fewestMinutes = 4;
constexpr Limit memoryLimit{"memory of the console from half time on", Bound::AtMost, 20, "MiB more", "four minutes"};
constexpr Limit ageLimit{"median age of its pictures from half time on", Bound::AtMost, 5, "ms more", "four minutes"};

Instant present() { return std::chrono::steady_clock::now(); }

/// MiB that the process has resident.
double resident(qint64 process) { return double(liena::lab::residentKiB(static_cast<pid_t>(process))) / 1024; }

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
                if (!moveOnce(end))
                    return false;
            print(seconds(present() - begun));
        }
        m_theatre.releaseAll();
        m_theatre.release(Qt::Key_Down);
        return true;
    }

    /// True when it is as asked for.
    bool conclude() const
    {
        const auto half = m_memory.size() / 2;
        const bool flat = judge(memoryLimit, growthSince(m_memory, half, fewestMinutes));
        return judge(ageLimit, growthSince(m_age, half, fewestMinutes)) && flat;
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

    /// Forward, then back, until `end` at most; armed again when the permit went.
    bool moveOnce(Instant end)
    {
        for (const auto key : {Qt::Key_Up, Qt::Key_Down}) {
            m_theatre.hold(key);
            const auto patience = std::clamp<Duration>(end - present(), Duration::zero(), stroke);
            (void)QTest::qWaitFor([this] { return m_theatre.phase() != PermitPhase::Engaged; }, int(milliseconds(patience)));
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
        m_memory.push_back(resident(::getpid()));
        m_age.push_back(percentileOf(m_ages, 0.5));
        std::printf("%6zu  %10.2f  %8.1f %6.1f %6.1f      %8.1f  %5.1f %4.1f  %5.1f  %d\n", m_memory.size(), double(m_ages.size()) / span,
                    m_age.back(), percentileOf(m_ages, 0.99), percentileOf(m_ages, 1), m_memory.back(), resident(m_theatre.robot->id()),
                    resident(m_theatre.armDevice->id()), resident(m_theatre.xray->id()), m_holds);
        std::fflush(stdout);
    }

    Wanted m_wanted;
    Theatre m_theatre;
    std::vector<double> m_ages;   ///< of this minute, ms
    std::vector<double> m_memory; ///< after each minute, MiB
    std::vector<double> m_age;    ///< of each minute, median, ms
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
        std::fprintf(stderr,
                     "endurance_bench [seconds] [256, 512 or 1024] [7.5, 15 or 30]; what grows can be told of four minutes and more\n");
        return endWrongCall;
    }
    SilentVoice voice;
    Endurance endurance(wanted, voice);
    const bool good = endurance.work();
    const bool kept = endurance.conclude();
    if (!good) {
        std::fprintf(stderr, "endurance_bench: the state after the last line was not reached: %s\n", qPrintable(endurance.story()));
        return endNotMeasured;
    }
    return kept ? endKept : endNotKept;
}
