// What the status strip says of the X-ray beam: on, off, or unknown. A report that is old says nothing of now.
#include "cockpit_stage.hpp"
#include "shown_texts.hpp"
#include "widgets/status_strip.hpp"

using namespace console;
using namespace console::test;
namespace colour = console::theme::colour;

namespace {

const XrayMark* markOf(const CockpitStage& stage) { return stage.window.findChild<XrayMark*>(); }

/// The X-ray system tells it at that time.
void report(CockpitStage& stage, bool beamOn, Instant at)
{
    AcquisitionStatus status = stage.cockpit.models.xray.status().value;
    status.beamOn = beamOn;
    stage.cockpit.models.xray.receive(status, at);
}

QString painted(QWidget& widget)
{
    QString all;
    for (const ShownText& shown : textsPaintedBy(widget))
        all += shown.text;
    return all;
}

int pixelsOf(const QImage& picture, const QColor& wanted)
{
    int count = 0;
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x)
            count += picture.pixelColor(x, y).rgb() == wanted.rgb() ? 1 : 0;
    return count;
}

} // namespace

class TestXrayMark : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase() { theme::apply(*qApp); }

    void isUnknownBeforeTheFirstReport()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.refresh();
        QCOMPARE(markOf(stage)->accessibleName(), QStringLiteral("X-ray beam"));
        QCOMPARE(markOf(stage)->accessibleDescription(), QStringLiteral("X-ray unknown"));
    }

    void saysWhatTheNewestReportSaysForAsLongAsItIsFresh_data()
    {
        QTest::addColumn<bool>("on");
        QTest::addColumn<int>("ageMs");
        QTest::addColumn<QString>("words");
        QTest::newRow("on") << true << 10 << QStringLiteral("X-RAY ON");
        QTest::newRow("on, as old as may be") << true << 500 << QStringLiteral("X-RAY ON");
        QTest::newRow("on, stale") << true << 501 << QStringLiteral("X-ray unknown");
        QTest::newRow("off") << false << 10 << QStringLiteral("X-ray off");
        QTest::newRow("off, as old as may be") << false << 500 << QStringLiteral("X-ray off");
        QTest::newRow("off, stale") << false << 501 << QStringLiteral("X-ray unknown");
    }

    void saysWhatTheNewestReportSaysForAsLongAsItIsFresh()
    {
        QFETCH(bool, on);
        QFETCH(int, ageMs);
        QFETCH(QString, words);
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        report(stage, on, stage.cockpit.now);
        stage.window.refresh(stage.cockpit.now + std::chrono::milliseconds(ageMs));
        QCOMPARE(markOf(stage)->accessibleDescription(), words);
    }

    void followsTheBeam()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        Instant at = stage.cockpit.now;
        for (const bool on : {true, false, true}) {
            at += std::chrono::milliseconds(100);
            report(stage, on, at);
            stage.window.refresh(at);
            QCOMPARE(markOf(stage)->accessibleDescription(), on ? QStringLiteral("X-RAY ON") : QStringLiteral("X-ray off"));
        }
    }

    void isUnknownWhileItsLinkTellsNothing_data()
    {
        QTest::addColumn<LinkState>("state");
        QTest::newRow("interrupted") << LinkState::Reconnecting;
        QTest::newRow("stand-by") << LinkState::StandBy;
        QTest::newRow("closed") << LinkState::Closed;
    }

    /// The last report grows old; neither on nor off stands there before the next one.
    void isUnknownWhileItsLinkTellsNothing()
    {
        QFETCH(LinkState, state);
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        report(stage, true, stage.cockpit.now);
        stage.window.refresh(stage.cockpit.now);
        QCOMPARE(markOf(stage)->accessibleDescription(), QStringLiteral("X-RAY ON"));
        stage.cockpit.models.sessions.setLinkState(xrayId, state, stage.cockpit.now);
        const Instant later = stage.cockpit.now + XraySystemState::statusLimit + std::chrono::milliseconds(1);
        stage.window.refresh(later);
        QCOMPARE(markOf(stage)->accessibleDescription(), QStringLiteral("X-ray unknown"));
        stage.cockpit.models.sessions.setLinkState(xrayId, LinkState::Open, later);
        report(stage, false, later);
        stage.window.refresh(later);
        QCOMPARE(markOf(stage)->accessibleDescription(), QStringLiteral("X-ray off"));
    }

    /// The beam's colour is there while it is on, and then only.
    void onlyABeamThatIsOnHasItsColour()
    {
        XrayMark mark;
        mark.resize(mark.sizeHint());
        const auto looksAs = [&mark](Beam beam) {
            mark.setBeam(beam);
            return mark.grab().toImage();
        };
        const QImage on = looksAs(Beam::On);
        QVERIFY2(pixelsOf(on, colour::xray) > on.width() * on.height() / 4, qPrintable(QString::number(pixelsOf(on, colour::xray))));
        QCOMPARE(painted(mark), QStringLiteral("X-RAY ON"));
        const QImage off = looksAs(Beam::Off);
        QCOMPARE(pixelsOf(off, colour::xray), 0);
        QCOMPARE(painted(mark), QStringLiteral("X-ray off"));
        const QImage unknown = looksAs(Beam::Unknown);
        QCOMPARE(pixelsOf(unknown, colour::xray), 0);
        QCOMPARE(painted(mark), QStringLiteral("X-ray unknown"));
        QVERIFY(off != unknown);
    }
};

QTEST_MAIN(TestXrayMark)
#include "test_xray_mark.moc"
