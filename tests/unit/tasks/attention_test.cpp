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

    void dialogue(int answers, std::chrono::nanoseconds every)
    {
        for (int i = 0; i < answers; ++i)
            step(every, 1);
    }
};

} // namespace

class AttentionTest : public QObject {
    Q_OBJECT

private slots:
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
