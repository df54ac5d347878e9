// Real and odd DICOM files: the same pixels as others read, or a clear refusal.
#include "dicom_cine.hpp"

#include "shared_data.hpp"

#include <QCryptographicHash>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTest>

using namespace liena::devices;

class DicomFilesTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void agreesWithTheExpectedHashes_data()
    {
        QTest::addColumn<QString>("folder");
        QTest::newRow("originals") << QString("dicom-xa");
        QTest::newRow("derived") << QString("dicom-xa-derived");
    }

    void agreesWithTheExpectedHashes()
    {
        QFETCH(QString, folder);
        const auto root = sharedData(folder.toStdString());
        if (!root)
            QSKIP("the shared data are not here");
        QFile list(QString::fromStdString((*root / "expected.json").string()));
        QVERIFY(list.open(QIODevice::ReadOnly));
        const QJsonObject all = QJsonDocument::fromJson(list.readAll()).object();
        QVERIFY(!all.isEmpty());
        for (auto entry = all.begin(); entry != all.end(); ++entry) {
            const QJsonObject expected = entry.value().toObject();
            if (!entry.key().endsWith(".dcm"))
                continue;
            const auto cine = DicomCine::open(*root / entry.key().toStdString());
            QVERIFY2(cine, cine ? "" : cine.error().what.c_str());
            QCOMPARE(static_cast<int>(cine.value()->frameCount()), expected["frames"].toInt());
            const QJsonArray hashes = expected["frame_pixel_sha256"].toArray();
            const QJsonArray means = expected["frame_means"].toArray();
            std::vector<std::uint16_t> pixels;
            for (std::uint32_t frame = 0; frame < cine.value()->frameCount(); ++frame) {
                QVERIFY(cine.value()->frame(frame, pixels));
                QByteArray bytes;
                double sum = 0;
                for (const std::uint16_t pixel : pixels) {
                    bytes.append(static_cast<char>(pixel));
                    if (cine.value()->bitsAllocated() == 16)
                        bytes.append(static_cast<char>(pixel >> 8));
                    sum += pixel;
                }
                const int index = static_cast<int>(frame);
                if (!hashes.isEmpty())
                    QCOMPARE(QString::fromLatin1(QCryptographicHash::hash(bytes, QCryptographicHash::Sha256).toHex()),
                             hashes[index].toString());
                if (!means.isEmpty())
                    QVERIFY(std::abs(sum / static_cast<double>(pixels.size()) - means[index].toDouble()) < 0.2);
            }
        }
    }

    void readsOddFilesOrRefusesThem()
    {
        const auto root = sharedData("dicom-robustness");
        if (!root)
            QSKIP("the shared data are not here");
        int files = 0;
        for (const auto& entry : std::filesystem::directory_iterator(*root)) {
            if (entry.path().extension() != ".dcm")
                continue;
            ++files;
            const auto cine = DicomCine::open(entry.path());
            qInfo("%s", cine ? cine.value()->describe().c_str() : cine.error().what.c_str());
            if (cine)
                QVERIFY(cine.value()->frameCount() >= 1);
            else
                QVERIFY(cine.error().what.find(entry.path().filename().string()) != std::string::npos);
        }
        QVERIFY(files > 10);
        QVERIFY(!DicomCine::open(*root / "MR_truncated.dcm"));
        QVERIFY(!DicomCine::open(*root / "SC_rgb_rle_2frame.dcm"));
        QVERIFY(DicomCine::open(*root / "JPGExtended.dcm"));
        QVERIFY(DicomCine::open(*root / "image_dfl.dcm"));
        QVERIFY(DicomCine::open(*root / "MR_small_RLE.dcm"));
    }
};

QTEST_GUILESS_MAIN(DicomFilesTest)
#include "dicom_files_test.moc"
