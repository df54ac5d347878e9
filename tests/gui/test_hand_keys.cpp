// Whose keys they are after a click, after a control went, and with Ctrl, Alt or Meta held.
#include "cockpit_stage.hpp"
#include "widgets/alarm_band.hpp"
#include "widgets/link_card.hpp"
#include "widgets/sheet_button.hpp"

#include <QKeyEvent>
#include <QPushButton>
#include <QSignalSpy>

using namespace console;
using namespace console::test;

namespace {

const QString acknowledgeName = QStringLiteral("Acknowledge the alarm shown");
const QString openAllName = QStringLiteral("Open all closed links, one after the other");

/// A cockpit whose wishes are carried out, as the program does it.
struct Stage : CockpitStage {
    QSignalSpy opened{&window, &CockpitWindow::openRequested};
    QSignalSpy closed{&window, &CockpitWindow::closeRequested};
    QSignalSpy openedAll{&window, &CockpitWindow::openAllRequested};
    QSignalSpy keys{&window, &CockpitWindow::handKeyPressed};

    Stage()
    {
        auto& models = cockpit.models;
        QObject::connect(&window, &CockpitWindow::acknowledgeRequested, &window,
                         [&models](quint64 id) { models.alarms.acknowledge(id, 0); });
        QObject::connect(&window, &CockpitWindow::openAllRequested, &window, [this] {
            for (const quint32 peer : {robotId, armId, xrayId})
                cockpit.models.sessions.setLinkState(peer, LinkState::Opening, cockpit.now);
            refresh();
        });
        QObject::connect(&window, &CockpitWindow::openRequested, &window, [this](quint32 peer) {
            cockpit.models.sessions.setLinkState(peer, LinkState::Open, cockpit.now);
            refresh();
        });
    }

    void alarm()
    {
        cockpit.models.alarms.update({{AlarmCondition::ForceWarn, robotId, AlarmPriority::Medium, false, QStringLiteral("Force"),
                                       QStringLiteral("Advance no further.")}},
                                     cockpit.now, 0);
    }

    QPushButton* cardButton(quint32 peer) const
    {
        for (const LinkCard* card : window.findChildren<LinkCard*>())
            if (card->peer() == peer)
                return card->findChild<QPushButton*>();
        return nullptr;
    }

    /// A person types on: Space is nobody's, and the arrow is the hand's.
    bool handHasThem()
    {
        const auto wishes = [this] { return opened.count() + closed.count() + openedAll.count(); };
        const auto before = wishes();
        const auto heard = keys.count();
        QTest::keyClick(QApplication::focusWidget(), Qt::Key_Space);
        QTest::keyClick(QApplication::focusWidget(), Qt::Key_Up);
        return QApplication::focusWidget() == &window && window.handHasKeys() && wishes() == before && keys.count() == heard + 1 &&
               keys.back().front().toInt() == Qt::Key_Up;
    }
};

} // namespace

class TestHandKeys : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase() { theme::apply(*qApp); }

    void comeBackAfterAClickOn_data()
    {
        QTest::addColumn<QString>("what");
        for (const char* what : {"acknowledge", "open all", "a card", "pause", "the self-test"})
            QTest::newRow(what) << QString::fromLatin1(what);
    }

    void comeBackAfterAClickOn()
    {
        QFETCH(QString, what);
        Stage stage;
        QVERIFY(stage.ready());
        if (what != QLatin1String("open all") && what != QLatin1String("a card"))
            stage.cockpit.openAll(); // the cards offer to close
        if (what == QLatin1String("acknowledge") || what == QLatin1String("pause"))
            stage.alarm();
        stage.refresh();
        QPushButton* button = what == QLatin1String("acknowledge") ? stage.named<QPushButton>(acknowledgeName)
                              : what == QLatin1String("open all")  ? stage.named<QPushButton>(openAllName)
                              : what == QLatin1String("a card")    ? stage.cardButton(robotId)
                              : what == QLatin1String("pause")
                                  ? stage.named<QPushButton>(QStringLiteral("Pause the alarm sound for a while, or end the pause"))
                                  : stage.named<QPushButton>(QStringLiteral("Begin the alarm self-test: three colours and three sounds"));
        QVERIFY(button != nullptr && button->isEnabled());
        QTest::mouseClick(button, Qt::LeftButton);
        QVERIFY(stage.handHasThem());
    }

    /// By Tab and Space, as without a mouse.
    void comeBackAfterAPressOn_data()
    {
        QTest::addColumn<QString>("what");
        for (const char* what : {"acknowledge", "open all", "a card"})
            QTest::newRow(what) << QString::fromLatin1(what);
    }

    void comeBackAfterAPressOn()
    {
        QFETCH(QString, what);
        Stage stage;
        QVERIFY(stage.ready());
        if (what == QLatin1String("acknowledge"))
            stage.cockpit.openAll();
        stage.alarm();
        stage.refresh();
        QPushButton* button = what == QLatin1String("open all") ? stage.named<QPushButton>(openAllName)
                              : what == QLatin1String("a card") ? stage.cardButton(robotId)
                                                                : stage.named<QPushButton>(acknowledgeName);
        button->setFocus(Qt::TabFocusReason);
        QCOMPARE(QApplication::focusWidget(), static_cast<QWidget*>(button));
        QTest::keyClick(button, Qt::Key_Space);
        QVERIFY(stage.handHasThem());
    }

    /// The alarm ends while Acknowledge has the keys: the next control would be the one to close a link.
    void comeBackWhenTheControlThatHadThemGoes()
    {
        Stage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        stage.alarm();
        stage.refresh();
        stage.named<QPushButton>(acknowledgeName)->setFocus(Qt::TabFocusReason);
        stage.cockpit.models.alarms.update({}, stage.cockpit.now, 0);
        stage.cockpit.models.alarms.update({}, stage.cockpit.now + AlarmList::longestEndDelay, 0);
        QVERIFY(stage.handHasThem());
    }

    void comeBackWhenACardHasNothingToOffer()
    {
        Stage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        stage.refresh();
        stage.cardButton(robotId)->setFocus(Qt::TabFocusReason);
        stage.cockpit.models.sessions.setLinkState(robotId, LinkState::Closing, stage.cockpit.now);
        stage.refresh();
        QVERIFY(!stage.cardButton(robotId)->isEnabled());
        QVERIFY(stage.handHasThem());
    }

    /// The link is open before the second click, and the button offers to close it.
    void aDoubleClickOnACardIsOneWish()
    {
        Stage stage;
        QVERIFY(stage.ready());
        stage.refresh();
        QTest::mouseClick(stage.cardButton(robotId), Qt::LeftButton);
        QCOMPARE(stage.cardButton(robotId)->text(), QStringLiteral("Close"));
        QTest::mouseClick(stage.cardButton(robotId), Qt::LeftButton);
        QCOMPARE(stage.opened.count(), 1);
        QCOMPARE(stage.closed.count(), 0);
    }

    /// Tab has led to a button; its own way with an arrow would be to hand the focus on, and that of the cards' list to turn a page.
    void arrowsAndPageKeysAreTheHandsWhateverHasTheFocus()
    {
        Stage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        stage.refresh();
        int asked = 0;
        for (auto* control : stage.window.findChildren<QWidget*>()) {
            if (!control->isVisible() || !control->isEnabled() || control->focusPolicy() == Qt::NoFocus)
                continue;
            control->setFocus(Qt::TabFocusReason);
            if (QApplication::focusWidget() != control || !stage.window.handHasKeys())
                continue;
            ++asked;
            for (const Qt::Key key : {Qt::Key_Up, Qt::Key_Down, Qt::Key_Left, Qt::Key_Right, Qt::Key_PageUp, Qt::Key_PageDown}) {
                const auto heard = stage.keys.count();
                QTest::keyClick(control, key);
                QVERIFY2(stage.keys.count() == heard + 1 && stage.keys.back().front().toInt() == key,
                         qPrintable(control->accessibleName()));
                QCOMPARE(QApplication::focusWidget(), control);
            }
        }
        QVERIFY(asked > 5);
    }

    void areNoneOfTheHandsWithAModifier_data()
    {
        QTest::addColumn<int>("modifier");
        QTest::addColumn<bool>("counts");
        QTest::newRow("none") << int(Qt::NoModifier) << true;
        QTest::newRow("Shift") << int(Qt::ShiftModifier) << true;
        QTest::newRow("key pad") << int(Qt::KeypadModifier) << true;
        QTest::newRow("Ctrl") << int(Qt::ControlModifier) << false;
        QTest::newRow("Alt") << int(Qt::AltModifier) << false;
        QTest::newRow("Meta") << int(Qt::MetaModifier) << false;
        QTest::newRow("Ctrl and Shift") << int(Qt::ControlModifier | Qt::ShiftModifier) << false;
    }

    /// R arms, D is the dead-man, G injects.
    void areNoneOfTheHandsWithAModifier()
    {
        QFETCH(int, modifier);
        QFETCH(bool, counts);
        Stage stage;
        QVERIFY(stage.ready());
        QSignalSpy released(&stage.window, &CockpitWindow::handKeyReleased);
        for (const Qt::Key key : {Qt::Key_R, Qt::Key_D, Qt::Key_G, Qt::Key_Up}) {
            for (const auto type : {QEvent::KeyPress, QEvent::KeyRelease}) { // QTest::keyPress() would press the modifier, too
                QKeyEvent event(type, key, Qt::KeyboardModifiers(modifier));
                QApplication::sendEvent(&stage.window, &event);
            }
        }
        QCOMPARE(stage.keys.count(), counts ? 4 : 0);
        QCOMPARE(released.count(), 4); // what stops motion always counts
    }
};

QTEST_MAIN(TestHandKeys)
#include "test_hand_keys.moc"
