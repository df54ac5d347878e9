// The X-ray system's own figures, repeated: never without their age, and grey when they are old.
#include "widgets/dose_panel.hpp"
#include "widgets/figures.hpp"
#include "widgets/theme.hpp"

#include <QApplication>
#include <QTest>

#include <vector>

using namespace console;
using namespace std::chrono_literals;
namespace colour = console::theme::colour;

namespace {

const Instant heard = Instant{} + 1h;

/// One figure of the panel, as it stands there when it was received and when it never was.
struct Repeat {
    QString caption;
    QString value;
    QString dash;
};

std::vector<Repeat> repeats()
{
    return {{QStringLiteral("Fluoroscopy time"), QStringLiteral("3:52"), QStringLiteral("\u2014")},
            {QStringLiteral("Air kerma"), QStringLiteral("212.4\u00A0mGy"), QStringLiteral("\u2014\u00A0mGy")},
            {QStringLiteral("Kerma rate"), QStringLiteral("9.6\u00A0mGy/min"), QStringLiteral("\u2014\u00A0mGy/min")},
            {QStringLiteral("Dose-area product"), QStringLiteral("18.42\u00A0Gy\u00B7cm\u00B2"),
             QStringLiteral("\u2014\u00A0Gy\u00B7cm\u00B2")}};
}

struct Stage {
    InstrumentState instrument;
    XraySystemState xray;
    DosePanel panel{instrument, xray};

    void reportDose(Instant at)
    {
        AcquisitionStatus status;
        status.fluoroscopyTime = 232;
        status.airKerma = 212.4;
        status.airKermaRate = 9.6;
        status.doseAreaProduct = 18.42;
        xray.receive(status, at);
    }

    void reportContrast(Instant at)
    {
        RobotStatus status;
        status.contrastRemaining = 78.5;
        instrument.receiveRobot(status, at);
    }

    const FigureLabel* value(const QString& caption) const
    {
        for (const auto* label : panel.findChildren<FigureLabel*>())
            if (label->accessibleName() == caption)
                return label;
        return nullptr;
    }

    /// The end of the line that begins so.
    QString age(const QString& beginning) const
    {
        for (const auto* label : panel.findChildren<FigureLabel*>())
            if (label->text().startsWith(beginning))
                return label->text().mid(beginning.size());
        return QStringLiteral("no such line");
    }

    QString doseAge() const { return age(QStringLiteral("Repeated from the X-ray system, ")); }
};

QColor inkOf(const FigureLabel* label) { return label->palette().color(QPalette::WindowText); }

} // namespace

class TestDosePanel : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase() { theme::apply(*qApp); }

    void whatWasNeverReceivedIsADash()
    {
        Stage stage;
        stage.panel.refresh(heard);
        for (const Repeat& repeat : repeats()) {
            const auto* label = stage.value(repeat.caption);
            QVERIFY2(label != nullptr, qPrintable(repeat.caption));
            QCOMPARE(label->text(), repeat.dash);
            QCOMPARE(inkOf(label), QColor(colour::secondary));
        }
        QCOMPARE(stage.doseAge(), QStringLiteral("never received"));
    }

    void oldFiguresAreGreyAndSayHowOldTheyAre_data()
    {
        QTest::addColumn<int>("ageMs");
        QTest::addColumn<bool>("fresh");
        QTest::addColumn<QString>("age");
        QTest::newRow("just received") << 64 << true << QStringLiteral("age 64\u00A0ms");
        QTest::newRow("as old as may be") << 500 << true << QStringLiteral("age 500\u00A0ms");
        QTest::newRow("stale") << 501 << false << QStringLiteral("stale 501\u00A0ms");
        QTest::newRow("stale for long") << 2400 << false << QStringLiteral("stale 2.4\u00A0s");
    }

    void oldFiguresAreGreyAndSayHowOldTheyAre()
    {
        QFETCH(int, ageMs);
        QFETCH(bool, fresh);
        QFETCH(QString, age);
        Stage stage;
        stage.reportDose(heard);
        stage.panel.refresh(heard + std::chrono::milliseconds(ageMs));
        for (const Repeat& repeat : repeats()) {
            const auto* label = stage.value(repeat.caption);
            QVERIFY2(label != nullptr, qPrintable(repeat.caption));
            QCOMPARE(label->text(), repeat.value);
            QVERIFY2(inkOf(label) == (fresh ? colour::bright : colour::stale), qPrintable(repeat.caption));
        }
        QCOMPARE(stage.doseAge(), age);
    }

    void figuresThatComeAgainAreBrightAgain()
    {
        Stage stage;
        stage.reportDose(heard);
        stage.panel.refresh(heard + 3s);
        stage.reportDose(heard + 4s);
        stage.panel.refresh(heard + 4s);
        for (const Repeat& repeat : repeats())
            QVERIFY2(inkOf(stage.value(repeat.caption)) == colour::bright, qPrintable(repeat.caption));
        QCOMPARE(stage.doseAge(), QStringLiteral("age 0\u00A0ms"));
    }

    /// Each side of the panel is as old as the device that told it.
    void theRobotAndTheXraySystemAreOldForThemselves()
    {
        const QString contrast = QStringLiteral("Contrast left");
        const QString contrastAge = QStringLiteral("Contrast from the robot, ");
        Stage silentXray;
        silentXray.reportDose(heard);
        silentXray.reportContrast(heard + 2s);
        silentXray.panel.refresh(heard + 2s);
        QCOMPARE(inkOf(silentXray.value(contrast)), QColor(colour::bright));
        QCOMPARE(silentXray.age(contrastAge), QStringLiteral("age 0\u00A0ms"));
        QCOMPARE(silentXray.doseAge(), QStringLiteral("stale 2.0\u00A0s"));
        Stage silentRobot;
        silentRobot.reportContrast(heard);
        silentRobot.reportDose(heard + 2s);
        silentRobot.panel.refresh(heard + 2s);
        QCOMPARE(inkOf(silentRobot.value(contrast)), QColor(colour::stale));
        QCOMPARE(silentRobot.age(contrastAge), QStringLiteral("stale 2.0\u00A0s"));
        QCOMPARE(silentRobot.doseAge(), QStringLiteral("age 0\u00A0ms"));
        for (const Repeat& repeat : repeats()) {
            QVERIFY2(inkOf(silentXray.value(repeat.caption)) == colour::stale, qPrintable(repeat.caption));
            QVERIFY2(inkOf(silentRobot.value(repeat.caption)) == colour::bright, qPrintable(repeat.caption));
        }
    }
};

QTEST_MAIN(TestDosePanel)
#include "test_dose_panel.moc"
