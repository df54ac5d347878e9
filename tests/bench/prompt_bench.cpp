// Measures how long it takes from a robot that is gone to the alarm's burst and the prompt on the screen: `prompt_bench [rounds]`.
//
// The console is the whole one with its window, on Qt's offscreen platform, and armed; robot and X-ray system are liena-devices in
// processes of their own on loopback, over TLS. In every second round the robot's process is killed, so that its sockets close; in the
// others it is stopped, so that nothing closes and nothing comes. The sound output is a stand-in that notes when it is told to play: what a
// sound server and a loudspeaker add is not in it. A round takes some six seconds, most of them for the way back to armed.
//
// It ends with 1 where the 99th percentile of the burst, the red band or the whole prompt is above 200 ms, or there were fewer than 100
// rounds of either kind, which tell none; with 3 where a round did not end as it should.
#include "limits.hpp"
#include "theatre.hpp"
#include "widgets/alarm_band.hpp"
#include "widgets/diagnosis_sheet.hpp"
#include "widgets/theme.hpp"

#include <QApplication>
#include <QTest>

#include <cstdlib>
#include <optional>

using namespace console;
using console::test::Theatre;

namespace {

constexpr double aim = 200; // ms

Instant present() { return std::chrono::steady_clock::now(); }

/// Notes the first high burst: a report that is overdue sounds earlier, and lower.
class NotingVoice : public AlarmVoice {
public:
    void play(AlarmPriority priority) override
    {
        if (!played && priority == AlarmPriority::High)
            played = present();
    }
    void silence() override {}

    std::optional<Instant> played;
};

/// Notes when the red band and the sheet were on the window's surface: after the update in which they were painted.
class NotingApplication : public QApplication {
public:
    using QApplication::QApplication;

    bool notify(QObject* receiver, QEvent* event) override
    {
        const auto type = event->type();
        const bool done = QApplication::notify(receiver, event);
        if (sheet == nullptr)
            return done;
        if (type == QEvent::Paint && receiver == alarms)
            m_red = alarms->surface() == theme::colour::highSurface;
        if (type == QEvent::Paint && receiver == sheet) {
            m_painted = true;
            m_whole = sheet->pos().y() == 0;
        }
        if (type == QEvent::UpdateRequest || type == QEvent::Expose)
            noteShown();
        return done;
    }

    void begin()
    {
        red.reset();
        first.reset();
        whole.reset();
        m_red = m_painted = false;
    }

    DiagnosisSheet* sheet = nullptr;
    AlarmBand* alarms = nullptr;
    std::optional<Instant> red;
    std::optional<Instant> first;
    std::optional<Instant> whole;

private:
    void noteShown()
    {
        if (m_red && !red)
            red = present();
        if (m_painted && !first)
            first = present();
        if (m_painted && m_whole && !whole)
            whole = present();
        m_painted = false;
    }

    bool m_red = false;
    bool m_painted = false;
    bool m_whole = false;
};

struct Times {
    std::vector<double> noticed, sound, red, first, whole, decided;
};

class Stage {
public:
    explicit Stage(NotingApplication& application) : m_application(application), m_theatre(wishes())
    {
        m_application.alarms = m_theatre.window().findChild<AlarmBand*>();
        m_application.sheet = m_theatre.window().findChild<DiagnosisSheet*>();
        const auto& sessions = m_theatre.models().sessions;
        const auto robot = *sessions.firstPeer(DeviceKind::Hand);
        QObject::connect(&sessions, &SessionModel::linkStateChanged, &m_theatre.window(),
                         [this, robot](quint32 peer, LinkState, LinkState to) {
                             if (peer == robot && to == LinkState::Reconnecting && !m_noticed)
                                 m_noticed = present();
                             if (peer == robot && to == LinkState::StandBy && !m_decided)
                                 m_decided = present();
                         });
    }

    ~Stage() { m_application.sheet = nullptr; }

    bool open() { return m_theatre.openAll(); }

    /// One loss, measured, and back to an open link on which everything was read.
    bool round(bool kill, Times& times)
    {
        if (!m_theatre.arm())
            return false;
        m_voice.played.reset();
        m_noticed.reset();
        m_decided.reset();
        m_application.begin();
        const auto gone = present();
        kill ? m_theatre.robot->kill() : m_theatre.robot->freeze();
        const auto done = [this] { return m_application.whole && m_application.red && m_voice.played && m_decided && m_noticed; };
        if (!QTest::qWaitFor(done, Theatre::patience))
            return false;
        const auto since = [](Instant from, Instant to) { return milliseconds(to - from); };
        times.noticed.push_back(since(gone, *m_noticed));
        times.sound.push_back(since(gone, *m_voice.played));
        times.red.push_back(since(gone, *m_application.red));
        times.decided.push_back(since(gone, *m_decided));
        times.first.push_back(since(gone, *m_application.first));
        times.whole.push_back(since(gone, *m_application.whole));
        m_theatre.releaseAll();
        m_theatre.robot.reset();
        m_theatre.robot = m_theatre.start("robot");
        return reopen();
    }

private:
    Theatre::Wishes wishes()
    {
        Theatre::Wishes wishes;
        wishes.window = QSize(1920, 1080);
        wishes.arm = false;
        wishes.system.timing = R"(heartbeat="20ms" suspect="70ms" lost="110ms" reconnect="500ms")";
        wishes.voice = &m_voice;
        return wishes;
    }

    bool reopen()
    {
        const auto& models = m_theatre.models();
        Q_EMIT m_theatre.window().reopenRequested(*models.sessions.firstPeer(DeviceKind::Hand));
        if (!QTest::qWaitFor([&models] { return models.sessions.allOpen() && models.incidents.empty(); }, Theatre::patience))
            return false;
        m_theatre.readAccount();
        return models.interruption.settled();
    }

    NotingApplication& m_application;
    NotingVoice m_voice;
    std::optional<Instant> m_noticed;
    std::optional<Instant> m_decided;
    Theatre m_theatre; ///< last: it goes first
};

constexpr const char* burst = "gone -> high burst handed to the sound output (a stand-in)";
constexpr const char* redBand = "gone -> alarm band painted red";
constexpr const char* wholePrompt = "gone -> prompt painted whole";

bool keepsAim(const char* what, const std::vector<double>& times)
{
    return judge({what, Bound::AtMost, aim, "ms at the 99th percentile", "100 rounds"}, p99Of(times));
}

/// What was measured; true when it is as asked for.
bool conclude(const char* how, const Times& times)
{
    std::printf("%s\n", how);
    printPercentiles("gone -> this console holds: the link is interrupted", times.noticed);
    printPercentiles(burst, times.sound);
    printPercentiles(redBand, times.red);
    printPercentiles("gone -> prompt begins to be painted", times.first);
    printPercentiles(wholePrompt, times.whole);
    printPercentiles("gone -> decided that the link will not heal", times.decided);
    bool kept = keepsAim(burst, times.sound);
    kept = keepsAim(redBand, times.red) && kept;
    return keepsAim(wholePrompt, times.whole) && kept;
}

} // namespace

int main(int argc, char* argv[])
{
    if (qEnvironmentVariableIsEmpty("QT_QPA_PLATFORM"))
        qputenv("QT_QPA_PLATFORM", "offscreen");
    NotingApplication application(argc, argv);
    theme::apply(application);
    const int rounds = argc > 1 ? std::atoi(argv[1]) : 200;
    if (rounds < 1 || rounds > 100000) {
        std::fprintf(stderr, "prompt_bench [rounds]: 1 to 100000; 200 are the fewest of which the aim can be told\n");
        return endWrongCall;
    }
    Stage stage(application);
    Times killed;
    Times stopped;
    bool good = stage.open();
    for (int i = 0; good && i < rounds; ++i)
        good = stage.round(i % 2 == 0, i % 2 == 0 ? killed : stopped);
    std::printf(
        "Armed; heartbeat 20 ms, lost 110 ms, reconnect 500 ms. The aim for alarm and prompt is %.0f ms at the 99th percentile. Neither\n"
        "waits for the decision that the link will not heal, with which the prompt offers to re-open.\n",
        aim);
    bool kept = conclude("process killed, its sockets closed:", killed);
    kept = conclude("process stopped, silence:", stopped) && kept;
    if (!good) {
        std::fprintf(stderr, "prompt_bench: a round did not end as it should; what was measured until then is above\n");
        return endNotMeasured;
    }
    return kept ? endKept : endNotKept;
}
