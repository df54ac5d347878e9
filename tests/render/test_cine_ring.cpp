// Tests of the last minute of frames: bounded in time and in memory, with numbers that stay.
#include "imaging/cine_ring.hpp"
#include "sample_frames.hpp"

#include <QtTest>

using namespace console;
using namespace std::chrono_literals;

namespace {

const Instant start = std::chrono::steady_clock::now();

// 64 x 16 pixels of 8 bits: 1024 bytes; fifteen a second.
std::shared_ptr<XrayFrame> frameAt(quint32 number, Duration since)
{
    auto frame = samples::frame(number, {64, 16}, 8, PixelEncoding::Raw);
    frame->arrival = start + since;
    frame->captureNs = static_cast<quint64>(since.count());
    return frame;
}

} // namespace

class TestCineRing : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void keepsOneMinute();
    void keepsToItsMemory();
    void numbersStay();
    void copiesTheBytes();
    void keepsNothingLargerThanItself();
    void findsTheFrameOfAMoment();
    void clocksThatAreSetLeadToNoOtherFrame();
};

void TestCineRing::keepsOneMinute()
{
    CineRing ring;
    QVERIFY(ring.range().isEmpty());
    QCOMPARE(ring.span(), 0ns);
    for (int second = 0; second <= 100; ++second)
        ring.add(*frameAt(static_cast<quint32>(second), std::chrono::seconds(second)));
    QCOMPARE(ring.span(), Duration(60s));
    QCOMPARE(ring.range().first, quint64(40));
    QCOMPARE(ring.range().end, quint64(101));
    QCOMPARE(ring.at(40)->frame, 40U);
}

void TestCineRing::keepsToItsMemory()
{
    CineRing ring(10 * 1024);
    for (quint32 number = 0; number < 500; ++number) {
        ring.add(*frameAt(number, std::chrono::milliseconds(66) * number));
        QVERIFY(ring.bytes() <= 10 * 1024);
    }
    QCOMPARE(ring.range().end - ring.range().first, quint64(10));
    QCOMPARE(ring.bytes(), std::size_t(10 * 1024));
    QCOMPARE(ring.span(), Duration(9 * 66ms));
}

void TestCineRing::numbersStay()
{
    CineRing ring(3 * 1024);
    for (quint32 number = 0; number < 5; ++number)
        ring.add(*frameAt(number, std::chrono::milliseconds(66) * number));
    QCOMPARE(ring.at(1), nullptr);
    QCOMPARE(ring.at(2)->frame, 2U);
    QCOMPARE(ring.at(4)->frame, 4U);
    QCOMPARE(ring.at(5), nullptr);
}

void TestCineRing::copiesTheBytes()
{
    CineRing ring;
    auto frame = frameAt(1, 0ns);
    const std::weak_ptr<const void> bytes = frame->owner;
    const auto first = frame->pixels.front();
    ring.add(*frame);
    frame.reset();
    QVERIFY(bytes.expired());
    QCOMPARE(ring.at(0)->pixels.size(), std::size_t(1024));
    QCOMPARE(ring.at(0)->pixels.front(), first);
}

void TestCineRing::keepsNothingLargerThanItself()
{
    CineRing ring(1000);
    ring.add(*frameAt(1, 0ns));
    QVERIFY(ring.range().isEmpty());
    QCOMPARE(ring.bytes(), std::size_t(0));
}

void TestCineRing::findsTheFrameOfAMoment()
{
    CineRing ring;
    QVERIFY(ring.frameOf(start).picture == MomentPicture::NotTaken);
    for (quint32 number = 0; number < 3; ++number)
        ring.add(*frameAt(number, std::chrono::milliseconds(100) * number));
    ring.add(*frameAt(3, 10s));
    const auto numberAt = [&ring](Duration since) {
        const auto found = ring.frameOf(start + since);
        return found.picture == MomentPicture::Kept ? int(found.number) : -1;
    };
    QCOMPARE(numberAt(-1ns), -1);
    QVERIFY(ring.frameOf(start - 1ns).picture == MomentPicture::NotTaken); // the first one ever came later
    QCOMPARE(numberAt(0ns), 0);
    QCOMPARE(numberAt(99ms), 0);
    QCOMPARE(numberAt(100ms), 1);
    QCOMPARE(numberAt(199ms), 1);
    QCOMPARE(numberAt(200ms + CineRing::longestGap), 2);
    QCOMPARE(numberAt(201ms + CineRing::longestGap), -1); // between two runs
    QCOMPARE(numberAt(10s), 3);
    QCOMPARE(numberAt(10s + CineRing::longestGap), 3);
    QVERIFY(ring.frameOf(start + 30s).picture == MomentPicture::NotTaken);
    ring.add(*frameAt(4, 65s)); // the first three go
    QVERIFY(ring.frameOf(start + 150ms).picture == MomentPicture::Gone);
    QCOMPARE(numberAt(10s), 3);
    QCOMPARE(numberAt(65s), 4);
}

/// The X-ray system's clock goes back by an hour between the second frame and the third.
void TestCineRing::clocksThatAreSetLeadToNoOtherFrame()
{
    CineRing ring;
    for (quint32 number = 0; number < 4; ++number) {
        const auto frame = frameAt(number, std::chrono::milliseconds(100) * number);
        frame->captureNs = 7'200'000'000'000ULL + frame->captureNs - (number < 2 ? 0 : 3'600'000'000'000ULL);
        ring.add(*frame);
    }
    for (quint32 number = 0; number < 4; ++number)
        QCOMPARE(ring.frameOf(start + std::chrono::milliseconds(100) * number + 50ms).number, quint64(number));
}

QTEST_APPLESS_MAIN(TestCineRing)
#include "test_cine_ring.moc"
