// Regions, clipped texts, names and what an alarm may not move, at three sizes of the screen.
#include "cockpit_stage.hpp"
#include "widgets/alarm_band.hpp"
#include "widgets/figures.hpp"
#include "widgets/hold_button.hpp"
#include "widgets/stop_button.hpp"

#include <QAbstractButton>
#include <QAbstractScrollArea>
#include <QDialog>
#include <QLabel>
#include <QPushButton>

#include <functional>

using namespace console;
using namespace console::test;

namespace {

const QSize screens[] = {{2560, 1440}, {1920, 1080}, {1366, 768}};

constexpr Region regions[] = {Region::Status, Region::Alarm, Region::Links, Region::Live,   Region::Reference,
                              Region::Scene,  Region::Robot, Region::Dose,  Region::Trends, Region::Motion};

QString describe(const QWidget* widget)
{
    const auto* label = qobject_cast<const QLabel*>(widget);
    const auto* button = qobject_cast<const QAbstractButton*>(widget);
    const QString text = label ? label->text() : button ? button->text() : widget->accessibleName();
    return QStringLiteral("%1 \"%2\" is %3x%4, needs %5x%6")
        .arg(QString::fromLatin1(widget->metaObject()->className()), text)
        .arg(widget->width())
        .arg(widget->height())
        .arg(widget->sizeHint().width())
        .arg(widget->sizeHint().height());
}

bool fits(const QLabel* label)
{
    if (label->wordWrap())
        return label->heightForWidth(label->width()) <= label->height();
    return label->sizeHint().width() <= label->width() && label->sizeHint().height() <= label->height();
}

bool fits(const QAbstractButton* button)
{
    return button->sizeHint().width() <= button->width() && button->sizeHint().height() <= button->height();
}

void bring(CockpitStage& stage, const QString& state)
{
    if (state == QLatin1String("idle"))
        return;
    stage.cockpit.openAll();
    if (state == QLatin1String("engaged") || state == QLatin1String("stand-by")) {
        stage.cockpit.arm();
        stage.cockpit.engage();
    }
    if (state == QLatin1String("stand-by")) {
        stage.cockpit.loseXray();
        stage.cockpit.loseRobot();
    }
    if (state == QLatin1String("topology"))
        stage.window.showView(View::Topology);
    if (state == QLatin1String("plots"))
        stage.window.showView(View::Plots);
    if (state == QLatin1String("resting force"))
        stage.cockpit.restWithForce();
}

} // namespace

class TestCockpitLayout : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase() { theme::apply(*qApp); }

    void regionsNeverOverlap_data()
    {
        QTest::addColumn<QSize>("screen");
        for (const QSize& screen :
             {QSize(2560, 1440), QSize(1920, 1080), QSize(1366, 768), QSize(1920, 1200), QSize(3440, 1440), QSize(1280, 1024)})
            QTest::newRow(qPrintable(QStringLiteral("%1x%2").arg(screen.width()).arg(screen.height()))) << screen;
    }

    void regionsNeverOverlap()
    {
        QFETCH(QSize, screen);
        for (const Region a : regions) {
            QVERIFY(QRect(QPoint(), screen).contains(regionRect(a, screen)));
            for (const Region b : regions)
                if (a != b)
                    QVERIFY(!regionRect(a, screen).intersects(regionRect(b, screen)));
        }
        const QRect live = regionRect(Region::Live, screen);
        QCOMPARE(live.width(), live.height());
        QVERIFY(live.height() > 0.45 * screen.height());
        for (const Region over : {Region::Sheet, Region::Overlay}) {
            QVERIFY(!regionRect(over, screen).intersects(live));
            QVERIFY(!regionRect(over, screen).intersects(regionRect(Region::Motion, screen)));
            QVERIFY(!regionRect(over, screen).intersects(regionRect(Region::Alarm, screen)));
        }
    }

    void liveImageIsTheLargestAtTheReference()
    {
        const QSize screen(2560, 1440);
        QCOMPARE(regionRect(Region::Live, screen).size(), QSize(1136, 1136));
        for (const Region other : regions) {
            const QSize size = regionRect(other, screen).size();
            if (other != Region::Live)
                QVERIFY(size.width() * size.height() < 1136 * 1136);
        }
    }

    void textsAreWhole_data()
    {
        QTest::addColumn<QSize>("screen");
        QTest::addColumn<QString>("state");
        for (const QSize& screen : screens)
            for (const char* state : {"idle", "open", "engaged", "stand-by", "topology", "plots", "resting force"})
                QTest::newRow(qPrintable(QStringLiteral("%1 at %2").arg(QString::fromLatin1(state)).arg(screen.height())))
                    << screen << QString::fromLatin1(state);
    }

    /// WCAG 2.2, target size (minimum): 24 pixels. What stops or starts a movement is twice that.
    void buttonsAreLargeEnoughToBeHit_data() { textsAreWhole_data(); }
    void buttonsAreLargeEnoughToBeHit()
    {
        QFETCH(QSize, screen);
        QFETCH(QString, state);
        CockpitStage stage(screen);
        QVERIFY(stage.ready());
        bring(stage, state);
        stage.refresh();
        QStringList small;
        for (const auto* button : stage.window.findChildren<QAbstractButton*>()) {
            const bool safety = qobject_cast<const HoldButton*>(button) != nullptr || qobject_cast<const StopButton*>(button) != nullptr;
            if (button->isVisible() && std::min(button->width(), button->height()) < (safety ? 48 : 24))
                small << QStringLiteral("%1 %2x%3").arg(button->accessibleName()).arg(button->width()).arg(button->height());
        }
        QVERIFY2(small.isEmpty(), qPrintable(small.join(QStringLiteral("; "))));
    }

    void textsAreWhole()
    {
        QFETCH(QSize, screen);
        QFETCH(QString, state);
        CockpitStage stage(screen);
        QVERIFY(stage.ready());
        bring(stage, state);
        stage.refresh();
        QTest::qWait(0);
        int looked = 0;
        for (const QLabel* label : stage.window.findChildren<QLabel*>()) {
            if (!label->isVisible() || label->text().isEmpty())
                continue;
            ++looked;
            QTRY_VERIFY2(fits(label), qPrintable(describe(label)));
        }
        for (const QAbstractButton* button : stage.window.findChildren<QAbstractButton*>()) {
            if (!button->isVisible())
                continue;
            ++looked;
            QTRY_VERIFY2(fits(button), qPrintable(describe(button)));
        }
        QVERIFY(looked > 25);
    }

    void siblingsDoNotCoverEachOther_data() { textsAreWhole_data(); }

    void siblingsDoNotCoverEachOther()
    {
        QFETCH(QSize, screen);
        QFETCH(QString, state);
        CockpitStage stage(screen);
        QVERIFY(stage.ready());
        bring(stage, state);
        stage.refresh();
        for (const QLabel* a : stage.window.findChildren<QLabel*>())
            for (const QObject* other : a->parentWidget()->children()) {
                const auto* b = qobject_cast<const QWidget*>(other);
                if (!b || b == a || !a->isVisible() || !b->isVisible() || a->text().isEmpty())
                    continue;
                QTRY_VERIFY2(!a->geometry().intersects(b->geometry()), qPrintable(describe(a) + QStringLiteral(" / ") + describe(b)));
            }
    }

    void everyControlHasAName_data()
    {
        QTest::addColumn<QString>("state");
        for (const char* state : {"idle", "open", "engaged", "stand-by", "topology"})
            QTest::newRow(state) << QString::fromLatin1(state);
    }

    void everyControlHasAName()
    {
        QFETCH(QString, state);
        CockpitStage stage;
        QVERIFY(stage.ready());
        bring(stage, state);
        stage.refresh();
        int controls = 0;
        for (const QWidget* widget : stage.window.findChildren<QWidget*>()) {
            const bool control = qobject_cast<const QAbstractButton*>(widget) || widget->focusPolicy() != Qt::NoFocus;
            if (!control || !widget->isVisible() || widget->focusProxy())
                continue;
            ++controls;
            QVERIFY2(!widget->accessibleName().isEmpty(), qPrintable(describe(widget)));
        }
        QVERIFY(controls >= 6);
    }

    void tabReachesEveryButton()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        stage.refresh();
        QSet<const QWidget*> reached;
        for (int i = 0; i < 80; ++i) {
            QTest::keyClick(QApplication::focusWidget(), Qt::Key_Tab);
            reached.insert(QApplication::focusWidget());
        }
        for (const QAbstractButton* button : stage.window.findChildren<QAbstractButton*>())
            if (button->isVisible() && button->isEnabled())
                QVERIFY2(reached.contains(button), qPrintable(describe(button)));
    }

    void alarmsMoveNothing()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        stage.refresh();
        const auto places = [&stage] {
            std::vector<QRect> all;
            for (const QWidget* widget : stage.window.findChildren<QWidget*>()) {
                const bool fixed = widget->parentWidget() == &stage.window || qobject_cast<const QAbstractButton*>(widget) ||
                                   widget->inherits("console::LinkCard") || widget->inherits("console::AxisPanel");
                if (fixed && !widget->parentWidget()->inherits("console::AlarmBand"))
                    all.push_back(QRect(widget->mapTo(&stage.window, QPoint()), widget->size()));
            }
            return all;
        };
        auto before = places();
        const auto settled = [&] {
            const auto last = before;
            QTest::qWait(0);
            stage.refresh();
            before = places();
            return before == last;
        };
        QTRY_VERIFY(settled());
        stage.cockpit.models.alarms.update({{AlarmCondition::ForceStop, robotId, AlarmPriority::High, true,
                                             QStringLiteral("Force above 2 N"), QStringLiteral("Let go of the dead-man.")},
                                            {AlarmCondition::DriveFault, robotId, AlarmPriority::Medium, true,
                                             QStringLiteral("Drive fault"), QStringLiteral("Call service.")}},
                                           stage.cockpit.now, 0);
        stage.refresh();
        QTest::qWait(0);
        QVERIFY(places() == before);
    }

    void nothingIsModal()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        bring(stage, QStringLiteral("stand-by"));
        stage.refresh();
        for (QAbstractButton* button : stage.window.findChildren<QAbstractButton*>())
            if (button->isVisible() && button->isEnabled() && !qobject_cast<HoldButton*>(button))
                QTest::mouseClick(button, Qt::LeftButton);
        QVERIFY(!QApplication::activeModalWidget());
        QVERIFY(!QApplication::activePopupWidget());
        QCOMPARE(stage.window.findChildren<QDialog*>().size(), 0);
    }

    void focusIsSeen()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        auto* button = stage.named<QAbstractButton>(QStringLiteral("Open all closed links, one after the other"));
        QVERIFY(button);
        stage.window.setFocus();
        const QImage without = button->grab().toImage();
        button->setFocus(Qt::TabFocusReason);
        QTRY_VERIFY(button->grab().toImage() != without);
    }
};

QTEST_MAIN(TestCockpitLayout)
#include "test_cockpit_layout.moc"
