// Each guard, taken away, is missed: the reference model reports what then happens.
#include "runs.hpp"

#include <QTest>

using namespace liena::simulation;

class MutantsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void isFound_data();
    void isFound();
};

void MutantsTest::isFound_data()
{
    QTest::addColumn<int>("mutant");
    for (const auto mutant : mutants)
        QTest::addRow("%s", std::string(nameOf(mutant)).c_str()) << static_cast<int>(mutant);
}

void MutantsTest::isFound()
{
    QFETCH(int, mutant);
    const auto found = caught(static_cast<Mutant>(mutant), 100);
    QVERIFY2(found.has_value(), "one hundred seeds with this fault look as without it");
    qInfo("seed %llu: %s: %s", static_cast<unsigned long long>(found->seed), found->violation.invariant.c_str(),
          found->violation.what.c_str());
}

QTEST_APPLESS_MAIN(MutantsTest)
#include "mutants_test.moc"
