// Tests of the moment that a picture in review stands for.
#include "imaging/cine_review.hpp"
#include "sample_frames.hpp"

#include <QSignalSpy>
#include <QtTest>

using namespace console;
using namespace std::chrono_literals;

namespace {

const Instant start = std::chrono::steady_clock::now();

std::shared_ptr<XrayFrame> frameAt(quint32 number, Duration since)
{
    auto frame = samples::frame(number, {64, 16}, 8, PixelEncoding::Raw);
    frame->arrival = start + since;
    return frame;
}

} // namespace

class TestCineReview : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void momentEndsWithTheNextPicture();
    void momentOfTheNewestEndsWhenAnotherComes();
    void momentEndsWithOneThatWasNeverShown();
    void momentIsNoLongerThanAPictureCounts();
};

void TestCineReview::momentEndsWithTheNextPicture()
{
    CineRing ring;
    CineReview review(ring);
    QVERIFY(!review.moment());
    ring.add(*frameAt(1, 0ms));
    ring.add(*frameAt(2, 66ms));
    QVERIFY(review.openAt(0));
    QVERIFY(review.moment() == start + 66ms - Instant::duration(1));
    review.close();
    QVERIFY(!review.moment());
}

/// The pedal is down: the newest is the newest for 66 ms.
void TestCineReview::momentOfTheNewestEndsWhenAnotherComes()
{
    CineRing ring;
    CineReview review(ring);
    const auto end = start + 66ms - Instant::duration(1);
    ring.add(*frameAt(1, 0ms));
    QVERIFY(review.open());
    QVERIFY(review.moment() == start + CineRing::longestGap);
    QSignalSpy changes(&review, &CineReview::placeChanged);
    review.noteNewest(*frameAt(1, 0ms)); // drawn anew
    QCOMPARE(changes.count(), 0);
    review.noteNewest(*frameAt(2, 66ms)); // before the ring has it
    QVERIFY(review.moment() == end);
    QCOMPARE(changes.count(), 1);
    ring.add(*frameAt(2, 66ms));
    review.noteNewest(*frameAt(3, 132ms));
    QVERIFY(review.moment() == end);
    QCOMPARE(changes.count(), 1); // whoever looks on is told once
    review.close();
    review.noteNewest(*frameAt(4, 198ms));
    QVERIFY(!review.moment());
}

/// It was replaced by another before it was shown.
void TestCineReview::momentEndsWithOneThatWasNeverShown()
{
    CineRing ring;
    CineReview review(ring);
    ring.add(*frameAt(1, 0ms));
    QVERIFY(review.open());
    ring.add(*frameAt(2, 66ms));
    review.noteNewest(*frameAt(3, 132ms));
    QVERIFY(review.moment() == start + 66ms - Instant::duration(1));
}

void TestCineReview::momentIsNoLongerThanAPictureCounts()
{
    CineRing ring;
    CineReview review(ring);
    ring.add(*frameAt(1, 0ms));
    QVERIFY(review.open());
    review.noteNewest(*frameAt(2, 10s)); // of the next run
    QVERIFY(review.moment() == start + CineRing::longestGap);
}

QTEST_GUILESS_MAIN(TestCineReview)
#include "test_cine_review.moc"
