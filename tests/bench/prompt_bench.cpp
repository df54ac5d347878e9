// Measures how long it takes from a peer that is gone to the prompt on the screen and the alarm's burst: `prompt_bench [rounds]`.
//
// The console is the whole one with its window, on Qt's offscreen platform; the robot is a liena-device in a process of its own on
// loopback, over TLS. In every second round the process is killed, so that its sockets close; in the others it is stopped, so that nothing
// closes and nothing comes. The sound output is a stand-in that notes when it is told to play: what a sound server and a loudspeaker add is
// not in it.
#include "app/cockpit_application.hpp"
#include "child_process.hpp"
#include "percentiles.hpp"
#include "test_system.hpp"
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

/// Notes when the sheet was on the window's surface: after the update in which it was painted.
class NotingApplication : public QApplication {
public:
    using QApplication::QApplication;

    bool notify(QObject* receiver, QEvent* event) override
    {
        const auto type = event->type();
        const bool done = QApplication::notify(receiver, event);
        if (sheet == nullptr || !sheet->isVisible())
            return done;
        if (type == QEvent::Paint && receiver == sheet) {
            m_painted = true;
            m_whole = sheet->pos().y() == 0;
        } else if (m_painted && (type == QEvent::UpdateRequest || type == QEvent::Expose)) {
            m_painted = false;
            if (!first)
                first = present();
            if (!whole && m_whole)
                whole = present();
        }
        return done;
    }

    void begin()
    {
        first.reset();
        whole.reset();
        m_painted = false;
    }

    DiagnosisSheet* sheet = nullptr;
    std::optional<Instant> first;
    std::optional<Instant> whole;

private:
    bool m_painted = false;
    bool m_whole = false;
};

struct Times {
    std::vector<double> decided, first, whole, sound, shownAfter, soundAfter;
};

class Stage {
public:
    explicit Stage(NotingApplication& application)
        : m_application(application),
          m_files({reference::cockpit, reference::robot}, {"cockpit robot"},
                  {"tls", R"(heartbeat="20ms" suspect="70ms" lost="110ms" reconnect="500ms")"})
    {
        startRobot();
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
        m_cockpit = std::make_unique<CockpitApplication>(options);
        m_cockpit->setVoice(m_voice);
        QString error;
        if (!m_cockpit->prepare(&error))
            throw std::runtime_error(error.toStdString());
        m_cockpit->show();
        m_application.sheet = m_cockpit->window().findChild<DiagnosisSheet*>();
        QObject::connect(&m_cockpit->models().incidents, &IncidentModel::incidentRaised, &m_cockpit->window(),
                         [this] { m_decided = m_decided ? m_decided : present(); });
    }

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
        m_voice.played.reset();
        m_decided.reset();
        m_application.begin();
        const auto gone = present();
        kill ? m_robot->kill() : m_robot->freeze();
        const auto done = [this] { return m_application.whole && m_voice.played && m_decided; };
        if (!QTest::qWaitFor(done, patience))
            return false;
        const auto since = [](Instant from, Instant to) { return milliseconds(to - from); };
        times.decided.push_back(since(gone, *m_decided));
        times.first.push_back(since(gone, *m_application.first));
        times.whole.push_back(since(gone, *m_application.whole));
        times.sound.push_back(since(gone, *m_voice.played));
        times.shownAfter.push_back(since(*m_decided, *m_application.whole));
        times.soundAfter.push_back(since(*m_decided, *m_voice.played));
        m_robot.reset();
        startRobot();
        return reopen();
    }

private:
    void startRobot()
    {
        m_robot = std::make_unique<ChildProcess>(QStringLiteral("liena-device"),
                                                 QStringList{QStringLiteral("robot")} + m_files.argumentsOf("robot"));
        if (!m_robot->waitForLine(QStringLiteral("listening on")))
            throw std::runtime_error(m_robot->output().toStdString());
    }

    bool settled()
    {
        const auto& models = m_cockpit->models();
        return QTest::qWaitFor(
            [&models] {
                const auto* link = models.sessions.linkTo(*models.sessions.firstPeer(DeviceKind::Hand));
                return link->state == LinkState::Open && link->figures.heartbeatsOnTime > 10 && models.incidents.empty();
            },
            patience);
    }

    bool reopen()
    {
        auto& window = m_cockpit->window();
        Q_EMIT window.reopenRequested(*m_cockpit->models().sessions.firstPeer(DeviceKind::Hand));
        if (!settled())
            return false;
        const auto& alarms = m_cockpit->models().alarms;
        while (!alarms.alarms().empty() && alarms.highest()->demandsAttention())
            Q_EMIT window.acknowledgeRequested(alarms.highest()->id);
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
    std::optional<Instant> m_decided;
    std::unique_ptr<CockpitApplication> m_cockpit; ///< last: it goes first
};

void print(const char* how, const Times& times)
{
    std::printf("%s\n", how);
    printPercentiles("gone -> this console decides that the link is lost", times.decided);
    printPercentiles("gone -> prompt begins to be painted", times.first);
    printPercentiles("gone -> prompt painted whole", times.whole);
    printPercentiles("gone -> burst handed to the sound output (a stand-in)", times.sound);
    printPercentiles("decided -> prompt painted whole", times.shownAfter);
    printPercentiles("decided -> burst handed to the sound output (a stand-in)", times.soundAfter);
}

} // namespace

int main(int argc, char* argv[])
{
    if (qEnvironmentVariableIsEmpty("QT_QPA_PLATFORM"))
        qputenv("QT_QPA_PLATFORM", "offscreen");
    NotingApplication application(argc, argv);
    theme::apply(application);
    const int rounds = argc > 1 ? std::atoi(argv[1]) : 200;
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
    std::printf("heartbeat 20 ms, lost 110 ms, reconnect 500 ms: a link that does not heal is decided to be lost only after `reconnect`.\n"
                "The aim is %.0f ms for what the console adds to that decision.\n",
                aim);
    print("process killed, its sockets closed:", killed);
    print("process stopped, silence:", stopped);
    if (!good)
        std::fprintf(stderr, "prompt_bench: a round did not end as it should; what was measured until then is above\n");
    return good ? 0 : 1;
}
