// Lengths above the table as a person chooses them: set up in the preferences, chosen in the picture, said on it and in what is saved.
#include "app/picture_desk.hpp"
#include "app/preference_desk.hpp"
#include "cockpit_stage.hpp"
#include "imaging/live_image_view.hpp"
#include "sample_frames.hpp"
#include "shown_texts.hpp"
#include "touching_hand.hpp"
#include "widgets/preferences_view.hpp"
#include "widgets/sheet_button.hpp"
#include "widgets/small_button.hpp"

#include <QDir>
#include <QLabel>
#include <QLineEdit>
#include <QTemporaryDir>

using namespace console;
using namespace console::test;

namespace {

struct Stage : CockpitStage {
    QTemporaryDir folder;
    Options options;
    PictureDesk pictures;
    PreferenceDesk desk;
    LiveImageView* live = nullptr;
    PreferencesView* view = nullptr;

    Stage() : options(at(folder)), pictures(options, cockpit.models), desk(options, cockpit.models, pictures)
    {
        pictures.build(window);
        desk.build(window);
        live = window.findChild<LiveImageView*>();
        view = window.findChild<PreferencesView*>();
    }

    static Options at(const QTemporaryDir& folder)
    {
        Options options;
        options.preferences = folder.filePath(QStringLiteral("preferences.ini"));
        options.pictures = folder.filePath(QStringLiteral("saved"));
        return options;
    }

    template <typename Widget>
    Widget* part(const QString& name) const
    {
        for (Widget* candidate : window.findChildren<Widget*>())
            if (candidate->accessibleName() == name)
                return candidate;
        return nullptr;
    }

    void setTableTop(const QString& text)
    {
        window.showView(View::Preferences);
        auto* line = part<QLineEdit>(QStringLiteral("Table top"));
        QVERIFY(line != nullptr);
        line->setFocus();
        line->selectAll();
        QTest::keyClicks(line, text);
        QTest::keyClick(line, Qt::Key_Return);
    }

    bool says(const QString& words) const
    {
        for (const QLabel* label : view->findChildren<QLabel*>())
            if (label->text().contains(words))
                return true;
        return false;
    }

    Instant report(double height)
    {
        AcquisitionStatus status;
        status.geometry.table = {0, 0, height};
        const auto now = std::chrono::steady_clock::now();
        cockpit.models.xray.receive(status, now);
        return now;
    }

    /// A report of the table, and behind it a picture that was taken when it came.
    bool send(quint32 number, double height, double primaryAngle = 0)
    {
        const Instant now = report(height);
        const auto frame = samples::frame(number, {256, 256}, 12, PixelEncoding::Raw);
        frame->geometry.primaryAngle = primaryAngle;
        frame->arrival = now + std::chrono::milliseconds(1);
        frame->ageAtArrival = Duration::zero();
        pictures.pipeline().showFrame(frame);
        return QTest::qWaitFor([&] { return live->picture() && live->picture()->about.frame == number; });
    }

    /// 100 pixels of the pane, by keys.
    void measure() const
    {
        live->clearMeasurement();
        QTest::keyClick(live, Qt::Key_5);
        for (int i = 0; i < 100; ++i)
            QTest::keyClick(live, Qt::Key_6);
        QTest::keyClick(live, Qt::Key_5);
    }

    /// The length stands on the screen with these words, and its number is that of the distance from the source, mm.
    bool isLength(const QString& words, double distance) const
    {
        const auto pixels = live->measurement().pixels();
        const QString text = live->measurement().text();
        if (!pixels || !text.endsWith(words))
            return false;
        const double millimetres = *pixels * 0.3 * distance / 1100;
        return std::abs(text.section(QLatin1Char(' '), 0, 0).toDouble() - millimetres) < 0.051 && painted().contains(words);
    }

    QString painted() const { return wordsPaintedBy(*live); }
};

} // namespace

class TestTableLengths : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase() { theme::apply(*qApp); }

    void thePlaneIsChosenInThePictureAndSaidThere()
    {
        Stage stage;
        QVERIFY(stage.ready());
        stage.setTableTop(QStringLiteral("170"));
        QCOMPARE(stage.desk.preferences().tableTop, std::optional(170));
        stage.window.showView(View::Cockpit);
        QVERIFY(stage.send(1, 20));
        QTest::keyClick(stage.live, Qt::Key_M);
        stage.measure();
        QVERIFY2(stage.isLength(QStringLiteral("mm @ isocentre plane (geometry)"), 750), qPrintable(stage.live->measurement().text()));
        QTest::keyClick(stage.live, Qt::Key_O);
        QCOMPARE(stage.live->told(), QStringLiteral("lengths by geometry: table plane + 10.0 cm"));
        QVERIFY2(stage.isLength(QStringLiteral("mm @ table plane + 10.0 cm (geometry)"), 700), qPrintable(stage.painted()));
        QTest::mouseClick(stage.live, Qt::RightButton, Qt::ShiftModifier, stage.live->rect().center());
        QVERIFY2(stage.isLength(QStringLiteral("mm @ table plane + 12.5 cm (geometry)"), 725), qPrintable(stage.painted()));
        for (int press = 0; press < 4; ++press)
            QTest::keyClick(stage.live, Qt::Key_O);
        QVERIFY2(stage.isLength(QStringLiteral("mm @ isocentre plane (geometry)"), 750), qPrintable(stage.painted()));
    }

    /// No key, and no second button of a mouse.
    void aFingerCalibratesAndChoosesThePlane()
    {
        Stage stage;
        QVERIFY(stage.ready());
        stage.setTableTop(QStringLiteral("170"));
        stage.window.showView(View::Cockpit);
        QVERIFY(stage.send(1, 20));
        Hand hand{stage.window};
        const auto press = [&](const char* name) {
            auto* button = stage.part<SmallButton>(QString::fromLatin1(name));
            QVERIFY2(button != nullptr && button->isVisible(), name);
            hand.touch(hand.at(*button, button->rect().center()));
        };
        press("Measure");
        press("Width of a catheter");
        QVERIFY2(stage.painted().contains(QStringLiteral("First set two points")), qPrintable(stage.painted()));
        const QPoint middle = stage.live->pictureRect().center();
        hand.touch(hand.at(*stage.live, middle));
        hand.touch(hand.at(*stage.live, middle + QPoint(100, 0)));
        QVERIFY2(stage.isLength(QStringLiteral("mm @ isocentre plane (geometry)"), 750), qPrintable(stage.painted()));
        press("Plane of lengths");
        QVERIFY2(stage.isLength(QStringLiteral("mm @ table plane + 10.0 cm (geometry)"), 700), qPrintable(stage.painted()));
        QCOMPARE(stage.live->told(), QStringLiteral("lengths by geometry: table plane + 10.0 cm"));
        press("Width of a catheter");
        QCOMPARE(stage.live->measurement().text(), QStringLiteral("1.3 mm (4 F catheter)"));
        press("Width of a catheter");
        QCOMPARE(stage.live->measurement().text(), QStringLiteral("1.7 mm (5 F catheter)"));
        QVERIFY(stage.painted().contains(QStringLiteral("F catheter)")));
    }

    void noLengthStandsForAPlaneThatIsNotKnown()
    {
        Stage stage;
        QVERIFY(stage.ready());
        QVERIFY(stage.send(1, 20));
        QTest::keyClick(stage.live, Qt::Key_M);
        stage.measure();
        QTest::keyClick(stage.live, Qt::Key_O);
        QVERIFY(stage.live->measurement().text().endsWith(QStringLiteral("px (uncalibrated: no table plane)")));
        QVERIFY(stage.painted().contains(QStringLiteral("the table's top is not set up in the preferences")));
        stage.setTableTop(QStringLiteral("170"));
        QVERIFY2(stage.isLength(QStringLiteral("mm @ table plane + 10.0 cm (geometry)"), 700), qPrintable(stage.painted()));
        QVERIFY(stage.send(2, 100));
        QVERIFY(stage.live->measurement().points().empty());
        stage.measure();
        QVERIFY2(stage.isLength(QStringLiteral("mm @ table plane + 10.0 cm (geometry)"), 780), qPrintable(stage.painted()));
        stage.report(110); // it may have been on its way when the picture was taken
        QVERIFY(stage.painted().contains(QStringLiteral("the table's height in this picture is unknown")));
        QVERIFY(stage.live->measurement().text().endsWith(QStringLiteral("px (uncalibrated: no table plane)")));
        QVERIFY(stage.send(3, 100, 75));
        QVERIFY(stage.live->measurement().points().empty());
        stage.measure();
        QVERIFY(stage.live->measurement().text().endsWith(QStringLiteral("px (uncalibrated: no table plane)")));
        QVERIFY(stage.painted().contains(QStringLiteral("from upright")));
    }

    void aSavedPictureSaysThePlane()
    {
        Stage stage;
        QVERIFY(stage.ready());
        stage.setTableTop(QStringLiteral("170"));
        QVERIFY(stage.send(1, 20));
        QTest::keyClick(stage.live, Qt::Key_M);
        stage.measure();
        QTest::keyClick(stage.live, Qt::Key_O);
        const QString text = stage.live->measurement().text();
        QVERIFY2(text.endsWith(QStringLiteral("mm @ table plane + 10.0 cm (geometry)")), qPrintable(text));
        auto* save = stage.part<SmallButton>(QStringLiteral("Save picture"));
        QVERIFY(save != nullptr);
        QTest::mouseClick(save, Qt::LeftButton);
        const QDir saved(stage.options.pictures);
        QTRY_COMPARE(saved.entryList({QStringLiteral("*_live_*.png")}, QDir::Files).size(), 1); // written after the DICOM file
        QFile file(saved.filePath(saved.entryList({QStringLiteral("*_live_*.dcm")}, QDir::Files).value(0)));
        QVERIFY(file.open(QIODevice::ReadOnly));
        QVERIFY(file.readAll().contains(text.toUtf8()));
    }

    void whatIsNoNumberIsNotTakenForOne()
    {
        Stage stage;
        QVERIFY(stage.ready());
        stage.setTableTop(QStringLiteral("-35"));
        for (const char* wrong : {"17,5", "1001", "high"}) {
            stage.setTableTop(QString::fromLatin1(wrong));
            QVERIFY2(stage.says(QStringLiteral("'%1' is no whole number").arg(QString::fromLatin1(wrong))), wrong);
            QCOMPARE(stage.desk.preferences().tableTop, std::optional(-35));
            QCOMPARE(stage.part<QLineEdit>(QStringLiteral("Table top"))->text(), QStringLiteral("-35"));
        }
        QTest::mouseClick(stage.part<SheetButton>(QStringLiteral("Restore the defaults of all entries")), Qt::LeftButton);
        QCOMPARE(stage.desk.preferences().tableTop, std::optional(-35)); // it belongs to the site
        auto* line = stage.part<QLineEdit>(QStringLiteral("Table top"));
        line->setFocus();
        line->selectAll();
        QTest::keyClick(line, Qt::Key_Delete);
        QTest::keyClick(line, Qt::Key_Return);
        QVERIFY(!stage.desk.preferences().tableTop);
    }

    void theUsualHeightIsAPreference()
    {
        Stage stage;
        QVERIFY(stage.ready());
        stage.window.showView(View::Preferences);
        auto* height = stage.part<SheetButton>(QStringLiteral("Object's height: 7.5 cm"));
        QVERIFY(height != nullptr);
        height->setFocus();
        QTest::keyClick(height, Qt::Key_Return);
        QVERIFY(!stage.pictures.display().plane().object); // the isocentre's stays the default
        stage.pictures.display().nextPlane();
        QCOMPARE(stage.pictures.display().plane().object, std::optional(75));
        QCOMPARE(PreferenceStore(stage.options.preferences).read().preferences.objectHeight, 75);
    }
};

QTEST_MAIN(TestTableLengths)
#include "test_table_lengths.moc"
