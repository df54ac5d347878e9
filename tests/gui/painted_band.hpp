// The alarm band by itself, as it is painted.
#pragma once

#include "widgets/alarm_band.hpp"
#include "widgets/flash_clock.hpp"
#include "widgets/theme.hpp"

#include <QDateTime>
#include <QImage>

#include <algorithm>
#include <map>

namespace console::test {

inline constexpr int wide = 2560;
inline constexpr int tall = 56;
inline const QRect alarmText(240, 0, 700, tall);

inline Alarm alarm(AlarmPriority priority, bool acknowledged)
{
    Alarm one;
    one.id = 1;
    one.priority = priority;
    one.acknowledged = acknowledged;
    one.text = QStringLiteral("Vascular robot: link lost, stand-by");
    one.remedy = QStringLiteral("Read the prompt.");
    return one;
}

/// It was there, latched, and nobody has seen it.
inline Alarm ended(AlarmPriority priority)
{
    Alarm one = alarm(priority, false);
    one.latching = true;
    one.present = false;
    one.endedWallMs = QDateTime(QDate::currentDate(), QTime(6, 20, 56)).toMSecsSinceEpoch();
    return one;
}

struct Band {
    AlarmBand band;

    explicit Band(AlarmPriority priority, bool acknowledged = false)
    {
        band.resize(wide, tall);
        band.setAlarms({alarm(priority, acknowledged)});
        band.show();
    }

    QImage at(Duration phase, const QRect& where = QRect(0, 0, wide, tall))
    {
        band.flashClock().drive(phase);
        QImage image(where.size(), QImage::Format_RGB32);
        band.render(&image, QPoint(), QRegion(where), QWidget::DrawWindowBackground);
        return image;
    }
};

/// Of the commonest colour of a text's room and the one that stands out most from it.
inline double paintedContrast(const QImage& image)
{
    std::map<QRgb, int> seen;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            ++seen[image.pixel(x, y)];
    const auto surface = std::max_element(seen.begin(), seen.end(), [](auto& a, auto& b) { return a.second < b.second; })->first;
    double most = 1;
    for (const auto& [colour, count] : seen)
        if (count >= 20) // strokes, not their blurred edges
            most = std::max(most, theme::contrast(QColor(colour), QColor(surface)));
    return most;
}

} // namespace console::test
