// A thousand losses of one link within a minute: one card, one sheet, one account, and nothing that grows with their number.
#include "app/alarm_watch.hpp"
#include "app/interruption_watch.hpp"
#include "cockpit_stage.hpp"
#include "flapping_link.hpp"
#include "widgets/alarm_band.hpp"
#include "widgets/diagnosis_sheet.hpp"
#include "widgets/interruption_card.hpp"
#include "widgets/link_card.hpp"
#include "widgets/stop_button.hpp"
#include "widgets/trends_pane.hpp"

#include <QLabel>

using namespace console;
using namespace console::test;
using namespace std::chrono_literals;

namespace {

constexpr int flaps = 1000;
constexpr auto period = 60ms; // a thousand in a minute

struct Flapping : CockpitStage {
    SessionIntake intake{cockpit.models};
    InterruptionWatch interruptions{cockpit.models, [] { return quint64(0); }};
    AlarmWatch alarms{cockpit.models, robotId};
    FlappingLink link{intake};
    Instant now = std::chrono::steady_clock::now() - 60s;

    Flapping() { cockpit.openAll(); }

    void lose()
    {
        link.lose(now += period / 2);
        turn();
    }

    void reopen()
    {
        link.reopen(now += period / 2);
        turn();
    }

    void turn()
    {
        alarms.update(now, 0);
        if (++m_turns % 16 <= 1) // in every eighth flap, lost and open: a sanitizer paints slowly
            paint();
    }

    void paint()
    {
        window.refresh(now);
        QCoreApplication::processEvents();
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    }

    qsizetype objects() const { return window.findChildren<QObject*>().size(); }

    template <typename Widget>
    qsizetype visible() const
    {
        qsizetype count = 0;
        for (const Widget* widget : window.findChildren<Widget*>())
            count += widget->isVisible() ? 1 : 0;
        return count;
    }

    bool sheetSays(const QString& words) const
    {
        for (const QLabel* label : window.findChild<DiagnosisSheet*>()->findChildren<QLabel*>())
            if (label->isVisible() && label->text().contains(words))
                return true;
        return false;
    }

private:
    int m_turns = 0;
};

class PaintCount : public QObject {
public:
    explicit PaintCount(QWidget* painted) { painted->installEventFilter(this); }

    int paints() const { return m_paints; }
    double seconds() const { return console::seconds(std::chrono::steady_clock::now() - m_since); }

    bool eventFilter(QObject*, QEvent* event) override
    {
        m_paints += event->type() == QEvent::Paint ? 1 : 0;
        return false;
    }

private:
    int m_paints = 0;
    Instant m_since = std::chrono::steady_clock::now();
};

} // namespace

class TestFlaps : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase() { theme::apply(*qApp); }

    void aThousandFlapsAreOneCardAndNothingGrows()
    {
        Flapping stage;
        QVERIFY(stage.ready());
        auto& models = stage.cockpit.models;
        stage.lose();
        stage.reopen();
        stage.paint(); // the account has its lines from now on
        stage.lose();
        stage.paint();
        const auto cardsBefore = stage.visible<LinkCard>();
        const auto whileLost = stage.objects();
        stage.reopen();
        stage.paint();
        const auto whileOpen = stage.objects();
        const auto logBefore = models.log.rowCount();
        for (int i = 3; i <= flaps; ++i) {
            stage.lose();
            QCOMPARE(stage.objects(), whileLost);
            QCOMPARE(models.incidents.incidents().size(), std::size_t(1));
            if (i < flaps)
                stage.reopen();
        }
        stage.paint();
        QCOMPARE(cardsBefore, qsizetype(3));
        QCOMPARE(stage.visible<LinkCard>(), qsizetype(3));
        QCOMPARE(stage.visible<DiagnosisSheet>(), qsizetype(1));
        QVERIFY(stage.sheetSays(QStringLiteral("1000th time in 2 min")));
        QCOMPARE(models.incidents.raisedInAll(), quint64(flaps));
        stage.reopen();
        stage.paint();
        QCOMPARE(stage.objects(), whileOpen);
        QCOMPARE(stage.visible<InterruptionCard>(), qsizetype(1));
        QCOMPARE(models.interruption.losses(), flaps);
        QVERIFY(models.log.rowCount() > logBefore);
    }

    void whatIsKeptIsBounded()
    {
        Flapping stage;
        QVERIFY(stage.ready());
        auto& models = stage.cockpit.models;
        for (int i = 0; i < flaps; ++i) {
            stage.link.lose(stage.now += period / 2);
            stage.alarms.update(stage.now, 0);
            stage.link.reopen(stage.now += period / 2);
            stage.alarms.update(stage.now, 0);
        }
        QCOMPARE(models.log.rowCount(), EventLog::usualLimit); // more than that was told
        QVERIFY(models.log.lost() > 0);
        QVERIFY(models.alarms.log().size() <= AlarmList::logLimit);
        QCOMPARE(std::size_t(models.alarmLog.rowCount()), models.alarms.log().size());
        QVERIFY2(models.alarms.alarms().size() <= 3, qPrintable(QString::number(models.alarms.alarms().size())));
        const auto* link = models.sessions.linkTo(robotId);
        QVERIFY(link->suspects.size() <= std::size_t(flaps) && link->history.size() <= 610);
        QCOMPARE(models.interruption.lost().size(), 1);
        QVERIFY(models.incidents.empty() && !models.sessions.inStandBy());
        QCOMPARE(link->incident, quint64(0));
    }

    /// The sheet takes the focus as it comes, and gives it back as it goes: that is no reason to draw the whole window.
    void aFlapDrawsNothingThatItDoesNotConcern()
    {
        Flapping stage;
        QVERIFY(stage.ready());
        stage.paint();
        PaintCount stop(stage.window.findChild<StopButton*>());
        PaintCount trends(stage.window.findChild<TrendsPane*>());
        PaintCount band(stage.window.findChild<AlarmBand*>());
        stage.lose();
        QTRY_VERIFY(stage.visible<DiagnosisSheet>() == 1);
        QTRY_VERIFY(QApplication::focusWidget() && stage.window.findChild<DiagnosisSheet*>()->isAncestorOf(QApplication::focusWidget()));
        stage.reopen();
        QTRY_VERIFY(stage.visible<DiagnosisSheet>() == 0);
        QTRY_COMPARE(QApplication::focusWidget(), &stage.window);
        QTRY_VERIFY(band.paints() > 0);
        QCOMPARE(stop.paints(), 0);
        QVERIFY2(trends.paints() <= 5 * stop.seconds() + 2, qPrintable(QString::number(trends.paints()))); // its own clock's
    }

    void theCountIsOfTheLastTwoMinutes()
    {
        Flapping stage;
        QVERIFY(stage.ready());
        for (int i = 0; i < 20; ++i) {
            stage.lose();
            stage.reopen();
        }
        stage.now += 3min;
        stage.link.lose(stage.now);
        QCOMPARE(stage.cockpit.models.incidents.incidents().front().flaps, 1);
    }
};

QTEST_MAIN(TestFlaps)
#include "test_flaps.moc"
