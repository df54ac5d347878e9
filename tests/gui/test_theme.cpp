// The palette's contrast, the fonts' sizes, and figures that do not jump.
#include "widgets/figures.hpp"
#include "widgets/theme.hpp"

#include <QApplication>
#include <QFile>
#include <QLabel>
#include <QPainter>
#include <QRegularExpression>
#include <QTest>

using namespace console;
namespace colour = console::theme::colour;
using theme::TextRole;

class TestTheme : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase() { theme::apply(*qApp); }

    void textIsReadable_data()
    {
        QTest::addColumn<QColor>("ink");
        QTest::addColumn<QColor>("surface");
        QTest::addColumn<double>("least");
        for (const Brightness level : {Brightness::Dim, Brightness::Usual, Brightness::Bright}) {
            const theme::Greys& grey = theme::greys(level);
            for (const QColor& surface : {grey.background, grey.panel, grey.raised}) {
                const auto add = [&](const char* ink, const QColor& colour) {
                    const QString name = QStringLiteral("%1: %2 on %3").arg(word(level), QString::fromLatin1(ink), surface.name());
                    QTest::newRow(qPrintable(name)) << colour << surface << 4.5;
                };
                add("bright", grey.bright);
                add("text", grey.text);
                add("secondary", grey.secondary);
                add("stale", grey.stale);
                add("armed", colour::armed);
                add("medium", colour::medium);
                add("low", colour::low);
                add("x-ray", colour::xray);
                add("high", colour::high);
                add("plot", colour::plot);
            }
        }
        QTest::newRow("white on high") << QColor(Qt::white) << QColor(colour::highSurface) << 4.5;
        QTest::newRow("white on acknowledged high") << QColor(Qt::white) << QColor(colour::highSurfaceDim) << 4.5;
        QTest::newRow("white on acknowledged medium") << QColor(Qt::white) << QColor(colour::mediumSurfaceDim) << 4.5;
        QTest::newRow("dark on medium") << QColor(colour::onAlarm) << QColor(colour::medium) << 4.5;
        QTest::newRow("dark on low") << QColor(colour::onAlarm) << QColor(colour::low) << 4.5;
        QTest::newRow("dark on armed") << QColor(colour::onAlarm) << QColor(colour::armed) << 4.5;
        QTest::newRow("armed on its surface") << QColor(colour::armed) << QColor(colour::armedSurface) << 4.5;
        QTest::newRow("dark on x-ray") << QColor(colour::onAlarm) << QColor(colour::xray) << 4.5;
    }

    void textIsReadable()
    {
        QFETCH(QColor, ink);
        QFETCH(QColor, surface);
        QFETCH(double, least);
        QVERIFY2(theme::contrast(ink, surface) >= least, qPrintable(QString::number(theme::contrast(ink, surface))));
    }

    /// Each rule of the style sheet that names both.
    void theStyleSheetIsReadable_data()
    {
        QTest::addColumn<int>("level");
        for (int level = 0; level < brightnessCount; ++level)
            QTest::newRow(qPrintable(word(Brightness(level)))) << level;
    }

    void theStyleSheetIsReadable()
    {
        QFETCH(int, level);
        const QString sheet = theme::styleSheet(Brightness(level));
        const QRegularExpression rule(QStringLiteral("\\{([^}]*)\\}"));
        const QRegularExpression ink(QStringLiteral("(?:^|[\\s;])color: (#[0-9A-Fa-f]{6})"));
        const QRegularExpression surface(QStringLiteral("(?:^|[\\s;])background: (#[0-9A-Fa-f]{6})"));
        int checked = 0;
        auto rules = rule.globalMatch(sheet);
        while (rules.hasNext()) {
            const auto body = rules.next().captured(1);
            const auto text = ink.match(body);
            const auto under = surface.match(body);
            if (!text.hasMatch() || !under.hasMatch())
                continue;
            ++checked;
            QVERIFY2(theme::contrast(QColor(text.captured(1)), QColor(under.captured(1))) >= 4.5, qPrintable(body));
        }
        QVERIFY(checked >= 5);
    }

    void theUsualLevelIsThatOfTheSheetItself()
    {
        QFile file(QStringLiteral(":/liena/styles/cockpit.qss"));
        QVERIFY(file.open(QIODevice::ReadOnly));
        QCOMPARE(theme::styleSheet(Brightness::Usual).toLower(), QString::fromUtf8(file.readAll()).toLower());
        QVERIFY(theme::styleSheet(Brightness::Dim) != theme::styleSheet(Brightness::Bright));
        QVERIFY(!theme::styleSheet(Brightness::Bright).contains(QLatin1Char('@')));
    }

    void aLevelDoesNotGiveTwoTonesOneGrey()
    {
        for (const Brightness level : {Brightness::Dim, Brightness::Usual, Brightness::Bright}) {
            const theme::Greys& g = theme::greys(level);
            QSet<QRgb> tones;
            for (const QColor& tone :
                 {g.background, g.panel, g.raised, g.line, g.strongLine, g.bright, g.text, g.secondary, g.stale, g.hover, g.pressed})
                tones.insert(tone.rgb());
            QCOMPARE(tones.size(), 11);
        }
    }

    void inksFollowTheLevelAndAlarmsDoNot()
    {
        QLabel label;
        QPalette palette = label.palette();
        palette.setColor(QPalette::WindowText, colour::secondary);
        label.setPalette(palette);
        QLabel alarm;
        palette.setColor(QPalette::WindowText, colour::high);
        alarm.setPalette(palette);
        theme::setBrightness(*qApp, Brightness::Bright);
        QCOMPARE(label.palette().color(QPalette::WindowText), theme::greys(Brightness::Bright).secondary);
        QCOMPARE(alarm.palette().color(QPalette::WindowText), QColor(colour::high));
        theme::setBrightness(*qApp, Brightness::Usual);
        QCOMPARE(label.palette().color(QPalette::WindowText), theme::greys(Brightness::Usual).secondary);
    }

    void contrastIsTheOneOfWcag()
    {
        QCOMPARE(qRound(theme::contrast(Qt::white, Qt::black)), 21);
        QCOMPARE(qRound(10 * theme::contrast(colour::text, colour::background)), 118);
    }

    void sizesAreThoseOfTheReference()
    {
        QVERIFY(theme::font(TextRole::Caption, 1).pixelSize() >= 16);
        QVERIFY(theme::font(TextRole::Body, 1).pixelSize() >= 16);
        QVERIFY(theme::font(TextRole::Value, 1).pixelSize() >= 24);
        QVERIFY(theme::font(TextRole::Alarm, 1).pixelSize() >= 32);
        QVERIFY(theme::font(TextRole::Permit, 1).pixelSize() >= 32);
    }

    void smallScreensKeepALeastSize() { QVERIFY(theme::font(TextRole::Caption, 0.1).pixelSize() >= 11); }

    void scaleIsTheSmallerFraction()
    {
        QCOMPARE(theme::scaleFor({2560, 1440}), 1.0);
        QCOMPARE(theme::scaleFor({1920, 1440}), 0.75);
    }

    void figuresAllTakeTheSameRoom()
    {
        const QFont font = theme::font(TextRole::Value, 1);
        QCOMPARE(figuresWidth(font, QStringLiteral("111.1 mm")), figuresWidth(font, QStringLiteral("888.8 mm")));
    }

    void figuresBelowZeroHaveAMinusSign()
    {
        const auto mm = QStringLiteral("mm");
        QCOMPARE(figure(-2.55, 1, mm), QStringLiteral("\u22122.5\u00A0mm"));
        QCOMPARE(figure(-0.04, 1, mm), QStringLiteral("0.0\u00A0mm"));
        QCOMPARE(figure(-0.04, 2, mm), QStringLiteral("\u22120.04\u00A0mm"));
        QVERIFY(figure(-0.5, 0, mm) != QStringLiteral("\u22120\u00A0mm"));
        QCOMPARE(signedFigure(-2.0, 1, mm), QStringLiteral("\u22122.0\u00A0mm"));
        QCOMPARE(signedFigure(2.0, 1, mm), QStringLiteral("+2.0\u00A0mm"));
        QCOMPARE(signedFigure(0.04, 1, mm), QStringLiteral("0.0\u00A0mm"));
    }

    void unknownIsADash_data()
    {
        QTest::addColumn<double>("value");
        QTest::newRow("not a number") << std::numeric_limits<double>::quiet_NaN();
        QTest::newRow("infinite") << std::numeric_limits<double>::infinity();
    }

    void unknownIsADash()
    {
        QFETCH(double, value);
        QVERIFY(figure(value, 1, QStringLiteral("mm")).startsWith(QChar(0x2014)));
        QVERIFY(figure(std::nullopt, 1, QStringLiteral("mm")).startsWith(QChar(0x2014)));
    }

    void agesAreSpoken_data()
    {
        QTest::addColumn<qint64>("ms");
        QTest::addColumn<QString>("words");
        QTest::newRow("milliseconds") << qint64(84) << QStringLiteral("84\u00A0ms");
        QTest::newRow("seconds") << qint64(2400) << QStringLiteral("2.4\u00A0s");
        QTest::newRow("minutes") << qint64(187000) << QStringLiteral("3:07");
        QTest::newRow("hours") << qint64(3729000) << QStringLiteral("1:02:09");
        QTest::newRow("never negative") << qint64(-5) << QStringLiteral("0\u00A0ms");
    }

    void agesAreSpoken()
    {
        QFETCH(qint64, ms);
        QFETCH(QString, words);
        QCOMPARE(spokenAge(std::chrono::milliseconds(ms)), words);
    }
};

QTEST_MAIN(TestTheme)
#include "test_theme.moc"
