// The age that the console tells, beside the age of what stands on its screen: each picture bears its number in its pixels.
#include "imaging/live_image_view.hpp"
#include "puppet_theatre.hpp"
#include "widgets/theme.hpp"

#include <QApplication>
#include <QTest>

#include <algorithm>
#include <cmath>

using namespace console;
using console::test::PuppetTheatre;
using console::test::Theatre;
using liena::test::PuppetXray;

namespace {

constexpr int patience = Theatre::patience;
constexpr std::size_t looks = 31;

/// The number that the pixels of the live picture bear.
std::uint32_t readStrip(LiveImageView& view)
{
    using Strip = PuppetXray::StampStrip;
    const QImage shown = view.grab().toImage();
    const QRect area = view.pictureRect();
    std::uint32_t number = 0;
    for (int bit = 0; bit < Strip::bits; ++bit) {
        const double x = area.left() + (bit + 0.5) * Strip::barWidth * area.width();
        const double y = area.top() + Strip::middle * area.height();
        number |= (qGray(shown.pixel(int(x), int(y))) > 127 ? 1U : 0U) << unsigned(bit);
    }
    return number;
}

struct Look {
    double told = 0; ///< ms
    double real = 0;
};

} // namespace

class PictureAgeTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase() { theme::apply(*qobject_cast<QApplication*>(QCoreApplication::instance())); }

    void theAgeThatIsToldIsThatOfThePixels()
    {
        PuppetTheatre stage;
        stage.xray.show(PuppetXray::Pictures::Stamped);
        QVERIFY(stage.theatre.openAll());
        auto* view = stage.theatre.window().findChild<LiveImageView*>();
        QVERIFY(view != nullptr);
        std::vector<Look> found;
        QObject::connect(view, &LiveImageView::picturePainted, view, [&](quint32 frame, std::optional<double> age) {
            const auto taken = stage.xray.takenAt(frame);
            if (age && taken)
                found.push_back({*age, milliseconds(std::chrono::steady_clock::now() - *taken)});
        });
        stage.theatre.hold(Qt::Key_F);
        for (std::size_t look = 1; look <= looks; ++look) {
            QTRY_VERIFY2_WITH_TIMEOUT(found.size() >= look, qPrintable(stage.theatre.story()), patience);
            const auto onScreen = readStrip(*view); // which paints what came meanwhile
            const quint32 told = view->picture()->about.frame;
            QCOMPARE(onScreen, told & ((1U << PuppetXray::StampStrip::bits) - 1));
        }
        stage.theatre.releaseAll();

        // One clock made both figures. What this process was kept from running between the two is no fault of the console's: the median.
        const auto* link = stage.theatre.models().sessions.linkTo(stage.theatre.files.idOf("xray").value());
        QVERIFY(link != nullptr && link->figures.clockOffset);
        std::vector<double> errors;
        for (const Look& look : found)
            errors.push_back(std::abs(look.told - look.real));
        std::nth_element(errors.begin(), errors.begin() + std::ptrdiff_t(errors.size() / 2), errors.end());
        const double median = errors[errors.size() / 2];
        const double allowed = milliseconds(link->figures.clockUncertainty) + 1;
        qInfo("told and real differ by %.3f ms (median of %zu), clocks compared to within %.3f ms", median, errors.size(), allowed - 1);
        QVERIFY2(median <= allowed, qPrintable(QStringLiteral("%1 ms, %2 ms allowed").arg(median).arg(allowed)));
    }
};

QTEST_MAIN(PictureAgeTest)
#include "picture_age_test.moc"
