// Tests of the JPEG-LS decoder against the encoder of another implementation, and against damage.
#include "imaging/jpeg_ls_decoder.hpp"
#include "sample_frames.hpp"

#include <QtTest>

#include <charls/charls.h>

#include <cmath>
#include <cstdlib>
#include <random>

using namespace console;

namespace {

enum class Texture { Flat, Ramp, Noise, Steps, Film };

// Deterministic pictures that drive runs, interruptions, escapes and every context.
std::vector<std::uint16_t> picture(Texture texture, QSize size, int maximum, unsigned seed)
{
    std::mt19937 random(seed);
    std::vector<std::uint16_t> values;
    for (int y = 0; y < size.height(); ++y)
        for (int x = 0; x < size.width(); ++x) {
            double value = 0;
            switch (texture) {
            case Texture::Flat:
                value = random() % 97 == 0 ? maximum : maximum / 3;
                break;
            case Texture::Ramp:
                value = static_cast<double>(maximum) * (x + y) / (size.width() + size.height());
                break;
            case Texture::Noise:
                value = static_cast<double>(random() % (static_cast<unsigned>(maximum) + 1U));
                break;
            case Texture::Steps:
                value = ((x / 9 + y / 7) % 3) * maximum / 2.0;
                break;
            case Texture::Film:
                value = maximum * (0.5 + 0.4 * std::sin(x / 15.0) * std::cos(y / 11.0)) + static_cast<double>(random() % 21) - 10;
                break;
            }
            values.push_back(static_cast<std::uint16_t>(std::clamp(value, 0.0, static_cast<double>(maximum))));
        }
    return values;
}

std::vector<std::byte> encoded(const std::vector<std::uint16_t>& values, QSize size, int bits, int near,
                               const charls::jpegls_pc_parameters* parameters = nullptr)
{
    std::vector<std::byte> raw;
    for (const std::uint16_t value : values) {
        raw.push_back(static_cast<std::byte>(value & 0xFFU));
        if (bits > 8)
            raw.push_back(static_cast<std::byte>(value >> 8U));
    }
    charls::jpegls_encoder encoder;
    encoder.frame_info({static_cast<std::uint32_t>(size.width()), static_cast<std::uint32_t>(size.height()), bits, 1}).near_lossless(near);
    if (parameters)
        encoder.preset_coding_parameters(*parameters);
    std::vector<std::byte> bytes(encoder.estimated_destination_size() * 2);
    encoder.destination(bytes.data(), bytes.size());
    bytes.resize(encoder.encode(raw.data(), raw.size()));
    return bytes;
}

bool decoded(const std::vector<std::byte>& bytes, cv::Mat& stored)
{
    JpegLsHeader header;
    if (!readJpegLsHeader(bytes, header).isEmpty() || header.rows > 4096 || header.columns > 4096)
        return false;
    stored.create(header.rows, header.columns, header.bits <= 8 ? CV_8UC1 : CV_16UC1);
    return decodeJpegLs(header, stored);
}

int valueAt(const cv::Mat& stored, std::size_t i)
{
    return stored.type() == CV_8UC1 ? stored.ptr<std::uint8_t>()[i] : stored.ptr<std::uint16_t>()[i];
}

// What the other implementation's own decoder makes of it: near-lossless pictures must agree with it exactly.
std::vector<std::uint16_t> reference(const std::vector<std::byte>& bytes, int bits)
{
    const charls::jpegls_decoder decoder(bytes.data(), bytes.size(), true);
    std::vector<std::uint8_t> raw(decoder.destination_size());
    decoder.decode(raw);
    std::vector<std::uint16_t> values;
    for (std::size_t i = 0; i<raw.size(); i += bits> 8 ? 2 : 1)
        values.push_back(bits > 8 ? static_cast<std::uint16_t>(raw[i] | (raw[i + 1] << 8U)) : raw[i]);
    return values;
}

} // namespace

class TestJpegLsDecoder : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void agreesWithAnotherImplementation_data();
    void agreesWithAnotherImplementation();
    void takesOtherCodingParameters();
    void refusesDataThatEndEarlyOrLate();
    void refusesExtensions_data();
    void refusesExtensions();
    void endsOnEveryDamage_data();
    void endsOnEveryDamage();
};

void TestJpegLsDecoder::agreesWithAnotherImplementation_data()
{
    QTest::addColumn<int>("bits");
    QTest::addColumn<int>("near");
    for (int bits = 2; bits <= 16; ++bits)
        QTest::addRow("%d bits", bits) << bits << 0;
    QTest::addRow("8 bits, near 1") << 8 << 1;
    QTest::addRow("8 bits, near 7") << 8 << 7;
    QTest::addRow("8 bits, near 127") << 8 << 127;
    QTest::addRow("10 bits, near 3") << 10 << 3;
    QTest::addRow("12 bits, near 4") << 12 << 4;
    QTest::addRow("16 bits, near 2") << 16 << 2;
    QTest::addRow("16 bits, near 255") << 16 << 255;
}

void TestJpegLsDecoder::agreesWithAnotherImplementation()
{
    QFETCH(int, bits);
    QFETCH(int, near);
    for (const QSize size : {QSize(1, 1), QSize(1, 40), QSize(53, 1), QSize(61, 47), QSize(130, 20)})
        for (const Texture texture : {Texture::Flat, Texture::Ramp, Texture::Noise, Texture::Steps, Texture::Film}) {
            const auto values = picture(texture, size, (1 << bits) - 1, static_cast<unsigned>(bits * 7 + near));
            const auto bytes = encoded(values, size, bits, near);
            cv::Mat stored;
            QVERIFY2(decoded(bytes, stored), qPrintable(QStringLiteral("texture %1, width %2").arg(int(texture)).arg(size.width())));
            const auto expected = near == 0 ? values : reference(bytes, bits);
            for (std::size_t i = 0; i < expected.size(); ++i)
                QCOMPARE(valueAt(stored, i), static_cast<int>(expected[i]));
        }
}

void TestJpegLsDecoder::takesOtherCodingParameters()
{
    const QSize size(70, 50);
    const charls::jpegls_pc_parameters parameters{4095, 11, 40, 300, 31};
    const auto values = picture(Texture::Film, size, 4095, 5);
    cv::Mat stored;
    QVERIFY(decoded(encoded(values, size, 12, 0, &parameters), stored));
    for (std::size_t i = 0; i < values.size(); ++i)
        QCOMPARE(valueAt(stored, i), static_cast<int>(values[i]));
}

void TestJpegLsDecoder::refusesDataThatEndEarlyOrLate()
{
    const QSize size(60, 40);
    const auto bytes = encoded(picture(Texture::Film, size, 4095, 3), size, 12, 0);
    cv::Mat stored;
    QVERIFY(decoded(bytes, stored));
    for (std::size_t length = 0; length < bytes.size(); length += length + 40 < bytes.size() ? 37 : 1)
        QVERIFY2(!decoded({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length)}, stored),
                 qPrintable(QString::number(length)));
    // A line more in the data than the header says.
    auto shorter = bytes;
    shorter[8] = std::byte{39};
    QVERIFY(!decoded(shorter, stored));
    shorter[8] = std::byte{41};
    QVERIFY(!decoded(shorter, stored));
}

void TestJpegLsDecoder::refusesExtensions_data()
{
    QTest::addColumn<int>("at");
    QTest::addColumn<int>("value");
    QTest::addColumn<QString>("says");
    // 8 bits: SOI at 0, frame header at 2 (components at 11), scan header at 15 (near 22, interleave 23, transform 24).
    QTest::newRow("no picture") << 1 << 0xD9 << QStringLiteral("no JPEG-LS picture");
    QTest::newRow("baseline JPEG frame") << 3 << 0xC0 << QStringLiteral("unknown marker 0xc0");
    QTest::newRow("frame of 17 bits") << 6 << 17 << QStringLiteral("frame header is damaged");
    QTest::newRow("no columns") << 10 << 0 << QStringLiteral("frame header is damaged");
    QTest::newRow("three components") << 11 << 3 << QStringLiteral("3 components instead of one");
    QTest::newRow("mapping table") << 21 << 1 << QStringLiteral("not supported");
    QTest::newRow("near too large") << 22 << 200 << QStringLiteral("out of range");
    QTest::newRow("interleaved") << 23 << 1 << QStringLiteral("not supported");
    QTest::newRow("point transform") << 24 << 3 << QStringLiteral("not supported");
    QTest::newRow("restart intervals") << 16 << 0xDD << QStringLiteral("restart intervals");
    QTest::newRow("length beyond the end") << 17 << 0xFF << QStringLiteral("cut off");
}

void TestJpegLsDecoder::refusesExtensions()
{
    QFETCH(int, at);
    QFETCH(int, value);
    QFETCH(QString, says);
    const QSize size(20, 20);
    auto bytes = encoded(picture(Texture::Film, size, 255, 1), size, 8, 0);
    JpegLsHeader header;
    QCOMPARE(readJpegLsHeader(bytes, header), QString());
    bytes[static_cast<std::size_t>(at)] = static_cast<std::byte>(value);
    const QString refusal = readJpegLsHeader(bytes, header);
    QVERIFY2(refusal.contains(says), qPrintable(refusal));
}

void TestJpegLsDecoder::endsOnEveryDamage_data()
{
    QTest::addColumn<int>("bits");
    QTest::addColumn<int>("near");
    QTest::newRow("8 bits") << 8 << 0;
    QTest::newRow("12 bits") << 12 << 0;
    QTest::newRow("16 bits") << 16 << 0;
    QTest::newRow("16 bits, near 3") << 16 << 3;
}

void TestJpegLsDecoder::endsOnEveryDamage()
{
    QFETCH(int, bits);
    QFETCH(int, near);
    const QSize size(40, 30);
    const auto good = encoded(picture(Texture::Film, size, (1 << bits) - 1, 9), size, bits, near);
    std::mt19937 random(1234);
    int refused = 0;
    constexpr int trials = 600;
    for (int trial = 0; trial < trials; ++trial) {
        auto bytes = good;
        for (unsigned hit = 0; hit < 1 + random() % 6; ++hit)
            bytes[random() % bytes.size()] = static_cast<std::byte>(random() & 0xFFU);
        cv::Mat stored;
        refused += decoded(bytes, stored) ? 0 : 1;
    }
    QVERIFY2(refused > trials / 2, qPrintable(QString::number(refused)));
}

QTEST_APPLESS_MAIN(TestJpegLsDecoder)
#include "test_jpeg_ls_decoder.moc"
