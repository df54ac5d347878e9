// Pictures from a folder: what is read, and what is refused.
#include "picture_folder.hpp"

#include <QTemporaryDir>
#include <QTest>

#include <fstream>

using namespace liena::devices;

namespace {

void write(const QTemporaryDir& folder, const char* name, const std::string& bytes)
{
    std::ofstream(folder.filePath(name).toStdString(), std::ios::binary) << bytes;
}

} // namespace

class PictureFolderTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void playsInTheOrderOfTheNamesAndBeginsAgain()
    {
        QTemporaryDir folder;
        write(folder, "b.pgm", "P5 2 1 255\n\x03\x04");
        write(folder, "a.pgm", "P5\n# remark\n2 1\n255\n\x01\x02");
        write(folder, "notes.txt", "not a picture");
        const auto pictures = PictureFolder::open(folder.path().toStdString());
        QVERIFY(pictures);
        Picture picture;
        for (const std::uint16_t first : {std::uint16_t{1}, std::uint16_t{3}, std::uint16_t{1}}) {
            QVERIFY(pictures.value()->next({}, picture));
            QCOMPARE(picture.pixels, (std::vector<std::uint16_t>{first, static_cast<std::uint16_t>(first + 1)}));
        }
        QCOMPARE(picture.format.source, PictureSource::Recorded);
    }

    void readsSixteenBitsHighByteFirst()
    {
        const auto picture = readPgm(std::string("P5 1 2 4095\n\x0F\xFF\x01\x02", 16), "deep.pgm");
        QVERIFY(picture);
        QCOMPARE(picture.value().pixels, (std::vector<std::uint16_t>{4095, 258}));
        QCOMPARE(picture.value().format.bitsStored, std::uint8_t{12});
    }

    void refusesDefectiveFiles_data()
    {
        QTest::addColumn<QByteArray>("bytes");
        QTest::newRow("empty") << QByteArray();
        QTest::newRow("text PGM") << QByteArray("P2 1 1 255\n7");
        QTest::newRow("cut off") << QByteArray("P5 4 4 255\nabc");
        QTest::newRow("no size") << QByteArray("P5 x y 255\n");
        QTest::newRow("too large") << QByteArray("P5 5000 1 255\n");
        QTest::newRow("negative") << QByteArray("P5 -1 1 255\n");
        QTest::newRow("only remark") << QByteArray("P5 #");
        QTest::newRow("overflow") << QByteArray("P5 99999999999999 1 255\n");
    }

    void refusesDefectiveFiles()
    {
        QFETCH(QByteArray, bytes);
        const auto picture = readPgm(bytes.toStdString(), "bad.pgm");
        QVERIFY(!picture);
        QVERIFY(picture.error().what.find("bad.pgm") != std::string::npos);
        QVERIFY(!readJpeg(bytes.toStdString(), "bad.jpg"));
    }

    void refusesPicturesOfDifferentSizes()
    {
        QTemporaryDir folder;
        write(folder, "a.pgm", "P5 2 1 255\n\x01\x02");
        write(folder, "b.pgm", "P5 1 1 255\n\x01");
        const auto pictures = PictureFolder::open(folder.path().toStdString());
        QVERIFY(!pictures);
        QVERIFY(pictures.error().what.find("b.pgm") != std::string::npos);
    }

    void refusesFoldersWithoutPictures()
    {
        QTemporaryDir folder;
        QVERIFY(!PictureFolder::open(folder.path().toStdString()));
        QVERIFY(!PictureFolder::open("/nowhere"));
    }
};

QTEST_GUILESS_MAIN(PictureFolderTest)
#include "picture_folder_test.moc"
