// Tests of what a roadmap does not survive: it is better gone than wrong.
#include "model/roadmap_state.hpp"

#include <QList>
#include <QPair>
#include <QSignalSpy>
#include <QtTest>

#include <cmath>
#include <functional>
#include <limits>

using namespace console;
using namespace std::chrono_literals;

namespace {

const Instant start = Instant{} + 1000s;

RoadmapBasis basis()
{
    RoadmapBasis basis;
    basis.about.acquisition = 3;
    basis.about.rows = basis.about.columns = 512;
    basis.about.imagerPixelSpacing = 0.3;
    basis.about.geometry = {179.8, 10, 1100, 750, {}};
    basis.about.arrival = start;
    return basis;
}

using Change = std::function<void(XrayFrame&)>;
using Places = QList<QPair<int, double>>;

} // namespace
Q_DECLARE_METATYPE(Change)

class TestRoadmapState : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void isRemovedByWhatMoves_data()
    {
        QTest::addColumn<Change>("change");
        QTest::addColumn<QString>("reason");
        const auto row = [](const char* name, const Change& change, const QString& reason) { QTest::newRow(name) << change << reason; };
        row("nothing", [](XrayFrame&) {}, {});
        row("less than the tolerance", [](XrayFrame& f) { f.geometry.secondaryAngle += 0.4; }, {});
        row("past half a turn", [](XrayFrame& f) { f.geometry.primaryAngle = -179.9; }, {});
        row(
            "C-arm", [](XrayFrame& f) { f.geometry.primaryAngle -= 0.6; }, QStringLiteral("the C-arm turned"));
        row(
            "SID", [](XrayFrame& f) { f.geometry.sourceDetectorDistance += 3; }, QStringLiteral("the distances of the C-arm changed"));
        row(
            "SOD", [](XrayFrame& f) { f.geometry.sourceObjectDistance -= 3; }, QStringLiteral("the distances of the C-arm changed"));
        row(
            "zoom", [](XrayFrame& f) { f.imagerPixelSpacing = 0.2; }, QStringLiteral("the zoom changed"));
        row(
            "size", [](XrayFrame& f) { f.rows = 256; }, QStringLiteral("the zoom changed"));
        row(
            "source", [](XrayFrame& f) { f.source = PictureSource::Live; }, QStringLiteral("the pictures come from elsewhere"));
        row(
            "no number", [](XrayFrame& f) { f.geometry.primaryAngle = std::numeric_limits<double>::quiet_NaN(); },
            QStringLiteral("the C-arm turned"));
    }

    void isRemovedByWhatMoves()
    {
        QFETCH(Change, change);
        QFETCH(QString, reason);
        RoadmapState state;
        QVERIFY(!state.isWanted() && !state.isValid());
        state.begin(basis());
        QVERIFY(state.isValid());
        auto about = basis().about;
        change(about);
        state.checkPicture(about);
        QCOMPARE(state.reason(), reason);
        QCOMPARE(state.isValid(), reason.isEmpty());
        QVERIFY(state.isWanted());
        QVERIFY(state.line().contains(reason.isEmpty() ? QStringLiteral("run 3") : reason));
    }

    void doesNotComeBackByItself()
    {
        RoadmapState state;
        QSignalSpy changes(&state, &RoadmapState::changed);
        state.begin(basis());
        auto turned = basis().about;
        turned.geometry.primaryAngle = 0;
        state.checkPicture(turned);
        state.checkPicture(turned);
        QCOMPARE(changes.count(), 2); // told once
        state.checkPicture(basis().about);
        QVERIFY(!state.isValid());
        state.begin(basis());
        QVERIFY(state.isValid());
        state.end();
        QVERIFY(!state.isWanted() && state.reason().isEmpty() && state.line().isEmpty());
    }

    void theTableCountsFromTheRunOn_data()
    {
        QTest::addColumn<Places>("places"); // ms after the run's first picture, mm
        QTest::addColumn<bool>("valid");
        QTest::newRow("not reported") << Places{} << true;
        QTest::newRow("moved before the run") << Places{{-500, 0}, {-100, 50}, {100, 50}} << true;
        QTest::newRow("moved between run and roadmap") << Places{{-100, 0}, {500, 5}} << false;
        QTest::newRow("moved and moved back") << Places{{-100, 0}, {500, 5}, {900, 0}} << false;
        QTest::newRow("within the tolerance") << Places{{-100, 0}, {500, 0.9}} << true;
        QTest::newRow("creeping") << Places{{-100, 0}, {500, 0.5}, {900, 1.1}} << false;
        QTest::newRow("reported late") << Places{{100, 7}, {900, 7}} << true;
    }

    void theTableCountsFromTheRunOn()
    {
        QFETCH(const Places, places);
        QFETCH(const bool, valid);
        for (const bool before : {true, false}) { // the reports come before the roadmap is made, or after
            RoadmapState state;
            if (!before)
                state.begin(basis());
            for (const auto& [ms, mm] : places)
                state.noteTable({0, mm, 0}, start + std::chrono::milliseconds(ms));
            if (before)
                state.begin(basis());
            QCOMPARE(state.isValid(), valid);
        }
    }

    void aTableWhosePlaceIsForgottenHasMoved()
    {
        RoadmapState state;
        for (std::size_t i = 0; i <= RoadmapState::tablesKept; ++i)
            state.noteTable({0, 0, i % 2 == 0 ? 0 : 0.5}, start + std::chrono::seconds(i));
        state.begin(basis());
        QVERIFY(!state.isValid());
    }

    void thePatientMovesWhenPicturesSaySoAgainAndAgain()
    {
        RoadmapState state;
        state.begin(basis());
        for (int i = 0; i < 10; ++i) {
            state.checkDisplacement(0.02);
            state.checkDisplacement(0.02);
            state.checkDisplacement(0.001); // one beat of the heart
        }
        QVERIFY(state.isValid());
        for (int i = 0; i < RoadmapState::displacementsThatCount; ++i)
            state.checkDisplacement(0.02);
        QCOMPARE(state.reason(), QStringLiteral("the patient moved"));
    }
};

QTEST_APPLESS_MAIN(TestRoadmapState)
#include "test_roadmap_state.moc"
