// A roadmap that is asked for: answered once, and never with what was taken before somebody thought better of it.
#include "contrast_run.hpp"
#include "imaging/roadmap_maker.hpp"
#include "imaging/roadmap_request.hpp"

#include <QSignalSpy>
#include <QtTest>

using namespace console;
using namespace console::test;

class TestRoadmapRequest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void eachRequestIsAnsweredOnce();
    void aRequestThatWasCancelledIsNotAnswered();
    void aRequestMayEndBeforeItsAnswer();
};

void TestRoadmapRequest::eachRequestIsAnsweredOnce()
{
    RoadmapMaker maker;
    RoadmapRequest request(maker);
    QSignalSpy answers(&request, &RoadmapRequest::answered);
    request.make();
    request.make();
    QCOMPARE(answers.count(), 0);
    QTRY_COMPARE(answers.count(), 1);
    QVERIFY(!answers.takeFirst().front().value<MadeRoadmap>().roadmap);
    takeRun(maker, {}, 1);
    request.make();
    QTRY_COMPARE(answers.count(), 1);
    const auto made = answers.front().front().value<MadeRoadmap>();
    QVERIFY(made.roadmap);
    QCOMPARE(made.vessels.size(), QSize(edge, edge));
}

/// And the one after it is made of what there is then.
void TestRoadmapRequest::aRequestThatWasCancelledIsNotAnswered()
{
    RoadmapMaker maker;
    takeRun(maker, {}, 1, 1);
    takeRun(maker, {}, 1, 2);
    RoadmapRequest request(maker);
    QSignalSpy answers(&request, &RoadmapRequest::answered);
    request.make();
    QTest::qSleep(500); // its answer is there, and not yet heard
    request.cancel();
    maker.forget();
    request.make();
    QTRY_COMPARE(answers.count(), 1);
    QVERIFY(!answers.front().front().value<MadeRoadmap>().roadmap);
    request.make();
    QTRY_COMPARE(answers.count(), 2);
    QVERIFY(!answers.back().front().value<MadeRoadmap>().roadmap);
}

void TestRoadmapRequest::aRequestMayEndBeforeItsAnswer()
{
    RoadmapMaker maker;
    takeRun(maker, {}, 1);
    int answers = 0;
    {
        RoadmapRequest request(maker);
        connect(&request, &RoadmapRequest::answered, this, [&answers] { ++answers; });
        request.make();
    }
    QCoreApplication::processEvents();
    QCOMPARE(answers, 0);
}

QTEST_GUILESS_MAIN(TestRoadmapRequest)
#include "test_roadmap_request.moc"
