// Tests of saved pictures: read back with another reader, whole or not at all, and saying what they are.
#include "imaging/file_writing.hpp"
#include "imaging/picture_saver.hpp"
#include "saved_picture.hpp"

#include <QSignalSpy>
#include <QTemporaryDir>
#include <QtTest>

#include <csignal>
#include <sys/resource.h>

using namespace console;
using namespace console::saved;

namespace {

// While it lives no file of this process grows beyond so many bytes: a disk that is full.
class FullDisk {
public:
    explicit FullDisk(rlim_t bytes)
    {
        std::signal(SIGXFSZ, SIG_IGN);
        getrlimit(RLIMIT_FSIZE, &m_before);
        rlimit limit = m_before;
        limit.rlim_cur = bytes;
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FullDisk() { setrlimit(RLIMIT_FSIZE, &m_before); }
    FullDisk(const FullDisk&) = delete;
    FullDisk& operator=(const FullDisk&) = delete;

private:
    rlimit m_before{};
};

} // namespace

class TestPictureExport : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void writesSecondaryCapture();
    void savesOfOneRunBelongTogether();
    void leavesOutWhatIsNotKnown();
    void carriesWhatWasMeasured();
    void namesThePatientAsOneWhomNobodyChecked();
    void namesAndWordsTellWhatItIs();
    void saysThatItWasNotLive_data();
    void saysThatItWasNotLive();
    void writesPng();
    void writesAllOfAPaneOnAScaledScreen();
    void leavesOldFileWhenDiskIsFull();
    void namesFolderThatIsMissing();
    void savesBothBesideTheWork();
    void refusesWithoutPicture();
};

void TestPictureExport::writesSecondaryCapture()
{
    const QTemporaryDir folder;
    const QString path = folder.filePath(QStringLiteral("a.dcm"));
    DisplayPicture sent = picture();
    sent.settings.edge = 30;
    sent.settings.edgeMethod = EdgeMethod::MultiScale;
    QCOMPARE(saveSecondaryCapture({sent}, path), QString());
    DcmFileFormat file;
    QVERIFY(file.loadFile(path.toLocal8Bit().constData()).good());
    DcmDataset& dataset = *file.getDataset();
    QCOMPARE(valueOf(dataset, DCM_SOPClassUID), QString::fromLatin1(UID_SecondaryCaptureImageStorage));
    QVERIFY(valueOf(dataset, DCM_ImageComments).startsWith(QStringLiteral("REVIEW  SIMULATED")));
    QCOMPARE(valueOf(dataset, DCM_QualityControlImage), QStringLiteral("YES"));
    QCOMPARE(valueOf(dataset, DCM_BurnedInAnnotation), QStringLiteral("YES"));
    QCOMPARE(valueOf(dataset, DCM_ConversionType), QStringLiteral("WSD"));
    QVERIFY(valueOf(dataset, DCM_DerivationDescription).contains(QStringLiteral("edge 30 %, multi-scale")));
    QCOMPARE(valueOf(dataset, DCM_PatientName), QString());
    QVERIFY(dataset.tagExists(DCM_PatientName));
    QCOMPARE(valueOf(dataset, DCM_PixelSpacingCalibrationType), QStringLiteral("GEOMETRY"));
    QVERIFY(std::abs(valueOf(dataset, DCM_PixelSpacing).split(QLatin1Char('\\')).first().toDouble() - 0.3 * 750 / 1100) < 1e-6);
    Uint16 rows = 0;
    Uint16 columns = 0;
    const Uint8* pixels = nullptr;
    unsigned long count = 0;
    QVERIFY(dataset.findAndGetUint16(DCM_Rows, rows).good() && rows == size.height());
    QVERIFY(dataset.findAndGetUint16(DCM_Columns, columns).good() && columns == size.width());
    QVERIFY(dataset.findAndGetUint8Array(DCM_PixelData, pixels, &count).good());
    QCOMPARE(count, static_cast<unsigned long>(size.width() * size.height() + 1));
    // Between the marks every pixel is the one that was shown.
    int wrong = 0;
    for (int y = 40; y < 120; ++y)
        for (int x = 60; x < 240; ++x)
            wrong += pixels[y * size.width() + x] != (x + y) % 256 ? 1 : 0;
    QCOMPARE(wrong, 0);
    int words = 0;
    for (int x = 0; x < 100; ++x)
        words += pixels[12 * size.width() + x] != (x + 12) % 256 ? 1 : 0;
    QVERIFY(words > 50);
}

void TestPictureExport::savesOfOneRunBelongTogether()
{
    const QTemporaryDir folder;
    QList<QString> paths;
    for (const char* run : {"one", "two"}) {
        PictureSaver saver(folder.filePath(QString::fromLatin1(run)));
        QSignalSpy saved(&saver, &PictureSaver::saved);
        for (int count = 1; count <= 2; ++count) {
            saver.save({picture()}, picture().image);
            QTRY_COMPARE(saved.count(), count);
            paths << saved.last().first().toString();
        }
    }
    QStringList studies;
    QStringList series;
    QStringList instances;
    for (const QString& path : paths) {
        DcmFileFormat file;
        QVERIFY(file.loadFile((path + QStringLiteral(".dcm")).toLocal8Bit().constData()).good());
        studies << valueOf(*file.getDataset(), DCM_StudyInstanceUID);
        series << valueOf(*file.getDataset(), DCM_SeriesInstanceUID);
        instances << valueOf(*file.getDataset(), DCM_SOPInstanceUID);
    }
    QVERIFY(!studies[0].isEmpty() && !series[0].isEmpty());
    QCOMPARE(studies[1], studies[0]);
    QCOMPARE(series[1], series[0]);
    QVERIFY(studies[2] != studies[0] && series[2] != series[0]);
    QCOMPARE(instances.removeDuplicates(), 0);
}

void TestPictureExport::leavesOutWhatIsNotKnown()
{
    const QTemporaryDir folder;
    const QString path = folder.filePath(QStringLiteral("a.dcm"));
    DisplayPicture sent = picture(PictureRole::Live);
    sent.about.geometry = {};
    sent.about.source = PictureSource::Live;
    QCOMPARE(saveSecondaryCapture({sent}, path), QString());
    DcmFileFormat file;
    QVERIFY(file.loadFile(path.toLocal8Bit().constData()).good());
    QVERIFY(!file.getDataset()->tagExists(DCM_PixelSpacing));
    QVERIFY(file.getDataset()->tagExists(DCM_ImagerPixelSpacing));
    QCOMPARE(valueOf(*file.getDataset(), DCM_QualityControlImage), QStringLiteral("NO"));
}

void TestPictureExport::carriesWhatWasMeasured()
{
    const QTemporaryDir folder;
    const QString path = folder.filePath(QStringLiteral("a.dcm"));
    Snapshot snapshot{picture()};
    snapshot.measurement.setMode(MeasureMode::Distance);
    snapshot.measurement.follow(snapshot.picture.about);
    snapshot.measurement.add({50, 100});
    QCOMPARE(saveSecondaryCapture(snapshot, path), QString());
    const QByteArray withOnePoint = pixelsOf(path); // nothing was measured yet
    snapshot.measurement.add({150, 100});
    QCOMPARE(saveSecondaryCapture(snapshot, path), QString());
    DcmFileFormat file;
    QVERIFY(file.loadFile(path.toLocal8Bit().constData()).good());
    const QString comments = valueOf(*file.getDataset(), DCM_ImageComments);
    QVERIFY2(comments.endsWith(QStringLiteral("  20.5 mm @ isocentre plane (geometry)  object 5 cm nearer or farther: \u2248 7 % off")),
             qPrintable(comments));
    const QByteArray measured = pixelsOf(path);
    const auto changed = [&](const QRect& where) {
        int count = 0;
        for (int y = where.top(); y <= where.bottom(); ++y)
            for (int x = where.left(); x <= where.right(); ++x)
                count += measured[y * size.width() + x] != withOnePoint[y * size.width() + x] ? 1 : 0;
        return count;
    };
    QVERIFY(changed(QRect(60, 99, 80, 3)) > 200);    // the line
    QVERIFY(changed(QRect(200, 111, 40, 14)) > 300); // its length, in words
    QVERIFY(changed(QRect(200, 127, 40, 14)) > 300); // and what that is worth
    QCOMPARE(changed(QRect(0, 40, size.width(), 40)), 0);
}

void TestPictureExport::namesThePatientAsOneWhomNobodyChecked()
{
    const QTemporaryDir folder;
    const QString path = folder.filePath(QStringLiteral("a.dcm"));
    Snapshot snapshot{picture()};
    snapshot.patient = {QStringLiteral("Inv\u00E9nted\\ Anna\n"), QStringLiteral("PID-2026-0004711")};
    QCOMPARE(saveSecondaryCapture(snapshot, path), QString());
    DcmFileFormat file;
    QVERIFY(file.loadFile(path.toLocal8Bit().constData()).good());
    QCOMPARE(valueOf(*file.getDataset(), DCM_PatientName), QStringLiteral("Inv\u00E9nted  Anna"));
    QCOMPARE(valueOf(*file.getDataset(), DCM_PatientID), QStringLiteral("PID-2026-0004711"));
    QVERIFY(valueOf(*file.getDataset(), DCM_PatientComments).contains(QStringLiteral("not checked")));
}

void TestPictureExport::saysThatItWasNotLive_data()
{
    QTest::addColumn<PictureRole>("role");
    QTest::addColumn<PictureCondition>("condition");
    QTest::addColumn<QString>("words");
    const auto row = [](const char* name, PictureRole role, PictureCondition condition, const char* words) {
        QTest::newRow(name) << role << condition << QString::fromLatin1(words);
    };
    row("live", PictureRole::Live, PictureCondition::Live, "SNAPSHOT  picture of ");
    row("frozen", PictureRole::Live, PictureCondition::Frozen, "SNAPSHOT  FROZEN  picture of ");
    row("of unknown age", PictureRole::Live, PictureCondition::Unknown, "SNAPSHOT  AGE UNKNOWN  picture of ");
    row("pedal up", PictureRole::Live, PictureCondition::Held, "SNAPSHOT  LAST IMAGE HOLD  picture of ");
    row("roadmap on a frozen one", PictureRole::Roadmap, PictureCondition::Frozen, "ROADMAP  FROZEN  picture of ");
    row("hold beside a frozen one", PictureRole::Hold, PictureCondition::Frozen, "LAST IMAGE HOLD  picture of ");
    row("review beside a frozen one", PictureRole::Review, PictureCondition::Frozen, "REVIEW  picture of ");
}

// In the words, in the DICOM file's pixels and attributes, and in the line below the PNG.
void TestPictureExport::saysThatItWasNotLive()
{
    QFETCH(PictureRole, role);
    QFETCH(PictureCondition, condition);
    QFETCH(QString, words);
    const QTemporaryDir folder;
    const QString path = folder.filePath(QStringLiteral("a.dcm"));
    Snapshot snapshot{picture(role)};
    snapshot.picture.about.source = PictureSource::Live;
    Snapshot live = snapshot;
    snapshot.condition = condition;
    QVERIFY2(exportWords(snapshot).startsWith(words), qPrintable(exportWords(snapshot)));
    QCOMPARE(saveSecondaryCapture(live, path), QString());
    const QByteArray livePixels = pixelsOf(path);
    QCOMPARE(saveSecondaryCapture(snapshot, path), QString());
    DcmFileFormat file;
    QVERIFY(file.loadFile(path.toLocal8Bit().constData()).good());
    QVERIFY(valueOf(*file.getDataset(), DCM_ImageComments).startsWith(words));
    const bool same = exportWords(snapshot) == exportWords(live);
    QCOMPARE(pixelsOf(path) == livePixels, same);
    QCOMPARE(withBanner(picture().image, snapshot) == withBanner(picture().image, live), same);
}

void TestPictureExport::namesAndWordsTellWhatItIs()
{
    DisplayPicture sent = picture(PictureRole::Live);
    sent.about.source = PictureSource::Live;
    QVERIFY(exportWords({sent}).startsWith(QStringLiteral("SNAPSHOT  picture of")));
    QVERIFY(!exportWords({sent}).contains(QStringLiteral("LIVE")));
    sent.about.source = PictureSource::Recorded;
    QVERIFY(exportWords({sent}).contains(QStringLiteral("RECORDED")));
    sent.about.captureNs = 1'700'000'000'250'000'000ULL;
    QCOMPARE(exportName(sent), QStringLiteral("liena_2023-11-14T22-13-20.250_live_run3_frame17"));
    QVERIFY(exportName(picture(PictureRole::Hold)).contains(QStringLiteral("_hold_")));
}

void TestPictureExport::writesPng()
{
    const QTemporaryDir folder;
    const QString path = folder.filePath(QStringLiteral("a.png"));
    const QImage image = withBanner(picture().image, {picture()});
    QCOMPARE(savePng(image, path), QString());
    QCOMPARE(QImage(path).convertToFormat(QImage::Format_RGB32), image);
    QCOMPARE(image.copy(0, 0, size.width(), size.height()), picture().image);
    QVERIFY(image.height() > size.height());
}

void TestPictureExport::writesAllOfAPaneOnAScaledScreen()
{
    const QImage plain = picture().image;
    QImage scaled = plain;
    scaled.setDevicePixelRatio(2); // as QWidget::grab() gives it there
    const QImage image = withBanner(scaled, {picture()});
    QCOMPARE(image, withBanner(plain, {picture()}));
    QCOMPARE(image.copy(0, 0, size.width(), size.height()), plain);
}

void TestPictureExport::leavesOldFileWhenDiskIsFull()
{
    const QTemporaryDir folder;
    const QString path = folder.filePath(QStringLiteral("a.dcm"));
    QCOMPARE(writeWhole("before", path), QString());
    {
        const FullDisk full(10000);
        const QString reason = saveSecondaryCapture({picture()}, path);
        QVERIFY2(reason.contains(path) && reason.contains(QStringLiteral("make room on the disk")), qPrintable(reason));
    }
    QFile file(path);
    QVERIFY(file.open(QIODevice::ReadOnly));
    QCOMPARE(file.readAll(), QByteArray("before"));
    QCOMPARE(QDir(folder.path()).entryList(QDir::Files | QDir::Hidden).size(), 1); // nothing half written is left
}

void TestPictureExport::namesFolderThatIsMissing()
{
    const QTemporaryDir folder;
    const QString path = folder.filePath(QStringLiteral("none/a.png"));
    QVERIFY(savePng(picture().image, path).contains(path));
}

void TestPictureExport::savesBothBesideTheWork()
{
    const QTemporaryDir folder;
    PictureSaver saver(folder.filePath(QStringLiteral("pictures")));
    QSignalSpy saved(&saver, &PictureSaver::saved);
    QSignalSpy failed(&saver, &PictureSaver::failed);
    saver.save({picture()}, picture().image);
    saver.save({picture()}, picture().image); // one at a time
    QTRY_COMPARE(saved.count(), 1);
    QCOMPARE(failed.count(), 1);
    const QString path = saved.first().first().toString();
    QVERIFY(QFile::exists(path + QStringLiteral(".png")));
    QVERIFY(QFile::exists(path + QStringLiteral(".dcm")));
    saver.save({picture()}, picture().image);
    QTRY_COMPARE(saved.count(), 2);
}

void TestPictureExport::refusesWithoutPicture()
{
    QVERIFY(!saveSecondaryCapture({}, QStringLiteral("/nowhere/a.dcm")).isEmpty());
    QVERIFY(!savePng({}, QStringLiteral("/nowhere/a.png")).isEmpty());
}

QTEST_MAIN(TestPictureExport)
#include "test_picture_export.moc"
