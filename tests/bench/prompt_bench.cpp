// Measures how long it takes from a robot that is gone to the alarm's burst and the prompt on the screen: `prompt_bench [rounds]`.
//
// The console is the whole one with its window, on Qt's offscreen platform, and armed; robot and X-ray system are liena-devices in
// processes of their own on loopback, over TLS. In every second round the robot's process is killed, so that its sockets close; in the
// others it is stopped, so that nothing closes and nothing comes. The sound output is a stand-in that notes when it is told to play: what a
// sound server and a loudspeaker add is not in it. A round takes some ten seconds, most of them for the way back to armed.
#include "app/cockpit_application.hpp"
#include "child_process.hpp"
#include "percentiles.hpp"
#include "test_system.hpp"
#include "widgets/alarm_band.hpp"
#include "widgets/cockpit_window.hpp"
#include "widgets/diagnosis_sheet.hpp"
#include "widgets/interruption_card.hpp"
#include "widgets/sheet_button.hpp"
#include "widgets/theme.hpp"

#include <QApplication>
#include <QTest>

#include <cstdlib>
#include <optional>

using namespace console;
using namespace liena::test;

namespace {

constexpr int patience = 30000;
constexpr double aim = 200; // ms

Instant present() { return std::chrono::steady_clock::now(); }

/// Notes when something was first played since it was armed.
class NotingVoice : public AlarmVoice {
public:
    void play(AlarmPriority) override
    {
        if (!played)
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
    std::vector<double> noticed, sound, red, decided, first, whole, shownAfter;
};

class Stage {
public:
    explicit Stage(NotingApplication& application)
        : m_application(application),
          m_files({reference::cockpit, reference::robot, reference::xray}, {"cockpit robot", "cockpit xray", "xray robot"},
                  {"tls", R"(heartbeat="20ms" suspect="70ms" lost="110ms" reconnect="500ms")"})
    {
        m_robot = start("robot", {});
        m_xray = start("xray", {QStringLiteral("--size"), QStringLiteral("256")});
        const auto settings = m_files.settingsOf("cockpit");
        const auto text = [](const std::filesystem::path& path) { return QString::fromStdString(path.string()); };
        Options options;
        options.topology = text(settings.topology);
        options.device = QStringLiteral("cockpit");
        options.registry = {text(settings.registry.front())};
        options.store = text(settings.store);
        options.certificate = text(settings.certificate);
        options.key = text(settings.key);
        options.authority = text(settings.authority);
        options.alarmLog = text(m_files.folder() / "alarms");
        options.size = QSize(1920, 1080);
        options.profile = PictureProfile::Coronary;
        m_cockpit = std::make_unique<CockpitApplication>(options);
        m_cockpit->setVoice(m_voice);
        QString error;
        if (!m_cockpit->prepare(&error))
            throw std::runtime_error(error.toStdString());
        m_cockpit->show();
        m_application.alarms = m_cockpit->window().findChild<AlarmBand*>();
        m_application.sheet = m_cockpit->window().findChild<DiagnosisSheet*>();
        const auto& models = m_cockpit->models();
        const auto robot = *models.sessions.firstPeer(DeviceKind::Hand);
        QObject::connect(&models.sessions, &SessionModel::linkStateChanged, &m_cockpit->window(),
                         [this, robot](quint32 peer, LinkState, LinkState to) {
                             if (peer == robot && to == LinkState::Reconnecting && !m_noticed)
                                 m_noticed = present();
                             if (peer == robot && to == LinkState::StandBy && !m_decided)
                                 m_decided = present();
                         });
    }

    ~Stage() { m_application.sheet = nullptr; }

    bool open()
    {
        if (!QTest::qWaitForWindowActive(&m_cockpit->window()))
            return false;
        Q_EMIT m_cockpit->window().openAllRequested();
        return settled();
    }

    /// One loss, measured, and back to an open link on which everything was read.
    bool round(bool kill, Times& times)
    {
        if (!arm())
            return false;
        m_voice.played.reset();
        m_noticed.reset();
        m_decided.reset();
        m_application.begin();
        const auto gone = present();
        kill ? m_robot->kill() : m_robot->freeze();
        const auto done = [this] { return m_application.whole && m_application.red && m_voice.played && m_decided && m_noticed; };
        if (!QTest::qWaitFor(done, patience))
            return false;
        const auto since = [](Instant from, Instant to) { return milliseconds(to - from); };
        times.noticed.push_back(since(gone, *m_noticed));
        times.sound.push_back(since(gone, *m_voice.played));
        times.red.push_back(since(gone, *m_application.red));
        times.decided.push_back(since(gone, *m_decided));
        times.first.push_back(since(gone, *m_application.first));
        times.whole.push_back(since(gone, *m_application.whole));
        times.shownAfter.push_back(since(*m_decided, *m_application.whole));
        releaseKeys();
        m_robot.reset();
        m_robot = start("robot", {});
        return reopen();
    }

private:
    std::unique_ptr<ChildProcess> start(const std::string& role, const QStringList& options)
    {
        auto process = std::make_unique<ChildProcess>(QStringLiteral("liena-device"),
                                                      QStringList{QString::fromStdString(role)} + m_files.argumentsOf(role) + options);
        if (!process->waitForLine(QStringLiteral("listening on")))
            throw std::runtime_error(process->output().toStdString());
        return process;
    }

    PermitPhase phase() const { return m_cockpit->models().permit.phase(); }

    bool reaches(PermitPhase wanted)
    {
        return QTest::qWaitFor([&] { return phase() == wanted; }, 6000);
    }

    void releaseKeys()
    {
        for (const auto key : {Qt::Key_R, Qt::Key_F})
            QTest::keyRelease(&m_cockpit->window(), key);
    }

    void acknowledge()
    {
        const auto& alarms = m_cockpit->models().alarms;
        while (!alarms.alarms().empty() && alarms.highest()->demandsAttention())
            Q_EMIT m_cockpit->window().acknowledgeRequested(alarms.highest()->id);
    }

    void testAlarms()
    {
        auto& window = m_cockpit->window();
        const auto& test = m_cockpit->models().selfTest;
        QTest::keyClick(&window, Qt::Key_F8);
        (void)QTest::qWaitFor([&test] { return !test.signal(); }, patience);
        Q_EMIT window.alarmTestAnswered(true);
    }

    /// A condition that fails on the way sends a person back to the start, and so this.
    bool arm()
    {
        constexpr int tries = 5;
        for (int i = 0; i < tries && phase() != PermitPhase::Armed; ++i) {
            releaseKeys();
            acknowledge();
            testAlarms();
            QTest::keyPress(&m_cockpit->window(), Qt::Key_F);
            if (!reaches(PermitPhase::Ready))
                continue;
            QTest::keyPress(&m_cockpit->window(), Qt::Key_R);
            (void)reaches(PermitPhase::Armed);
            QTest::keyRelease(&m_cockpit->window(), Qt::Key_R);
        }
        return phase() == PermitPhase::Armed;
    }

    bool settled()
    {
        const auto& models = m_cockpit->models();
        return QTest::qWaitFor([&models] { return models.sessions.allOpen() && models.incidents.empty(); }, patience);
    }

    bool reopen()
    {
        auto& window = m_cockpit->window();
        Q_EMIT window.reopenRequested(*m_cockpit->models().sessions.firstPeer(DeviceKind::Hand));
        if (!settled())
            return false;
        auto* read = window.findChild<InterruptionCard*>()->findChild<SheetButton*>();
        if (!QTest::qWaitFor([read] { return read->isEnabled(); }, patience))
            return false;
        QTest::mouseClick(read, Qt::LeftButton);
        return m_cockpit->models().interruption.settled();
    }

    NotingApplication& m_application;
    TestSystem m_files;
    NotingVoice m_voice;
    std::unique_ptr<ChildProcess> m_robot;
    std::unique_ptr<ChildProcess> m_xray;
    std::optional<Instant> m_noticed;
    std::optional<Instant> m_decided;
    std::unique_ptr<CockpitApplication> m_cockpit; ///< last: it goes first
};

void print(const char* how, const Times& times)
{
    std::printf("%s\n", how);
    printPercentiles("gone -> this console holds: the link is interrupted", times.noticed);
    printPercentiles("gone -> burst handed to the sound output (a stand-in)", times.sound);
    printPercentiles("gone -> alarm band painted red", times.red);
    printPercentiles("gone -> decided that the link will not heal", times.decided);
    printPercentiles("gone -> prompt begins to be painted", times.first);
    printPercentiles("gone -> prompt painted whole", times.whole);
    printPercentiles("decided -> prompt painted whole", times.shownAfter);
}

} // namespace

int main(int argc, char* argv[])
{
    if (qEnvironmentVariableIsEmpty("QT_QPA_PLATFORM"))
        qputenv("QT_QPA_PLATFORM", "offscreen");
    NotingApplication application(argc, argv);
    theme::apply(application);
    const int rounds = argc > 1 ? std::atoi(argv[1]) : 100;
    if (rounds < 2 || rounds > 100000) {
        std::fprintf(stderr, "prompt_bench [rounds]: 2 to 100000\n");
        return 2;
    }
    Stage stage(application);
    Times killed;
    Times stopped;
    bool good = stage.open();
    for (int i = 0; good && i < rounds; ++i)
        good = stage.round(i % 2 == 0, i % 2 == 0 ? killed : stopped);
    std::printf(
        "Armed; heartbeat 20 ms, lost 110 ms, reconnect 500 ms. The aim for alarm and prompt is %.0f ms at the 99th percentile. The "
        "prompt\n"
        "comes with the decision that the link will not heal, which the topology's `reconnect` puts off; the alarm does not wait for it.\n",
        aim);
    print("process killed, its sockets closed:", killed);
    print("process stopped, silence:", stopped);
    if (!good)
        std::fprintf(stderr, "prompt_bench: a round did not end as it should; what was measured until then is above\n");
    return good ? 0 : 1;
}
