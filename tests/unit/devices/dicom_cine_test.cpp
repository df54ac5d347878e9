// Recorded runs: every transfer syntax, what is missing in a header, and defective files.
#include "dicom_cine.hpp"

#include <QFile>
#include <QTemporaryDir>
#include <QTest>

#include "dcmtk/config/osconfig.h"
#include "dcmtk/dcmdata/dctk.h"

#include "dcmtk/dcmdata/dcrleerg.h"
#include "dcmtk/dcmjpeg/djencode.h"
#include "dcmtk/dcmjpeg/djrploss.h"

#include <fstream>

using namespace liena::devices;

namespace {

constexpr int rows = 24;
constexpr int columns = 40;
constexpr int frames = 3;

struct Made {
    int bitsAllocated = 16;
    int bitsStored = 12;
    E_TransferSyntax syntax = EXS_LittleEndianExplicit;
    std::string file;
};

std::uint16_t pixelOf(int frame, int row, int column, int bits)
{
    return static_cast<std::uint16_t>((row * 3 + column * 7 + frame * 11 + (row * column) / 5) % (1 << std::min(bits, 10)));
}

void fill(DcmDataset& dataset, const Made& made)
{
    dataset.putAndInsertString(DCM_SOPClassUID, UID_XRayAngiographicImageStorage);
    dataset.putAndInsertString(DCM_SOPInstanceUID, "1.2.3.4");
    dataset.putAndInsertString(DCM_Modality, "XA");
    dataset.putAndInsertUint16(DCM_Rows, rows);
    dataset.putAndInsertUint16(DCM_Columns, columns);
    dataset.putAndInsertUint16(DCM_SamplesPerPixel, 1);
    dataset.putAndInsertString(DCM_PhotometricInterpretation, "MONOCHROME2");
    dataset.putAndInsertUint16(DCM_BitsAllocated, static_cast<Uint16>(made.bitsAllocated));
    dataset.putAndInsertUint16(DCM_BitsStored, static_cast<Uint16>(made.bitsStored));
    dataset.putAndInsertUint16(DCM_HighBit, static_cast<Uint16>(made.bitsStored - 1));
    dataset.putAndInsertUint16(DCM_PixelRepresentation, 0);
    dataset.putAndInsertString(DCM_NumberOfFrames, "3");
    std::vector<Uint8> bytes;
    std::vector<Uint16> words;
    for (int frame = 0; frame < frames; ++frame)
        for (int row = 0; row < rows; ++row)
            for (int column = 0; column < columns; ++column) {
                const auto pixel = pixelOf(frame, row, column, made.bitsStored);
                bytes.push_back(static_cast<Uint8>(pixel));
                words.push_back(pixel);
            }
    if (made.bitsAllocated == 8)
        dataset.putAndInsertUint8Array(DCM_PixelData, bytes.data(), bytes.size());
    else
        dataset.putAndInsertUint16Array(DCM_PixelData, words.data(), words.size());
}

// Writes the run; `change` may alter the data set first.
bool write(const Made& made, const std::function<void(DcmDataset&)>& change = {})
{
    DcmFileFormat file;
    DcmDataset& dataset = *file.getDataset();
    fill(dataset, made);
    if (change)
        change(dataset);
    const DJ_RPLossy lossy(100);
    const DcmRepresentationParameter* parameter =
        DcmXfer(made.syntax).isEncapsulated() && made.syntax != EXS_RLELossless ? &lossy : nullptr;
    if (made.syntax == EXS_JPEGProcess14SV1 || made.syntax == EXS_JPEGProcess14)
        parameter = nullptr;
    if (dataset.chooseRepresentation(made.syntax, parameter).bad())
        return false;
    return file.saveFile(made.file.c_str(), made.syntax).good();
}

} // namespace

class DicomCineTest : public QObject {
    Q_OBJECT

    QTemporaryDir m_folder;

    std::string path(const char* name) const { return m_folder.filePath(name).toStdString(); }

private Q_SLOTS:
    void initTestCase()
    {
        OFLog::configure(OFLogger::OFF_LOG_LEVEL);
        DJEncoderRegistration::registerCodecs();
        DcmRLEEncoderRegistration::registerCodecs();
    }

    void readsEveryTransferSyntax_data()
    {
        QTest::addColumn<int>("syntax");
        QTest::addColumn<int>("allocated");
        QTest::addColumn<int>("stored");
        QTest::addColumn<int>("tolerance");
        QTest::newRow("implicit little endian") << int(EXS_LittleEndianImplicit) << 16 << 12 << 0;
        QTest::newRow("explicit little endian 8") << int(EXS_LittleEndianExplicit) << 8 << 8 << 0;
        QTest::newRow("explicit little endian 16") << int(EXS_LittleEndianExplicit) << 16 << 16 << 0;
        QTest::newRow("big endian 8") << int(EXS_BigEndianExplicit) << 8 << 8 << 0;
        QTest::newRow("big endian 12") << int(EXS_BigEndianExplicit) << 16 << 12 << 0;
        QTest::newRow("deflated") << int(EXS_DeflatedLittleEndianExplicit) << 16 << 12 << 0;
        QTest::newRow("RLE 8") << int(EXS_RLELossless) << 8 << 8 << 0;
        QTest::newRow("RLE 12") << int(EXS_RLELossless) << 16 << 12 << 0;
        QTest::newRow("JPEG lossless 8") << int(EXS_JPEGProcess14SV1) << 8 << 8 << 0;
        QTest::newRow("JPEG lossless 10") << int(EXS_JPEGProcess14SV1) << 16 << 10 << 0;
        QTest::newRow("JPEG lossless 16") << int(EXS_JPEGProcess14SV1) << 16 << 16 << 0;
        QTest::newRow("JPEG lossless, process 14") << int(EXS_JPEGProcess14) << 16 << 12 << 0;
        QTest::newRow("JPEG baseline") << int(EXS_JPEGProcess1) << 8 << 8 << 40;
        QTest::newRow("JPEG extended 12") << int(EXS_JPEGProcess2_4) << 16 << 12 << 40;
    }

    void readsEveryTransferSyntax()
    {
        QFETCH(int, syntax);
        QFETCH(int, allocated);
        QFETCH(int, stored);
        QFETCH(int, tolerance);
        const Made made{allocated, stored, static_cast<E_TransferSyntax>(syntax), path("run.dcm")};
        QVERIFY(write(made));
        for (const std::size_t memory : {DicomCine::memoryBound, std::size_t{0}}) { // at once, and frame by frame
            const auto cine = DicomCine::open(made.file, memory);
            QVERIFY2(cine, cine ? "" : cine.error().what.c_str());
            QCOMPARE(cine.value()->frameCount(), 3U);
            QCOMPARE(int{cine.value()->format().bitsStored}, stored);
            Picture picture;
            for (int frame = 0; frame < 2 * frames; ++frame) {
                QVERIFY(cine.value()->next({}, picture));
                for (int row = 0; row < rows; ++row)
                    for (int column = 0; column < columns; ++column) {
                        const int value = picture.pixels.at(static_cast<std::size_t>(row * columns + column));
                        QVERIFY(std::abs(value - pixelOf(frame % frames, row, column, stored)) <= tolerance);
                    }
            }
            QCOMPARE(picture.format.source, PictureSource::Recorded);
        }
    }

    void readsTheRateInItsOrder_data()
    {
        QTest::addColumn<QByteArray>("recommended");
        QTest::addColumn<QByteArray>("cine");
        QTest::addColumn<QByteArray>("time");
        QTest::addColumn<double>("expected");
        QTest::newRow("all") << QByteArray("8") << QByteArray("7") << QByteArray("133.3333") << 8.0;
        QTest::newRow("cine rate") << QByteArray() << QByteArray("7") << QByteArray("133.3333") << 7.0;
        QTest::newRow("frame time") << QByteArray() << QByteArray() << QByteArray("40") << 25.0;
        QTest::newRow("none") << QByteArray() << QByteArray() << QByteArray() << 15.0;
        QTest::newRow("impossible") << QByteArray("0") << QByteArray("-5") << QByteArray("0") << 15.0;
        QTest::newRow("absurd") << QByteArray("100000") << QByteArray() << QByteArray("100") << 10.0;
    }

    void readsTheRateInItsOrder()
    {
        QFETCH(QByteArray, recommended);
        QFETCH(QByteArray, cine);
        QFETCH(QByteArray, time);
        QFETCH(double, expected);
        const Made made{16, 12, EXS_LittleEndianExplicit, path("rate.dcm")};
        QVERIFY(write(made, [&](DcmDataset& dataset) {
            if (!recommended.isEmpty())
                dataset.putAndInsertString(DCM_RecommendedDisplayFrameRate, recommended.constData());
            if (!cine.isEmpty())
                dataset.putAndInsertString(DCM_CineRate, cine.constData());
            if (!time.isEmpty())
                dataset.putAndInsertString(DCM_FrameTime, time.constData());
        }));
        const auto run = DicomCine::open(made.file);
        QVERIFY(run);
        QCOMPARE(run.value()->ownRate(), expected);
    }

    void readsTheFrameTimeVector()
    {
        const Made made{16, 12, EXS_LittleEndianExplicit, path("vector.dcm")};
        QVERIFY(write(made, [](DcmDataset& dataset) { dataset.putAndInsertString(DCM_FrameTimeVector, "0\\50\\50"); }));
        QCOMPARE(DicomCine::open(made.file).value()->ownRate(), 20.0);
    }

    void readsWhatThePixelsMean()
    {
        const Made made{16, 12, EXS_LittleEndianExplicit, path("meaning.dcm")};
        QVERIFY(write(made, [](DcmDataset& dataset) {
            dataset.putAndInsertString(DCM_PhotometricInterpretation, "MONOCHROME1");
            dataset.putAndInsertString(DCM_PixelIntensityRelationship, "LOG");
            dataset.putAndInsertString(DCM_ImagerPixelSpacing, "0.278875\\0.278875");
            dataset.putAndInsertString(DCM_PositionerPrimaryAngle, "-32");
            dataset.putAndInsertString(DCM_PositionerSecondaryAngle, "2.5");
            dataset.putAndInsertString(DCM_DistanceSourceToDetector, "1108");
            dataset.putAndInsertString(DCM_DistanceSourceToPatient, "811.94");
            dataset.putAndInsertString(DCM_WindowCenter, "121");
            dataset.putAndInsertString(DCM_WindowWidth, "143");
        }));
        const auto cine = DicomCine::open(made.file);
        const PictureFormat& format = cine.value()->format();
        QCOMPARE(format.photometric, Photometric::Monochrome1);
        QCOMPARE(format.relationship, IntensityRelationship::Logarithmic);
        QCOMPARE(format.imagerPixelSpacing, 0.278875);
        QCOMPARE(format.primaryAngle, -32.0);
        QCOMPARE(format.secondaryAngle, 2.5);
        QCOMPARE(format.sourceDetectorDistance, 1108.0);
        QCOMPARE(format.sourceObjectDistance, 811.94);
        QCOMPARE(format.windowCentre, 121.0);
        QCOMPARE(format.windowWidth, 143.0);
    }

    void choosesAWindowWhenThereIsNone()
    {
        const Made made{16, 12, EXS_LittleEndianExplicit, path("window.dcm")};
        QVERIFY(write(made));
        const auto cine = DicomCine::open(made.file);
        const PictureFormat& format = cine.value()->format();
        QVERIFY(format.windowWidth > 100 && format.windowWidth <= 1024);
        QVERIFY(format.windowCentre > 50 && format.windowCentre < 600);
    }

    void shiftsSignedPixelsAndTheirWindow()
    {
        const Made made{16, 12, EXS_LittleEndianExplicit, path("signed.dcm")};
        QVERIFY(write(made, [](DcmDataset& dataset) {
            dataset.putAndInsertUint16(DCM_PixelRepresentation, 1);
            dataset.putAndInsertString(DCM_NumberOfFrames, "1");
            std::vector<Uint16> words(rows * columns, static_cast<Uint16>(-5 & 0x0FFF));
            words.front() = 5;
            dataset.putAndInsertUint16Array(DCM_PixelData, words.data(), words.size());
            dataset.putAndInsertString(DCM_WindowCenter, "0");
            dataset.putAndInsertString(DCM_WindowWidth, "100");
        }));
        const auto cine = DicomCine::open(made.file);
        std::vector<std::uint16_t> pixels;
        QVERIFY(cine.value()->frame(0, pixels));
        QCOMPARE(pixels[0], std::uint16_t{2053});
        QCOMPARE(pixels[1], std::uint16_t{2043});
        QCOMPARE(cine.value()->format().windowCentre, 2048.0);
    }

    void refusesWithFileAndRemedy_data()
    {
        QTest::addColumn<int>("defect");
        QTest::addColumn<QByteArray>("expected");
        QTest::newRow("colour") << 0 << QByteArray("not greyscale");
        QTest::newRow("no rows") << 1 << QByteArray("Rows and Columns");
        QTest::newRow("huge") << 2 << QByteArray("Rows and Columns");
        QTest::newRow("no pixels") << 3 << QByteArray("no pixel data");
        QTest::newRow("more frames than pixels") << 4 << QByteArray("cut off");
        QTest::newRow("absurd frames") << 5 << QByteArray("Number of Frames");
        QTest::newRow("bits") << 6 << QByteArray("Bits Stored");
        QTest::newRow("32 bits") << 7 << QByteArray("Bits Stored");
    }

    void refusesWithFileAndRemedy()
    {
        QFETCH(int, defect);
        QFETCH(QByteArray, expected);
        const Made made{16, 12, EXS_LittleEndianExplicit, path("defect.dcm")};
        QVERIFY(write(made, [&](DcmDataset& dataset) {
            switch (defect) {
            case 0:
                dataset.putAndInsertUint16(DCM_SamplesPerPixel, 3);
                dataset.putAndInsertString(DCM_PhotometricInterpretation, "RGB");
                break;
            case 1:
                dataset.findAndDeleteElement(DCM_Rows);
                break;
            case 2:
                dataset.putAndInsertUint16(DCM_Columns, 65535);
                break;
            case 3:
                dataset.findAndDeleteElement(DCM_PixelData);
                break;
            case 4:
                dataset.putAndInsertString(DCM_NumberOfFrames, "5");
                break;
            case 5:
                dataset.putAndInsertString(DCM_NumberOfFrames, "2000000000");
                break;
            case 6:
                dataset.putAndInsertUint16(DCM_BitsStored, 17);
                break;
            case 7:
                dataset.putAndInsertUint16(DCM_BitsAllocated, 32);
                break;
            }
        }));
        const auto cine = DicomCine::open(made.file);
        QVERIFY(!cine);
        QVERIFY2(QByteArray::fromStdString(cine.error().what).contains(expected), cine.error().what.c_str());
        QVERIFY(cine.error().what.find("defect.dcm") != std::string::npos);
    }

    void survivesEveryCutAndFlip_data()
    {
        QTest::addColumn<int>("syntax");
        QTest::newRow("plain") << int(EXS_LittleEndianExplicit);
        QTest::newRow("deflated") << int(EXS_DeflatedLittleEndianExplicit);
        QTest::newRow("RLE") << int(EXS_RLELossless);
        QTest::newRow("JPEG lossless") << int(EXS_JPEGProcess14SV1);
    }

    // Whatever stands in the file: pictures or a refusal, never a crash.
    void survivesEveryCutAndFlip()
    {
        QFETCH(int, syntax);
        const Made made{16, 12, static_cast<E_TransferSyntax>(syntax), path("whole.dcm")};
        QVERIFY(write(made));
        QFile whole(QString::fromStdString(made.file));
        QVERIFY(whole.open(QIODevice::ReadOnly));
        const QByteArray bytes = whole.readAll();
        const std::string broken = path("broken.dcm");
        unsigned state = 12345;
        int refused = 0;
        for (int round = 0; round < 120; ++round) {
            QByteArray copy = bytes;
            state = state * 1664525U + 1013904223U;
            const auto place = static_cast<qsizetype>(state >> 8U) % bytes.size();
            if (round % 2 == 0)
                copy.truncate(place);
            else
                copy[place] = static_cast<char>(copy[place] ^ static_cast<char>(1U << (state & 7U)));
            std::ofstream(broken, std::ios::binary).write(copy.constData(), copy.size());
            const auto cine = DicomCine::open(broken);
            if (!cine)
                ++refused;
            else
                QVERIFY(cine.value()->frameCount() >= 1);
        }
        QVERIFY(refused > 40);
    }

    void refusesWhatIsNoFile()
    {
        QVERIFY(!DicomCine::open(m_folder.path().toStdString()));
        QVERIFY(!DicomCine::open("/nowhere/run.dcm"));
        std::ofstream(path("text.dcm")) << "this is no DICOM file, only some text that is long enough to be one";
        QVERIFY(!DicomCine::open(path("text.dcm")));
    }
};

QTEST_GUILESS_MAIN(DicomCineTest)
#include "dicom_cine_test.moc"
