// What travels is what was taken: pixels through every encoding and back.
#include "frame_encoder.hpp"

#include <QTest>

#include <charls/charls.h>
#include <turbojpeg.h>

#include <span>
#include <utility>

using namespace liena::devices;

namespace {

Picture ramp(int bits)
{
    Picture picture;
    picture.format.rows = 40;
    picture.format.columns = 60;
    picture.format.bitsStored = static_cast<std::uint8_t>(bits);
    picture.format.windowWidth = 1 << bits;
    picture.format.windowCentre = (1 << bits) / 2.0;
    for (unsigned pixel = 0; pixel < 40 * 60; ++pixel)
        picture.pixels.push_back(static_cast<std::uint16_t>(pixel * ((1U << bits) - 1) / (40 * 60 - 1)));
    return picture;
}

unsigned at(std::span<const std::byte> bytes, std::size_t index) { return std::to_integer<unsigned>(bytes[index]); }

} // namespace

class FrameEncoderTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void rawIsLowByteFirst()
    {
        FrameEncoder encoder(Encoding::Raw, 7);
        Picture picture = ramp(12);
        const auto encoded = encoder.encode(picture).value();
        const std::span<const std::byte> bytes(*encoded);
        QCOMPARE(bytes.size(), 4800U);
        for (std::size_t pixel = 0; pixel < picture.pixels.size(); ++pixel)
            QCOMPARE(at(bytes, 2 * pixel) | at(bytes, 2 * pixel + 1) << 8U, unsigned{picture.pixels[pixel]});
        QCOMPARE(encoder.quality(), 0U);
    }

    void rawOfEightBitsIsOneByteAPixel()
    {
        FrameEncoder encoder(Encoding::Raw, 0);
        Picture picture = ramp(8);
        const auto encoded = encoder.encode(picture).value();
        const std::span<const std::byte> bytes(*encoded);
        QCOMPARE(bytes.size(), 2400U);
        QCOMPARE(at(bytes, 2399), 255U);
    }

    void pixelsAreAsManyAsTheFormatSays_data()
    {
        QTest::addColumn<Encoding>("encoding");
        QTest::addColumn<int>("pixels");
        for (const auto& [name, encoding] : {std::pair{"raw", Encoding::Raw}, {"JPEG-LS", Encoding::JpegLs}, {"JPEG", Encoding::Jpeg}})
            for (const int pixels : {0, 2399, 2401})
                QTest::addRow("%s, %d", name, pixels) << encoding << pixels;
    }

    void pixelsAreAsManyAsTheFormatSays()
    {
        QFETCH(Encoding, encoding);
        QFETCH(int, pixels);
        FrameEncoder encoder(encoding, 75);
        Picture picture = ramp(8);
        picture.pixels.resize(static_cast<std::size_t>(pixels));
        const auto encoded = encoder.encode(picture);
        QVERIFY(!encoded);
        QVERIFY(encoded.error().what.find("60 x 40") != std::string::npos);
    }

    void jpegLsComesBackWithinItsBound_data()
    {
        QTest::addColumn<int>("bits");
        QTest::addColumn<unsigned>("near");
        QTest::newRow("8 lossless") << 8 << 0U;
        QTest::newRow("12 lossless") << 12 << 0U;
        QTest::newRow("16 lossless") << 16 << 0U;
        QTest::newRow("12 near 3") << 12 << 3U;
    }

    void jpegLsComesBackWithinItsBound()
    {
        QFETCH(int, bits);
        QFETCH(unsigned, near);
        FrameEncoder encoder(Encoding::JpegLs, near);
        Picture picture = ramp(bits);
        const auto encoded = encoder.encode(picture).value();
        const std::span<const std::byte> bytes(*encoded);
        charls::jpegls_decoder decoder(bytes.data(), bytes.size());
        QCOMPARE(decoder.frame_info().bits_per_sample, bits);
        std::vector<std::uint8_t> pixels(decoder.destination_size());
        decoder.decode(pixels);
        for (std::size_t pixel = 0; pixel < picture.pixels.size(); ++pixel) {
            const int value = bits > 8 ? pixels[2 * pixel] | pixels[2 * pixel + 1] << 8 : pixels[pixel];
            QVERIFY(std::abs(value - picture.pixels[pixel]) <= static_cast<int>(near));
        }
    }

    void jpegShowsDeepPicturesThroughTheirWindow()
    {
        FrameEncoder encoder(Encoding::Jpeg, 95);
        Picture picture = ramp(12);
        picture.format.relationship = IntensityRelationship::Linear;
        const auto encoded = encoder.encode(picture).value();
        const std::span<const std::byte> bytes(*encoded);
        QCOMPARE(picture.format.bitsStored, std::uint8_t{8});
        QCOMPARE(picture.format.relationship, IntensityRelationship::Display);
        std::vector<unsigned char> pixels(2400);
        const auto codec = tjInitDecompress();
        QCOMPARE(tjDecompress2(codec, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), pixels.data(), 60, 0, 40,
                               TJPF_GRAY, 0),
                 0);
        tjDestroy(codec);
        QVERIFY(std::abs(int{pixels[1200]} - 128) < 6);
        QVERIFY(pixels[0] < 8 && pixels[2399] > 247);
    }

    void changesBetweenTwoPictures()
    {
        FrameEncoder encoder(Encoding::Raw, 0);
        Picture picture = ramp(12);
        QCOMPARE(encoder.encode(picture).value()->size(), 4800U);
        encoder.use(Encoding::JpegLs, 0);
        QVERIFY(encoder.encode(picture).value()->size() < 4800U);
        encoder.use(Encoding::Jpeg, 50);
        QVERIFY(at(*encoder.encode(picture).value(), 0) == 0xFF);
        QCOMPARE(encoder.quality(), 50U);
        picture = ramp(12);
        encoder.use(Encoding::Raw, 0);
        QCOMPARE(encoder.encode(picture).value()->size(), 4800U);
    }

    void namesAreThoseOfTheMessageSet()
    {
        QCOMPARE(encodingFrom("raw"), Encoding::Raw);
        QCOMPARE(encodingFrom("jpeg-ls"), Encoding::JpegLs);
        QCOMPARE(encodingFrom("jpeg"), Encoding::Jpeg);
        QVERIFY(!encodingFrom("png"));
    }
};

QTEST_GUILESS_MAIN(FrameEncoderTest)
#include "frame_encoder_test.moc"
