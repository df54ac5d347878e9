// What a thread keeps of the one that made it.
#include "base/ordinary_thread.hpp"
#include "support/bound_thread.hpp"

#include <QTest>

#include <thread>

using namespace liena;
using namespace liena::test;

class OrdinaryThreadTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void leavesTheProcessorsOfWhoeverMadeIt();
    void changesNothingOfOneThatIsOrdinary();
};

void OrdinaryThreadTest::leavesTheProcessorsOfWhoeverMadeIt()
{
    if (const auto all = processorsOfProcess(); CPU_COUNT(&all) < 2)
        QSKIP("there is one processor");
    cpu_set_t inherited{};
    cpu_set_t ordinary{};
    runBound([&] {
        std::thread([&] {
            inherited = ownProcessors();
            base::runAsOrdinaryThread();
            ordinary = ownProcessors();
        }).join();
    });
    QCOMPARE(CPU_COUNT(&inherited), 1);
    const auto all = processorsOfProcess();
    QVERIFY(CPU_EQUAL(&ordinary, &all) != 0);
}

void OrdinaryThreadTest::changesNothingOfOneThatIsOrdinary()
{
    const auto before = ownProcessors();
    base::runAsOrdinaryThread();
    const auto after = ownProcessors();
    QVERIFY(CPU_EQUAL(&before, &after) != 0);
    QCOMPARE(::sched_getscheduler(0), SCHED_OTHER);
}

QTEST_APPLESS_MAIN(OrdinaryThreadTest)
#include "ordinary_thread_test.moc"
