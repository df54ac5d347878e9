// Tests of the waterfall: its stages can be told apart, and where the limit lies is said.
#include "widgets/theme.hpp"
#include "widgets/waterfall.hpp"

#include <QTest>

using namespace console;
using namespace std::chrono_literals;
namespace colour = console::theme::colour;

namespace {

const Instant start = Instant{} + 1h;

PictureStages usualStages()
{
    PictureStages stages;
    for (int i = 0; i < 50; ++i) {
        stages.note({21ms, 37ms, 7ms, 6ms, 5ms, 2ms, 11ms}, start + i * 66ms);
        stages.notePresented(4ms);
    }
    return stages;
}

// The longest stretch of the bars' colour in any row of the picture.
int longestBar(const QImage& image)
{
    int longest = 0;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0, run = 0; x < image.width(); ++x) {
            run = image.pixel(x, y) == colour::plot.rgb() ? run + 1 : 0;
            longest = std::max(longest, run);
        }
    return longest;
}

} // namespace

class TestWaterfall : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase() { theme::apply(*qApp); }

    void namesEachStageAndWhatComesOnTop()
    {
        Waterfall waterfall;
        waterfall.refresh(usualStages(), 250, start + 4s);
        const QString words = waterfall.accessibleDescription().replace(QChar::Nbsp, QLatin1Char(' '));
        for (const char* stage : {"before sending: median 21.0 ms", "way to here: median 37.0 ms", "filter's delay: median 11.0 ms",
                                  "age at the paint: median 89.0 ms", "to the screen: median 4.0 ms"})
            QVERIFY2(words.contains(QString::fromLatin1(stage)), qPrintable(words));
    }

    // An age of 89 ms, of which a limit of 250 ms would leave a third of the room.
    void usesTheRoomForWhatWasMeasured()
    {
        Waterfall waterfall;
        waterfall.resize(800, 300);
        waterfall.refresh(usualStages(), 250, start + 4s);
        const int bar = longestBar(waterfall.grab().toImage());
        QVERIFY2(bar > 800 * 35 / 100, qPrintable(QString::number(bar)));
    }

    // A quarter of the limit is not drawn as if it were near it.
    void aSmallAgeLooksSmall()
    {
        PictureStages stages;
        stages.note({5ms, 5ms, 2ms, 2ms, 1ms, 1ms, 4ms}, start);
        Waterfall waterfall;
        waterfall.resize(800, 300);
        waterfall.refresh(stages, 250, start);
        const int bar = longestBar(waterfall.grab().toImage());
        QVERIFY2(bar > 10 && bar < 800 / 5, qPrintable(QString::number(bar)));
    }
};

QTEST_MAIN(TestWaterfall)
#include "test_waterfall.moc"
