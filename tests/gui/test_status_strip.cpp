// What the strip at the top says of the procedure, the system, the person and the clock.
#include "widgets/status_strip.hpp"
#include "widgets/theme.hpp"

#include <QApplication>
#include <QTest>

using namespace console;
using namespace std::chrono_literals;

namespace {

/// As it is read aloud: its caption and its value.
bool says(const StatusStrip& strip, const QString& words)
{
    for (const auto* label : strip.findChildren<NameLabel*>())
        if (label->accessibleName() == words)
            return true;
    return false;
}

} // namespace

class TestStatusStrip : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase() { theme::apply(*qApp); }

    void aStripThatKnowsNothingSaysSo()
    {
        const StatusStrip strip;
        for (const char* words : {"Patient: Not named", "Procedure: Not started", "System: None loaded",
                                  "Operator: Not signed in \u00B7 operator", "Recorder: Stopped", "Local time: --:--:-- not compared"})
            QVERIFY2(says(strip, QString::fromUtf8(words)), words);
    }

    void eachFieldSaysWhatItWasGiven()
    {
        StatusStrip strip;
        strip.setProcedureTime(74s);
        strip.setTopology(QStringLiteral("Remote vascular intervention"), QStringLiteral("3bf54c0123456789"));
        strip.setRole(QStringLiteral("Dr. Example"), OperatorRole::Observer);
        strip.setWallClock(QStringLiteral("09:29:35"), 1250us);
        strip.setRecorder(true);
        for (const char* words : {"Procedure: 1:14", "System: Remote vascular intervention  3bf54c",
                                  "Operator: Dr. Example \u00B7 observer", "Local time: 09:29:35 \u00B11.3\u00A0ms", "Recorder: Alarm log"})
            QVERIFY2(says(strip, QString::fromUtf8(words)), words);
        strip.setProcedureTime(3674s);
        QVERIFY(says(strip, QStringLiteral("Procedure: 1:01:14")));
        strip.setWallClock(QStringLiteral("09:29:36"), std::nullopt);
        QVERIFY(says(strip, QStringLiteral("Local time: 09:29:36 not compared")));
    }
};

QTEST_MAIN(TestStatusStrip)
#include "test_status_strip.moc"
