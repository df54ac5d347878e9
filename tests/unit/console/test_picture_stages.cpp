// Where a picture's age comes from: sums, percentiles, and that a minute is kept and no more.
#include "model/picture_stages.hpp"
#include "model/picture_state.hpp"

#include <QTest>

using namespace console;
using namespace std::chrono_literals;

namespace {

const Instant start = Instant{} + 1h;

StageShares shares(Duration way) { return {5ms, way, 2ms, 3ms, 1ms, 4ms, 10ms}; }

} // namespace

class TestPictureStages : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void thereIsNothingBeforeAPicture()
    {
        PictureStages stages;
        QVERIFY(!stages.of(PictureStage::Way, start));
        QVERIFY(!stages.ofAge(start));
    }

    void everyStageHasItsName()
    {
        QStringList names;
        for (std::size_t i = 0; i < pictureStageCount; ++i)
            names << word(static_cast<PictureStage>(i));
        names.removeDuplicates();
        names.removeAll(QString());
        QCOMPARE(names.size(), qsizetype(pictureStageCount));
    }

    void tellsMedianAndTheWorstOfAHundred()
    {
        PictureStages stages;
        for (int i = 1; i <= 100; ++i)
            stages.note(shares(std::chrono::milliseconds(i)), start + i * 66ms);
        const auto now = start + 100 * 66ms;
        QCOMPARE(stages.of(PictureStage::Way, now)->p50, 50.0);
        QCOMPARE(stages.of(PictureStage::Way, now)->p99, 99.0);
        QCOMPARE(stages.of(PictureStage::FilterDelay, now)->p50, 10.0);
        QCOMPARE(stages.ofAge(now)->p50, 75.0); // the stages of one picture add up
    }

    void forgetsAfterAMinute()
    {
        PictureStages stages;
        stages.note(shares(90ms), start);
        stages.note(shares(5ms), start + 61s);
        QCOMPARE(stages.of(PictureStage::Way, start + 61s)->p99, 5.0);
        QVERIFY(!stages.of(PictureStage::Way, start + 122s)); // though nothing was painted since
    }

    void presentingComesOnTopOfTheAge()
    {
        PictureStages stages;
        stages.notePresented(9ms); // of nothing
        QVERIFY(!stages.ofPresenting(start));
        stages.note(shares(20ms), start);
        QVERIFY(!stages.ofPresenting(start)); // painted, and not handed over yet
        const auto age = stages.ofAge(start)->p50;
        stages.notePresented(4ms);
        QCOMPARE(stages.ofPresenting(start)->p50, 4.0);
        QCOMPARE(stages.ofAge(start)->p50, age);
        stages.note(shares(20ms), start + 66ms);
        QCOMPARE(stages.ofPresenting(start + 66ms)->p99, 4.0); // the second one counts when it is there
    }

    void onlyTheNewestPictureIsPresented()
    {
        PictureState state;
        PictureStamp stamp;
        stamp.frame = 7;
        stamp.captured = start - 60ms;
        stamp.arrived = start - 25ms;
        stamp.painted = start;
        state.notePainted(stamp);
        state.notePresented(6, 3ms);
        QVERIFY(!state.stages().ofPresenting(start));
        state.notePresented(7, 3ms);
        QCOMPARE(state.stages().ofPresenting(start)->p50, 3.0);
    }

    /// The state of the picture feeds it: what is painted, by its stamp.
    void addsUpToTheAgeAtThePaint()
    {
        PictureState state;
        PictureStamp stamp;
        stamp.frame = 1;
        stamp.captured = start - 60ms;
        stamp.beforeSending = 12ms;
        stamp.arrived = start - 25ms;
        stamp.decoding = 8ms;
        stamp.filters = 4ms;
        stamp.window = 3ms;
        stamp.filterDelay = 20ms;
        stamp.painted = start;
        state.notePainted(stamp);
        const auto of = [&state](PictureStage stage) { return state.stages().of(stage, start)->p50; };
        QCOMPARE(of(PictureStage::Sending), 12.0);
        QCOMPARE(of(PictureStage::Way), 23.0);
        QCOMPARE(of(PictureStage::Waiting), 10.0);
        QCOMPARE(of(PictureStage::Decoding), 8.0);
        QCOMPARE(of(PictureStage::Filters), 4.0);
        QCOMPARE(of(PictureStage::Window), 3.0);
        QCOMPARE(of(PictureStage::FilterDelay), 20.0);
        QCOMPARE(state.stages().ofAge(start)->p50, milliseconds(*state.reading(start).age));

        stamp.frame = 2;
        stamp.captured.reset(); // whose age is unknown has no stages
        state.notePainted(stamp);
        QCOMPARE(state.stages().ofAge(start)->p99, 80.0);
    }
};

QTEST_GUILESS_MAIN(TestPictureStages)
#include "test_picture_stages.moc"
