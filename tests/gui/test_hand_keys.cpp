// Whose keys they are after a click, after a control went, and with Ctrl, Alt or Meta held; and that each is known again when it comes up.
#include "cockpit_stage.hpp"
#include "support/keyboard_key.hpp"
#include "widgets/alarm_band.hpp"
#include "widgets/link_card.hpp"
#include "widgets/sheet_button.hpp"

#include <QKeyEvent>
#include <QPushButton>
#include <QSet>
#include <QSignalSpy>

#include <utility>

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
    QSignalSpy keysUp{&window, &CockpitWindow::handKeyReleased};

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
        for (const Qt::Key key : {Qt::Key_R, Qt::Key_D, Qt::Key_G, Qt::Key_Up}) {
            for (const auto type : {QEvent::KeyPress, QEvent::KeyRelease}) { // QTest::keyPress() would press the modifier, too
                QKeyEvent event(type, key, Qt::KeyboardModifiers(modifier));
                QApplication::sendEvent(&stage.window, &event);
            }
        }
        QCOMPARE(stage.keys.count(), counts ? 4 : 0);
        QCOMPARE(stage.keysUp.count(), 4); // what stops motion always counts
    }

    void comeUpAsTheyWentDown_data()
    {
        QTest::addColumn<quint32>("scanCode");
        QTest::addColumn<int>("down");
        QTest::addColumn<int>("up");
        QTest::newRow("dead-man, AltGr held") << scan::d << int(Qt::Key_D) << int(Qt::Key_ETH);
        QTest::newRow("dead-man, another layout") << scan::d << int(Qt::Key_D) << 0x412;
        QTest::newRow("pedal, AltGr held") << scan::f << int(Qt::Key_F) << altGr::f;
        QTest::newRow("ARM, AltGr held") << scan::r << int(Qt::Key_R) << int(Qt::Key_paragraph);
        QTest::newRow("inject, AltGr held") << scan::g << int(Qt::Key_G) << altGr::g;
        QTest::newRow("arrow, Num Lock on") << scan::padUp << int(Qt::Key_Up) << int(Qt::Key_8);
    }

    /// Wherever the focus is; what the keyboard repeats meanwhile has the other code, too.
    void comeUpAsTheyWentDown()
    {
        QFETCH(quint32, scanCode);
        QFETCH(int, down);
        QFETCH(int, up);
        Stage stage;
        QVERIFY(stage.ready());
        stage.refresh();
        QWidget* const control = stage.named<QPushButton>(openAllName);
        QVERIFY(control != nullptr);
        for (QWidget* focus : {static_cast<QWidget*>(&stage.window), control}) {
            focus->setFocus(Qt::TabFocusReason);
            QTRY_VERIFY(stage.window.handHasKeys());
            stage.keys.clear();
            stage.keysUp.clear();
            sendKey(focus, QEvent::KeyPress, scanCode, down);
            for (int i = 0; i < 3; ++i) {
                sendKey(focus, QEvent::KeyRelease, scanCode, up, true);
                sendKey(focus, QEvent::KeyPress, scanCode, up, true);
            }
            QCOMPARE(stage.keys.count(), 1);
            QCOMPARE(stage.keys.front().front().toInt(), down);
            QCOMPARE(stage.keysUp.count(), 0);
            sendKey(focus, QEvent::KeyRelease, scanCode, up);
            QCOMPARE(stage.keysUp.count(), 1);
            QCOMPARE(stage.keysUp.front().front().toInt(), down);
        }
    }

    /// Without scan codes: what nobody saw go down may be any of those that are down.
    void allComeUpWithOneThatIsUnknown()
    {
        Stage stage;
        QVERIFY(stage.ready());
        QTRY_VERIFY(stage.window.handHasKeys());
        sendKey(&stage.window, QEvent::KeyPress, 0, Qt::Key_D);
        sendKey(&stage.window, QEvent::KeyPress, 0, Qt::Key_F);
        sendKey(&stage.window, QEvent::KeyRelease, 0, Qt::Key_ETH);
        QSet<int> up;
        for (const auto& told : std::as_const(stage.keysUp))
            up.insert(told.front().toInt());
        QVERIFY(up.contains(Qt::Key_D) && up.contains(Qt::Key_F));
    }

    /// Nor with those that a shortcut takes, or that are urgent.
    void doNotComeUpWithOthers()
    {
        Stage stage;
        QVERIFY(stage.ready());
        QTRY_VERIFY(stage.window.handHasKeys());
        QTest::keyPress(&stage.window, Qt::Key_D);
        for (const Qt::Key key : {Qt::Key_Escape, Qt::Key_F8, Qt::Key_F9, Qt::Key_F10, Qt::Key_F11, Qt::Key_F12, Qt::Key_N})
            for (const Qt::KeyboardModifier modifier : {Qt::NoModifier, Qt::ShiftModifier, Qt::ControlModifier})
                QTest::keyClick(&stage.window, key, modifier);
        QVERIFY(stage.window.handHasKeys());
        for (const auto& told : std::as_const(stage.keysUp))
            QVERIFY(told.front().toInt() != Qt::Key_D);
        QTest::keyRelease(&stage.window, Qt::Key_D);
        QCOMPARE(stage.keysUp.back().front().toInt(), int(Qt::Key_D));
    }

    /// A key that stayed down while they were another's is no key of the hand's until it is pressed again.
    void areForgottenWhileTheyAreAnothers()
    {
        Stage stage;
        QVERIFY(stage.ready());
        QTRY_VERIFY(stage.window.handHasKeys());
        sendKey(&stage.window, QEvent::KeyPress, scan::d, Qt::Key_D);
        QTest::keyClick(&stage.window, Qt::Key_F2);
        QVERIFY(!stage.window.handHasKeys());
        QTest::keyClick(QApplication::focusWidget(), Qt::Key_F1);
        QTRY_VERIFY(stage.window.handHasKeys());
        stage.keysUp.clear();
        sendKey(&stage.window, QEvent::KeyRelease, scan::d, Qt::Key_ETH);
        QCOMPARE(stage.keysUp.count(), 1);
        QCOMPARE(stage.keysUp.front().front().toInt(), int(Qt::Key_ETH));
        QCOMPARE(stage.keys.count(), 1);
    }
};

QTEST_MAIN(TestHandKeys)
#include "test_hand_keys.moc"
