// The permit's word and line as they are painted: what of the block is theirs.
#include "cockpit_stage.hpp"
#include "widgets/permit_block.hpp"

#include <QImage>

using namespace console;
using namespace console::test;
using namespace std::chrono_literals;

namespace {

// Of the inner frame, in pixels from the block's edge.
constexpr int frame = 7;   ///< its middle
constexpr int within = 9;  ///< the first that is not its own
constexpr int corner = 14; ///< from here on it is straight

/// Where along the line that is `depth` px within the four edges another colour is; nothing when there is none.
QString strangeAt(const QImage& image, int depth, const QColor& own)
{
    const int right = image.width() - 1 - depth;
    const int bottom = image.height() - 1 - depth;
    QStringList strange;
    const auto look = [&](int x, int y) {
        if (image.pixelColor(x, y) != own)
            strange << QStringLiteral("%1,%2 %3").arg(x).arg(y).arg(image.pixelColor(x, y).name());
    };
    for (int x = corner; x < image.width() - corner; ++x)
        look(x, depth), look(x, bottom);
    for (int y = corner; y < image.height() - corner; ++y)
        look(depth, y), look(right, y);
    return strange.mid(0, 8).join(QLatin1String("; "));
}

} // namespace

class TestPermitBlock : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase() { theme::apply(*qApp); }

    void whatHoldSaysStaysWithinItsInnerFrame_data()
    {
        QTest::addColumn<QSize>("screen");
        QTest::addColumn<bool>("longer");
        for (const QSize& screen : {QSize(2560, 1440), QSize(1920, 1080)})
            for (const bool longer : {false, true})
                QTest::addRow("%s lines at %d", longer ? "three" : "two", screen.height()) << screen << longer;
    }

    void whatHoldSaysStaysWithinItsInnerFrame()
    {
        QFETCH(QSize, screen);
        QFETCH(bool, longer);
        CockpitStage stage(screen);
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        stage.cockpit.arm();
        stage.cockpit.engage();
        auto readings = stage.cockpit.goodReadings();
        readings.robotState = RobotState::Engaged;
        if (longer) {
            readings.usualRoundTrip = 62ms;
        } else {
            readings.picture.atRate = readings.picture.keepsRate = false;
            readings.picture.shownPerSecond = 10;
            readings.picture.liveFor = 0ms;
        }
        auto& permit = stage.cockpit.models.permit;
        permit.keep(readings, stage.cockpit.now);
        QCOMPARE(permit.phase(), PermitPhase::Hold);
        stage.refresh();
        auto* block = stage.window.findChild<PermitBlock*>();
        const QString line = PermitBlock::explanation(permit, stage.cockpit.now);
        const QFontMetrics caption(theme::font(theme::TextRole::Caption, theme::scaleOf(block)));
        QVERIFY2(caption.horizontalAdvance(line) > (longer ? 2 : 1) * block->width(), qPrintable(line));
        const QImage image = block->grab().toImage();
        QCOMPARE(strangeAt(image, frame, theme::colour::bright), QString());
        QCOMPARE(strangeAt(image, within, theme::colour::panel), QString());
    }
};

QTEST_MAIN(TestPermitBlock)
#include "test_permit_block.moc"
