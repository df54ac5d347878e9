// A roadmap in the whole system: made of a run with contrast, while the hand goes on moving the robot.
#include "imaging/reference_image_view.hpp"
#include "theatre.hpp"
#include "widgets/theme.hpp"

#include <QApplication>
#include <QDeadlineTimer>
#include <QTest>

#include <algorithm>
#include <cmath>
#include <numeric>

using namespace console;
using console::test::Theatre;

namespace {

constexpr int patience = Theatre::patience;

/// Arms, and gives five millilitres by one hold; again as often as the permit ended before: a busy computer paints too late, or stands
/// still.
bool armAndGiveContrast(Theatre& theatre)
{
    const QDeadlineTimer deadline(3 * patience);
    const auto& injections = theatre.models().instrument.injections();
    while (!deadline.hasExpired() && theatre.arm()) {
        const auto asked = injections.size();
        const auto given = [&] { return injections.size() == asked + 1 && injections.back().progress == InjectionProgress::Done; };
        theatre.hold(Qt::Key_G);
        (void)QTest::qWaitFor([&] { return given() || !theatre.mayMove(); }, patience);
        theatre.release(Qt::Key_G);
        if (given())
            return true;
    }
    return false;
}

double contrastGiven(const Theatre& theatre)
{
    const auto& injections = theatre.models().instrument.injections();
    return std::accumulate(injections.begin(), injections.end(), 0.0,
                           [](double sum, const InjectionStatus& injection) { return sum + injection.delivered; });
}

bool makeRoadmap(Theatre& theatre)
{
    const auto& roadmap = theatre.models().roadmap;
    return QTest::qWaitFor([&] { return roadmap.isValid() || (theatre.click(QStringLiteral("Roadmap")), false); }, patience);
}

} // namespace

class RoadmapTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase() { theme::apply(*qApp); }

    void contrastIsGivenOnceAndARoadmapKeepsWhatItFilled()
    {
        Theatre theatre;
        QVERIFY(theatre.openAll());
        QTRY_VERIFY_WITH_TIMEOUT(theatre.models().instrument.robot().known(), patience);
        const double before = theatre.robotStatus().contrastRemaining;
        QVERIFY(before >= 10);
        QVERIFY2(armAndGiveContrast(theatre), qPrintable(theatre.story()));
        QVERIFY(std::abs(theatre.models().instrument.injections().back().delivered - 5) < 0.2);
        QTRY_VERIFY_WITH_TIMEOUT(std::abs(theatre.robotStatus().contrastRemaining - (before - contrastGiven(theatre))) < 0.2, patience);
        QVERIFY2(makeRoadmap(theatre), qPrintable(theatre.story()));
        const auto* pane = theatre.window().findChild<ReferenceImageView*>();
        QTRY_VERIFY(pane->picture() && pane->picture()->role == PictureRole::Roadmap);
        const auto shown = pane->picture()->about.frame;
        QTRY_VERIFY2_WITH_TIMEOUT(pane->picture()->about.frame > shown + 20, qPrintable(theatre.story()), patience);
        QVERIFY2(theatre.models().roadmap.isValid(), qPrintable(theatre.story())); // nothing moved
        theatre.releaseAll();
    }

    /// A console that stands still for a tenth of a second ends motion: with a roadmap that is made by the thread that hears hands it would
    /// do so each time.
    void askedForHoweverOftenItEndsNoMotion()
    {
        Theatre theatre;
        QVERIFY(theatre.openAll());
        QVERIFY2(armAndGiveContrast(theatre), qPrintable(theatre.story()));
        QVERIFY2(makeRoadmap(theatre), qPrintable(theatre.story()));
        const auto& models = theatre.models();
        const auto made = [&models] {
            const auto& lines = models.log.lines();
            return std::count_if(lines.begin(), lines.end(),
                                 [](const LogLine& line) { return line.text.startsWith(QStringLiteral("roadmap made of ")); });
        };
        const auto whileItMoves = [&theatre](const auto& happens) {
            const auto moves = [&theatre] { return theatre.phase() == PermitPhase::Engaged; };
            return QTest::qWaitFor([&] { return happens() || !moves(); }, patience) && happens() && moves();
        };
        const auto askAgainAndAgain = [&] {
            for (int turn = 0; turn < 3; ++turn) {
                const auto before = made();
                for (int time = 0; time < 6; ++time)
                    if (!theatre.click(QStringLiteral("Roadmap")))
                        return false;
                if (!whileItMoves([&] { return made() > before; }))
                    return false;
            }
            const auto shown = models.picture.paintedCount();
            return whileItMoves([&] { return models.picture.paintedCount() > shown + 5; });
        };
        constexpr int tries = 5;
        bool movedOn = false;
        for (int i = 0; i < tries && !movedOn; ++i) {
            QVERIFY2(theatre.armAndMove(), qPrintable(theatre.story()));
            movedOn = askAgainAndAgain();
            QVERIFY2(movedOn || theatre.heldByThisComputer(), qPrintable(theatre.story()));
        }
        QVERIFY2(movedOn, qPrintable(theatre.story()));
        QVERIFY2(models.roadmap.isValid(), qPrintable(theatre.story()));
        theatre.releaseAll();
    }
};

QTEST_MAIN(RoadmapTest)
#include "roadmap_test.moc"
