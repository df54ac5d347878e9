// Tests of the frame decoder: every encoding, and bytes of every kind that must be refused.
#include "imaging/frame_decoder.hpp"
#include "sample_frames.hpp"

#include <QtTest>

#include <cstdlib>
#include <functional>
#include <random>

using namespace console;

namespace {

using Change = std::function<std::shared_ptr<XrayFrame>(const XrayFrame&)>;

constexpr QSize smallSize(24, 16);

std::vector<std::byte> bytesOf(const XrayFrame& frame) { return {frame.pixels.begin(), frame.pixels.end()}; }

int valueAt(const cv::Mat& stored, int row, int column)
{
    return stored.type() == CV_8UC1 ? stored.at<std::uint8_t>(row, column) : stored.at<std::uint16_t>(row, column);
}

Change setting(const std::function<void(XrayFrame&)>& change)
{
    return [change](const XrayFrame& frame) {
        auto copy = std::make_shared<XrayFrame>(frame);
        change(*copy);
        return copy;
    };
}

Change cutTo(double share)
{
    return [share](const XrayFrame& frame) {
        std::vector<std::byte> bytes = bytesOf(frame);
        bytes.resize(static_cast<std::size_t>(static_cast<double>(bytes.size()) * share));
        return samples::withBytes(frame, std::move(bytes));
    };
}

} // namespace

Q_DECLARE_METATYPE(Change)

class TestFrameDecoder : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void givesBackStoredValues_data();
    void givesBackStoredValues();
    void jpegStaysNear();
    void clearsBitsAboveThoseStored();
    void refusesWhatContradictsTheMessage_data();
    void refusesWhatContradictsTheMessage();
    void survivesDamagedBytes_data();
    void survivesDamagedBytes();
    void takesNoMemoryForWhatItRefuses();
};

void TestFrameDecoder::givesBackStoredValues_data()
{
    QTest::addColumn<int>("bits");
    QTest::addColumn<int>("encoding");
    QTest::addColumn<int>("near");
    for (const int bits : {1, 2, 7, 8, 9, 10, 12, 15, 16}) {
        QTest::addRow("raw, %d bits", bits) << bits << static_cast<int>(PixelEncoding::Raw) << 0;
        QTest::addRow("jpeg-ls, %d bits", bits) << bits << static_cast<int>(PixelEncoding::JpegLs) << 0;
    }
    QTest::newRow("jpeg-ls, 8 bits, near 2") << 8 << static_cast<int>(PixelEncoding::JpegLs) << 2;
    QTest::newRow("jpeg-ls, 12 bits, near 5") << 12 << static_cast<int>(PixelEncoding::JpegLs) << 5;
}

void TestFrameDecoder::givesBackStoredValues()
{
    QFETCH(int, bits);
    QFETCH(int, encoding);
    QFETCH(int, near);
    const QSize size(67, 41);
    const auto frame = samples::frame(1, size, bits, static_cast<PixelEncoding>(encoding), near);
    cv::Mat stored;
    QCOMPARE(decodeFrame(*frame, stored), QString());
    QCOMPARE(stored.type(), bits <= 8 ? CV_8UC1 : CV_16UC1);
    QCOMPARE(QSize(stored.cols, stored.rows), size);
    const auto values = samples::storedValues(size, bits);
    for (int row = 0; row < stored.rows; ++row)
        for (int column = 0; column < stored.cols; ++column)
            QVERIFY(std::abs(valueAt(stored, row, column) - values[static_cast<std::size_t>(row * size.width() + column)]) <= near);
}

void TestFrameDecoder::jpegStaysNear()
{
    const QSize size(128, 96);
    const auto frame = samples::frame(1, size, 8, PixelEncoding::Jpeg, 95);
    cv::Mat stored;
    QCOMPARE(decodeFrame(*frame, stored), QString());
    QCOMPARE(stored.type(), CV_8UC1);
    const auto values = samples::storedValues(size, 8);
    for (int row = 0; row < stored.rows; ++row)
        for (int column = 0; column < stored.cols; ++column)
            QVERIFY(std::abs(valueAt(stored, row, column) - values[static_cast<std::size_t>(row * size.width() + column)]) <= 8);
}

void TestFrameDecoder::clearsBitsAboveThoseStored()
{
    auto frame = samples::frame(1, {2, 1}, 12, PixelEncoding::Raw);
    frame = samples::withBytes(*frame, {std::byte{0x34}, std::byte{0xF2}, std::byte{0xFF}, std::byte{0xFF}});
    cv::Mat stored;
    QCOMPARE(decodeFrame(*frame, stored), QString());
    QCOMPARE(valueAt(stored, 0, 0), 0x234);
    QCOMPARE(valueAt(stored, 0, 1), 0xFFF);
}

void TestFrameDecoder::refusesWhatContradictsTheMessage_data()
{
    QTest::addColumn<int>("bits");
    QTest::addColumn<int>("encoding");
    QTest::addColumn<Change>("change");
    QTest::addColumn<QString>("says");
    const int raw = static_cast<int>(PixelEncoding::Raw);
    const int jpegLs = static_cast<int>(PixelEncoding::JpegLs);
    const int jpeg = static_cast<int>(PixelEncoding::Jpeg);
    const auto row = [](const char* name, int bits, int encoding, Change change, const char* says) {
        QTest::newRow(name) << bits << encoding << std::move(change) << QString::fromLatin1(says);
    };
    row("no rows", 8, raw, setting([](XrayFrame& f) { f.rows = 0; }), "not within 1 to 4096");
    row("negative columns", 8, raw, setting([](XrayFrame& f) { f.columns = -3; }), "not within 1 to 4096");
    row("too many rows", 8, raw, setting([](XrayFrame& f) { f.rows = 4097; }), "not within 1 to 4096");
    row("no bits", 8, raw, setting([](XrayFrame& f) { f.bitsStored = 0; }), "bits stored");
    row("17 bits", 16, raw, setting([](XrayFrame& f) { f.bitsStored = 17; }), "bits stored");
    row("no pixels", 8, raw, setting([](XrayFrame& f) { f.pixels = {}; }), "no pixels");
    row("unknown encoding", 8, raw, setting([](XrayFrame& f) { f.encoding = static_cast<PixelEncoding>(9); }), "encoding 9 is unknown");
    row("raw, cut", 12, raw, cutTo(0.9), "bytes, and it has");
    row("raw, depth other than said", 8, raw, setting([](XrayFrame& f) { f.bitsStored = 12; }), "bytes, and it has");
    row("jpeg-ls, other size", 12, jpegLs, setting([](XrayFrame& f) { f.rows = 17; }), "the message says 24 x 17");
    row("jpeg-ls, huge claim", 12, jpegLs, setting([](XrayFrame& f) { f.rows = f.columns = 4096; }), "the message says 4096 x 4096");
    row("jpeg-ls, fewer bits than said", 12, jpegLs, setting([](XrayFrame& f) { f.bitsStored = 14; }), "has 12 bits, the message says 14");
    row("jpeg-ls, too deep for the message", 12, jpegLs, setting([](XrayFrame& f) { f.bitsStored = 8; }),
        "has 12 bits, the message says 8");
    row("jpeg-ls, cut", 12, jpegLs, cutTo(0.5), "data are damaged");
    row("jpeg-ls, header only", 12, jpegLs, cutTo(0.02), "header is cut off");
    row("jpeg-ls said, jpeg sent", 8, jpeg, setting([](XrayFrame& f) { f.encoding = PixelEncoding::JpegLs; }), "unknown marker");
    row("jpeg, 12 bits", 8, jpeg, setting([](XrayFrame& f) { f.bitsStored = 12; }), "a JPEG picture has 8 bits");
    row("jpeg, other size", 8, jpeg, setting([](XrayFrame& f) { f.columns = 25; }), "the message says 25 x 16");
    row("jpeg, cut", 8, jpeg, cutTo(0.95), "cannot be decoded");
    row("jpeg, header cut", 8, jpeg, cutTo(0.1), "JPEG");
    row("jpeg said, raw sent", 8, raw, setting([](XrayFrame& f) { f.encoding = PixelEncoding::Jpeg; }), "JPEG header");
    row(
        "jpeg-ls lossier than said", 8, jpegLs,
        [](const XrayFrame& f) {
            return samples::withBytes(f, samples::encode(samples::storedValues(smallSize, 8), smallSize, 8, PixelEncoding::JpegLs, 3));
        },
        "off by 3, the message says by at most 0");
    row(
        "more bytes than allowed", 8, jpegLs,
        [](const XrayFrame& f) {
            std::vector<std::byte> bytes = bytesOf(f);
            bytes.resize(largestEncoding + 1);
            return samples::withBytes(f, std::move(bytes));
        },
        "more than 16 MiB");
}

void TestFrameDecoder::refusesWhatContradictsTheMessage()
{
    QFETCH(int, bits);
    QFETCH(int, encoding);
    QFETCH(Change, change);
    QFETCH(QString, says);
    const auto good = samples::frame(1, smallSize, bits, static_cast<PixelEncoding>(encoding), encoding == 2 ? 90 : 0);
    cv::Mat stored;
    QCOMPARE(decodeFrame(*good, stored), QString());
    const QString refusal = decodeFrame(*change(*good), stored);
    QVERIFY2(refusal.contains(says), qPrintable(refusal));
}

void TestFrameDecoder::survivesDamagedBytes_data()
{
    QTest::addColumn<int>("bits");
    QTest::addColumn<int>("encoding");
    QTest::newRow("jpeg-ls, 8 bits") << 8 << static_cast<int>(PixelEncoding::JpegLs);
    QTest::newRow("jpeg-ls, 16 bits") << 16 << static_cast<int>(PixelEncoding::JpegLs);
    QTest::newRow("jpeg") << 8 << static_cast<int>(PixelEncoding::Jpeg);
}

void TestFrameDecoder::survivesDamagedBytes()
{
    QFETCH(int, bits);
    QFETCH(int, encoding);
    const auto good = samples::frame(1, smallSize, bits, static_cast<PixelEncoding>(encoding), encoding == 2 ? 90 : 0);
    std::mt19937 random(20240611);
    int refused = 0;
    for (int trial = 0; trial < 600; ++trial) {
        std::vector<std::byte> bytes = bytesOf(*good);
        // Half of the damage falls into the header, where sizes and tables are.
        const std::size_t reach = trial % 2 == 0 ? std::min<std::size_t>(bytes.size(), 40) : bytes.size();
        for (unsigned hit = 0; hit < 1 + random() % 4; ++hit)
            bytes[random() % reach] = static_cast<std::byte>(random() & 0xFFU);
        if (trial % 5 == 0)
            bytes.resize(random() % bytes.size());
        cv::Mat stored;
        if (!decodeFrame(*samples::withBytes(*good, std::move(bytes)), stored).isEmpty())
            ++refused;
        else
            QCOMPARE(QSize(stored.cols, stored.rows), smallSize);
    }
    QVERIFY(refused > 120);
}

void TestFrameDecoder::takesNoMemoryForWhatItRefuses()
{
    auto frame = samples::frame(1, smallSize, 16, PixelEncoding::Raw);
    frame->rows = 4096;
    frame->columns = 4096;
    cv::Mat stored;
    QVERIFY(!decodeFrame(*frame, stored).isEmpty());
    QVERIFY(stored.empty());
    frame->encoding = PixelEncoding::JpegLs;
    QVERIFY(!decodeFrame(*frame, stored).isEmpty());
    QVERIFY(stored.empty());
}

QTEST_APPLESS_MAIN(TestFrameDecoder)
#include "test_frame_decoder.moc"
