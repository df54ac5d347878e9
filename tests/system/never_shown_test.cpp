// What must never be shown, or not be shown: another device's picture, a picture or a number that looks live and is not, a reduction that
// nobody is told of. By the pixels of the console's own window.
#include "imaging/live_image_view.hpp"
#include "never_possible_stage.hpp"
#include "widgets/theme.hpp"

#include <QApplication>
#include <QScopeGuard>

using namespace console;
using console::test::logTells;
using console::test::puppetWishes;
using console::test::Theatre;
using liena::Message;
using liena::test::PuppetXray;
using Pictures = PuppetXray::Pictures;
using Stage = console::test::NeverStage;

namespace {

constexpr int patience = Theatre::patience;

const LiveImageView& liveView(Stage& stage) { return *stage.theatre.window().findChild<LiveImageView*>(); }

/// A part of the window as it is painted, with whatever lies over it.
QImage painted(Stage& stage, const QRect& part)
{
    return stage.theatre.window().grab(part).toImage().convertToFormat(QImage::Format_RGB32);
}

QImage paintedLive(Stage& stage)
{
    const auto& view = liveView(stage);
    return painted(stage, {view.mapTo(&stage.theatre.window(), QPoint()), view.size()});
}

/// The plate in the picture's upper left corner, with the word for what the picture is: black and white.
QImage wordOf(Stage& stage)
{
    const auto shot = paintedLive(stage);
    const auto marks = liveView(stage).overlayRegion();
    auto corner = liveView(stage).pictureRect().topLeft();
    while (!marks.contains(corner) && shot.rect().contains(corner))
        corner += {1, 1};
    QRect plate(corner, QSize(1, 1));
    while (marks.contains(plate.bottomLeft() + QPoint(0, 1)))
        plate.setHeight(plate.height() + 1);
    while (marks.contains(plate.topRight() + QPoint(1, 0)))
        plate.setWidth(plate.width() + 1);
    auto word = shot.copy(plate);
    for (int y = 0; y < word.height(); ++y)
        for (int x = 0; x < word.width(); ++x)
            word.setPixel(x, y, qGray(word.pixel(x, y)) > 110 ? qRgb(255, 255, 255) : qRgb(0, 0, 0));
    return word;
}

int countOf(const QImage& image, const QColor& colour)
{
    int count = 0;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            count += image.pixel(x, y) == colour.rgb() ? 1 : 0;
    return count;
}

/// Of the same word: what differs is the picture that shines through the plate.
bool alike(const QImage& a, const QImage& b)
{
    if (a.size() != b.size())
        return false;
    int differing = 0;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x)
            differing += a.pixel(x, y) != b.pixel(x, y) ? 1 : 0;
    return differing * 50 < countOf(a, Qt::white);
}

/// How often light and dark change along the upper edge of the pane's frame: hardly for a solid line, all along for hatching.
int changesAlongFrame(Stage& stage)
{
    const auto shot = paintedLive(stage);
    constexpr int row = 6; // half its width
    int changes = 0;
    for (int x = 1; x < shot.width(); ++x)
        changes += (qGray(shot.pixel(x, row)) > 90) != (qGray(shot.pixel(x - 1, row)) > 90) ? 1 : 0;
    return changes;
}

PictureCondition conditionOf(const Stage& stage)
{
    return stage.theatre.models().picture.reading(std::chrono::steady_clock::now()).condition;
}

/// Under a new press of the pedal: a console that stood still, as one does whose window is looked at here, asks for nothing under the last.
bool showsNew(Stage& stage)
{
    stage.theatre.release(Qt::Key_F);
    stage.theatre.hold(Qt::Key_F);
    const auto before = stage.theatre.models().picture.paintedCount();
    return QTest::qWaitFor([&] { return stage.theatre.models().picture.paintedCount() > before + 3; }, patience);
}

} // namespace

class NeverShownTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase()
    {
        theme::apply(*qobject_cast<QApplication*>(QCoreApplication::instance()));
        m_stage = std::make_unique<Stage>();
        QVERIFY(m_stage->open());
        QVERIFY2(showsNew(*m_stage), qPrintable(m_stage->theatre.story()));
    }

    void cleanupTestCase() { m_stage.reset(); }

    // Rule 6.

    void everyPictureBearsTheWordForWhatItIs()
    {
        Stage& stage = *m_stage;
        const auto wordWith = [&stage](std::string_view source) {
            stage.xray.alterFrame([source](Message& frame) { frame.set("source", source); });
            (void)(showsNew(stage) && QTest::qWaitFor([&stage] { return conditionOf(stage) == PictureCondition::Live; }, patience));
            return wordOf(stage);
        };
        const auto live = wordWith("live");
        QVERIFY(countOf(live, Qt::white) > 20);
        QVERIFY(alike(live, wordWith("live")));
        const auto simulated = wordWith("simulated");
        const auto recorded = wordWith("recorded");
        stage.xray.alterFrame({});
        QVERIFY(countOf(simulated, Qt::white) > 20 && countOf(recorded, Qt::white) > 20);
        QVERIFY(!alike(live, simulated) && !alike(live, recorded) && !alike(simulated, recorded));
    }

    void aPictureThatStopsLooksFrozen()
    {
        Stage& stage = *m_stage;
        stage.xray.alterFrame([](Message& frame) { frame.set("source", std::string_view("live")); });
        QVERIFY(showsNew(stage));
        QTRY_COMPARE_WITH_TIMEOUT(conditionOf(stage), PictureCondition::Live, patience);
        const auto live = wordOf(stage);
        QVERIFY(changesAlongFrame(stage) < 8);
        stage.xray.show(Pictures::None);
        QTRY_COMPARE_WITH_TIMEOUT(conditionOf(stage), PictureCondition::Frozen, patience);
        QVERIFY(changesAlongFrame(stage) > 20);
        QVERIFY(!alike(live, wordOf(stage))); // not LIVE any more
        stage.xray.show(Pictures::Good);
        stage.xray.alterFrame({});
        QVERIFY(showsNew(stage));
    }

    void aNumberThatIsNoLongerToldLooksOld()
    {
        Stage& stage = *m_stage;
        const auto panel = [&stage] { return painted(stage, stage.theatre.window().regionGeometry(Region::Robot)); };
        const auto fresh = [&stage] { return stage.theatre.models().instrument.robotFresh(std::chrono::steady_clock::now()); };
        QTRY_VERIFY_WITH_TIMEOUT(fresh(), patience);
        const auto bright = [&panel] { return countOf(panel(), theme::colour::bright); };
        const auto stale = [&panel] { return countOf(panel(), theme::colour::stale); };
        QTRY_VERIFY_WITH_TIMEOUT(bright() > 100, patience);
        const int before = bright();
        const int staleBefore = stale();
        stage.robot.setSilent(true);
        QTRY_VERIFY_WITH_TIMEOUT(!fresh(), patience);
        QTRY_VERIFY_WITH_TIMEOUT(bright() * 5 < before && stale() > staleBefore + 100, patience);
        stage.robot.setSilent(false);
        QTRY_VERIFY_WITH_TIMEOUT(bright() * 2 > before, patience);
    }

    // Rule 9.

    void aReducedPictureIsAnnounced()
    {
        Stage& stage = *m_stage;
        const auto& theatre = stage.theatre;
        const auto told = [&theatre] {
            const auto& alarms = theatre.models().alarms.alarms();
            return std::any_of(alarms.begin(), alarms.end(), [](const Alarm& alarm) {
                return alarm.condition == AlarmCondition::PictureReduced && alarm.present && alarm.priority == AlarmPriority::Low;
            });
        };
        // Only the mark of a reduction has an alarm's colour on the picture.
        const auto marked = [&stage] { return showsNew(stage) ? countOf(paintedLive(stage), theme::colour::low) : -1; };
        QCOMPARE(marked(), 0);
        QVERIFY(!told());
        stage.xray.alterFrame([](Message& frame) { frame.set("rung", 1).set("rate", 7.5).set("asked_rate", 15.0); });
        QTRY_VERIFY2_WITH_TIMEOUT(told(), qPrintable(theatre.story()), patience);
        QTRY_VERIFY_WITH_TIMEOUT(marked() > 50, patience);
        QVERIFY2(logTells(theatre, QStringLiteral("picture REDUCED 7.5 of 15 /s")), qPrintable(theatre.story()));
        stage.xray.alterFrame({});
        QTRY_VERIFY2_WITH_TIMEOUT(!told(), qPrintable(theatre.story()), patience);
        QTRY_COMPARE_WITH_TIMEOUT(marked(), 0, patience);
        QVERIFY(logTells(theatre, QStringLiteral("picture as asked for again")));
    }

    // Rule 4.

    void nobodyArmsOnAnotherDevicesPicture()
    {
        const auto front = qScopeGuard([this] { m_stage->comeToTheFront(); });
        auto wishes = puppetWishes();
        wishes.secondXray = true;
        Stage stage(wishes);
        PuppetXray second(stage.theatre.files.settingsOf("xray-2"));
        second.setBeam(true);
        stage.xray.show(Pictures::None);
        QVERIFY(stage.open());
        stage.theatre.hold(Qt::Key_F);
        const auto refused = [&stage] { return logTells(stage.theatre, QStringLiteral("pictures of Second C-arm are not shown")); };
        QTRY_VERIFY2_WITH_TIMEOUT(refused(), qPrintable(stage.theatre.story()), patience);
        QVERIFY(stage.staysUnarmed(100));
        QCOMPARE(stage.theatre.models().picture.paintedCount(), quint64{0});

        // With the right one's pictures it can be used; without them nothing of the other one takes their place.
        stage.xray.show(Pictures::Good);
        QVERIFY2(stage.theatre.makeReady(), qPrintable(stage.theatre.story()));
        stage.xray.show(Pictures::None);
        QTRY_VERIFY2_WITH_TIMEOUT(stage.phase() != PermitPhase::Ready, qPrintable(stage.theatre.story()), patience);
        QTRY_COMPARE_WITH_TIMEOUT(conditionOf(stage), PictureCondition::Frozen, patience);
        const auto shown = stage.theatre.models().picture.paintedCount();
        stage.theatre.hold(Qt::Key_R);
        QVERIFY2(stage.staysUnarmed(320), qPrintable(stage.theatre.story()));
        QCOMPARE(stage.robot.armRequests(), 0);
        QCOMPARE(stage.theatre.models().picture.paintedCount(), shown);
        QCOMPARE(conditionOf(stage), PictureCondition::Frozen);
        stage.theatre.releaseAll();
    }

private:
    std::unique_ptr<Stage> m_stage;
};

QTEST_MAIN(NeverShownTest)
#include "never_shown_test.moc"
