// Takes the pictures of the user's guide from the running console and real devices: `guide_pictures FOLDER WIDTHxHEIGHT`.
//
// The console is the whole one, on Qt's offscreen platform; robot, arm and X-ray system are liena-devices in processes of their own. The
// links' timing is slower than a real one, so that a moment lasts long enough for its picture.
#include "imaging/live_image_view.hpp"
#include "imaging/reference_image_view.hpp"
#include "theatre.hpp"
#include "widgets/diagnosis_sheet.hpp"
#include "widgets/theme.hpp"

#include <QApplication>
#include <QDir>
#include <QTest>

#include <algorithm>
#include <cstdio>
#include <functional>

using namespace console;
using console::test::Theatre;

namespace {

class SilentVoice : public AlarmVoice {
public:
    void play(AlarmPriority) override {}
    void silence() override {}
};

class Photographer {
public:
    Photographer(const QDir& folder, const QSize& size, AlarmVoice& voice) : m_folder(folder), m_theatre(wishes(size, voice)) {}

    /// False at the first state that is not reached.
    bool work()
    {
        return idle() && topology() && open() && selfTest() && measured() && armed() && engaged() && roadmap() && frozen() &&
               interrupted() && lost() && reopened() && review() && views();
    }

    /// What was taken until now.
    bool save() const
    {
        for (const auto& [state, picture] : m_taken) {
            const auto path = m_folder.filePath(QStringLiteral("%1-%2.jpg").arg(state).arg(picture.height()));
            const bool saved = picture.save(path, "JPG", 88);
            std::printf("%s\n", qPrintable(saved ? path : QStringLiteral("cannot write ") + path));
            if (!saved)
                return false;
        }
        return true;
    }

    QString story() const { return m_theatre.story(); }

private:
    static Theatre::Wishes wishes(const QSize& size, AlarmVoice& voice)
    {
        Theatre::Wishes wishes;
        wishes.window = size;
        wishes.pictureSize = 1024;
        wishes.user = QStringLiteral("Dr. Example");
        wishes.preferences.patientSide = QStringLiteral("lab 2, tel. 4711");
        wishes.voice = &voice;
        wishes.watchdog = QStringLiteral("/bin/cat"); // it answers each beat, and needs no sound
        wishes.system.timing = R"(heartbeat="20ms" suspect="150ms" lost="250ms" reconnect="800ms")";
        wishes.pictureTiming = R"(heartbeat="50ms" suspect="2s" lost="4s" reconnect="6s")"; // a frozen picture, and the link stands
        wishes.system.name = R"(name="cerebrovascular" title="Remote vascular intervention")";
        return wishes;
    }

    static constexpr int settling = 150;   ///< ms
    static constexpr int reviewedBack = 5; ///< pictures
    static constexpr int frozenFor = 1500; ///< ms, so that the seconds beside the word count something

    static bool until(const std::function<bool()>& reached) { return QTest::qWaitFor(reached, Theatre::patience); }

    /// Written later: a console that compresses pictures stands still, and says so.
    bool take(const char* state)
    {
        QTest::qWait(settling); // what was just asked for is laid out and painted, and what is heard goes on being heard
        m_theatre.window().refresh(std::chrono::steady_clock::now());
        QCoreApplication::processEvents();
        m_taken.emplace_back(QString::fromLatin1(state), m_theatre.window().grab().toImage());
        return true;
    }

    PictureCondition picture() const { return m_theatre.models().picture.reading(std::chrono::steady_clock::now()).condition; }
    quint32 robotId() const { return m_theatre.files.idOf("robot").value(); }

    bool idle()
    {
        m_theatre.window().setPatient(QStringLiteral("Example, Eva"), QStringLiteral("PID 4711-0815"));
        return QTest::qWaitForWindowActive(&m_theatre.window()) && take("idle");
    }

    /// As the guide comes to it: before the first link is opened.
    bool topology()
    {
        QTest::keyClick(&m_theatre.window(), Qt::Key_F2);
        const bool taken = take("topology");
        QTest::keyClick(&m_theatre.window(), Qt::Key_F1);
        return taken;
    }

    /// What each device says by itself, once or every second, has come.
    bool allReported() const
    {
        const auto& models = m_theatre.models();
        const auto& instrument = models.instrument;
        return instrument.robot().known() && instrument.drives().known() && instrument.tip().known() && instrument.travel() &&
               models.arm.status().known() && models.xray.status().known();
    }

    /// Live pictures, compared clocks and all else that arming asks for.
    bool onlyTestIsMissing() const
    {
        const auto met = metGuards(m_theatre.models().permit.checklist());
        return met.count() == guardCount - 1 && !met.test(static_cast<std::size_t>(Guard::AlarmsTested));
    }

    bool open()
    {
        if (!m_theatre.openAll())
            return false;
        m_theatre.hold(Qt::Key_F);
        return until([this] { return allReported() && onlyTestIsMissing() && picture() == PictureCondition::Live; }) && take("open");
    }

    /// The first of its three signals.
    bool selfTest()
    {
        QTest::keyClick(&m_theatre.window(), Qt::Key_F8);
        const bool taken = until([this] { return m_theatre.models().selfTest.signal() == AlarmPriority::High; }) && take("self-test");
        if (!taken || !until([this] { return !m_theatre.models().selfTest.signal(); }) || !m_theatre.click(QStringLiteral("Test seen")))
            return false;
        m_theatre.hold(Qt::Key_F); // not heard before where the keys were elsewhere
        return m_theatre.reaches(PermitPhase::Ready);
    }

    void press(const char* accessibleName)
    {
        for (auto* button : m_theatre.window().findChildren<QAbstractButton*>())
            if (button->isVisible() && button->accessibleName() == QLatin1String(accessibleName))
                QTest::mouseClick(button, Qt::LeftButton);
    }

    /// A distance in a larger picture with less noise; then the whole picture as it came.
    bool measured()
    {
        auto* image = m_theatre.window().findChild<LiveImageView*>();
        for (const char* wanted : {"More zoom", "More noise reduction", "More noise reduction"})
            press(wanted);
        if (image == nullptr || !m_theatre.click(QStringLiteral("Measure")))
            return false;
        const QPoint middle = image->rect().center();
        const int reach = image->height() / 8;
        QTest::mouseClick(image, Qt::LeftButton, {}, middle - QPoint(reach, reach));
        QTest::mouseClick(image, Qt::LeftButton, {}, middle + QPoint(reach, 0));
        const bool taken = take("measured");
        return m_theatre.click(QStringLiteral("Distance")) && m_theatre.click(QStringLiteral("Angle")) &&
               m_theatre.click(QStringLiteral("Reset")) && taken;
    }

    bool armed() { return m_theatre.arm() && take("armed"); }

    bool engaged() { return m_theatre.armAndMove() && take("engaged"); }

    /// Contrast is given, and what it filled stays when it is gone.
    bool roadmap()
    {
        if (!m_theatre.arm())
            return false;
        m_theatre.hold(Qt::Key_G);
        const auto& injections = m_theatre.models().instrument.injections();
        const auto given = [&injections] { return !injections.empty() && injections.back().progress == InjectionProgress::Done; };
        const bool done = until(given);
        m_theatre.release(Qt::Key_G);
        const auto mapped = [this] {
            if (!m_theatre.models().roadmap.isValid())
                m_theatre.click(QStringLiteral("Roadmap"));
            return m_theatre.models().roadmap.isValid();
        };
        const auto* pane = m_theatre.window().findChild<ReferenceImageView*>();
        const auto isTold = [pane] { return pane != nullptr && pane->told().isEmpty(); }; // of what it was made: that goes by itself
        const bool made = done && until(mapped) && until(isTold) && m_theatre.armAndMove() && take("roadmap");
        m_theatre.click(QStringLiteral("Hold"));
        m_theatre.releaseAll();
        return made;
    }

    /// While moving, which is what the guide tells of; and the link stands longer than a picture may be old.
    bool frozen()
    {
        if (!m_theatre.armAndMove())
            return false;
        m_theatre.xray->freeze();
        const auto told = [this] {
            const auto& alarms = m_theatre.models().alarms.alarms();
            const bool stale = std::any_of(alarms.begin(), alarms.end(),
                                           [](const Alarm& alarm) { return alarm.condition == AlarmCondition::PictureStale; });
            return stale && picture() == PictureCondition::Frozen && m_theatre.phase() == PermitPhase::Hold;
        };
        const bool held = until(told);
        QTest::qWait(frozenFor);
        const bool seen = held && take("frozen");
        m_theatre.xray->thaw();
        m_theatre.releaseAll();
        return seen && until([this] { return m_theatre.models().sessions.allOpen(); });
    }

    bool interrupted()
    {
        if (!m_theatre.armAndMove())
            return false;
        m_theatre.robot->freeze();
        const auto* sheet = m_theatre.window().findChild<DiagnosisSheet*>();
        return until([sheet] { return sheet->isVisible() && sheet->pos().isNull(); }) && take("interrupted");
    }

    bool lost()
    {
        const auto told = [this] {
            const auto* incident = m_theatre.models().incidents.ofPair(robotId(), m_theatre.files.idOf("cockpit").value());
            return incident != nullptr && incident->diagnosis && incident->diagnosis->probe != ProbeFinding::NotProbed;
        };
        return until(told) && take("stand-by");
    }

    bool reopened()
    {
        m_theatre.releaseAll();
        m_theatre.robot->thaw();
        auto* sheet = m_theatre.window().findChild<DiagnosisSheet*>();
        if (!m_theatre.click(QStringLiteral("Re-open channel"), sheet))
            return false;
        const auto read = [this] {
            auto* button = m_theatre.button(QStringLiteral("I have read this"));
            return m_theatre.models().incidents.empty() && button != nullptr && button->isEnabled();
        };
        return until(read) && take("away");
    }

    /// Some pictures before the newest, with the pedal up.
    bool review()
    {
        m_theatre.readAccount();
        m_theatre.acknowledgeAlarms();
        const auto quiet = [this] { return m_theatre.models().alarms.alarms().empty(); };
        if (!until(quiet) || !m_theatre.click(QStringLiteral("Review")))
            return false;
        for (int i = 0; i < reviewedBack; ++i)
            m_theatre.click(QStringLiteral("\u25C0"));
        return take("review");
    }

    bool views()
    {
        using Keys = QKeyCombination;
        for (const auto& [keys, name] :
             {std::pair{Keys(Qt::Key_F3), "plots"}, std::pair{Keys(Qt::Key_F4), "log"}, std::pair{Keys(Qt::Key_F6), "conditions"},
              std::pair{Qt::CTRL | Qt::Key_Comma, "preferences"}, std::pair{Keys(Qt::Key_F7), "screens"}}) {
            QTest::keyClick(&m_theatre.window(), keys.key(), keys.keyboardModifiers());
            if (!take(name))
                return false;
        }
        return true;
    }

    QDir m_folder;
    std::vector<std::pair<QString, QImage>> m_taken;
    Theatre m_theatre;
};

QSize sizeFrom(const QByteArray& text)
{
    const auto parts = text.split('x');
    return parts.size() == 2 ? QSize(parts[0].toInt(), parts[1].toInt()) : QSize();
}

} // namespace

int main(int argc, char* argv[])
{
    if (qEnvironmentVariableIsEmpty("QT_QPA_PLATFORM"))
        qputenv("QT_QPA_PLATFORM", "offscreen");
    QApplication application(argc, argv);
    QApplication::setApplicationName(QStringLiteral("liena-console"));
    QApplication::setApplicationVersion(QStringLiteral(LIENA_VERSION));
    theme::apply(application);
    const auto size = argc == 3 ? sizeFrom(argv[2]) : QSize();
    if (size.width() < 800 || size.height() < 450 || !QDir(QString::fromLocal8Bit(argv[1])).exists()) {
        std::fprintf(stderr, "guide_pictures FOLDER WIDTHxHEIGHT: a folder that is there, and a size from 800x450\n");
        return 2;
    }
    SilentVoice voice;
    Photographer photographer(QDir(QString::fromLocal8Bit(argv[1])), size, voice);
    const bool whole = photographer.work();
    if (!photographer.save())
        return 1;
    if (whole)
        return 0;
    std::fprintf(stderr, "guide_pictures: the state after the last picture was not reached: %s\n", qPrintable(photographer.story()));
    return 1;
}
