// Tests of the display shutter: what is outside is black, what is inside is untouched, and AUTO looks inside only.
#include "imaging/shutter.hpp"
#include "imaging/window_level.hpp"

#include <QtTest>

using namespace console;

class TestShutter : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void hidesNothingWhenOpen();
    void isRound();
    void leavesMarginOnFourSides();
    void keepsAutoWindowInside();
};

namespace {

QImage grey(QSize size)
{
    QImage image(size, QImage::Format_RGB32);
    image.fill(qRgb(99, 99, 99));
    return image;
}

} // namespace

void TestShutter::hidesNothingWhenOpen()
{
    QImage image = grey({30, 20});
    applyShutter(image, Shutter(ShutterShape::None, image.size()));
    QCOMPARE(image, grey({30, 20}));
}

void TestShutter::isRound()
{
    for (const QSize size : {QSize(100, 80), QSize(81, 97)}) {
        QImage image = grey(size);
        applyShutter(image, Shutter(ShutterShape::Circle, size));
        const double radius = std::min(size.width(), size.height()) / 2.0;
        int wrong = 0;
        for (int y = 0; y < size.height(); ++y)
            for (int x = 0; x < size.width(); ++x) {
                const double distance = std::hypot(x + 0.5 - size.width() / 2.0, y + 0.5 - size.height() / 2.0);
                if (std::abs(distance - radius) > 1e-6)
                    wrong += (qGray(image.pixel(x, y)) == 99) != (distance < radius) ? 1 : 0;
            }
        QCOMPARE(wrong, 0);
    }
}

void TestShutter::leavesMarginOnFourSides()
{
    QImage image = grey({100, 200});
    applyShutter(image, Shutter(ShutterShape::Rectangle, image.size()));
    QCOMPARE(qGray(image.pixel(4, 100)), 0);
    QCOMPARE(qGray(image.pixel(5, 100)), 99);
    QCOMPARE(qGray(image.pixel(94, 100)), 99);
    QCOMPARE(qGray(image.pixel(95, 100)), 0);
    QCOMPARE(qGray(image.pixel(50, 9)), 0);
    QCOMPARE(qGray(image.pixel(50, 10)), 99);
    QCOMPARE(qGray(image.pixel(50, 190)), 0);
}

void TestShutter::keepsAutoWindowInside()
{
    // Dark tissue inside, a collimator's blaze outside.
    cv::Mat stored(100, 100, CV_16UC1, cv::Scalar(60000));
    const Shutter round(ShutterShape::Circle, {100, 100});
    for (int y = 0; y < 100; ++y) {
        const Shutter::Opening opening = round.opening(y);
        for (int x = opening.first; x < opening.end; ++x)
            stored.at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(1000 + 3 * x);
    }
    QVERIFY(percentileWindow(stored).width > 50000);
    const GreyWindow inside = percentileWindow(stored, round);
    QVERIFY(inside.width < 400);
    QVERIFY(std::abs(inside.centre - 1150) < 60);
}

QTEST_APPLESS_MAIN(TestShutter)
#include "test_shutter.moc"
