// Staying awake for a dialogue and for nothing else, in virtual time.
#include "tasks/attention.hpp"

#include <QTest>

using namespace liena::tasks;
using namespace std::chrono_literals;

namespace {

struct Thread {
    Attention attention;
    Attention::Instant now{1h};

    void step(std::chrono::nanoseconds after, int messages)
    {
        now += after;
        for (int i = 0; i < messages; ++i)
            attention.heard();
        if (attention.isConcerned())
            attention.judge(now);
    }

    /// Whether it is awake then.
    bool ask(std::chrono::nanoseconds after)
    {
        attention.asked();
        step(after, 0);
        return attention.isAwake();
    }

    void dialogue(int answers, std::chrono::nanoseconds every)
    {
        for (int i = 0; i < answers; ++i)
            step(every, 1);
    }
};

} // namespace

class AttentionTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void aDialogueKeepsItAwakeAndAPauseLetsItSleep()
    {
        Thread thread;
        thread.dialogue(Attention::enough - 1, 90us);
        QVERIFY(!thread.attention.isAwake());
        thread.dialogue(1, 90us);
        QVERIFY(thread.attention.isAwake());
        thread.dialogue(1000, 20us);
        QVERIFY(thread.attention.isAwake());
        thread.step(Attention::pause, 0);
        QVERIFY(thread.attention.isAwake());
        thread.step(1us, 0);
        QVERIFY(!thread.attention.isAwake());
        QVERIFY(!thread.attention.isConcerned());
        thread.dialogue(Attention::enough - 1, 90us); // and the next begins anew
        QVERIFY(!thread.attention.isAwake());
    }

    void whatComesNowAndThenIsSleptThrough_data()
    {
        QTest::addColumn<int>("microseconds");
        QTest::addColumn<int>("messages");
        QTest::newRow("commands at 1 kHz") << 1000 << 1;
        QTest::newRow("reports of many peers") << 300 << 1;
        QTest::newRow("bursts") << 2000 << 100;
        QTest::newRow("just not close") << 151 << 1;
        QTest::newRow("images alone") << 20 << 0;
    }

    void whatComesNowAndThenIsSleptThrough()
    {
        QFETCH(const int, microseconds);
        QFETCH(const int, messages);
        Thread thread;
        for (int i = 0; i < 10000; ++i) {
            thread.step(std::chrono::microseconds(microseconds), messages);
            QVERIFY(!thread.attention.isAwake());
        }
    }

    void whoseQuestionsAreAnsweredAtOnceIsAwakeUntilTheAnswer()
    {
        Thread thread;
        for (int i = 0; i < Attention::enough; ++i) {
            QVERIFY(!thread.ask(1ms));
            thread.step(70us, 1);
            QVERIFY(!thread.attention.isAwake());
        }
        for (int i = 0; i < 1000; ++i) {
            QVERIFY(thread.ask(1ms));
            thread.step(20us, 0);
            QVERIFY(thread.attention.isAwake());
            thread.step(40us, 1);
            QVERIFY(!thread.attention.isAwake()); // until it asks again
        }
    }

    void anAnswerThatIsLateIsSleptThroughAndAFewInTimeMakeUpForIt()
    {
        Thread thread;
        for (int i = 0; i < Attention::enough; ++i) {
            QVERIFY(!thread.ask(1ms));
            thread.step(70us, 1);
        }
        QVERIFY(thread.ask(1ms));
        thread.step(Attention::close, 0);
        QVERIFY(thread.attention.isAwake());
        thread.step(1us, 0);
        QVERIFY(!thread.attention.isAwake());
        QVERIFY(!thread.attention.isConcerned());
        for (int i = 0; i < Attention::enough / 2; ++i) {
            QVERIFY(!thread.ask(1ms));
            thread.step(70us, 1);
        }
        QVERIFY(thread.ask(1ms));
    }

    void whoIsNotAnsweredAtOnceOrAnswersIsNotAwake_data()
    {
        QTest::addColumn<int>("answerAfter"); // microseconds
        QTest::addColumn<int>("answersInSixteen");
        QTest::newRow("no answers") << 0 << 0;
        QTest::newRow("answers that take their time") << 151 << 16;
        QTest::newRow("messages that come close by chance, every second time") << 70 << 8;
    }

    void whoIsNotAnsweredAtOnceOrAnswersIsNotAwake()
    {
        QFETCH(const int, answerAfter);
        QFETCH(const int, answersInSixteen);
        Thread thread;
        for (int i = 0; i < 10000; ++i) {
            QVERIFY(!thread.ask(1ms));
            if (i % 16 * answersInSixteen % 16 < answersInSixteen)
                thread.step(std::chrono::microseconds(answerAfter), 1);
            QVERIFY(!thread.attention.isAwake());
        }
        for (int i = 0; i < 10000; ++i) { // and the other end: it hears and says in one step
            thread.attention.heard();
            QVERIFY(!thread.ask(1ms));
        }
    }

    void imagesBetweenCommandsDoNotKeepItAwake()
    {
        Thread thread;
        for (int i = 0; i < 10000; ++i) {
            thread.step(20us, i % 100 == 0 ? 1 : 0); // 500 commands a second among the segments of images
            QVERIFY(!thread.attention.isAwake());
        }
        thread.dialogue(Attention::enough, 50us);
        QVERIFY(thread.attention.isAwake());
        for (int i = 0; i < 6; ++i)
            thread.step(20us, 0);
        QVERIFY(!thread.attention.isAwake());
    }
};

QTEST_GUILESS_MAIN(AttentionTest)
#include "attention_test.moc"
