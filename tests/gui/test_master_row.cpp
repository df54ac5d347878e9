// Which master is in use and whether it is alive is always in sight, and another one is a click away while nothing is armed.
#include "cockpit_stage.hpp"
#include "widgets/master_row.hpp"

#include <QSignalSpy>

using namespace console;
using namespace console::test;
using namespace std::chrono_literals;

namespace {

struct MasterStage : CockpitStage {
    using CockpitStage::CockpitStage;

    std::vector<MasterChip*> chips() const
    {
        std::vector<MasterChip*> shown;
        for (auto* chip : window.findChildren<MasterChip*>())
            if (chip->isVisible())
                shown.push_back(chip);
        return shown;
    }

    MasterChip* chip(MasterKind kind) const
    {
        for (auto* candidate : chips())
            if (candidate->status().kind == kind)
                return candidate;
        return nullptr;
    }
};

int inked(const QImage& picture, const QColor& ink)
{
    int count = 0;
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x)
            count += picture.pixelColor(x, y) == ink ? 1 : 0;
    return count;
}

} // namespace

class TestMasterRow : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase() { theme::apply(*qApp); }

    void theMasterInUseIsAlwaysInSight()
    {
        MasterStage stage;
        QVERIFY(stage.ready());
        stage.refresh();
        QCOMPARE(stage.chips().size(), std::size_t(1));
        QCOMPARE(stage.chips().front()->accessibleName(), QStringLiteral("Master in use: Keyboard, alive"));
        stage.window.showView(View::Topology);
        stage.cockpit.openAll();
        stage.cockpit.loseRobot();
        stage.refresh();
        auto* chip = stage.chips().front();
        QCOMPARE(stage.seen(chip).size(), chip->size()); // no sheet and no view lies over it
    }

    void saysHowLongAMasterIsGone()
    {
        MasterStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        stage.cockpit.losePad();
        stage.window.refresh(stage.cockpit.now);
        QCOMPARE(stage.chip(MasterKind::GamePad)->accessibleName(),
                 QString::fromUtf16(u"Master in use: Game pad Invented 360, gone for 3.0\u00A0s"));
        QCOMPARE(stage.chips().size(), std::size_t(3));
    }

    void anAliveMasterHasAFilledMark()
    {
        MasterChip chip;
        MasterStatus status;
        status.name = QStringLiteral("X");
        status.inUse = true;
        const auto bright = [&](MasterLife life) {
            status.life = life;
            chip.setStatus(status, {});
            chip.resize(chip.sizeHint());
            return inked(chip.grab().toImage().copy(0, 0, chip.height() + 4, chip.height()), theme::colour::bright);
        };
        const int alive = bright(MasterLife::Alive);
        for (const auto life : {MasterLife::Gone, MasterLife::Silent, MasterLife::Unheard, MasterLife::Unreleased})
            QVERIFY2(alive > 2 * bright(life), qPrintable(word(life)));
    }

    void aClickChoosesAnotherMaster()
    {
        MasterStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        stage.cockpit.losePad();
        stage.refresh();
        QSignalSpy chosen(&stage.window, &CockpitWindow::masterChosen);
        QTest::mouseClick(stage.chip(MasterKind::GamePad), Qt::LeftButton);
        QCOMPARE(chosen.count(), 0); // it is in use
        QTest::mouseClick(stage.chip(MasterKind::Keyboard), Qt::LeftButton);
        QCOMPARE(chosen.count(), 1);
        QCOMPARE(chosen.first().first().value<MasterKind>(), MasterKind::Keyboard);
        QVERIFY(stage.window.handHasKeys()); // the click did not take the keys from the hand
    }

    void whileArmedNoMasterCanBeChosen_data()
    {
        QTest::addColumn<bool>("engaged");
        QTest::newRow("armed") << false;
        QTest::newRow("engaged") << true;
    }

    void whileArmedNoMasterCanBeChosen()
    {
        QFETCH(bool, engaged);
        MasterStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        stage.cockpit.arm();
        if (engaged)
            stage.cockpit.engage();
        stage.cockpit.models.hand.setMasters({{MasterKind::Keyboard, QStringLiteral("Keyboard"), MasterLife::Alive, {}, true, {}},
                                              {MasterKind::GamePad, QStringLiteral("Game pad"), MasterLife::Alive, {}, false, {}}});
        stage.refresh();
        QSignalSpy chosen(&stage.window, &CockpitWindow::masterChosen);
        auto* chip = stage.chip(MasterKind::GamePad);
        QVERIFY(!chip->isEnabled());
        QTest::mouseClick(chip, Qt::LeftButton);
        QTest::keyClick(chip, Qt::Key_Space);
        QCOMPARE(chosen.count(), 0);
    }

    void aMasterThatIsNotThereSaysWhyAndCannotBeChosen()
    {
        MasterStage stage;
        QVERIFY(stage.ready());
        const QString why = QStringLiteral("there, and not used: X (Bluetooth)");
        stage.cockpit.models.hand.setMasters({{MasterKind::Keyboard, QStringLiteral("Keyboard"), MasterLife::Alive, {}, true, {}},
                                              {MasterKind::GamePad, QStringLiteral("Game pad"), MasterLife::Gone, {}, false, why}});
        stage.refresh();
        const auto* chip = stage.chip(MasterKind::GamePad);
        QVERIFY(chip != nullptr && !chip->isEnabled());
        QCOMPARE(chip->toolTip(), why);
        QCOMPARE(chip->accessibleDescription(), why);
    }

    void theForceToTheHandIsShownOnlyWhereThereIsOne()
    {
        MasterStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        stage.cockpit.arm();
        stage.cockpit.engage();
        stage.refresh();
        const auto* hand = stage.named<QWidget>(QStringLiteral("Hand"));
        QVERIFY(!hand->accessibleDescription().contains(QStringLiteral("force to hand")));
        const int narrow = hand->sizeHint().width();
        stage.cockpit.feelForce();
        stage.refresh();
        QVERIFY2(hand->accessibleDescription().contains(QStringLiteral("force to hand resistance 0.46")),
                 qPrintable(hand->accessibleDescription()));
        QVERIFY(hand->sizeHint().width() >= narrow);
        QTRY_VERIFY(hand->width() >= hand->sizeHint().width());
    }

    void nothingIsCut_data()
    {
        QTest::addColumn<QSize>("size");
        for (const QSize size : {QSize(2560, 1440), QSize(1920, 1080), QSize(1366, 768)})
            QTest::addRow("%d", size.height()) << size;
    }

    void nothingIsCut()
    {
        QFETCH(QSize, size);
        MasterStage stage(size);
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        stage.cockpit.losePad();
        stage.refresh();
        for (const auto* chip : stage.chips()) {
            QTRY_VERIFY(chip->width() >= chip->sizeHint().width() && chip->height() >= chip->sizeHint().height());
            QVERIFY(stage.window.rect().contains(stage.seen(chip)));
        }
    }
};

QTEST_MAIN(TestMasterRow)
#include "test_master_row.moc"
