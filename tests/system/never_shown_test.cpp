// What must never be shown, or not be shown: another device's picture, a picture, a number or a tip that looks live and is not, a reduction
// that nobody is told of. By the pixels of the console's own window.
#include "gui/shown_texts.hpp"
#include "imaging/live_image_view.hpp"
#include "imaging/scene_view.hpp"
#include "never_possible_stage.hpp"
#include "shown_alarms.hpp"
#include "widgets/diagnosis_sheet.hpp"
#include "widgets/theme.hpp"

#include <QApplication>
#include <QBuffer>
#include <QScopeGuard>

using namespace console;
using console::test::isPresent;
using console::test::logTells;
using console::test::puppetWishes;
using console::test::textsPaintedBy;
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

SceneView& scene(Stage& stage) { return *stage.theatre.window().findChild<SceneView*>(); }

bool sceneSays(Stage& stage, const QString& text)
{
    const auto texts = textsPaintedBy(scene(stage));
    return std::any_of(texts.begin(), texts.end(), [&text](const auto& shown) { return shown.text == text; });
}

/// Nothing else in the scene is green.
int tipPixels(Stage& stage)
{
    const auto drawing = scene(stage).drawing().convertToFormat(QImage::Format_RGB32);
    int count = 0;
    for (int y = 0; y < drawing.height(); ++y)
        for (int x = 0; x < drawing.width(); ++x) {
            const QRgb pixel = drawing.pixel(x, y);
            count += qGreen(pixel) > qRed(pixel) + 20 && qGreen(pixel) > qBlue(pixel) + 20 ? 1 : 0;
        }
    return count;
}

/// In the middle of the vessels that come with the console, so that it is in the picture.
void putTip(Stage& stage, double aside)
{
    stage.robot.alterTip([aside](Message& tip) { tip.set("position", std::vector<double>{3 + aside, 12, -185}); });
}

/// What an X-ray system makes of its picture for a poor line.
void sendAsJpeg(Message& frame)
{
    constexpr int quality = 75;
    const auto raw = frame.get<std::span<const std::byte>>("pixels");
    const int columns = frame.get<int>("columns");
    const QImage picture(reinterpret_cast<const uchar*>(raw.data()), columns, frame.get<int>("rows"), columns, QImage::Format_Grayscale8);
    QByteArray jpeg;
    QBuffer buffer(&jpeg);
    if (!buffer.open(QIODevice::WriteOnly) || !picture.save(&buffer, "JPG", quality))
        qFatal("Qt writes no JPEG here");
    frame.set("encoding", std::string_view("jpeg")).set("quality", quality);
    frame.set("pixels", std::as_bytes(std::span(jpeg.constData(), std::size_t(jpeg.size()))));
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
        m_stage = console::test::openStage();
        QVERIFY(m_stage);
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

    void aTipThatIsNoLongerTrackedIsNotShown()
    {
        Stage& stage = *m_stage;
        putTip(stage, 0);
        QTRY_VERIFY2_WITH_TIMEOUT(tipPixels(stage) > 5, qPrintable(scene(stage).unavailable()), patience);
        QVERIFY(!sceneSays(stage, QStringLiteral("tip not tracked")));
        stage.robot.setTipSilent(true);
        const auto told = [&stage] { return isPresent(stage.theatre, AlarmCondition::TrackerStale, AlarmPriority::Low); };
        QTRY_VERIFY2_WITH_TIMEOUT(told(), qPrintable(stage.theatre.story()), patience);
        QTRY_VERIFY_WITH_TIMEOUT(tipPixels(stage) == 0 && sceneSays(stage, QStringLiteral("tip not tracked")), patience);
        stage.robot.setTipSilent(false);
        QTRY_VERIFY_WITH_TIMEOUT(tipPixels(stage) > 5 && !told(), patience);
        stage.robot.alterTip({});
    }

    /// Where the tip was before an interruption is shown beside where it is, until somebody has read of it.
    void theTipOfBeforeIsMarkedUntilItIsRead()
    {
        Stage& stage = *m_stage;
        auto& theatre = stage.theatre;
        const auto marked = [&stage] { return sceneSays(stage, QStringLiteral("BEFORE")); };
        putTip(stage, 0);
        QTRY_VERIFY_WITH_TIMEOUT(theatre.models().instrument.tip().known(), patience);
        QVERIFY(!marked());
        stage.robot.standStill(std::chrono::milliseconds(4000)); // it is lost after 800 ms, and not waited for after two seconds more
        QTRY_COMPARE_WITH_TIMEOUT(theatre.link("robot"), LinkState::StandBy, patience);
        putTip(stage, 40);
        QVERIFY(!marked()); // the last known place is the only one there is
        const auto slept = stage.robot.turns();
        QTRY_VERIFY_WITH_TIMEOUT(stage.robot.turns() > slept + 10, patience); // and is awake again
        QVERIFY2(theatre.click(QStringLiteral("Re-open channel"), theatre.window().findChild<DiagnosisSheet*>()),
                 qPrintable(theatre.story()));
        QTRY_VERIFY2_WITH_TIMEOUT(marked() && sceneSays(stage, QStringLiteral("NOW")), qPrintable(theatre.story()), patience);
        const auto isRead = [&theatre] {
            theatre.readAccount();
            return theatre.models().interruption.settled();
        };
        QTRY_VERIFY2_WITH_TIMEOUT(isRead(), qPrintable(theatre.story()), patience);
        QTRY_VERIFY_WITH_TIMEOUT(!marked() && !sceneSays(stage, QStringLiteral("NOW")), patience);
        stage.robot.alterTip({});
    }

    // Rule 9.

    void aReducedPictureIsAnnounced_data()
    {
        QTest::addColumn<bool>("lossy");
        QTest::addColumn<QString>("logged");
        QTest::newRow("fewer pictures") << false << QStringLiteral("picture REDUCED 7.5 of 15 /s, raw");
        QTest::newRow("lower quality") << true << QStringLiteral("picture REDUCED 15 of 15 /s, lossy 75");
    }

    void aReducedPictureIsAnnounced()
    {
        QFETCH(bool, lossy);
        QFETCH(QString, logged);
        Stage& stage = *m_stage;
        const auto& theatre = stage.theatre;
        const auto told = [&theatre] { return isPresent(theatre, AlarmCondition::PictureReduced, AlarmPriority::Low); };
        // Only the mark of a reduction has an alarm's colour on the picture.
        const auto marked = [&stage] { return showsNew(stage) ? countOf(paintedLive(stage), theme::colour::low) : -1; };
        QCOMPARE(marked(), 0);
        QVERIFY(!told());
        stage.xray.alterFrame([lossy](Message& frame) {
            frame.set("rung", 1).set("rate", lossy ? 15.0 : 7.5).set("asked_rate", 15.0);
            if (lossy)
                sendAsJpeg(frame);
        });
        QTRY_VERIFY2_WITH_TIMEOUT(told(), qPrintable(theatre.story()), patience);
        QTRY_VERIFY_WITH_TIMEOUT(marked() > 50, patience);
        QVERIFY2(logTells(theatre, logged), qPrintable(theatre.story()));
        stage.xray.alterFrame({});
        QTRY_VERIFY2_WITH_TIMEOUT(!told(), qPrintable(theatre.story()), patience);
        QTRY_COMPARE_WITH_TIMEOUT(marked(), 0, patience);
        QVERIFY(logTells(theatre, QStringLiteral("picture as asked for again")));
    }

    // Rule 6.

    /// Another console or a pedal beside the patient has the beam: that its state cannot be told any more does not end the run.
    void aPictureThatBreaksOffStaysFrozenWhoeverHasThePedal()
    {
        Stage& stage = *m_stage;
        auto& theatre = stage.theatre;
        theatre.releaseAll();
        stage.xray.setBeam(true);
        QTRY_COMPARE_WITH_TIMEOUT(conditionOf(stage), PictureCondition::Live, patience);
        QVERIFY(!theatre.models().xray.pedalDown());
        stage.xray.standStill(std::chrono::milliseconds(4000)); // it is lost after 800 ms, and not waited for after two seconds more
        QTRY_COMPARE_WITH_TIMEOUT(theatre.link("xray"), LinkState::StandBy, patience);
        QVERIFY(!theatre.models().xray.fresh(std::chrono::steady_clock::now()));
        QCOMPARE(conditionOf(stage), PictureCondition::Frozen);
        const auto slept = stage.xray.turns();
        QTRY_VERIFY_WITH_TIMEOUT(stage.xray.turns() > slept + 2, patience); // and is awake again
        QVERIFY2(theatre.click(QStringLiteral("Re-open channel"), theatre.window().findChild<DiagnosisSheet*>()),
                 qPrintable(theatre.story()));
        QTRY_COMPARE_WITH_TIMEOUT(conditionOf(stage), PictureCondition::Live, patience);
        stage.xray.setBeam(false);
        QTRY_COMPARE_WITH_TIMEOUT(conditionOf(stage), PictureCondition::Held, patience);
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
