// What a person sets up for themselves, with its bounds. Nothing here makes motion larger, faster or stronger: that is no preference.
#pragma once

#include "model/alarm_list.hpp"
#include "model/display_settings.hpp"
#include "model/trend_book.hpp"

#include <QString>
#include <QStringList>

#include <array>
#include <chrono>
#include <optional>

namespace console {

enum class PermitPhase : std::uint8_t;

/// How bright the surroundings of the pictures are. The pictures themselves are the same in each.
enum class Brightness : std::uint8_t { Dim, Usual, Bright };
inline constexpr int brightnessCount = 3;
QString word(Brightness brightness);

/// Pictures per second while the X-ray pedal is down. A slower one would be late by the age limit's reckoning.
inline constexpr std::array<double, 3> pulseRates{7.5, 15, 30};

/// Of how many pictures the last image hold is the mean; 1: the last picture.
inline constexpr std::array<int, 4> holdCounts{1, 2, 4, 8};

struct Preferences {
    static constexpr int mostFolder = 1024; ///< characters
    static constexpr int mostContact = 80;
    static constexpr int farthestTableTop = 1000; ///< mm

    QString language; ///< `en`, `zh_CN`; empty: as the computer says
    Brightness brightness = Brightness::Usual;
    std::chrono::seconds audioPause = AlarmList::audioPause;
    TrendSpan trendSpan = TrendSpan::Minute;
    QString pictureFolder;                      ///< empty: `liena` in the person's folder of pictures
    WindowChoice window = WindowChoice::AsSent; ///< what the console begins with; never Fixed
    int noiseReduction = 0;                     ///< %
    int edge = 0;                               ///< %
    EdgeMethod edgeMethod = EdgeMethod::UnsharpMask;
    double pulseRate = 15;       ///< one of pulseRates
    int holdPictures = 1;        ///< one of holdCounts
    int objectHeight = 100;      ///< one of objectHeights, mm above the table's top: the plane of lengths above the table begins with it
    std::optional<int> tableTop; ///< mm below the isocentre at the reported height 0, as somebody measured it here; nothing: not set up
    QString patientSide;         ///< how a person there is called, as the prompt shows it; empty: not set up

    bool operator==(const Preferences&) const = default;
};

/// The languages that can be chosen, the empty one first.
QStringList preferenceLanguages();

/// Brought within the bounds.
Preferences withinBounds(Preferences preferences);

/// Not while a permit is asked for or given, and not in a Hold, which can go back to it.
bool preferencesMayChange(PermitPhase phase);

} // namespace console
