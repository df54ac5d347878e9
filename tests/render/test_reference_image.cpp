// Tests of hold and review: what they show, that they say so, and that they can never count as the live picture.
#include "imaging/cine_review.hpp"
#include "imaging/image_hold.hpp"
#include "imaging/live_image_view.hpp"
#include "imaging/pane_colours.hpp"
#include "imaging/reference_image_view.hpp"
#include "model/permit_guards.hpp"
#include "sample_frames.hpp"

#include <QSignalSpy>
#include <QtTest>

using namespace console;
using namespace std::chrono_literals;

namespace {

constexpr QSize size(320, 260);

DisplayPicture pictureWith(PictureRole role, quint32 number, quint32 run = 1)
{
    DisplayPicture picture;
    picture.about = *samples::frame(number, size, 8, PixelEncoding::Raw);
    picture.about.acquisition = run;
    picture.about.source = PictureSource::Live;
    picture.about.arrival = std::chrono::steady_clock::now();
    picture.about.ageAtArrival = 5ms; // as young as the youngest
    picture.role = role;
    picture.image = QImage(size, QImage::Format_RGB32);
    picture.image.fill(qRgb(100, 100, 100));
    return picture;
}

std::shared_ptr<XrayFrame> ringFrame(quint32 number)
{
    auto frame = samples::frame(number, size, 8, PixelEncoding::Raw);
    frame->arrival = std::chrono::steady_clock::now();
    return frame;
}

} // namespace

class TestReferenceImage : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void reviewNeverCountsAsLive_data();
    void reviewNeverCountsAsLive();
    void livePictureIsNotShownAsReference();
    void hasDashedFrameAndItsWord();
    void saysWhatItIsInLargeLetters();
    void neverSaysLive();
    void saysThatThePictureWasReduced();
    void vesselsLieOverRoadmapsOnly();
    void roadmapIsAsFrozenAsTheLivePicture();
    void whatIsToldLeavesTheMiddleFree();
    void holdsLastPictureOfRun();
    void holdsNothingOfAnXraySystemThatBeganAnew();
    void saysThatItPlaysForAsLongAsItDoes();
    void reviewsRing();
    void playsToTheEndAndStops();
    void playsToTheEndAlsoWhileNewOnesCome();
    void staysWhereItIsWhenTheRingMovesOn();
};

void TestReferenceImage::reviewNeverCountsAsLive_data()
{
    QTest::addColumn<int>("role");
    QTest::newRow("hold") << static_cast<int>(PictureRole::Hold);
    QTest::newRow("review") << static_cast<int>(PictureRole::Review);
    QTest::newRow("roadmap") << static_cast<int>(PictureRole::Roadmap);
}

void TestReferenceImage::reviewNeverCountsAsLive()
{
    QFETCH(int, role);
    PictureState state;
    state.setLinkUp(true);
    const Instant now = std::chrono::steady_clock::now();
    state.expect(15, now - 2s);
    LiveImageView live(state);
    live.resize(400, 400);
    // Even handed to the live pane by mistake, and even if a stamp were made of it.
    live.showPicture(pictureWith(static_cast<PictureRole>(role), 1));
    live.grab();
    QVERIFY(!live.picture());
    PictureStamp stamp;
    stamp.frame = 1;
    stamp.source = PictureSource::Live;
    stamp.role = static_cast<PictureRole>(role);
    stamp.captured = now;
    stamp.arrived = stamp.painted = now;
    state.notePainted(stamp);
    QCOMPARE(state.reading(now).condition, PictureCondition::None);
    QCOMPARE(state.paintedCount(), quint64(0));
    GuardReadings readings;
    readings.picture = state.reading(now);
    readings.pictureLimit = state.limit();
    const GuardSet met = metGuards(checkGuards(readings));
    QVERIFY(!met.test(static_cast<std::size_t>(Guard::PictureLive)));
    QVERIFY(!checkKept(readings).test(static_cast<std::size_t>(Guard::PictureLive)));
    stamp.role = PictureRole::Live;
    state.notePainted(stamp);
    QCOMPARE(state.reading(now).condition, PictureCondition::Live);
}

void TestReferenceImage::livePictureIsNotShownAsReference()
{
    ReferenceImageView view;
    view.showPicture(pictureWith(PictureRole::Live, 1));
    QVERIFY(!view.picture());
    view.showPicture(pictureWith(PictureRole::Hold, 1));
    QVERIFY(view.picture());
}

void TestReferenceImage::hasDashedFrameAndItsWord()
{
    ReferenceImageView view;
    view.resize(420, 400);
    QCOMPARE(view.accessibleDescription(), QStringLiteral("No reference picture yet."));
    view.showPicture(pictureWith(PictureRole::Hold, 1));
    const QImage hold = view.grab().toImage();
    QVERIFY(view.accessibleDescription().startsWith(QStringLiteral("LAST IMAGE HOLD")));
    QVERIFY(view.accessibleDescription().contains(QStringLiteral("not the live picture")));
    // The frame is broken: along its upper edge there is line, and there is ground.
    int line = 0;
    int ground = 0;
    for (int x = 10; x < view.width() - 10; ++x) {
        line += hold.pixelColor(x, 1) == pane_colours::line ? 1 : 0;
        ground += hold.pixelColor(x, 1) == pane_colours::background ? 1 : 0;
    }
    QVERIFY(line > view.width() / 4);
    QVERIFY(ground > view.width() / 5);
    view.showPicture(pictureWith(PictureRole::Review, 1));
    view.setPlace(QStringLiteral("3 of 9"));
    QVERIFY(view.grab().toImage() != hold);
    QVERIFY(view.accessibleDescription().startsWith(QStringLiteral("REVIEW")));
}

// However small the pane: 24 pixels where its window's texts have 16. Beside the plate below, which is narrower.
void TestReferenceImage::saysWhatItIsInLargeLetters()
{
    for (const QSize pane : {QSize(562, 520), QSize(421, 390)}) {
        ReferenceImageView view;
        QFont body = view.font();
        body.setPixelSize(16);
        view.setFont(body);
        view.resize(pane);
        view.showPicture(pictureWith(PictureRole::Hold, 1));
        view.grab();
        QFont head = body;
        head.setPixelSize(24);
        int rows = 0;
        for (int y = 0; y < 100; ++y)
            rows += view.overlayRegion().contains(view.pictureRect().topLeft() + QPoint(200, y)) ? 1 : 0;
        QVERIFY2(rows >= QFontMetrics(head).height() + 8, qPrintable(QString::number(rows)));
    }
}

void TestReferenceImage::neverSaysLive()
{
    ReferenceImageView view;
    for (const PictureRole role : {PictureRole::Hold, PictureRole::Review, PictureRole::Roadmap})
        for (const PictureSource source : {PictureSource::Live, PictureSource::Simulated, PictureSource::Recorded}) {
            DisplayPicture picture = pictureWith(role, 1);
            picture.about.source = source;
            view.showPicture(picture);
            QVERIFY(!view.accessibleDescription().contains(QStringLiteral("LIVE")));
            if (source != PictureSource::Live)
                QVERIFY(view.accessibleDescription().contains(word(source)));
        }
}

/// Where the live pane has forgotten it: the pixels are the same.
void TestReferenceImage::saysThatThePictureWasReduced()
{
    ReferenceImageView view;
    view.resize(420, 400);
    for (const PictureRole role : {PictureRole::Hold, PictureRole::Review, PictureRole::Roadmap}) {
        DisplayPicture picture = pictureWith(role, 1);
        view.showPicture(picture);
        view.grab();
        const QRegion asAskedFor = view.overlayRegion();
        picture.about.rung = 9;
        picture.about.rate = 7.5;
        picture.about.askedRate = 15;
        picture.about.encoding = PixelEncoding::Jpeg;
        picture.about.quality = 50;
        view.showPicture(picture);
        view.grab();
        QVERIFY(!(view.overlayRegion() - asAskedFor).isEmpty());
        QVERIFY2(view.accessibleDescription().endsWith(QStringLiteral("REDUCED 7.5 of 15 /s, lossy 50.")),
                 qPrintable(view.accessibleDescription()));
    }
}

void TestReferenceImage::vesselsLieOverRoadmapsOnly()
{
    QImage vessels(size / 2, QImage::Format_ARGB32_Premultiplied); // coarser than the picture
    vessels.fill(Qt::transparent);
    for (int row = 0; row < vessels.height(); ++row)
        for (int column = vessels.width() / 2; column < vessels.width(); ++column)
            vessels.setPixelColor(column, row, pane_colours::roadmap);
    ReferenceImageView view;
    view.resize(420, 400);
    view.showPicture(pictureWith(PictureRole::Roadmap, 1));
    view.setVessels(vessels);
    view.setOpacity(1);
    const auto colourAt = [&view](double share) {
        const QRect area = view.pictureRect();
        return view.grab().toImage().pixelColor(area.left() + static_cast<int>(share * area.width()), area.center().y());
    };
    QCOMPARE(colourAt(0.7), pane_colours::roadmap);
    QCOMPARE(colourAt(0.3), QColor(100, 100, 100));
    view.setOpacity(0.5);
    QVERIFY(std::abs(colourAt(0.7).blue() - (100 + pane_colours::roadmap.blue()) / 2) <= 2);
    const DisplayPicture saved = view.pictureWithVessels();
    QVERIFY(saved.image.pixelColor(size.width() * 3 / 4, size.height() / 2) != QColor(100, 100, 100));
    QVERIFY(saved.presentation.isNull());
    DisplayPicture calibrated = pictureWith(PictureRole::Roadmap, 1);
    calibrated.presentation = calibrated.image.convertToFormat(QImage::Format_Grayscale8);
    view.showPicture(calibrated);
    QCOMPARE(view.pictureWithVessels().presentation, saved.image); // they are in what is exported, too
    QCOMPARE(view.picture()->image.pixelColor(size.width() * 3 / 4, size.height() / 2), QColor(100, 100, 100));
    for (const PictureRole role : {PictureRole::Hold, PictureRole::Review}) {
        view.showPicture(pictureWith(role, 1));
        QCOMPARE(colourAt(0.7), QColor(100, 100, 100));
    }
}

void TestReferenceImage::roadmapIsAsFrozenAsTheLivePicture()
{
    ReferenceImageView view;
    view.resize(420, 400);
    view.showPicture(pictureWith(PictureRole::Roadmap, 1));
    const QPoint place(view.pictureRect().center().x(), view.pictureRect().center().y());
    const QColor live = view.grab().toImage().pixelColor(place);
    for (const PictureCondition condition : {PictureCondition::Frozen, PictureCondition::Unknown}) {
        view.setCondition(condition);
        QVERIFY(view.accessibleDescription().contains(word(condition)));
        QVERIFY(view.grab().toImage().pixelColor(place) != live);
    }
    view.setCondition(PictureCondition::Live);
    QCOMPARE(view.grab().toImage().pixelColor(place), live);
}

// Where the vessels are that a roadmap is made for.
void TestReferenceImage::whatIsToldLeavesTheMiddleFree()
{
    ReferenceImageView view;
    view.resize(420, 376);
    view.showPicture(pictureWith(PictureRole::Roadmap, 1));
    view.setPlace(QStringLiteral("Vessels of 12:00:00, run 4"));
    view.grab();
    const QRegion before = view.overlayRegion();
    view.tell(QStringLiteral("roadmap made of 92 pictures of run 4"));
    view.grab();
    const QRegion told = view.overlayRegion() - before;
    QVERIFY(!told.isEmpty());
    QVERIFY(!before.intersects(told.boundingRect()));
    const QRect picture = view.pictureRect();
    QVERIFY2(told.boundingRect().bottom() < picture.center().y(), qPrintable(QString::number(told.boundingRect().bottom())));
    QVERIFY(told.boundingRect().left() < picture.left() + picture.width() / 8);
}

void TestReferenceImage::holdsLastPictureOfRun()
{
    const CineRing ring;
    const TableRest table;
    ImageHold hold(ring, table);
    std::vector<DisplayPicture> held;
    QObject::connect(&hold, &ImageHold::held, this, [&held](const DisplayPicture& picture) { held.push_back(picture); });
    hold.endRun();
    QVERIFY(held.empty());
    hold.take(pictureWith(PictureRole::Live, 1));
    hold.take(pictureWith(PictureRole::Live, 2));
    hold.take(pictureWith(PictureRole::Review, 99));
    QVERIFY(held.empty());
    hold.endRun();
    QCOMPARE(held.size(), std::size_t(1));
    QCOMPARE(held.back().role, PictureRole::Hold);
    QCOMPARE(held.back().about.frame, 2U);
    hold.take(pictureWith(PictureRole::Live, 3, 2));
    QCOMPARE(held.size(), std::size_t(1));           // it was held when the pedal went up
    hold.take(pictureWith(PictureRole::Live, 4, 3)); // the pedal came down again at once
    QCOMPARE(held.size(), std::size_t(2));
    QCOMPARE(held.back().about.frame, 3U);
    hold.endRun();
    QCOMPARE(held.back().about.frame, 4U);
    hold.take(pictureWith(PictureRole::Live, 5, 3)); // was still being decoded when the run ended
    QCOMPARE(held.size(), std::size_t(4));
    QCOMPARE(held.back().about.frame, 5U);
}

/// It counts its runs and pictures from the first again: they are not late ones of the run that is held.
void TestReferenceImage::holdsNothingOfAnXraySystemThatBeganAnew()
{
    const CineRing ring;
    const TableRest table;
    ImageHold hold(ring, table);
    std::vector<DisplayPicture> held;
    QObject::connect(&hold, &ImageHold::held, this, [&held](const DisplayPicture& picture) { held.push_back(picture); });
    for (quint32 number = 1; number <= 3; ++number)
        hold.take(pictureWith(PictureRole::Live, number, 1));
    hold.endRun();
    QCOMPARE(held.size(), std::size_t(1));
    for (quint32 number = 1; number <= 5; ++number) {
        auto picture = pictureWith(PictureRole::Live, number, 1);
        picture.about.captureNs += 60'000'000'000ULL;
        hold.take(picture);
    }
    QCOMPARE(held.size(), std::size_t(1));
    QCOMPARE(held.back().about.frame, 3U);
    hold.endRun();
    QCOMPARE(held.back().about.frame, 5U);
}

/// Who is told of a place asks whether the film runs: its button must be the one that stops it.
void TestReferenceImage::saysThatItPlaysForAsLongAsItDoes()
{
    CineRing ring;
    for (quint32 number = 1; number <= 5; ++number)
        ring.add(*ringFrame(number));
    CineReview review(ring);
    QVERIFY(review.open());
    review.toOldest();
    std::vector<bool> plays;
    QObject::connect(&review, &CineReview::placeChanged, this, [&] { plays.push_back(review.isPlaying()); });
    review.setPlaying(true);
    QTRY_VERIFY(!review.isPlaying());
    QVERIFY(plays.size() >= 5);
    for (std::size_t i = 0; i + 1 < plays.size(); ++i)
        QVERIFY2(plays[i], qPrintable(QString::number(i)));
    QVERIFY(!plays.back());
}

void TestReferenceImage::reviewsRing()
{
    CineRing ring;
    CineReview review(ring);
    QVERIFY(!review.open());
    QCOMPARE(review.place(), QString());
    for (quint32 number = 1; number <= 5; ++number)
        ring.add(*ringFrame(number));
    std::vector<DisplayPicture> shown;
    QObject::connect(&review, &CineReview::pictureReady, this, [&shown](const DisplayPicture& picture) { shown.push_back(picture); });
    QVERIFY(review.open());
    QTRY_VERIFY(!shown.empty());
    QCOMPARE(shown.back().role, PictureRole::Review);
    QCOMPARE(shown.back().about.frame, 5U);
    QCOMPARE(review.place(), QStringLiteral("5 of 5, 0.0 s before the newest"));
    review.step(-2);
    QTRY_COMPARE(shown.back().about.frame, 3U);
    QCOMPARE(review.place(), QStringLiteral("3 of 5, 0.1 s before the newest"));
    review.step(-100);
    QTRY_COMPARE(shown.back().about.frame, 1U);
    review.step(100);
    QTRY_COMPARE(shown.back().about.frame, 5U);
    review.toOldest();
    QTRY_COMPARE(shown.back().about.frame, 1U);
    for (const DisplayPicture& picture : shown)
        QCOMPARE(picture.role, PictureRole::Review);
    review.close();
    QVERIFY(!review.isOpen());
    review.step(1);
    QVERIFY(!review.isOpen());
}

void TestReferenceImage::playsToTheEndAndStops()
{
    CineRing ring;
    for (quint32 number = 1; number <= 4; ++number) {
        auto frame = ringFrame(number);
        frame->captureNs = number * 1'000'000ULL;
        ring.add(*frame);
    }
    CineReview review(ring);
    std::vector<quint32> shown;
    QObject::connect(&review, &CineReview::pictureReady, this,
                     [&shown](const DisplayPicture& picture) { shown.push_back(picture.about.frame); });
    QVERIFY(review.open());
    review.setPlaying(true);
    QVERIFY(review.isPlaying());
    QTRY_VERIFY(!review.isPlaying());
    QTRY_COMPARE(shown.back(), 4U);
    QVERIFY(review.isOpen());
}

/// The pedal is down: by the time of Play the newest that stands there is the newest no more.
void TestReferenceImage::playsToTheEndAlsoWhileNewOnesCome()
{
    CineRing ring;
    quint32 number = 0;
    const auto add = [&] {
        auto frame = ringFrame(++number);
        frame->captureNs = number * 1'000'000ULL;
        ring.add(*frame);
    };
    while (number < 10)
        add();
    CineReview review(ring);
    QVERIFY(review.open());
    add();
    QStringList places;
    QObject::connect(&review, &CineReview::placeChanged, this, [&] {
        places << review.place();
        add();
    });
    review.setPlaying(true);
    QVERIFY2(places.first().startsWith(QStringLiteral("1 of 11,")), qPrintable(places.first()));
    QTRY_VERIFY(!review.isPlaying());
    QVERIFY2(places.last().startsWith(QStringLiteral("11 of ")), qPrintable(places.last()));
    QCOMPARE(places.size(), 13); // eleven frames, the begin and the end
    places.clear();
    review.setPlaying(true); // once more, from the oldest
    QVERIFY2(places.first().startsWith(QStringLiteral("1 of ")), qPrintable(places.first()));
}

void TestReferenceImage::staysWhereItIsWhenTheRingMovesOn()
{
    CineRing ring(3 * static_cast<std::size_t>(size.width() * size.height()));
    for (quint32 number = 1; number <= 3; ++number)
        ring.add(*ringFrame(number));
    CineReview review(ring);
    QSignalSpy pictures(&review, &CineReview::pictureReady);
    QVERIFY(review.open());
    QTRY_COMPARE(pictures.count(), 1);
    for (quint32 number = 4; number <= 9; ++number)
        ring.add(*ringFrame(number));
    QCOMPARE(review.place(), QStringLiteral("older than the 3 frames that are kept"));
    review.step(-1); // the oldest there still is
    QTRY_COMPARE(pictures.count(), 2);
    QCOMPARE(pictures.last().first().value<DisplayPicture>().about.frame, 7U);
}

QTEST_MAIN(TestReferenceImage)
#include "test_reference_image.moc"
