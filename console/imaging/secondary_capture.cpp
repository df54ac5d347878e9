// Saving a picture as a DICOM Secondary Capture.
#include "imaging/file_writing.hpp"
#include "imaging/measurement_marks.hpp"
#include "imaging/picture_export.hpp"
#include "imaging/picture_marks.hpp"
#include "imaging/text_plates.hpp"

#include <QCoreApplication>
#include <QDateTime>
#include <QPainter>
#include <QStringList>
#include <QTimeZone>

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcostrmb.h>
#include <dcmtk/dcmdata/dctk.h>

#include <algorithm>
#include <vector>

namespace console {

namespace {

constexpr std::size_t roomForAttributes = 64 * 1024;

struct Text {
    Q_DECLARE_TR_FUNCTIONS(console::PictureExport)
};

QFont captureFont(const QImage& image)
{
    QFont font;
    font.setPixelSize(std::clamp(image.width() / 40, 10, 40));
    return font;
}

/// As on every pane: what it is, which side is which, its scale, its frame, run, window and treatment. What they took.
QRegion paintMarks(QPainter& painter, const Snapshot& snapshot, const QRect& area, const QFont& font)
{
    TextPlates plates(font);
    const QString words = exportWords(snapshot);
    plates.add(words, fitted(font, {words}, area.width() - 4 * plates.gap()), {plates.gap(), plates.gap()}, Qt::AlignLeft | Qt::AlignTop);
    placeSides(plates, area, snapshot.picture);
    const QRect bar = placeScale(plates, area, snapshot.picture, 1);
    placeFacts(plates, area, bar, snapshot.picture, 1);
    plates.paint(painter);
    paintScaleBar(painter, bar);
    return plates.region() + bar;
}

void paintResult(QPainter& painter, const Measurement& measurement, const QRect& area, const QFont& font, const QRegion& taken)
{
    const QString measured = measurement.text();
    if (measured.isEmpty())
        return;
    paintMeasured(painter, measurement.points());
    QStringList words{measured};
    if (const QString depth = measurement.depthText(); !depth.isEmpty())
        words << depth;
    TextPlates plates(font);
    plates.addStack(words, area, measuredFoot(area), taken);
    plates.paint(painter);
}

// Whoever looks at it without the attributes must see what it is and which side is which, too. Only a picture with colour in it keeps its
// colours: in grey the painted vessels of a roadmap could not be told from the patient's.
QImage withMarks(const Snapshot& snapshot)
{
    const QImage& values = snapshot.picture.pValues();
    const bool isGrey = values.allGray();
    QImage image = values.convertToFormat(QImage::Format_RGB32);
    QPainter painter(&image);
    const QFont font = captureFont(image);
    const QRegion taken = paintMarks(painter, snapshot, image.rect(), font);
    paintResult(painter, snapshot.measurement, image.rect(), font, taken);
    painter.end();
    return image.convertToFormat(isGrey ? QImage::Format_Grayscale8 : QImage::Format_RGB888);
}

void put(DcmDataset& dataset, const DcmTagKey& tag, const QString& value) { dataset.putAndInsertString(tag, value.toUtf8().constData()); }

QByteArray uniqueUid(const char* root)
{
    char uid[65];
    return dcmGenerateUniqueIdentifier(uid, root);
}

/// What a value of a name or a number may hold (PS3.5, 6.2).
QString plain(QString text)
{
    constexpr qsizetype most = 64;
    const auto isPlain = [](QChar c) { return c.isPrint() && c != QLatin1Char('\\') && c != QLatin1Char('='); };
    for (QChar& c : text)
        if (!isPlain(c))
            c = QLatin1Char(' ');
    return text.trimmed().left(most);
}

void putPatient(DcmDataset& dataset, const PatientIdentity& patient)
{
    if (patient.name.isEmpty() && patient.number.isEmpty())
        return;
    put(dataset, DCM_PatientName, plain(patient.name));
    put(dataset, DCM_PatientID, plain(patient.number));
    put(dataset, DCM_PatientComments, QStringLiteral("typed at the start of the console, not checked against the X-ray system"));
}

void putIdentity(DcmDataset& dataset, const CaptureSeries& series)
{
    put(dataset, DCM_SpecificCharacterSet, QStringLiteral("ISO_IR 192"));
    dataset.putAndInsertString(DCM_SOPClassUID, UID_SecondaryCaptureImageStorage);
    dataset.putAndInsertString(DCM_SOPInstanceUID, uniqueUid(SITE_INSTANCE_UID_ROOT).constData());
    dataset.putAndInsertString(DCM_SeriesInstanceUID, series.series.constData());
    dataset.putAndInsertString(DCM_StudyInstanceUID, series.study.constData());
    // Of type 2: present, and empty where the console does not know.
    for (const DcmTagKey& tag : {DCM_PatientName, DCM_PatientID, DCM_PatientBirthDate, DCM_PatientSex, DCM_ReferringPhysicianName,
                                 DCM_StudyID, DCM_AccessionNumber, DCM_SeriesNumber, DCM_StudyDate, DCM_StudyTime, DCM_PatientOrientation})
        dataset.insertEmptyElement(tag);
}

/// PS3.3, C.7.6.1.1.5: what was lossy once is so for good. Of a recorded picture nobody here knows what it went through before.
void putLossy(DcmDataset& dataset, const XrayFrame& about)
{
    if (!about.isLossy()) {
        if (about.source != PictureSource::Recorded)
            put(dataset, DCM_LossyImageCompression, QStringLiteral("00"));
        return;
    }
    put(dataset, DCM_LossyImageCompression, QStringLiteral("01"));
    put(dataset, DCM_LossyImageCompressionMethod,
        about.encoding == PixelEncoding::Jpeg ? QStringLiteral("ISO_10918_1") : QStringLiteral("ISO_14495_1"));
    if (about.encodedBytes > 0) {
        const double raw = static_cast<double>(about.rows) * about.columns * (about.bitsStored > 8 ? 2 : 1);
        put(dataset, DCM_LossyImageCompressionRatio, QString::number(raw / static_cast<double>(about.encodedBytes), 'g', 4));
    }
}

// Descriptions that other systems sort by are English whatever the screen speaks.
void putFacts(DcmDataset& dataset, const Snapshot& snapshot)
{
    const DisplayPicture& picture = snapshot.picture;
    const XrayFrame& about = picture.about;
    const auto taken = QDateTime::fromMSecsSinceEpoch(static_cast<qint64>(about.captureNs / 1'000'000), QTimeZone::utc());
    put(dataset, DCM_ContentDate, taken.toString(QStringLiteral("yyyyMMdd")));
    put(dataset, DCM_ContentTime, taken.toString(QStringLiteral("HHmmss.zzz")));
    put(dataset, DCM_TimezoneOffsetFromUTC, QStringLiteral("+0000"));
    put(dataset, DCM_InstanceNumber, QString::number(about.frame));
    put(dataset, DCM_AcquisitionNumber, QString::number(about.acquisition));
    put(dataset, DCM_Modality, QStringLiteral("XA"));
    put(dataset, DCM_ConversionType, QStringLiteral("WSD"));
    put(dataset, DCM_ImageType, QStringLiteral("DERIVED\\SECONDARY"));
    put(dataset, DCM_SecondaryCaptureDeviceManufacturer, QStringLiteral("LiENa"));
    put(dataset, DCM_SeriesDescription, QStringLiteral("LiENa console, research system, not a medical device"));
    QStringList comments{exportWords(snapshot), snapshot.measurement.text(), snapshot.measurement.depthText()};
    comments.removeAll(QString());
    put(dataset, DCM_ImageComments, comments.join(QStringLiteral("  ")));
    const QString mean = picture.meanOf > 1 ? meanWords(picture) + QStringLiteral("  ") : QString();
    put(dataset, DCM_DerivationDescription, mean + windowLine(picture) + QStringLiteral("  ") + treatmentLine(picture));
    put(dataset, DCM_BurnedInAnnotation, QStringLiteral("YES"));
    put(dataset, DCM_QualityControlImage, about.source == PictureSource::Live ? QStringLiteral("NO") : QStringLiteral("YES"));
    putLossy(dataset, about);
    if (about.imagerPixelSpacing > 0) {
        const QString spacing = QString::number(about.imagerPixelSpacing, 'g', 10);
        put(dataset, DCM_ImagerPixelSpacing, spacing + QLatin1Char('\\') + spacing);
    }
    if (const std::optional<double> size = pixelSizeAtIsocentre(about)) {
        const QString spacing = QString::number(*size, 'g', 10);
        put(dataset, DCM_PixelSpacing, spacing + QLatin1Char('\\') + spacing);
        put(dataset, DCM_PixelSpacingCalibrationType, QStringLiteral("GEOMETRY"));
        put(dataset, DCM_PixelSpacingCalibrationDescription, QStringLiteral("in the isocentre's plane, from SID and SOD"));
    }
}

/// `image` as `withMarks()` made it.
void putPixels(DcmDataset& dataset, const QImage& image)
{
    const bool isGrey = image.format() == QImage::Format_Grayscale8;
    const int samples = isGrey ? 1 : 3;
    dataset.putAndInsertUint16(DCM_SamplesPerPixel, static_cast<Uint16>(samples));
    put(dataset, DCM_PhotometricInterpretation, isGrey ? QStringLiteral("MONOCHROME2") : QStringLiteral("RGB"));
    if (!isGrey)
        dataset.putAndInsertUint16(DCM_PlanarConfiguration, 0);
    dataset.putAndInsertUint16(DCM_Rows, static_cast<Uint16>(image.height()));
    dataset.putAndInsertUint16(DCM_Columns, static_cast<Uint16>(image.width()));
    dataset.putAndInsertUint16(DCM_BitsAllocated, 8);
    dataset.putAndInsertUint16(DCM_BitsStored, 8);
    dataset.putAndInsertUint16(DCM_HighBit, 7);
    dataset.putAndInsertUint16(DCM_PixelRepresentation, 0);
    std::vector<Uint8> pixels;
    pixels.reserve(static_cast<std::size_t>(image.sizeInBytes()) + 1);
    for (int row = 0; row < image.height(); ++row)
        pixels.insert(pixels.end(), image.constScanLine(row), image.constScanLine(row) + samples * image.width());
    if (pixels.size() % 2 != 0)
        pixels.push_back(0);
    dataset.putAndInsertUint8Array(DCM_PixelData, pixels.data(), static_cast<unsigned long>(pixels.size()));
}

// In memory first: the disk is written by the one way that is whole or not at all.
QByteArray encoded(DcmFileFormat& file, std::size_t pixelBytes)
{
    std::vector<char> room(pixelBytes + roomForAttributes);
    DcmOutputBufferStream stream(room.data(), static_cast<offile_off_t>(room.size()));
    file.transferInit();
    const OFCondition written = file.write(stream, EXS_LittleEndianExplicit, EET_ExplicitLength, nullptr, EGL_recalcGL);
    file.transferEnd();
    if (written.bad())
        return {};
    void* first = nullptr;
    offile_off_t length = 0;
    stream.flushBuffer(first, length);
    return {static_cast<const char*>(first), static_cast<qsizetype>(length)};
}

} // namespace

CaptureSeries CaptureSeries::begin() { return {uniqueUid(SITE_STUDY_UID_ROOT), uniqueUid(SITE_SERIES_UID_ROOT)}; }

QString saveSecondaryCapture(const Snapshot& snapshot, const QString& path, const CaptureSeries& series)
{
    if (snapshot.picture.image.isNull())
        return Text::tr("%1 cannot be written: there is no picture. Save again when one is shown.").arg(path);
    const QImage image = withMarks(snapshot);
    DcmFileFormat file;
    DcmDataset& dataset = *file.getDataset();
    putIdentity(dataset, series);
    putPatient(dataset, snapshot.patient);
    putFacts(dataset, snapshot);
    putPixels(dataset, image);
    const QByteArray bytes = encoded(file, static_cast<std::size_t>(image.sizeInBytes()));
    if (bytes.isEmpty())
        return Text::tr("%1 cannot be written: the picture could not be encoded as DICOM. Save it as PNG.").arg(path);
    return writeWhole(bytes, path);
}

} // namespace console
