// Tests of what a saved DICOM picture says of its pixels.
#include "chain_run.hpp"
#include "imaging/pane_colours.hpp"
#include "imaging/picture_marks.hpp"
#include "saved_picture.hpp"

#include <QPainter>
#include <QTemporaryDir>
#include <QtTest>

using namespace console;
using namespace console::saved;

class TestSecondaryCapture : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void saysWhatWasLostOnTheWay_data();
    void saysWhatWasLostOnTheWay();
    void keepsTheColourOfVessels();
    void saysOfHowManyPicturesItIsTheMean();
    void carriesSidesScaleAndWindowInItsPixels_data();
    void carriesSidesScaleAndWindowInItsPixels();
    void isTheSameOnACalibratedDisplay();
};

void TestSecondaryCapture::saysWhatWasLostOnTheWay_data()
{
    QTest::addColumn<PixelEncoding>("encoding");
    QTest::addColumn<int>("quality");
    QTest::addColumn<int>("rung");
    QTest::addColumn<PictureSource>("source");
    QTest::addColumn<QStringList>("lossy"); // whether, how, by how much
    QTest::addColumn<QString>("words");
    const auto none = QString();
    const QString jpeg = QStringLiteral("ISO_10918_1");
    const QString ls = QStringLiteral("ISO_14495_1");
    const auto row = [](const char* name, PixelEncoding encoding, int quality, int rung, PictureSource source, const QStringList& lossy,
                        const char* words) {
        QTest::newRow(name) << encoding << quality << rung << source << lossy << QString::fromLatin1(words);
    };
    using enum PixelEncoding;
    using enum PictureSource;
    row("raw", Raw, 0, 0, Live, {QStringLiteral("00"), none, none}, "");
    row("lossless", JpegLs, 0, 0, Live, {QStringLiteral("00"), none, none}, "");
    row("fewer", Raw, 0, 1, Live, {QStringLiteral("00"), none, none}, "REDUCED 7.5 of 15 /s, raw");
    row("recorded", Raw, 0, 0, Recorded, {none, none, none}, "");
    row("near", JpegLs, 2, 0, Simulated, {QStringLiteral("01"), ls, QStringLiteral("10")}, "");
    row("lossy", Jpeg, 50, 9, Live, {QStringLiteral("01"), jpeg, QStringLiteral("10")}, "REDUCED 7.5 of 15 /s, lossy 50");
    row("lossy before", Jpeg, 90, 0, Recorded, {QStringLiteral("01"), jpeg, QStringLiteral("10")}, "");
}

void TestSecondaryCapture::saysWhatWasLostOnTheWay()
{
    QFETCH(PixelEncoding, encoding);
    QFETCH(int, quality);
    QFETCH(int, rung);
    QFETCH(PictureSource, source);
    QFETCH(QStringList, lossy);
    QFETCH(QString, words);
    const QTemporaryDir folder;
    const QString path = folder.filePath(QStringLiteral("a.dcm"));
    DisplayPicture sent = picture();
    sent.about.encoding = encoding;
    sent.about.quality = quality;
    sent.about.source = source;
    sent.about.rung = rung;
    sent.about.rate = 7.5;
    sent.about.askedRate = 15;
    sent.about.rows = 200; // of one byte
    sent.about.columns = 300;
    sent.about.encodedBytes = 6000;
    QCOMPARE(saveSecondaryCapture({sent}, path), QString());
    DcmFileFormat file;
    QVERIFY(file.loadFile(path.toLocal8Bit().constData()).good());
    DcmDataset& dataset = *file.getDataset();
    const QStringList said{valueOf(dataset, DCM_LossyImageCompression), valueOf(dataset, DCM_LossyImageCompressionMethod),
                           valueOf(dataset, DCM_LossyImageCompressionRatio)};
    QCOMPARE(said, lossy);
    const QString comments = valueOf(dataset, DCM_ImageComments);
    QVERIFY2(words.isEmpty() ? !comments.contains(QStringLiteral("REDUCED")) : comments.contains(words), qPrintable(comments));
    QCOMPARE(exportWords({sent}).contains(QStringLiteral("REDUCED")), !words.isEmpty()); // in the pixels and below the PNG
}

void TestSecondaryCapture::saysOfHowManyPicturesItIsTheMean()
{
    const QTemporaryDir folder;
    const QString path = folder.filePath(QStringLiteral("a.dcm"));
    DisplayPicture sent = picture(PictureRole::Hold);
    for (const int meanOf : {1, 4}) {
        sent.meanOf = meanOf;
        QCOMPARE(saveSecondaryCapture({sent}, path), QString());
        DcmFileFormat file;
        QVERIFY(file.loadFile(path.toLocal8Bit().constData()).good());
        const QString comments = valueOf(*file.getDataset(), DCM_ImageComments);
        const QString derivation = valueOf(*file.getDataset(), DCM_DerivationDescription);
        QCOMPARE(comments.startsWith(QStringLiteral("LAST IMAGE HOLD \u00B7 MEAN OF 4  ")), meanOf == 4);
        QCOMPARE(comments.contains(QStringLiteral("MEAN")), meanOf == 4);
        QCOMPARE(derivation.startsWith(QStringLiteral("MEAN OF 4  C ")), meanOf == 4);
        QCOMPARE(derivation.contains(QStringLiteral("MEAN")), meanOf == 4);
    }
}

void TestSecondaryCapture::carriesSidesScaleAndWindowInItsPixels_data()
{
    QTest::addColumn<XrayGeometry>("geometry");
    QTest::addColumn<QStringList>("sides");
    QTest::addColumn<QString>("scale");
    XrayGeometry geometry;
    QTest::newRow("unknown") << geometry << QStringList{QStringLiteral("sides unknown")} << QStringLiteral("no scale: geometry unknown");
    geometry.sourceDetectorDistance = 1100;
    geometry.sourceObjectDistance = 750;
    const QString scale = QStringLiteral("10 mm @ isocentre plane (geometry)"); // 301 pixels of 0.2045 mm
    QTest::newRow("from the front") << geometry << QStringList{QStringLiteral("R"), QStringLiteral("L")} << scale;
    geometry.primaryAngle = 90;
    QTest::newRow("from the side") << geometry << QStringList{QStringLiteral("A"), QStringLiteral("P")} << scale;
}

/// As every pane paints them, at their place, and nothing over them.
void TestSecondaryCapture::carriesSidesScaleAndWindowInItsPixels()
{
    QFETCH(XrayGeometry, geometry);
    QFETCH(QStringList, sides);
    QFETCH(QString, scale);
    const QTemporaryDir folder;
    const QString path = folder.filePath(QStringLiteral("a.dcm"));
    DisplayPicture sent = picture(PictureRole::Hold);
    sent.about.geometry = geometry;
    QCOMPARE(saveSecondaryCapture({sent}, path), QString());
    const QByteArray bytes = pixelsOf(path);
    QVERIFY(bytes.size() >= size.width() * size.height());
    const QImage saved(reinterpret_cast<const uchar*>(bytes.constData()), size.width(), size.height(), size.width(),
                       QImage::Format_Grayscale8);

    QFont font;
    font.setPixelSize(10);
    TextPlates marks(font);
    placeSides(marks, sent.image.rect(), sent);
    const QRect bar = placeScale(marks, sent.image.rect(), sent, 1);
    placeFacts(marks, sent.image.rect(), bar, sent, 1);
    QImage marked = sent.image;
    QPainter painter(&marked);
    marks.paint(painter);
    paintScaleBar(painter, bar);
    painter.end();
    marked = marked.convertToFormat(QImage::Format_Grayscale8);
    const QImage bare = sent.image.convertToFormat(QImage::Format_Grayscale8);

    QStringList said;
    for (const OverlayPlate& plate : marks.plates()) {
        said << plate.text;
        QVERIFY2(saved.copy(plate.rect) == marked.copy(plate.rect), qPrintable(plate.text));
        QVERIFY2(saved.copy(plate.rect) != bare.copy(plate.rect), qPrintable(plate.text));
    }
    for (const QString& word : sides + QStringList{scale})
        QVERIFY2(said.contains(word), qPrintable(said.join(QLatin1Char('|'))));
    QVERIFY2(said.filter(QStringLiteral("C 128  W 256")).size() == 1, qPrintable(said.join(QLatin1Char('|'))));
    QCOMPARE(bar.isEmpty(), geometry.sourceDetectorDistance <= 0);
    if (!bar.isEmpty()) {
        QVERIFY(saved.rect().contains(bar));
        QCOMPARE(saved.copy(bar), marked.copy(bar));
        QVERIFY(saved.copy(bar) != bare.copy(bar));
    }
}

/// A workstation applies the grey scale of its own display to what is saved.
void TestSecondaryCapture::isTheSameOnACalibratedDisplay()
{
    const QTemporaryDir folder;
    const QString path = folder.filePath(QStringLiteral("a.dcm"));
    const auto frame = samples::frame(1, size, 12, PixelEncoding::Raw);
    DisplaySettings settings;
    settings.inverted = true;
    settings.edge = 30;
    settings.shutter = ShutterShape::Circle;
    samples::ChainRun plain;
    samples::ChainRun calibrated;
    calibrated.chain.setGreyScale(GreyScale(DisplayMeasurement{0.2, {{0, 0.4}, {128, 60}, {255, 350}}}));
    const DisplayPicture usual = plain.show(*frame, settings);
    DisplayPicture shown = calibrated.show(*frame, settings);
    QVERIFY(shown.isCalibrated && shown.image != usual.image);
    QCOMPARE(saveSecondaryCapture({usual}, path), QString());
    const QByteArray pixels = pixelsOf(path);
    QCOMPARE(saveSecondaryCapture({shown}, path), QString());
    DcmFileFormat file;
    QVERIFY(file.loadFile(path.toLocal8Bit().constData()).good());
    QVERIFY(!valueOf(*file.getDataset(), DCM_DerivationDescription).contains(QStringLiteral("levels")));
    QCOMPARE(valueOf(*file.getDataset(), DCM_PhotometricInterpretation), QStringLiteral("MONOCHROME2"));
    shown.isCalibrated = false; // that is said in the pixels, of the pane where it was seen
    QCOMPARE(saveSecondaryCapture({shown}, path), QString());
    QVERIFY(!pixels.isEmpty());
    QCOMPARE(pixelsOf(path), pixels);
}

/// All other pictures stay grey, whatever colour their words have.
void TestSecondaryCapture::keepsTheColourOfVessels()
{
    const QTemporaryDir folder;
    const QString path = folder.filePath(QStringLiteral("a.dcm"));
    for (const bool vessels : {false, true}) {
        Snapshot snapshot{picture(PictureRole::Roadmap)};
        snapshot.measurement.setMode(MeasureMode::Distance);
        snapshot.measurement.add({10, 60});
        snapshot.measurement.add({90, 60});
        if (vessels)
            snapshot.picture.image.setPixelColor(200, 100, pane_colours::roadmap);
        QCOMPARE(saveSecondaryCapture(snapshot, path), QString());
        DcmFileFormat file;
        QVERIFY(file.loadFile(path.toLocal8Bit().constData()).good());
        DcmDataset& dataset = *file.getDataset();
        const std::size_t samples = vessels ? 3 : 1;
        QCOMPARE(valueOf(dataset, DCM_SamplesPerPixel).toULong(), static_cast<unsigned long>(samples));
        QCOMPARE(valueOf(dataset, DCM_PhotometricInterpretation), vessels ? QStringLiteral("RGB") : QStringLiteral("MONOCHROME2"));
        QCOMPARE(valueOf(dataset, DCM_PlanarConfiguration), vessels ? QStringLiteral("0") : QString());
        const QByteArray pixels = pixelsOf(path);
        const auto pixelAt = [&](int x, int y) {
            const auto samplesBefore = static_cast<qsizetype>(samples) * (y * size.width() + x);
            return pixels.mid(samplesBefore, static_cast<qsizetype>(samples));
        };
        QCOMPARE(pixels.size(), static_cast<qsizetype>(samples) * size.width() * size.height() + 1); // odd: with a byte behind
        if (vessels) {
            const QColor violet = pane_colours::roadmap;
            QCOMPARE(pixelAt(200, 100), QByteArray().append(char(violet.red())).append(char(violet.green())).append(char(violet.blue())));
        }
        QCOMPARE(pixelAt(201, 100), QByteArray(static_cast<qsizetype>(samples), char(301 % 256)));
        QCOMPARE(pixelAt(300, 200), QByteArray(static_cast<qsizetype>(samples), char(500 % 256)));
    }
}

QTEST_MAIN(TestSecondaryCapture)
#include "test_secondary_capture.moc"
