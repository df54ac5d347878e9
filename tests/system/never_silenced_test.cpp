// What must never be possible with alarms: their sound kept off while the robot is armed, their band behind a view, one that is lost from
// the band or the log, or cleared by a control. Tried through the console's own window.
#include "gui/shown_texts.hpp"
#include "model/log_roles.hpp"
#include "never_possible_stage.hpp"
#include "shown_alarms.hpp"
#include "widgets/alarm_band.hpp"
#include "widgets/log_lines.hpp"
#include "widgets/log_view.hpp"
#include "widgets/theme.hpp"

#include <QApplication>
#include <QImage>
#include <QLabel>
#include <QPixmap>
#include <QRegularExpression>
#include <QScopeGuard>
#include <QTemporaryDir>

using namespace console;
using console::test::controlsOf;
using console::test::isPresent;
using console::test::present;
using console::test::textsPaintedBy;
using console::test::Theatre;
using liena::Message;
using C = AlarmCondition;
using Stage = console::test::NeverStage;
using Pictures = liena::test::PuppetXray::Pictures;

namespace {

constexpr int patience = Theatre::patience;

bool soundPaused(const Stage& stage) { return stage.theatre.models().alarms.audioPauseLeft(std::chrono::steady_clock::now()).has_value(); }

/// Presses F9, unless it is paused; while armed a pause waits until the last is some seconds past.
bool pausesSound(Stage& stage)
{
    if (!soundPaused(stage))
        stage.theatre.strike(Qt::Key_F9);
    return soundPaused(stage);
}

int pixelsOf(const QImage& image, const QColor& colour)
{
    int count = 0;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            count += image.pixelColor(x, y) == colour ? 1 : 0;
    return count;
}

/// All at once, and nothing of it ends motion while armed: by then a force is told below the one that does.
void causeAlarms(Stage& stage, bool armed)
{
    const double force = armed ? 1.4 : 2.3;
    stage.robot.alterStatus(
        [force](Message& m) { m.set("guidewire_force", force).set("contrast_remaining", 3.0).set("limit_switches", 8U); });
    stage.robot.alterTip([](Message& m) { m.set("valid", false); });
    stage.xray.alterStatus([](Message& m) { m.set("air_kerma", 3100.0).set("fluoroscopy_time", 301.0); });
}

void endCauses(Stage& stage)
{
    stage.robot.alterStatus({});
    stage.robot.alterTip({});
    stage.xray.alterStatus({});
}

/// What is to be told of that.
std::vector<C> alarmsOf(bool armed)
{
    std::vector<C> all{C::TrackerStale, C::ContrastLow, C::AirKerma, C::FluoroscopyTime};
    if (armed)
        all.insert(all.end(), {C::ForceWarn, C::HardLimit});
    else
        all.push_back(C::ForceStop);
    return all;
}

/// Present or not: what latches stays until somebody has seen it.
bool isListed(const Theatre& theatre, C condition)
{
    const auto& all = theatre.models().alarms.alarms();
    return std::any_of(all.begin(), all.end(), [condition](const Alarm& one) { return one.condition == condition; });
}

AlarmBand& bandOf(Theatre& theatre) { return *theatre.window().findChild<AlarmBand*>(); }

/// Beside the highest, which it paints cut where it must be, as many as there are, painted or counted; each of them in its tool tip.
bool bandTellsAll(Theatre& theatre)
{
    auto& band = bandOf(theatre);
    QStringList painted;
    for (const auto& shown : textsPaintedBy(band))
        painted << shown.text;
    const auto words = painted.join(QLatin1Char(' ')).simplified();
    const auto& alarms = theatre.models().alarms.alarms();
    if (alarms.empty())
        return false;
    const auto beside = std::count_if(alarms.begin() + 1, alarms.end(), [&words](const Alarm& one) { return words.contains(one.text); });
    const int more = QRegularExpression(QStringLiteral("\\+(\\d+) more")).match(words).captured(1).toInt();
    return 1 + beside + more == std::ssize(alarms) && std::all_of(alarms.begin(), alarms.end(), [&band](const Alarm& one) {
               return band.toolTip().contains(one.text.toHtmlEscaped());
           });
}

/// It says so, and nothing lies over it.
bool bandShows(Theatre& theatre, const QString& text)
{
    const QRect place = theatre.window().regionGeometry(Region::Alarm);
    const auto& band = bandOf(theatre);
    const QWidget* uppermost = theatre.window().childAt(place.left() + place.width() / 8, place.center().y()); // left of its buttons
    return band.isVisible() && uppermost == &band && band.accessibleDescription().contains(text);
}

QStringList textsOf(const QAbstractItemModel& lines)
{
    QStringList texts;
    for (int row = 0; row < lines.rowCount(); ++row)
        texts << lines.index(row, 0).data(LogTextRole).toString();
    return texts;
}

/// The alarm log as its page has it; empty where that says that there are more or fewer lines.
QStringList shownLog(Theatre& theatre)
{
    theatre.strike(Qt::Key_F1);
    theatre.strike(Qt::Key_F4);
    auto* page = theatre.window().findChild<LogView*>();
    if (!theatre.click(QStringLiteral("Alarms"), page))
        return {};
    const auto texts = textsOf(*page->findChild<LogLines*>()->model());
    const auto labels = page->findChildren<QLabel*>();
    const auto count = QStringLiteral("%1 lines").arg(texts.size());
    const bool said = std::any_of(labels.begin(), labels.end(), [&count](const QLabel* one) { return one->text() == count; });
    theatre.strike(Qt::Key_F1);
    return said ? texts : QStringList();
}

/// Into one of the person's own folders.
bool writesAFile(const QWidget& control) { return control.accessibleName() == QStringLiteral("Write the lines shown into the file"); }

} // namespace

class NeverSilencedTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase()
    {
        auto wishes = console::test::puppetWishes();
        wishes.preferences.pictureFolder = m_pictures.path(); // Save is pressed, too
        m_stage = console::test::openStage(wishes);
        QVERIFY(m_stage);
    }

    void cleanupTestCase() { m_stage.reset(); }

    // Rule 10.

    void noViewHidesAnAlarm()
    {
        Stage& stage = *m_stage;
        auto& window = stage.theatre.window();
        const QRect place = window.regionGeometry(Region::Alarm);
        const auto coloured = [&window, &place] { return pixelsOf(window.grab(place).toImage(), theme::colour::medium); };
        const auto forceStop = [&stage] { return isPresent(stage.theatre, AlarmCondition::ForceStop, AlarmPriority::Medium); };
        QVERIFY(!forceStop());
        const auto back = qScopeGuard([&stage] { stage.robot.setForce(0); });
        stage.robot.setForce(2.3);
        QTRY_VERIFY2_WITH_TIMEOUT(forceStop(), qPrintable(stage.theatre.story()), patience);
        const int much = place.width() * place.height() / 4; // between buttons and words
        QTRY_VERIFY2_WITH_TIMEOUT(coloured() > much, qPrintable(QString::number(coloured())), patience);
        const int most = coloured() * 3 / 4; // its badge flashes, and a button of the band may come or go
        for (const auto view : {View::Topology, View::Plots, View::Log, View::Start, View::About, View::Preferences, View::Screens,
                                View::Checklist, View::Cockpit}) {
            window.showView(view);
            QCoreApplication::processEvents(); // what has yet to be laid out is
            QVERIFY2(coloured() > most, qPrintable(QString::number(int(view))));
        }
        stage.robot.setForce(0);
        QTRY_VERIFY2_WITH_TIMEOUT(!forceStop(), qPrintable(stage.theatre.story()), patience);
        stage.comeToTheFront();
    }

    void aHighAlarmIsNotSilencedBeforehand()
    {
        Stage& stage = *m_stage;
        const auto& alarms = stage.theatre.models().alarms;
        QVERIFY2(stage.theatre.arm(), qPrintable(stage.theatre.story()));
        stage.theatre.hold(Qt::Key_D);
        QTRY_COMPARE_WITH_TIMEOUT(stage.phase(), PermitPhase::Engaged, patience);
        QTRY_VERIFY2_WITH_TIMEOUT(pausesSound(stage), qPrintable(stage.theatre.story()), patience);
        stage.xray.show(Pictures::None);
        QTRY_VERIFY2_WITH_TIMEOUT(alarms.unacknowledgedHigh(), qPrintable(stage.theatre.story()), patience);
        QVERIFY(!soundPaused(stage)); // it ends the pause
        QVERIFY(!stage.mayMove());
        stage.xray.show(Pictures::Good);
        stage.theatre.releaseAll();
    }

    /// Pause, end, pause: each press by itself is allowed, and all together would be silence for good.
    void soundIsNotKeptOffByPressingAgain()
    {
        Stage& stage = *m_stage;
        const auto& alarms = stage.theatre.models().alarms;
        QTRY_VERIFY_WITH_TIMEOUT(alarms.audibleForLong(std::chrono::steady_clock::now()), patience); // the last pause is long over
        QVERIFY2(stage.theatre.arm(), qPrintable(stage.theatre.story()));
        QTRY_VERIFY2_WITH_TIMEOUT(pausesSound(stage), qPrintable(stage.theatre.story()), patience);
        stage.theatre.strike(Qt::Key_F9);
        QVERIFY(!soundPaused(stage));
        for (int i = 0; i < 20; ++i) {
            stage.theatre.strike(Qt::Key_F9);
            QVERIFY2(!soundPaused(stage), qPrintable(stage.theatre.story()));
        }
        QVERIFY2(stage.mayMove(), qPrintable(stage.theatre.story())); // it was armed all the time
        stage.theatre.releaseAll();
    }

    void noAlarmIsLostFromTheBandOrTheLog_data()
    {
        QTest::addColumn<bool>("armed");
        QTest::newRow("not armed") << false;
        QTest::newRow("armed") << true;
    }

    /// Several come at once, end, and come again at once.
    void noAlarmIsLostFromTheBandOrTheLog()
    {
        QFETCH(bool, armed);
        constexpr int times = 3;
        Stage& stage = *m_stage;
        auto& theatre = stage.theatre;
        const auto expected = alarmsOf(armed);
        const auto every = [&](bool there) {
            return std::all_of(expected.begin(), expected.end(), [&](C one) { return (present(theatre, one) != nullptr) == there; });
        };
        const auto back = qScopeGuard([&stage] { endCauses(stage); });
        QVERIFY2(armed ? theatre.arm() : theatre.makeReady(), qPrintable(theatre.story()));
        QTRY_VERIFY2_WITH_TIMEOUT(every(false), qPrintable(theatre.story()), patience);
        const auto before = textsOf(theatre.models().alarmLog);
        QStringList texts;
        for (int i = 0; i < times; ++i) {
            causeAlarms(stage, armed);
            QTRY_VERIFY2_WITH_TIMEOUT(every(true), qPrintable(theatre.story()), patience);
            QVERIFY2(bandTellsAll(theatre), qPrintable(bandOf(theatre).accessibleDescription()));
            if (texts.isEmpty())
                for (const auto one : expected)
                    texts << present(theatre, one)->text;
            endCauses(stage);
            QTRY_VERIFY2_WITH_TIMEOUT(every(false), qPrintable(theatre.story()), patience);
        }
        // What was given, or stopped motion, is to be seen by somebody.
        std::vector<C> latched{C::AirKerma, C::FluoroscopyTime};
        if (!armed)
            latched.push_back(C::ForceStop);
        for (const auto one : latched)
            QVERIFY2(isListed(theatre, one), qPrintable(theatre.story()));
        QVERIFY2(bandTellsAll(theatre), qPrintable(bandOf(theatre).accessibleDescription()));
        const auto seen = [&] { // one after the other
            if (auto* button = theatre.button(QStringLiteral("Acknowledge")); button != nullptr && button->isEnabled())
                QTest::mouseClick(button, Qt::LeftButton);
            return std::none_of(latched.begin(), latched.end(), [&theatre](C one) { return isListed(theatre, one); });
        };
        QTRY_VERIFY2_WITH_TIMEOUT(seen(), qPrintable(theatre.story()), patience);
        const auto shown = shownLog(theatre);
        for (const auto& text : texts)
            for (const auto* what : {"raised: ", "ended: "}) {
                const QString line = QLatin1String(what) + text;
                const auto told = shown.count(line) - before.count(line);
                QVERIFY2(told == times, qPrintable(QStringLiteral("%1 times %2").arg(told).arg(line)));
            }
        theatre.releaseAll();
    }

    /// Whatever is pressed: what is there stays in the band, and the log only grows.
    void noControlClearsOrHidesAnAlarm()
    {
        Stage& stage = *m_stage;
        auto& theatre = stage.theatre;
        const auto& log = theatre.models().alarmLog;
        const auto back = qScopeGuard([&stage] { endCauses(stage); });
        // The dose that was given stays given, whichever link is closed in passing.
        stage.xray.alterStatus([](Message& m) { m.set("air_kerma", 5100.0); });
        const auto there = [&theatre] { return isPresent(theatre, C::AirKerma, AlarmPriority::Medium); };
        QTRY_VERIFY2_WITH_TIMEOUT(there(), qPrintable(theatre.story()), patience);
        const auto text = present(theatre, C::AirKerma)->text;
        int tried = 0;
        for (const auto view : {View::Cockpit, View::Log}) {
            theatre.window().showView(view);
            for (const auto& control : controlsOf(theatre.window())) {
                theatre.window().showView(view); // what was pressed last may have brought another
                if (!control || !control->isVisible() || !control->isEnabled() || writesAFile(*control))
                    continue;
                const auto name = control->accessibleName();
                const int lines = log.rowCount();
                QTest::mouseClick(control, Qt::LeftButton);
                ++tried;
                QVERIFY(stage.settles()); // what came of it is told
                QVERIFY2(there() && bandShows(theatre, text), qPrintable(name));
                QVERIFY2(log.rowCount() >= lines, qPrintable(name));
            }
        }
        QVERIFY(tried > 20);
        const auto shown = shownLog(theatre);
        QCOMPARE(shown, textsOf(log));
        QVERIFY(shown.contains(QStringLiteral("raised: ") + text));
    }

private:
    QTemporaryDir m_pictures;
    std::unique_ptr<Stage> m_stage;
};

QTEST_MAIN(NeverSilencedTest)
#include "never_silenced_test.moc"
