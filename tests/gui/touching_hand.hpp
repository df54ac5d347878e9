// Fingers on a touch screen, as Qt hears of them.
#pragma once

#include <QPointingDevice>
#include <QTest>
#include <QWidget>

namespace console::test {

inline QPointingDevice* touchScreen()
{
    static QPointingDevice* device = QTest::createTouchDevice();
    return device;
}

/// Two fingers on a window, by where they are on the widgets in it.
struct Hand {
    QWidget& window;
    QPoint first = {};

    QPoint at(const QWidget& widget, QPoint place) const { return widget.mapTo(&window, place); }
    QPoint middle(const QWidget& widget) const { return at(widget, widget.rect().center()); }

    void press(QPoint place) { QTest::touchEvent(&window, touchScreen()).press(0, first = place, &window); }
    void move(QPoint place) { QTest::touchEvent(&window, touchScreen()).move(0, first = place, &window); }
    void release(QPoint place) const { QTest::touchEvent(&window, touchScreen()).release(0, place, &window); }

    // Of the second one, while the first stays where it is.
    void pressAnother(QPoint place) const { QTest::touchEvent(&window, touchScreen()).move(0, first, &window).press(1, place, &window); }
    void moveAnother(QPoint place) const { QTest::touchEvent(&window, touchScreen()).move(0, first, &window).move(1, place, &window); }
    void releaseAnother(QPoint place) const
    {
        QTest::touchEvent(&window, touchScreen()).move(0, first, &window).release(1, place, &window);
    }

    void touch(QPoint place)
    {
        press(place);
        release(place);
    }

    /// Down where it is positive.
    void drag(QPoint from, int by)
    {
        constexpr int steps = 10;
        press(from);
        for (int step = 1; step <= steps; ++step)
            move(from + QPoint(0, by * step / steps));
        release(from + QPoint(0, by));
    }
};

} // namespace console::test
