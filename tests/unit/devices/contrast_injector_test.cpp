// The injector: each number once, and never the rest of a stopped one.
#include "contrast_injector.hpp"

#include <QTest>

using namespace liena;
using namespace liena::devices;
using namespace std::chrono_literals;

namespace {

const DeviceId cockpit(0x40018208);
const DeviceId arm(0x60008208);
const SteadyTime start{1h};

} // namespace

class ContrastInjectorTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void deliversTheVolumeAtItsRate()
    {
        ContrastInjector injector(50);
        QCOMPARE(injector.request({cockpit, 1, 6, 2}, start).state, InjectionState::Accepted);
        QCOMPARE(injector.advance(start + 100ms)->state, InjectionState::Running);
        QCOMPARE(injector.flow(), 2.0);
        QVERIFY(!injector.advance(start + 2900ms));
        const auto done = injector.advance(start + 3100ms);
        QCOMPARE(done->state, InjectionState::Done);
        QCOMPARE(done->delivered, 6.0);
        QCOMPARE(injector.remaining(), 44.0);
        QCOMPARE(injector.flow(), 0.0);
    }

    void repeatIsAcknowledgedAndNotInjectedAgain()
    {
        ContrastInjector injector(50);
        injector.request({cockpit, 1, 6, 2}, start);
        QCOMPARE(injector.request({cockpit, 1, 6, 2}, start).state, InjectionState::Running);
        injector.advance(start + 4s);
        QCOMPARE(injector.request({cockpit, 1, 6, 2}, start + 4s).state, InjectionState::Done);
        injector.advance(start + 8s);
        QCOMPARE(injector.remaining(), 44.0);
    }

    void stoppedOneIsNeverResumed()
    {
        ContrastInjector injector(50);
        injector.request({cockpit, 1, 6, 2}, start);
        injector.advance(start + 1s);
        const auto stopped = injector.stop("the system stands by");
        QCOMPARE(stopped->state, InjectionState::Stopped);
        QCOMPARE(stopped->delivered, 2.0);
        QVERIFY(!injector.stop("again"));
        QCOMPARE(injector.request({cockpit, 1, 6, 2}, start + 2s).state, InjectionState::Stopped);
        injector.advance(start + 10s);
        QCOMPARE(injector.remaining(), 48.0);
    }

    void refusesWithAReason_data()
    {
        QTest::addColumn<double>("volume");
        QTest::addColumn<double>("rate");
        QTest::newRow("too much") << 31.0 << 2.0;
        QTest::newRow("too little") << 0.05 << 2.0;
        QTest::newRow("too fast") << 5.0 << 11.0;
        QTest::newRow("more than is left") << 20.0 << 2.0;
        QTest::newRow("no number") << std::nan("") << 2.0;
    }

    void refusesWithAReason()
    {
        QFETCH(double, volume);
        QFETCH(double, rate);
        ContrastInjector injector(10);
        const auto answer = injector.request({cockpit, 9, volume, rate}, start);
        QCOMPARE(answer.state, InjectionState::Refused);
        QVERIFY(!answer.reason.empty());
        QVERIFY(!injector.running());
        // A late repeat of a refused one is refused as well.
        QCOMPARE(injector.request({cockpit, 9, 5, 2}, start).state, InjectionState::Refused);
    }

    void refusalsOfOneKeepNobodyFromInjecting_data()
    {
        QTest::addColumn<quint32>("refused");
        QTest::newRow("another's") << arm.value();
        QTest::newRow("its own") << cockpit.value();
    }

    void refusalsOfOneKeepNobodyFromInjecting()
    {
        QFETCH(quint32, refused);
        ContrastInjector injector(50);
        injector.request({cockpit, 1, 6, 2}, start);
        injector.advance(start + 4s);
        constexpr std::uint32_t last = 5001;
        for (std::uint32_t number = 2; number <= last; ++number)
            QCOMPARE(injector.refuse({DeviceId(refused), number, 5, 2}, "not armed").state, InjectionState::Refused);
        QCOMPARE(injector.request({DeviceId(refused), last, 5, 2}, start + 4s).state, InjectionState::Refused); // a late repeat
        QCOMPARE(injector.request({cockpit, 1, 6, 2}, start + 4s).state, InjectionState::Done); // what was given stays known
        QCOMPARE(injector.request({cockpit, last + 1, 5, 2}, start + 4s).state, InjectionState::Accepted);
    }

    void onlyOneAtATime()
    {
        ContrastInjector injector(50);
        injector.request({cockpit, 1, 6, 2}, start);
        QCOMPARE(injector.request({cockpit, 2, 6, 2}, start).state, InjectionState::Refused);
    }
};

QTEST_GUILESS_MAIN(ContrastInjectorTest)
#include "contrast_injector_test.moc"
