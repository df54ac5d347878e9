// A thread that does not answer is noticed, and one that does again.
#include "sound/answer_watch.hpp"

#include <QTest>

using namespace console;
using namespace std::chrono_literals;

class TestAnswerWatch : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void whoIsNotAskedIsNotLate()
    {
        const AnswerWatch watch;
        QVERIFY(!watch.isLate(Instant{} + 24h));
    }

    void silenceIsLateAfterItsTime()
    {
        AnswerWatch watch;
        const auto start = Instant{} + 1h;
        watch.ask(start);
        watch.ask(start + 3s); // does not begin the time anew
        QVERIFY(!watch.isLate(start + AnswerWatch::patience));
        QVERIFY(watch.isLate(start + AnswerWatch::patience + 1ms));
        watch.noteAnswered(2, start + 6s);
        QVERIFY(!watch.isLate(start + 24h));
    }

    void whoWorksThroughManyIsNotLate()
    {
        AnswerWatch watch;
        const auto start = Instant{} + 1h;
        for (int i = 0; i < 3; ++i)
            watch.ask(start);
        watch.noteAnswered(1, start + 4s);
        QVERIFY(!watch.isLate(start + 8s));
        QVERIFY(watch.isLate(start + 10s));
    }
};

QTEST_GUILESS_MAIN(TestAnswerWatch)
#include "test_answer_watch.moc"
