// Fixed seeds under the sanitizers, the same trace each time and with each compiler, and clocks that must not matter.
#include "runs.hpp"

#include <QTest>

#include <algorithm>

using namespace liena;
using namespace liena::simulation;
using namespace std::chrono_literals;

class SimulationTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void opensOverChunkedBytesAndHealsAfterACut();
    void seedsHold_data();
    void seedsHold();
    void laneThatBreaksTheSessionWhileItOpensDoesNoHarm();
    void sameSeedSameTrace();
    void wallClockStepsChangeNoSession();
    void minimisingKeepsWhatBreaks();
};

namespace {

QString wordsOf(const Outcome& outcome)
{
    QString words;
    for (const auto& violation : outcome.violations)
        words += QString::fromStdString(violation.invariant + ": " + violation.what + "\n");
    return words;
}

Scenario pairWith(std::vector<Fault> faults)
{
    auto scenario = Scenario::quiet(3, 2ms, 0, true, true);
    scenario.chaos = 3s;
    scenario.faults = std::move(faults);
    return scenario;
}

} // namespace

void SimulationTest::opensOverChunkedBytesAndHealsAfterACut()
{
    const auto outcome = runScenario(pairWith({{1500ms, FaultKind::Cut, 0, 1, 0, 200ms}}));
    QCOMPARE(wordsOf(outcome), QString());
    QCOMPARE(outcome.interruptions, std::uint64_t{2});
    QCOMPARE(outcome.standBys, std::uint64_t{0});
    QVERIFY(outcome.longestDetection > 107ms);
    QVERIFY(outcome.longestDetection <= 110ms);
    QVERIFY(outcome.commandsDelivered > 500);
}

void SimulationTest::seedsHold_data()
{
    QTest::addColumn<quint64>("seed");
    QTest::addColumn<quint64>("hash");
    const auto hashes = readHashes(LIENA_SOURCE_DIR "/tests/simulation/golden_hashes");
    QVERIFY2(hashes.size() >= 40, "tests/simulation/golden_hashes is not there, or not whole");
    for (const auto& [seed, hash] : hashes)
        QTest::addRow("seed %llu", static_cast<unsigned long long>(seed)) << quint64{seed} << quint64{hash};
}

/// Clean, and the trace that every compiler gave. After a change that is meant to be seen, `tests/simulation/run --keep` writes new hashes.
void SimulationTest::seedsHold()
{
    QFETCH(quint64, seed);
    QFETCH(quint64, hash);
    const auto outcome = runScenario(Scenario::chaotic(seed));
    QCOMPARE(wordsOf(outcome), QString());
    QCOMPARE(QString::number(outcome.hash, 16), QString::number(hash, 16));
}

void SimulationTest::laneThatBreaksTheSessionWhileItOpensDoesNoHarm()
{
    // What waited on a bulk lane was read while the lanes were being started, and ended them.
    QCOMPARE(wordsOf(runScenario(Scenario::chaotic(20261122030800134U))), QString());
}

void SimulationTest::sameSeedSameTrace()
{
    const auto once = runScenario(Scenario::chaotic(2));
    const auto again = runScenario(Scenario::chaotic(2));
    QVERIFY(once.observations > 100);
    QCOMPARE(again.hash, once.hash);
    QVERIFY(runScenario(Scenario::chaotic(3)).hash != once.hash);
}

void SimulationTest::wallClockStepsChangeNoSession()
{
    const auto course = [](std::uint32_t step) {
        auto scenario = pairWith({{1200ms, FaultKind::Cut, 0, 1, 0, 150ms}, {2200ms, FaultKind::Cut, 0, 1, 0, 700ms}});
        if (step != 6)
            scenario.faults.push_back({600ms, FaultKind::ClockStep, 0, 0, step, 0ns});
        return runScenario(scenario).course;
    };
    for (std::uint32_t step = 0; step < 6; ++step)
        QCOMPARE(course(step), course(6));
}

void SimulationTest::minimisingKeepsWhatBreaks()
{
    Outcome outcome;
    Scenario scenario;
    for (std::uint64_t seed = 1; outcome.violations.empty(); ++seed) {
        scenario = Scenario::chaotic(seed);
        scenario.mutant = Mutant::AutoResume;
        outcome = runScenario(scenario);
    }
    const auto invariant = outcome.violations.front().invariant;
    const auto least = minimised(scenario, invariant, 60);
    QVERIFY(least.faults.size() < scenario.faults.size());
    const auto left = runScenario(least);
    QVERIFY(std::any_of(left.violations.begin(), left.violations.end(), [&](const Violation& v) { return v.invariant == invariant; }));
}

QTEST_APPLESS_MAIN(SimulationTest)
#include "simulation_test.moc"
