// The start page and "About": what they say, where they lie, and how they go.
#include "cockpit_stage.hpp"
#include "widgets/about_view.hpp"
#include "widgets/start_view.hpp"

#include <QLabel>
#include <QPushButton>
#include <QSignalSpy>

using namespace console;
using namespace console::test;

namespace {

struct Started : CockpitStage {
    StartView* start;
    AboutView* about;

    explicit Started(const QSize& size = {1920, 1080}, const ProgramFacts& program = {QStringLiteral("1.2.3"), QStringLiteral("Dr Wu"), {}})
        : CockpitStage(size), start(new StartView(cockpit.models, program)), about(new AboutView(cockpit.models, program))
    {
        window.addView(View::Start, start);
        window.addView(View::About, about);
        QObject::connect(start, &StartView::leaveRequested, &window, [this] { window.showView(View::Cockpit); });
        QObject::connect(start, &StartView::aboutRequested, &window, [this] { window.showView(View::About); });
        QObject::connect(about, &AboutView::leaveRequested, &window, [this] { window.showView(View::Cockpit); });
    }

    bool shown()
    {
        if (!ready())
            return false;
        window.showView(View::Start);
        return start->isVisible();
    }

    static QString words(const QWidget* view)
    {
        QStringList words;
        for (const QLabel* label : view->findChildren<QLabel*>())
            if (label->isVisibleTo(view))
                words << label->text();
        return words.join(QLatin1Char('\n'));
    }
};

} // namespace

class TestStartView : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase() { theme::apply(*qApp); }

    void saysWhatItIsAndHowToBegin()
    {
        Started stage;
        QVERIFY(stage.shown());
        const QString words = Started::words(stage.start);
        for (const char* part : {"Not a medical device", "1.2.3", "Dr Wu", "Remote vascular intervention", "9f3c1a", "Keyboard (in use)",
                                 "nobody has tested it", "--help", "F8", "F2", "Open all"})
            QVERIFY2(words.contains(QString::fromLatin1(part)), part);
    }

    /// The most urgent key of all is looked for where keys stand.
    void theEmergencyStopsKeyHasItsOwnRow()
    {
        Started stage;
        QVERIFY(stage.shown());
        const QLabel* key = nullptr;
        const QLabel* words = nullptr;
        for (const QLabel* label : stage.start->findChildren<QLabel*>()) {
            if (label->text() == QLatin1String("Esc"))
                key = label;
            if (label->text().startsWith(QStringLiteral("Emergency stop")))
                words = label;
        }
        QVERIFY(key && words);
        QTRY_COMPARE(words->y(), key->y());
        QVERIFY(words->x() > key->geometry().right());
    }

    void whatIsNotKnownIsSaidToBe()
    {
        InventedCockpit cockpit;
        cockpit.models.sessions.setTopology({});
        cockpit.models.hand.setMasters({});
        int unknown = 0;
        for (const Fact& fact : presentFacts(cockpit.models, {}))
            unknown += fact.known ? 0 : 1;
        QCOMPARE(unknown, 6);
    }

    void soundIsKnownAfterTheTestAndWhenItFails()
    {
        InventedCockpit cockpit;
        const auto sound = [&] {
            for (const Fact& fact : presentFacts(cockpit.models, {}))
                if (fact.name == QStringLiteral("Alarm sound"))
                    return fact.text;
            return QString();
        };
        cockpit.testAlarms();
        QVERIFY2(sound().contains(QStringLiteral("seen and heard")), qPrintable(sound()));
        cockpit.models.alarms.update({{AlarmCondition::SoundFailed, 0, AlarmPriority::Low, false, QStringLiteral("no sound"), {}}},
                                     cockpit.now, 0);
        QVERIFY2(sound().contains(QStringLiteral("DOES NOT WORK")), qPrintable(sound()));
    }

    void goesByItsButtonByEnterAndByF1_data()
    {
        QTest::addColumn<QString>("way");
        for (const char* way : {"button", "Enter", "F1"})
            QTest::newRow(way) << QString::fromLatin1(way);
    }

    void goesByItsButtonByEnterAndByF1()
    {
        QFETCH(QString, way);
        Started stage;
        QVERIFY(stage.shown());
        QVERIFY(!stage.window.handHasKeys());
        if (way == QLatin1String("button"))
            QTest::mouseClick(stage.named<QPushButton>(QStringLiteral("Leave the start page")), Qt::LeftButton);
        else
            QTest::keyClick(QApplication::focusWidget(), way == QLatin1String("F1") ? Qt::Key_F1 : Qt::Key_Return);
        QVERIFY(!stage.start->isVisible());
        QVERIFY(stage.window.handHasKeys());
    }

    void escapeIsTheEmergencyStopAndNothingElse()
    {
        Started stage;
        QVERIFY(stage.shown());
        QSignalSpy stop(&stage.window, &CockpitWindow::emergencyStopRequested);
        QTest::keyClick(QApplication::focusWidget(), Qt::Key_Escape);
        QCOMPARE(stop.count(), 1);
        QVERIFY(stage.start->isVisible());
    }

    void goesByItselfWhenTheFirstSessionOpens()
    {
        Started stage;
        QVERIFY(stage.shown());
        stage.cockpit.models.sessions.setLinkState(robotId, LinkState::Opening, stage.cockpit.now);
        QVERIFY(stage.start->isVisible());
        stage.cockpit.models.sessions.setLinkState(robotId, LinkState::Open, stage.cockpit.now);
        QVERIFY(!stage.start->isVisible());
        QCOMPARE(stage.window.view(), View::Cockpit);
    }

    void otherViewsStayWhenASessionOpens()
    {
        Started stage;
        QVERIFY(stage.shown());
        QTest::keyClick(QApplication::focusWidget(), Qt::Key_F2);
        stage.cockpit.models.sessions.setLinkState(robotId, LinkState::Open, stage.cockpit.now);
        QCOMPARE(stage.window.view(), View::Topology);
    }

    void leavesImageAlarmsAndMotion_data()
    {
        QTest::addColumn<QSize>("screen");
        QTest::addColumn<bool>("about");
        for (const bool about : {false, true})
            for (const QSize& screen : {QSize(2560, 1440), QSize(1920, 1080), QSize(1366, 768)})
                QTest::newRow(
                    qPrintable(QStringLiteral("%1 %2").arg(about ? QStringLiteral("about") : QStringLiteral("start")).arg(screen.height())))
                    << screen << about;
    }

    void leavesImageAlarmsAndMotion()
    {
        QFETCH(QSize, screen);
        QFETCH(bool, about);
        Started stage(screen);
        QVERIFY(stage.ready());
        stage.window.showView(about ? View::About : View::Start);
        QWidget* view = about ? static_cast<QWidget*>(stage.about) : stage.start;
        for (const Region region : {Region::Status, Region::Alarm, Region::Live, Region::Motion})
            QVERIFY(!stage.seen(view).intersects(stage.window.regionGeometry(region)));
        QCOMPARE(view->size(), stage.window.regionGeometry(Region::Overlay).size());
        for (QWidget* part : view->findChildren<QWidget*>(Qt::FindDirectChildrenOnly))
            if (part->isVisible())
                QVERIFY2(view->rect().contains(part->geometry()), qPrintable(part->accessibleName()));
    }

    void aboutNamesTheLicencesAndIsReachedFromTheStrip()
    {
        Started stage;
        QVERIFY(stage.ready());
        QTest::mouseClick(stage.named<QPushButton>(QStringLiteral("About this software")), Qt::LeftButton);
        QVERIFY(stage.about->isVisible());
        QVERIFY(!stage.window.handHasKeys());
        const QString words = Started::words(stage.about);
        for (const char* part :
             {"Not a medical device", "Qt 6", "LGPL-3", "VTK", "OpenCV", "OpenSSL", "Boost", "pugixml", "SDL 2", "libspnav"})
            QVERIFY2(words.contains(QString::fromLatin1(part)), part);
        QVERIFY(!words.contains(QStringLiteral("CharLS"))); // the console decodes JPEG-LS itself
        QTest::keyClick(QApplication::focusWidget(), Qt::Key_F1);
        QVERIFY(!stage.about->isVisible());
    }

    void everythingIsReachedByTabAndHasAName()
    {
        Started stage;
        QVERIFY(stage.shown());
        QSet<QWidget*> reached;
        for (int i = 0; i < 120; ++i) {
            QWidget* focus = QApplication::focusWidget();
            QVERIFY(focus);
            reached.insert(focus);
            QTest::keyClick(focus, Qt::Key_Tab);
        }
        int parts = 0;
        for (QWidget* part : stage.start->findChildren<QWidget*>())
            if (part->isVisible() && part->focusPolicy() == Qt::StrongFocus && !part->accessibleName().isEmpty()) {
                QVERIFY2(reached.contains(part), qPrintable(part->accessibleName()));
                ++parts;
            }
        QCOMPARE(parts, 3);
    }
};

QTEST_MAIN(TestStartView)
#include "test_start_view.moc"
