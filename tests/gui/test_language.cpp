// Every state of the gallery in a language that takes 40 % more room, and in Chinese: nothing clipped, nothing painted over.
#include "app/language.hpp"
#include "gallery_scene.hpp"
#include "link/library_words.hpp"
#include "pseudo_language.hpp"
#include "shown_texts.hpp"
#include "unit/console/alarm_cases.hpp"
#include "widgets/alarm_band.hpp"
#include "widgets/stop_button.hpp"
#include "widgets/theme.hpp"

#include <QApplication>
#include <QFile>
#include <QFontDatabase>
#include <QGraphicsScene>
#include <QGraphicsView>
#include <QLabel>
#include <QScrollArea>
#include <QSet>
#include <QSignalSpy>
#include <QTest>
#include <QTranslator>
#include <QXmlStreamReader>

using namespace console;
using namespace console::test;

namespace {

/// As bad as it can be at once.
AlarmReadings everythingWrong()
{
    AlarmReadings bad;
    bad.armed = bad.engaged = bad.robotFresh = bad.drivesKnown = bad.emergencyStop = bad.trackerOverdue = bad.contrastRanDry = true;
    AlarmLinkReading link;
    link.peer = 1;
    link.title = QStringLiteral("Vascular robot");
    link.state = LinkState::StandBy;
    link.suspectsInMinute = 9;
    link.deadlineMissed = QStringLiteral("RobotStatus");
    link.jittery = link.lossy = link.clockUncertain = true;
    link.images = link.systemDiffers = true;
    link.commandRoundTrip = std::chrono::milliseconds(900);
    bad.links = {link, link};
    bad.links[1].state = LinkState::Open;
    bad.awaitingHold = std::chrono::seconds(1);
    bad.picture.condition = PictureCondition::Frozen;
    bad.pictureLimit = std::chrono::milliseconds(250);
    bad.force = 9;
    bad.faultCode = 2;
    bad.drivesHealthy = false;
    bad.limitSwitches = 0xFFFF;
    bad.airKerma = 5000;
    bad.painting = PaintingReading{15, 3};
    bad.recorderTroubles = QStringList{QStringLiteral("alarms-0x40018208.jsonl: No space left on device"),
                                       QStringLiteral("the audit file is not written: No space left on device")};
    bad.soundTrouble = QCoreApplication::translate("console::BurstPlayer", "the sound output does not take what is sent to it");
    bad.watchdogTrouble = QCoreApplication::translate("console::WatchdogProcess", "its watchdog does not answer");
    return bad;
}

/// What alarms have to say beside what each of them says first.
const std::vector<AlarmChange>& furtherTexts()
{
    static const std::vector<AlarmChange> all = [] {
        std::vector<AlarmChange> changes{
            [](AlarmReadings& r) { r.links[0].state = LinkState::Reconnecting; },
            [](AlarmReadings& r) {
                r.links[0].state = LinkState::Reconnecting;
                r.links[0].images = true;
            },
            [](AlarmReadings& r) { r.picture.condition = PictureCondition::Unknown; },
            [](AlarmReadings& r) {
                r.picture.overdue = true;
                r.picture.refusal = QStringLiteral("the JPEG-LS picture is 1024 x 1024, the message says 512 x 512");
            },
            [](AlarmReadings& r) { r.armFault = true; },
            [](AlarmReadings& r) { r.driveOff = true; },
            [](AlarmReadings& r) { r.drivesHealthy = false; },
            [](AlarmReadings& r) { r.faultCode = 3; },
        };
        for (const char* message : {"TipPose", "DriveStatus", "TravelLimits", "AcquisitionStatus", "ArmStatus"})
            changes.push_back([message](AlarmReadings& r) { r.links[0].deadlineMissed = QString::fromLatin1(message); });
        return changes;
    }();
    return all;
}

/// All at once, then each alone, armed and not.
std::vector<AlarmReadings> wrongReadings()
{
    std::vector<AlarmReadings> all{everythingWrong()};
    const auto add = [&all](const AlarmChange& change) {
        for (const bool armed : {true, false}) {
            auto readings = calmReadings();
            readings.links[0].title = QStringLiteral("Vascular robot");
            readings.armed = readings.engaged = armed;
            change(readings);
            all.push_back(readings);
        }
    };
    for (const AlarmCase& one : alarmCases())
        add(one.change);
    for (const AlarmChange& change : furtherTexts())
        add(change);
    return all;
}

std::vector<AlarmReport> reportsOf(const std::vector<AlarmReadings>& all)
{
    std::vector<AlarmReport> reports;
    for (const AlarmReadings& readings : all)
        for (const AlarmReport& report : presentAlarms(readings))
            reports.push_back(report);
    return reports;
}

/// Hears which texts a part of the program asks to be translated, and translates none.
class Listener : public QTranslator {
public:
    explicit Listener(const char* part) : m_part(part) {}

    mutable QSet<QString> heard;

    bool isEmpty() const override { return false; }
    QString translate(const char* context, const char* source, const char*, int) const override
    {
        if (m_part == QLatin1String(context))
            heard.insert(QString::fromUtf8(source));
        return {};
    }

private:
    QLatin1String m_part;
};

/// All texts of a part of the program that are translated into Chinese.
QSet<QString> textsOf(const QString& part)
{
    QFile file(QStringLiteral(LIENA_SOURCE_DIR "/resources/translations/liena-console_zh_CN.ts"));
    QSet<QString> texts;
    if (!file.open(QIODevice::ReadOnly))
        return texts;
    QXmlStreamReader xml(&file);
    bool inPart = false;
    while (!xml.atEnd()) {
        if (xml.readNext() != QXmlStreamReader::StartElement)
            continue;
        if (xml.name() == QLatin1String("name"))
            inPart = xml.readElementText() == part;
        else if (inPart && xml.name() == QLatin1String("source"))
            texts.insert(xml.readElementText());
    }
    return texts;
}

} // namespace

class TestLanguage : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase() { theme::apply(*qApp); }

    void seesWhatIsClipped()
    {
        QWidget window;
        auto* label = new QLabel(QStringLiteral("a text that is longer than its label"), &window);
        label->setGeometry(0, 0, 60, 30);
        window.resize(400, 100);
        window.show();
        QCOMPARE(unreadableTexts(window).size(), 2); // by its size, and by what the painter lets through
        label->resize(label->sizeHint());
        QCOMPARE(unreadableTexts(window), QStringList());
    }

    /// Painted texts would fall on their values, and the buttons of the alarm band on its text.
    void noPlaceIsMirrored()
    {
        PseudoLanguage pseudo;
        QVERIFY(QApplication::installTranslator(&pseudo));
        QCOMPARE(QGuiApplication::tr("QT_LAYOUT_DIRECTION"), QStringLiteral("RTL"));
        QCOMPARE(QGuiApplication::layoutDirection(), Qt::LeftToRight);
        GalleryScene scene(QSize(1920, 1080));
        QVERIFY(scene.bring(galleryStates().front(), 0));
        for (const QWidget* widget : scene.window().findChildren<QWidget*>())
            QCOMPARE(widget->layoutDirection(), Qt::LeftToRight);
    }

    void longerTextsFit_data() { states(); }

    void longerTextsFit()
    {
        PseudoLanguage pseudo;
        QVERIFY(QApplication::installTranslator(&pseudo));
        lookAt();
    }

    void everyAlarmIsWholeInTheBand_data()
    {
        QTest::addColumn<QSize>("band");
        QTest::newRow("at 1440") << QSize(2560, 56);
        QTest::newRow("at 1080") << QSize(1920, 42);
    }

    void everyAlarmIsWholeInTheBand()
    {
        PseudoLanguage pseudo;
        QVERIFY(QApplication::installTranslator(&pseudo));
        lookAtAlarms();
    }

    void noTextOfAnAlarmIsForgotten()
    {
        const QString part = QStringLiteral("console::AlarmRules");
        Listener listener("console::AlarmRules");
        QVERIFY(QCoreApplication::installTranslator(&listener));
        (void)reportsOf(wrongReadings());
        QCoreApplication::removeTranslator(&listener);
        const auto texts = textsOf(part);
        QVERIFY(texts.size() > 60);
        const auto forgotten = QSet<QString>(texts).subtract(listener.heard).values();
        QVERIFY2(forgotten.isEmpty(), qPrintable(forgotten.join(QLatin1Char('\n'))));
    }

    void systemsLanguageIsFoundByItsScript()
    {
        QCOMPARE(spokenOf({QStringLiteral("zh-Hans-CN")}), QStringLiteral("zh_CN"));
        QCOMPARE(spokenOf({QStringLiteral("zh-SG")}), QStringLiteral("zh_CN"));
        QCOMPARE(spokenOf({QStringLiteral("zh-TW")}), QStringLiteral("en"));
        QCOMPARE(spokenOf({QStringLiteral("de-DE"), QStringLiteral("zh-CN")}), QStringLiteral("zh_CN"));
        QCOMPARE(spokenOf({QStringLiteral("en-GB"), QStringLiteral("zh-CN")}), QStringLiteral("en"));
        QCOMPARE(spokenOf({QStringLiteral("C")}), QStringLiteral("en"));
        QCOMPARE(spokenOf({}), QStringLiteral("en"));
    }

    void theLibrarysOwnSentenceIsShownInEnglish()
    {
        QCOMPARE(words(liena::Error{liena::Errc::Busy, "robot is being opened"}), QStringLiteral("robot is being opened"));
    }

    // From here on the program speaks Chinese.
    void speaksChinese()
    {
        QVERIFY2(!QFontDatabase::families(QFontDatabase::SimplifiedChinese).isEmpty(),
                 "no typeface with Chinese: the console's own is not in the program");
        QCOMPARE(languages(), QStringList({QStringLiteral("en"), QStringLiteral("zh_CN")}));
        QCOMPARE(speak(QStringLiteral("zh_CN")), QString());
        QCOMPARE(word(LinkState::StandBy), QStringLiteral("\u5F85\u673A"));
        QCOMPARE(word(PermitPhase::Armed), word(RobotState::Armed));
    }

    void whatTheLibrarySaysIsChinese()
    {
        const auto chinese = [](const QString& text) {
            return std::any_of(text.begin(), text.end(), [](QChar c) { return c.script() == QChar::Script_Han; });
        };
        for (int reason = 0; liena::toString(static_cast<liena::RejectReason>(reason)) != "unknown"; ++reason)
            QVERIFY2(chinese(words(static_cast<liena::RejectReason>(reason))), qPrintable(QString::number(reason)));
        for (int probe = 0; liena::toString(static_cast<liena::ProbeResult>(probe)) != "unknown"; ++probe)
            QVERIFY2(chinese(words(static_cast<liena::ProbeResult>(probe))), qPrintable(QString::number(probe)));
        for (int code = 1; liena::toString(static_cast<liena::Errc>(code)) != "unknown error"; ++code) {
            const QString said = words(liena::Error{static_cast<liena::Errc>(code), "robot: port 52110"});
            QVERIFY2(chinese(said) && said.contains(QStringLiteral("robot: port 52110")), qPrintable(said));
        }
    }

    // What goes over the wire: a robot's log and its limit of length know one language.
    void emergencyStopIsToldInEnglish()
    {
        GalleryScene scene(QSize(1920, 1080));
        QVERIFY(scene.bring(galleryStates().front(), 0));
        const QSignalSpy told(&scene.window(), &CockpitWindow::emergencyStopRequested);
        QTest::keyClick(&scene.window(), Qt::Key_Escape);
        QTest::mousePress(scene.window().findChild<StopButton*>(), Qt::LeftButton);
        QCOMPARE(told.size(), 2);
        for (const auto& stop : told) {
            const auto reason = stop.front().toString();
            QCOMPARE(QString::fromLatin1(reason.toLatin1()), reason);
            QVERIFY2(reason.size() <= 40, qPrintable(reason));
        }
    }

    void chineseFits_data() { states(); }
    void chineseFits() { lookAt(); }

    void everyAlarmIsWholeInChinese_data() { everyAlarmIsWholeInTheBand_data(); }
    void everyAlarmIsWholeInChinese() { lookAtAlarms(); }

private:
    /// Each alarm alone, with its remedy.
    static void lookAtAlarms()
    {
        QFETCH(QSize, band);
        AlarmBand shown;
        theme::applyScale(&shown, band.width() / 2560.0);
        shown.resize(band);
        shown.show();
        const auto reports = reportsOf(wrongReadings());
        QVERIFY(reports.size() > 50);
        std::vector<std::pair<AlarmReport, bool>> all; // what latches is also shown when it has ended
        for (const AlarmReport& report : reports)
            for (const bool ended : {false, true})
                if (!ended || report.latching)
                    all.emplace_back(report, !ended);
        for (const auto& [report, present] : all) {
            Alarm alarm;
            alarm.present = present;
            alarm.endedWallMs = 1; // long ago: with its date
            alarm.id = 1;
            alarm.condition = report.condition;
            alarm.priority = report.priority;
            alarm.text = report.text;
            alarm.remedy = report.remedy;
            shown.setAlarms({alarm});
            shown.setSound(true, std::nullopt);
            QStringList wrong;
            const bool whole = QTest::qWaitFor([&] { return (wrong = unreadableTexts(shown)).isEmpty(); }, 200);
            QVERIFY2(whole, qPrintable(alarm.text + QStringLiteral(": ") + wrong.join(QLatin1Char('\n'))));
        }
    }

    static void states()
    {
        QTest::addColumn<QSize>("screen");
        QTest::addColumn<int>("state");
        int row = 0;
        for (const GalleryState& state : galleryStates()) {
            for (const QSize& screen : {QSize(2560, 1440), QSize(1920, 1080)})
                QTest::newRow(qPrintable(QStringLiteral("%1 at %2").arg(QString::fromLatin1(state.name)).arg(screen.height())))
                    << screen << row;
            ++row;
        }
    }

    static void lookAt()
    {
        QFETCH(QSize, screen);
        QFETCH(int, state);
        GalleryScene scene(screen);
        QVERIFY(scene.bring(galleryStates().at(std::size_t(state)), 0));
        QStringList wrong;
        const bool whole = QTest::qWaitFor([&] { return (wrong = unreadableTexts(scene.window())).isEmpty(); }, 500);
        QVERIFY2(whole, qPrintable(wrong.join(QLatin1Char('\n'))));
        // It scrolls down only: what is beyond its edge is cut.
        for (const QScrollArea* area : scene.window().findChildren<QScrollArea*>())
            QVERIFY2(!area->isVisible() || area->widget()->width() <= area->viewport()->width(), qPrintable(area->accessibleName()));
        for (const QGraphicsView* canvas : scene.window().findChildren<QGraphicsView*>()) {
            const QRectF shown = canvas->sceneRect().adjusted(-16, -16, 16, 16); // the room that a link asks for around its line
            const QRectF items = canvas->scene()->itemsBoundingRect();
            QVERIFY2(shown.contains(items), qPrintable(QStringLiteral("%1: the items end at %2, the scene at %3")
                                                           .arg(canvas->accessibleName())
                                                           .arg(items.right())
                                                           .arg(shown.right())));
        }
    }
};

QTEST_MAIN(TestLanguage)
#include "test_language.moc"
