// Tests of a last image hold that is a mean: when it comes, of what, how it says so, and that it is never the live picture.
#include "chain_run.hpp"
#include "imaging/image_hold.hpp"
#include "imaging/live_image_view.hpp"
#include "imaging/picture_export.hpp"
#include "imaging/picture_marks.hpp"
#include "imaging/reference_image_view.hpp"

#include <QtTest>

#include <vector>

using namespace console;
using namespace std::chrono_literals;

namespace {

constexpr std::array<double, 3> here{};
constexpr std::array<double, 3> elsewhere{0, 5, 0};
const Instant start = std::chrono::steady_clock::now();

Instant arrivalOf(quint32 number) { return start + number * 66ms; }

/// A hold with its ring, and what it told.
struct Stage {
    explicit Stage(int pictures)
    {
        QObject::connect(&hold, &ImageHold::held, &hold, [this](const DisplayPicture& picture) { held.push_back(picture); });
        hold.setPictures(pictures);
        table.note(here, start);
    }

    static std::shared_ptr<XrayFrame> frameOf(quint32 number, std::uint16_t value, quint32 run = 1)
    {
        auto frame = samples::flatFrame(number, value);
        frame->acquisition = run;
        frame->arrival = arrivalOf(number);
        return frame;
    }

    void take(const XrayFrame& frame)
    {
        DisplayPicture picture;
        picture.about = frame;
        picture.about.owner.reset();
        picture.about.pixels = {};
        picture.image = QImage(samples::chainSize, QImage::Format_RGB32);
        picture.image.fill(Qt::white);
        hold.take(picture);
    }

    void show(quint32 number, std::uint16_t value, quint32 run = 1)
    {
        const auto frame = frameOf(number, value, run);
        ring.add(*frame);
        take(*frame);
    }

    /// Numbers 1 to 4, whose mean is 1020.
    void showRun()
    {
        for (quint32 number = 1; number <= 4; ++number)
            show(number, number < 4 ? 1000 : 1080);
    }

    void reportAfter(quint32 number, const std::array<double, 3>& place = here)
    {
        table.note(place, arrivalOf(number) + 10ms);
        hold.tableReported();
    }

    int grey() const { return qGray(held.back().image.pixel(5, 5)); }

    CineRing ring;
    TableRest table;
    ImageHold hold{ring, table};
    std::vector<DisplayPicture> held;
};

int greyOf(int stored) { return samples::linearGrey(stored, 2048, 4096); }

} // namespace

class TestImageHold : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void theMeanComesWithTheNextReport()
    {
        Stage stage(4);
        stage.showRun();
        stage.hold.endRun();
        QCOMPARE(stage.held.size(), std::size_t(1)); // at once, as it was shown
        QCOMPARE(stage.held.back().meanOf, 1);
        stage.reportAfter(4);
        QTRY_COMPARE(stage.held.size(), std::size_t(2));
        QCOMPARE(stage.held.back().meanOf, 4);
        QCOMPARE(stage.held.back().role, PictureRole::Hold);
        QCOMPARE(stage.held.back().about.frame, 4U);
        QCOMPARE(stage.grey(), greyOf(1020));
        QVERIFY(greyOf(1020) != greyOf(1080));
    }

    void anEndThatIsSaidTwiceIsOne()
    {
        Stage stage(1);
        stage.showRun();
        stage.hold.endRun();
        stage.hold.endRun();
        QCOMPARE(stage.held.size(), std::size_t(1));
        stage.show(5, 1000, 2);
        stage.hold.endRun();
        QCOMPARE(stage.held.size(), std::size_t(2));
        QCOMPARE(stage.held.back().about.acquisition, 2U);
    }

    void itSaysHowManyThereReallyWere()
    {
        Stage stage(8);
        stage.showRun();
        stage.hold.endRun();
        stage.reportAfter(4);
        QTRY_COMPARE(stage.held.back().meanOf, 4);
    }

    /// The third is the clock: when its mean is there, the others would have theirs.
    void theLastPictureStaysWhereNoMeanIsWantedOrPossible()
    {
        Stage last(1);
        Stage moved(4);
        Stage wanted(4);
        for (Stage* stage : {&last, &moved, &wanted}) {
            stage->showRun();
            stage->hold.endRun();
        }
        last.reportAfter(4);
        moved.reportAfter(3);
        moved.reportAfter(4, elsewhere); // perhaps already while the last one was taken
        wanted.reportAfter(4);
        QTRY_COMPARE(wanted.held.size(), std::size_t(2));
        QCOMPARE(last.held.size(), std::size_t(1));
        QCOMPARE(moved.held.size(), std::size_t(1));
        QCOMPARE(moved.held.back().meanOf, 1);
    }

    void itGoesNotAcrossATableThatMoved()
    {
        Stage stage(4);
        stage.show(1, 1000);
        stage.show(2, 1000);
        stage.reportAfter(2, elsewhere);
        stage.show(3, 1010);
        stage.show(4, 1050);
        stage.hold.endRun();
        stage.reportAfter(4, elsewhere);
        QTRY_COMPARE(stage.held.back().meanOf, 2);
        QCOMPARE(stage.grey(), greyOf(1030));
    }

    void aPictureThatWasStillOnItsWayGoesIn()
    {
        Stage stage(4);
        stage.showRun();
        stage.hold.endRun();
        stage.reportAfter(4);
        QTRY_COMPARE(stage.held.back().meanOf, 4);
        stage.show(5, 1080);
        QCOMPARE(stage.held.back().about.frame, 5U);
        QCOMPARE(stage.held.back().meanOf, 1);
        stage.reportAfter(5);
        QTRY_COMPARE(stage.held.back().meanOf, 4);
        QCOMPARE(stage.held.back().about.frame, 5U);
        QCOMPARE(stage.grey(), greyOf(1040));
    }

    void itWaitsForTheRing()
    {
        Stage stage(2);
        stage.show(1, 1000);
        const auto last = Stage::frameOf(2, 1040);
        stage.take(*last);
        stage.hold.endRun();
        stage.reportAfter(2);
        stage.ring.add(*last);
        stage.reportAfter(3);
        QTRY_COMPARE(stage.held.back().meanOf, 2);
        QCOMPARE(stage.grey(), greyOf(1020));
    }

    void theNextRunDoesNotTakeItAway()
    {
        Stage stage(4);
        stage.showRun();
        stage.show(5, 1000, 2); // the pedal came down again at once
        QCOMPARE(stage.held.size(), std::size_t(1));
        stage.reportAfter(5);
        QTRY_COMPARE(stage.held.back().meanOf, 4);
        QCOMPARE(stage.held.back().about.acquisition, 1U);
        QCOMPARE(stage.grey(), greyOf(1020));
    }

    void settingsComeToItAsToOtherPicturesAndTheFilterDoesNot()
    {
        Stage stage(4);
        DisplaySettings settings;
        settings.noiseReduction = 60;
        stage.hold.setSettings(settings);
        stage.showRun();
        stage.hold.endRun();
        stage.reportAfter(4);
        QTRY_COMPARE(stage.held.back().meanOf, 4);
        QCOMPARE(stage.held.back().settings.noiseReduction, 0);
        QCOMPARE(stage.held.back().treatment.k, 1.0);
        settings.inverted = true;
        stage.take(*Stage::frameOf(4, 1080)); // the live picture once more, with them
        stage.hold.setSettings(settings);
        QTRY_VERIFY(stage.held.back().settings.inverted);
        QCOMPARE(stage.held.back().meanOf, 4);
        QCOMPARE(stage.grey(), 255 - greyOf(1020));
        for (std::size_t i = 1; i < stage.held.size(); ++i)
            QCOMPARE(stage.held[i].meanOf, 4);
    }

    void itSaysOfHowManyItIs()
    {
        const QString words = QStringLiteral("LAST IMAGE HOLD \u00B7 MEAN OF 4");
        DisplayPicture picture;
        picture.about = *samples::frame(1, samples::chainSize, 12, PixelEncoding::Raw);
        picture.role = PictureRole::Hold;
        picture.image = QImage(samples::chainSize, QImage::Format_RGB32);
        picture.image.fill(qRgb(100, 100, 100));
        ReferenceImageView view;
        view.resize(600, 500);
        view.showPicture(picture);
        view.grab();
        const QRegion last = view.overlayRegion();
        QCOMPARE(roleWords(picture), QStringLiteral("LAST IMAGE HOLD"));
        QVERIFY(!view.accessibleDescription().contains(QStringLiteral("MEAN")));
        QVERIFY(!exportWords({picture}).contains(QStringLiteral("MEAN")));
        picture.meanOf = 4;
        view.showPicture(picture);
        view.grab();
        QVERIFY(!(view.overlayRegion() - last).isEmpty()); // painted with the picture
        QCOMPARE(roleWords(picture), words);
        QVERIFY2(view.accessibleDescription().startsWith(words), qPrintable(view.accessibleDescription()));
        QVERIFY2(exportWords({picture}).startsWith(words), qPrintable(exportWords({picture})));
    }

    void itIsNeverTheLivePicture()
    {
        Stage stage(4);
        stage.showRun();
        stage.hold.endRun();
        stage.reportAfter(4);
        QTRY_COMPARE(stage.held.back().meanOf, 4);
        PictureState state;
        LiveImageView live(state);
        live.showPicture(stage.held.back());
        live.grab();
        QVERIFY(!live.picture());
        QCOMPARE(state.paintedCount(), quint64(0));
        PictureStamp stamp;
        stamp.role = stage.held.back().role;
        state.notePainted(stamp);
        QCOMPARE(state.paintedCount(), quint64(0));
    }
};

QTEST_MAIN(TestImageHold)
#include "test_image_hold.moc"
