// Measures how long it takes from a robot that is gone to the alarm's sound and the prompt on the screen: `prompt_bench [rounds]`.
//
// The console is the whole one with its window, on Qt's offscreen platform, and armed; robot and X-ray system are liena-devices in
// processes of their own on loopback, over TLS. In every second round the robot's process is killed, so that its sockets close; in the
// others it is stopped, so that nothing closes and nothing comes. The console plays as ever, to a PulseAudio of this program's own, whose
// output takes 10 ms at a time and is recorded. A sample sounded when its block has come to the recorder, or before: what is printed is
// never less than what was heard at the output; a sound card's buffer and a loudspeaker are not in it. Without PulseAudio's programs a
// stand-in notes when it is told to play, and the sound is not measured. A round takes some eight seconds, most of them for the way back to
// armed and for silence.
//
// It ends with 1 where the 99th percentile of the burst, its sound, the red band or the whole prompt is above 200 ms or was not measured,
// or there were fewer than 100 rounds of either kind, which tell none; with 3 where a round did not end as it should: an alarm that is not
// heard, say, or one that is heard before it is there.
#include "hearing.hpp"
#include "limits.hpp"
#include "theatre.hpp"
#include "widgets/alarm_band.hpp"
#include "widgets/diagnosis_sheet.hpp"
#include "widgets/theme.hpp"

#include <QApplication>
#include <QDeadlineTimer>
#include <QTest>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <optional>

using namespace console;
using console::test::Hearing;
using console::test::OutputRecorder;
using console::test::SoundServer;
using console::test::Theatre;

namespace {

constexpr double aim = 200;                     // ms
constexpr std::chrono::milliseconds quiet{800}; ///< more than any gap in a burst

Instant present() { return std::chrono::steady_clock::now(); }

/// Where there is no sound server. Notes the first high burst: a report that is overdue sounds earlier, and lower.
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
    std::vector<double> noticed, told, first, sounding, red, begun, whole, decided;
};

class Stage {
public:
    /// `recorder`: null: a stand-in takes the bursts.
    Stage(NotingApplication& application, OutputRecorder* recorder) : m_application(application), m_recorder(recorder), m_theatre(wishes())
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
        QObject::connect(&m_theatre.models().alarms, &AlarmList::raised, &m_theatre.window(), [this](quint64 id) { noteRaised(id); });
    }

    ~Stage() { m_application.sheet = nullptr; }

    bool open() { return m_theatre.openAll() || fail("the links do not open"); }

    /// One loss, measured, and back to an open link on which everything was read.
    bool round(bool kill, Times& times)
    {
        if (!armInSilence())
            return fail("not armed, or what sounded before does not end");
        begin();
        const auto gone = present();
        kill ? m_theatre.robot->kill() : m_theatre.robot->freeze();
        if (!waitForAll())
            return fail(told() && !isHeard() ? "the high burst is not heard at the sound server's output"
                                             : "not all of alarm and prompt came");
        if (isHeardTooEarly())
            return fail("something is heard before the console has an alarm to sound");
        note(gone, times);
        m_theatre.releaseAll();
        m_theatre.robot.reset();
        m_theatre.robot = m_theatre.start("robot");
        return reopen() || fail("the link is not as it was before the round");
    }

    /// Why a round did not end as it should.
    const char* trouble() const { return m_trouble; }

private:
    Theatre::Wishes wishes()
    {
        Theatre::Wishes wishes;
        wishes.window = QSize(1920, 1080);
        wishes.arm = false;
        wishes.system.timing = R"(heartbeat="20ms" suspect="70ms" lost="110ms" reconnect="500ms")";
        wishes.player = QStringLiteral(LIENA_PROGRAM_DIR "/liena-console-player");
        wishes.voice = m_recorder != nullptr ? nullptr : &m_voice;
        return wishes;
    }

    bool fail(const char* trouble)
    {
        m_trouble = trouble;
        return false;
    }

    /// Before the burst begins, which follows in the same call.
    void noteRaised(quint64 id)
    {
        const auto& alarms = m_theatre.models().alarms.alarms();
        const auto alarm = std::find_if(alarms.begin(), alarms.end(), [id](const Alarm& candidate) { return candidate.id == id; });
        m_lastRaised = present();
        if (!m_firstRaised)
            m_firstRaised = m_lastRaised;
        if (alarm->priority == AlarmPriority::High && !m_highRaised)
            m_highRaised = m_lastRaised;
    }

    /// What sounded before is over, and nothing is about to sound, so that what sounds next is the alarm of this round.
    bool armInSilence()
    {
        const auto isArmed = [this] { return m_theatre.phase() == PermitPhase::Armed; };
        const QDeadlineTimer deadline(3 * Theatre::patience);
        while (!deadline.hasExpired()) {
            if (!m_theatre.arm())
                return false;
            const auto settled = [&] { return !isArmed() || isSilent(); };
            if (m_recorder == nullptr || (QTest::qWaitFor(settled, Theatre::patience) && isArmed()))
                return true;
        }
        return false;
    }

    /// A medium alarm sounds every ten seconds until somebody acknowledges it: there is one as soon as it is armed, of the missing
    /// watchdog.
    bool isSilent()
    {
        constexpr int most = 16;
        const auto& alarms = m_theatre.models().alarms.alarms();
        const auto sounds = [&alarms] {
            return std::any_of(alarms.begin(), alarms.end(), [](const Alarm& alarm) { return alarm.sounds(); });
        };
        for (int i = 0; i < most && sounds(); ++i)
            if (auto* acknowledge = m_theatre.button(QStringLiteral("Acknowledge")); acknowledge != nullptr)
                QTest::mouseClick(acknowledge, Qt::LeftButton);
        return !sounds() && present() - m_lastRaised > quiet && m_recorder->silence() > quiet;
    }

    void begin()
    {
        for (auto* noted : {&m_voice.played, &m_noticed, &m_decided, &m_firstRaised, &m_highRaised})
            noted->reset();
        m_application.begin();
        if (m_recorder != nullptr)
            m_recorder->forget();
    }

    /// As the console's own loop runs: QTest's way to wait sleeps 10 ms at a time.
    bool waitForAll() const
    {
        const QDeadlineTimer deadline(Theatre::patience);
        while (!m_application.whole || !m_application.red || !told() || !m_decided || !m_noticed || !isHeard()) {
            if (deadline.hasExpired())
                return false;
            QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents);
            QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
        }
        return true;
    }

    std::optional<Instant> told() const { return m_recorder != nullptr ? m_highRaised : m_voice.played; }

    bool isHeard() const { return m_recorder == nullptr || m_recorder->onsets().high; }

    bool isHeardTooEarly() const
    {
        if (m_recorder == nullptr)
            return false;
        const auto onsets = m_recorder->onsets();
        return *onsets.first < *m_firstRaised || *onsets.high < *m_highRaised;
    }

    void note(Instant gone, Times& times) const
    {
        const auto add = [gone](std::vector<double>& to, Instant at) { to.push_back(milliseconds(at - gone)); };
        add(times.noticed, *m_noticed);
        add(times.told, *told());
        if (m_recorder != nullptr) {
            const auto onsets = m_recorder->onsets();
            add(times.first, *onsets.first);
            add(times.sounding, *onsets.high);
        }
        add(times.red, *m_application.red);
        add(times.decided, *m_decided);
        add(times.begun, *m_application.first);
        add(times.whole, *m_application.whole);
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
    OutputRecorder* m_recorder;
    NotingVoice m_voice;
    Instant m_lastRaised;
    std::optional<Instant> m_firstRaised; ///< alarm of this round, of whatever priority
    std::optional<Instant> m_highRaised;
    std::optional<Instant> m_noticed;
    std::optional<Instant> m_decided;
    const char* m_trouble = "";
    Theatre m_theatre; ///< last: it goes first
};

constexpr const char* highRaised = "gone -> high alarm, and its burst handed to the voice";
constexpr const char* standIn = "gone -> high burst handed to the sound output (a stand-in)";
constexpr const char* sounding = "gone -> high burst sounds at the sound server's output";
constexpr const char* redBand = "gone -> alarm band painted red";
constexpr const char* wholePrompt = "gone -> prompt painted whole";

bool keepsAim(const char* what, const std::vector<double>& times, const char* needs = "100 rounds")
{
    return judge({what, Bound::AtMost, aim, "ms at the 99th percentile", needs}, p99Of(times));
}

/// What was measured; true when it is as asked for. `heard`: what sounds, too.
bool conclude(const char* how, const Times& times, bool heard)
{
    const char* const told = heard ? highRaised : standIn;
    std::printf("%s\n", how);
    printPercentiles("gone -> this console holds: the link is interrupted", times.noticed);
    printPercentiles(told, times.told);
    printPercentiles("gone -> first sample above noise, of whatever burst", times.first);
    printPercentiles(sounding, times.sounding);
    printPercentiles(redBand, times.red);
    printPercentiles("gone -> prompt begins to be painted", times.begun);
    printPercentiles(wholePrompt, times.whole);
    printPercentiles("gone -> decided that the link will not heal", times.decided);
    bool kept = keepsAim(told, times.told);
    kept = keepsAim(sounding, times.sounding, heard ? "100 rounds" : "a sound server") && kept;
    kept = keepsAim(redBand, times.red) && kept;
    return keepsAim(wholePrompt, times.whole) && kept;
}

/// True when all that was measured is as asked for.
bool conclude(const Times& killed, const Times& stopped, const QString& missing)
{
    std::printf(
        "Armed; heartbeat 20 ms, lost 110 ms, reconnect 500 ms. The aim for alarm and prompt is %.0f ms at the 99th percentile. Neither\n"
        "waits for the decision that the link will not heal, with which the prompt offers to re-open.\n",
        aim);
    const bool heard = missing.isEmpty();
    if (heard)
        std::printf("The sound is taken at the output of a PulseAudio, 10 ms at a time; its times are those at which it was recorded.\n");
    else
        std::printf("The sound was NOT MEASURED, the bursts went to a stand-in: %s.\n", qPrintable(missing));
    const bool kept = conclude("process killed, its sockets closed:", killed, heard);
    return conclude("process stopped, silence:", stopped, heard) && kept;
}

int endWithUsage()
{
    std::fprintf(
        stderr,
        "prompt_bench [rounds]: 1 to 100000; 200, which take half an hour, are the fewest of which the aim can be told.\n"
        "From a robot that is killed or stopped: when motion is held, the alarm sounds at the output of a sound server of this\n"
        "program's own (pulseaudio, pactl and parec; without them the sound is not measured, and its aim not told), and alarm band\n"
        "and prompt are painted. The aim is %.0f ms at the 99th percentile. Ends with %d: kept; %d: not kept, or not told; %d: a round\n"
        "did not end as it should.\n",
        aim, endKept, endNotKept, endNotMeasured);
    return endWrongCall;
}

} // namespace

int main(int argc, char* argv[])
{
    if (qEnvironmentVariableIsEmpty("QT_QPA_PLATFORM"))
        qputenv("QT_QPA_PLATFORM", "offscreen");
    NotingApplication application(argc, argv);
    theme::apply(application);
    const int rounds = argc > 1 ? std::atoi(argv[1]) : 200;
    if (rounds < 1 || rounds > 100000)
        return endWithUsage();
    const auto missing = SoundServer::missing();
    std::unique_ptr<Hearing> hearing;
    if (missing.isEmpty()) {
        hearing = std::make_unique<Hearing>(); // before the console, which plays to what is there when it begins
        if (const auto trouble = hearing->begin(); !trouble.isEmpty()) {
            std::fprintf(stderr, "prompt_bench: %s\n", qPrintable(trouble));
            return endNotMeasured;
        }
    }
    Stage stage(application, hearing ? &hearing->recorder() : nullptr);
    Times killed;
    Times stopped;
    bool good = stage.open();
    for (int i = 0; good && i < rounds; ++i)
        good = stage.round(i % 2 == 0, i % 2 == 0 ? killed : stopped);
    const bool kept = conclude(killed, stopped, missing);
    if (!good) {
        std::fprintf(stderr, "prompt_bench: a round did not end as it should: %s; what was measured until then is above\n",
                     stage.trouble());
        return endNotMeasured;
    }
    return kept ? endKept : endNotKept;
}
