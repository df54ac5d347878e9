// Tests of the display settings in the assembled panes: each pane follows them, and the temporal filter takes what the age limit leaves.
#include "picture_desk_stage.hpp"
#include "widgets/theme.hpp"

#include <algorithm>

using namespace console;
using namespace std::chrono_literals;

using Desk = console::test::PictureDeskStage;

namespace {

constexpr auto period = 66ms; ///< of the sample frames
constexpr int enough = 40;    ///< pictures until the filter is as strong as it becomes

/// The sample picture as the pane paints it, along its middle, where no words stand.
bool growsBrighter(PictureCanvas& pane)
{
    const QImage shown = pane.grab().toImage();
    const QRect area = pane.pictureRect();
    const auto grey = [&](double share) { return qGray(shown.pixel(area.left() + int(share * area.width()), area.center().y())); };
    return grey(0.25) < grey(0.75);
}

/// Pictures that are so old when they come, each painted in the moment of its arrival, under the strongest filter.
struct AgedPictures {
    explicit AgedPictures(Duration atArrival) : age(atArrival)
    {
        desk.live->setClock([this] { return desk.live->picture() ? desk.live->picture()->about.arrival : Instant(); });
        DisplaySettings settings;
        settings.noiseReduction = 100;
        desk.desk.display().set(settings);
    }

    bool send()
    {
        const auto frame = samples::frame(++number, Desk::frameSize, 12, PixelEncoding::Raw);
        frame->ageAtArrival = age;
        return desk.send(frame);
    }

    bool sendEnough()
    {
        for (int i = 0; i < enough; ++i)
            if (!send())
                return false;
        return true;
    }

    PictureTreatment treatment() const { return desk.live->picture()->treatment; }

    /// For its delay: the picture stands for a period, and must not be too old at the end of it.
    Duration filterRoom() const
    {
        return std::max(desk.models.picture.limit() - PictureState::filterMargin - age - period, Duration::zero());
    }

    /// Of what moves in the newest picture, when it is painted.
    Duration shownAge() const { return desk.models.picture.reading(desk.live->picture()->about.arrival).age.value_or(Duration::max()); }

    const Duration age;
    quint32 number = 0;
    Desk desk;
};

} // namespace

class TestPictureSettings : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase() { theme::apply(*qApp); }

    void theLivePictureFollowsTheSettings()
    {
        Desk desk;
        QVERIFY(desk.send(1));
        QVERIFY(growsBrighter(*desk.live));
        desk.click(QStringLiteral("Invert"));
        QTRY_VERIFY(!growsBrighter(*desk.live));
        desk.click(QStringLiteral("Invert"));
        QTRY_VERIFY(growsBrighter(*desk.live));
    }

    void theReviewedPictureFollowsTheSettings()
    {
        Desk desk;
        QVERIFY(desk.send(1));
        QVERIFY(desk.send(2));
        desk.click(QStringLiteral("Review"));
        QTRY_VERIFY(desk.reference->picture());
        QVERIFY(growsBrighter(*desk.reference));
        desk.click(QStringLiteral("Invert"));
        QTRY_VERIFY(!growsBrighter(*desk.reference));
        QCOMPARE(desk.reference->picture()->role, PictureRole::Review);
    }

    /// A single picture that is held is the live one once more; a mean comes by a way of its own.
    void theMeanThatIsHeldFollowsTheSettings()
    {
        Desk desk;
        QVERIFY(desk.holdMeanOfThree());
        QVERIFY(growsBrighter(*desk.reference));
        desk.click(QStringLiteral("Invert"));
        QTRY_VERIFY(!growsBrighter(*desk.reference));
        QCOMPARE(desk.reference->picture()->role, PictureRole::Hold);
        QCOMPARE(desk.reference->picture()->meanOf, 3);
    }

    void theFilterTakesWhatTheAgeLimitLeaves_data()
    {
        QTest::addColumn<int>("age");
        QTest::addColumn<bool>("acts");
        QTest::newRow("young pictures") << 20 << true;
        QTest::newRow("old pictures") << 120 << true;
        QTest::newRow("pictures next to the limit") << 240 << false;
    }

    void theFilterTakesWhatTheAgeLimitLeaves()
    {
        QFETCH(int, age);
        QFETCH(bool, acts);
        AgedPictures pictures{std::chrono::milliseconds(age)};
        for (int i = 0; i < enough; ++i) {
            QVERIFY(pictures.send());
            QVERIFY2(pictures.shownAge() <= pictures.desk.models.picture.limit(),
                     qPrintable(QStringLiteral("AGE %1 ms").arg(milliseconds(pictures.shownAge()))));
        }
        const PictureTreatment treatment = pictures.treatment();
        QCOMPARE(treatment.k < 1, acts);
        const Duration room = pictures.filterRoom();
        QCOMPARE(room > Duration::zero(), acts);
        QVERIFY2(treatment.filterDelay <= room + 1us && treatment.filterDelay + 1ms >= room,
                 qPrintable(QStringLiteral("%1 ms of %2 ms").arg(milliseconds(treatment.filterDelay)).arg(milliseconds(room))));
    }

    /// Not only from the picture after it on, for which the next one that is painted makes room.
    void aLowerAgeLimitCountsFromTheNextPictureOn()
    {
        AgedPictures pictures{120ms};
        PictureState& state = pictures.desk.models.picture;
        state.setProfile(PictureProfile::Coronary);
        QVERIFY(pictures.sendEnough());
        state.setProfile(PictureProfile::Neuro);
        QVERIFY(pictures.shownAge() > state.limit()); // as the next one would be
        QVERIFY(pictures.send());
        QVERIFY2(pictures.shownAge() <= state.limit(), qPrintable(QStringLiteral("AGE %1 ms").arg(milliseconds(pictures.shownAge()))));
        QVERIFY(pictures.treatment().filterDelay <= pictures.filterRoom() + 1us);
    }
};

QTEST_MAIN(TestPictureSettings)
#include "test_picture_settings.moc"
