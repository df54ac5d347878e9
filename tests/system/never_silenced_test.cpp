// What must never be possible with alarms: their sound kept off while the robot is armed, their band behind a view. Tried through the
// console's own window.
#include "never_possible_stage.hpp"
#include "shown_alarms.hpp"
#include "widgets/theme.hpp"

#include <QApplication>
#include <QImage>
#include <QPixmap>

using namespace console;
using console::test::isPresent;
using console::test::Theatre;
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

} // namespace

class NeverSilencedTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase()
    {
        m_stage = console::test::openStage();
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

private:
    std::unique_ptr<Stage> m_stage;
};

QTEST_MAIN(NeverSilencedTest)
#include "never_silenced_test.moc"
