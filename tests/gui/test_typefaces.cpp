// The typefaces in the program: that they are what is drawn with, figures of one width, a slashed zero, and Chinese.
#include "widgets/theme.hpp"

#include <QApplication>
#include <QFile>
#include <QFontInfo>
#include <QFontMetricsF>
#include <QGlyphRun>
#include <QImage>
#include <QPainter>
#include <QPainterPath>
#include <QRawFont>
#include <QSet>
#include <QTest>
#include <QTextLayout>
#include <QXmlStreamReader>
#include <QtEndian>

#include <algorithm>

using namespace console;
using theme::TextRole;

namespace {

const QString sans = QStringLiteral("LiENa Sans");
const QString hei = QStringLiteral("LiENa Hei");
const QString figures = QStringLiteral("0123456789");

/// The families with which `text` is drawn; "none" where no face has a character of it.
QSet<QString> familiesOf(const QString& text)
{
    QTextLayout layout(text, theme::font(TextRole::Body, 1));
    layout.beginLayout();
    layout.createLine().setLineWidth(1e6);
    layout.endLayout();
    QSet<QString> families;
    for (const QGlyphRun& run : layout.glyphRuns()) {
        const bool drawn = run.rawFont().isValid() && !run.glyphIndexes().contains(0);
        families.insert(drawn ? run.rawFont().familyName() : QStringLiteral("none"));
    }
    return families;
}

QRawFont fileOf(const QString& file) { return QRawFont(file, 1000); }

QPainterPath outline(const QRawFont& face, QChar character) { return face.pathForGlyph(face.glyphIndexesForString(character).value(0)); }

bool inkInTheMiddle(const QPainterPath& shape) { return shape.contains(shape.boundingRect().center()); }

/// The ink in the middle ninth of a character as it is painted, in pixels.
double paintedInTheMiddle(const QFont& font, QChar character)
{
    const QRect box = QFontMetrics(font).tightBoundingRect(character);
    QImage image(box.size(), QImage::Format_Grayscale8);
    image.fill(Qt::black);
    QPainter painter(&image);
    painter.setFont(font);
    painter.setPen(Qt::white);
    painter.drawText(-box.topLeft(), character);
    painter.end();
    double ink = 0;
    for (int y = box.height() / 3; y < box.height() - box.height() / 3; ++y)
        for (int x = box.width() / 3; x < box.width() - box.width() / 3; ++x)
            ink += qGray(image.pixel(x, y)) / 255.0;
    return ink;
}

/// `count` numbers of two bytes of a face's table, from `offset` on.
QList<qint16> numbers(const QRawFont& face, const char* table, qsizetype offset, qsizetype count)
{
    const QByteArray bytes = face.fontTable(table);
    QList<qint16> found;
    for (qsizetype i = 0; i < count && offset + 2 * i + 2 <= bytes.size(); ++i)
        found << qFromBigEndian<qint16>(bytes.constData() + offset + 2 * i);
    return found;
}

/// Ascent, descent and line gap, and those for typography.
QList<qint16> heights(const QRawFont& face) { return numbers(face, "hhea", 4, 3) + numbers(face, "OS/2", 68, 5); }

} // namespace

class TestTypefaces : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase() { theme::apply(*qApp); }

    void everyRoleHasAFaceOfItsWeight_data() { roles(); }
    void everyRoleHasAFaceOfItsWeight()
    {
        QFETCH(QFont, font);
        QCOMPARE(QFontInfo(font).family(), sans);
        const QRawFont face = QRawFont::fromFont(font);
        QCOMPARE(face.familyName(), sans);
        QCOMPARE(numbers(face, "OS/2", 4, 1), QList<qint16>{qint16(font.weight())}); // of the file, not of what is asked for
    }

    void figuresAreOfOneWidth_data() { roles(); }
    void figuresAreOfOneWidth()
    {
        QFETCH(QFont, font);
        const QFontMetricsF metrics(font);
        QSet<double> widths;
        for (const QChar figure : figures)
            widths.insert(metrics.horizontalAdvance(figure));
        QCOMPARE(widths.size(), 1);
        QCOMPARE(metrics.horizontalAdvance(QStringLiteral("-1:11.7")), metrics.horizontalAdvance(QStringLiteral("-4:40.0")));
    }

    void zeroIsSlashed_data() { roles(); }
    void zeroIsSlashed()
    {
        QFETCH(QFont, font);
        const QRawFont face = QRawFont::fromFont(font);
        QVERIFY(inkInTheMiddle(outline(face, u'0')));
        QVERIFY(!inkInTheMiddle(outline(face, u'O')));
        const double zero = paintedInTheMiddle(font, u'0');
        const double letter = paintedInTheMiddle(font, u'O');
        QVERIFY2(zero > letter + 1, qPrintable(QStringLiteral("%1 and %2").arg(zero).arg(letter)));
    }

    void allButFiguresIsInter_data()
    {
        QTest::addColumn<QString>("weight");
        for (const char* weight : {"Regular", "Medium", "SemiBold", "Bold"})
            QTest::newRow(weight) << QString::fromLatin1(weight);
    }

    void allButFiguresIsInter()
    {
        QFETCH(QString, weight);
        const QRawFont ours = fileOf(QStringLiteral(":/liena/fonts/LiENaSans-%1.otf").arg(weight));
        const QRawFont inter = fileOf(QStringLiteral(LIENA_INTER "/Inter-%1.otf").arg(weight));
        QVERIFY(ours.isValid() && inter.isValid());
        QCOMPARE(heights(ours).size(), 8);
        QCOMPARE(heights(ours), heights(inter));
        for (ushort code = 0x21; code < 0x250; ++code) {
            const QChar character(code);
            if (!figures.contains(character) && inter.supportsCharacter(character))
                QVERIFY2(outline(ours, character) == outline(inter, character), qPrintable(QString(character)));
        }
        QVERIFY(!inkInTheMiddle(outline(inter, u'0')));
        QVERIFY(outline(ours, u'1') != outline(inter, u'1'));
    }

    void everyTextIsDrawnWithThem()
    {
        QFile file(QStringLiteral(LIENA_SOURCE_DIR "/resources/translations/liena-console_zh_CN.ts"));
        QVERIFY(file.open(QIODevice::ReadOnly));
        QXmlStreamReader xml(&file);
        int chinese = 0;
        while (!xml.atEnd()) {
            if (xml.readNext() != QXmlStreamReader::StartElement ||
                (xml.name() != QLatin1String("source") && xml.name() != QLatin1String("translation")))
                continue;
            const QString text = xml.readElementText(QXmlStreamReader::IncludeChildElements).simplified();
            const QSet<QString> families = familiesOf(text);
            QVERIFY2((families - QSet<QString>{sans, hei}).isEmpty(), qPrintable(text));
            chinese += families.contains(hei);
        }
        QVERIFY(!xml.hasError());
        QVERIFY(chinese > 500);
    }

    /// Beyond GB 2312, too.
    void namesOfPeopleAreDrawnWithThem()
    {
        QCOMPARE(familiesOf(QStringLiteral("\u5586\u9555\u5803\u73A5\u6607\u9648\u9673")), QSet<QString>{hei});
    }

    void figuresAmongChineseAreTheSame()
    {
        QCOMPARE(familiesOf(QStringLiteral("\u5F85\u673A10")), QSet<QString>({sans, hei}));
        const QRawFont face = fileOf(QStringLiteral(":/liena/fonts/LiENaHei-Regular.ttf"));
        QVERIFY(face.isValid() && face.supportsCharacter(QChar(0x5F85)));
        QVERIFY(std::none_of(figures.begin(), figures.end(), [&face](QChar figure) { return face.supportsCharacter(figure); }));
    }

    /// Thai, which neither has: what looks would notice.
    void whatNeitherHasIsNoticed() { QVERIFY(!(familiesOf(QStringLiteral("\u0E01")) - QSet<QString>{sans, hei}).isEmpty()); }

private:
    static void roles()
    {
        QTest::addColumn<QFont>("font");
        for (int role = 0; role <= int(TextRole::Permit); ++role)
            for (const double scale : {1.0, 0.5})
                QTest::addRow("role %d at %g", role, scale) << theme::font(TextRole(role), scale);
    }
};

/// Qt forgets a program's typefaces with its application; the tests run in the second of their process.
int main(int argc, char** argv)
{
    {
        const QGuiApplication first(argc, argv);
        const QFont loaded = theme::font(TextRole::Body, 1);
        Q_UNUSED(loaded)
    }
    QApplication application(argc, argv);
    TestTypefaces tests;
    return QTest::qExec(&tests, argc, argv);
}
#include "test_typefaces.moc"
