// The roll-call: who holds, since when, and who has not confirmed it; in words, and by a mark.
#include "shown_texts.hpp"
#include "widgets/roll_call.hpp"
#include "widgets/theme.hpp"

#include <QApplication>
#include <QTest>

#include <optional>
#include <vector>

using namespace console;
using namespace console::test;

namespace {

/// Wide enough for every name.
void show(RollCall& call, const std::vector<HoldLine>& lines)
{
    call.setLines(lines);
    call.resize(800, call.sizeHint().height());
}

QString painted(QWidget& widget)
{
    QString all;
    for (const ShownText& shown : textsPaintedBy(widget))
        all += shown.text;
    return all;
}

HoldLine holdLine(const QString& title, bool holding, std::optional<double> afterMs, bool already = false)
{
    return {1, title, holding, afterMs, already};
}

} // namespace

class TestRollCall : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase() { theme::apply(*qApp); }

    void saysWhetherADeviceHolds_data()
    {
        QTest::addColumn<bool>("holding");
        QTest::addColumn<int>("afterMs"); // below zero: no time is known
        QTest::addColumn<bool>("already");
        QTest::addColumn<QString>("words");
        QTest::newRow("after a time") << true << 41 << false << QStringLiteral("holds, after 41\u00A0ms");
        QTest::newRow("before the loss was noticed") << true << -1 << true << QStringLiteral("holds already");
        QTest::newRow("no time is known") << true << -1 << false << QStringLiteral("holds");
        QTest::newRow("said nothing") << false << -1 << false << QStringLiteral("not confirmed");
        QTest::newRow("a time is no confirmation") << false << 41 << false << QStringLiteral("not confirmed");
        QTest::newRow("nor is an earlier hold") << false << -1 << true << QStringLiteral("not confirmed");
    }

    void saysWhetherADeviceHolds()
    {
        QFETCH(bool, holding);
        QFETCH(int, afterMs);
        QFETCH(bool, already);
        QFETCH(QString, words);
        RollCall call;
        const auto after = afterMs < 0 ? std::optional<double>() : std::optional<double>(afterMs);
        show(call, {holdLine(QStringLiteral("Robot"), holding, after, already)});
        QCOMPARE(call.accessibleDescription(), QStringLiteral("Robot: ") + words);
        QCOMPARE(painted(call), words + QStringLiteral("Robot"));
    }

    void eachDeviceHasItsOwnLine()
    {
        RollCall call;
        show(call, {holdLine(QStringLiteral("Cockpit"), true, 0.4), holdLine(QStringLiteral("Robot"), false, std::nullopt),
                    holdLine(QStringLiteral("Arm"), true, 38.0)});
        QCOMPARE(call.accessibleDescription(),
                 QStringLiteral("Cockpit: holds, after 0\u00A0ms; Robot: not confirmed; Arm: holds, after 38\u00A0ms"));
        QCOMPARE(painted(call), QStringLiteral("holds, after 0\u00A0msCockpitnot confirmedRobotholds, after 38\u00A0msArm"));
        show(call, {holdLine(QStringLiteral("Robot"), true, 41.0)}); // and nothing stays of what was said before
        QCOMPARE(call.accessibleDescription(), QStringLiteral("Robot: holds, after 41\u00A0ms"));
        QCOMPARE(painted(call), QStringLiteral("holds, after 41\u00A0msRobot"));
    }

    /// Who does not read the words still sees which is which.
    void aHoldThatIsMissingHasAnotherMark()
    {
        RollCall call;
        const auto mark = [&call](bool holding) {
            show(call, {holdLine(QString(), holding, std::nullopt)});
            return call.grab(QRect(0, 0, call.height(), call.height())).toImage();
        };
        const QImage holds = mark(true);
        QVERIFY(mark(false) != holds);
        QVERIFY(mark(true) == holds);
    }
};

QTEST_MAIN(TestRollCall)
#include "test_roll_call.moc"
