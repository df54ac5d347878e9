// Colours, type and scale of the cockpit, each with a name; the only place where a colour is written down.
#pragma once

#include <QColor>
#include <QFont>

class QApplication;
class QWidget;

namespace console::theme {

// Contrast on `background` in brackets. Red, yellow and cyan are the alarms' own: nothing else may use them.
namespace colour {
inline constexpr QColor background{0x0E, 0x11, 0x14};
inline constexpr QColor panel{0x14, 0x18, 0x1D};
inline constexpr QColor raised{0x1C, 0x21, 0x28};
inline constexpr QColor line{0x2C, 0x33, 0x3B};
inline constexpr QColor strongLine{0x55, 0x5E, 0x68};
inline constexpr QColor bright{0xF1, 0xF3, 0xF5};    ///< 17:1, the one thing to read first
inline constexpr QColor text{0xC8, 0xCD, 0xD3};      ///< 11.8:1
inline constexpr QColor secondary{0x92, 0x9A, 0xA3}; ///< 6.7:1
inline constexpr QColor stale{0x82, 0x8A, 0x93};     ///< 5.4:1, always with a mark
inline constexpr QColor onAlarm{0x0B, 0x0D, 0x0F};   ///< on medium, low, armed and X-ray surfaces
inline constexpr QColor high{0xFF, 0x45, 0x3A};
inline constexpr QColor highSurface{0xB3, 0x26, 0x1E}; ///< under white
inline constexpr QColor highSurfaceDim{0x5C, 0x16, 0x12};
inline constexpr QColor medium{0xFF, 0xD6, 0x0A};
inline constexpr QColor mediumSurfaceDim{0x5A, 0x4C, 0x08};
inline constexpr QColor low{0x40, 0xCD, 0xE0};
inline constexpr QColor armed{0x7F, 0xB2, 0xFF};
inline constexpr QColor armedSurface{0x1B, 0x2C, 0x46};
inline constexpr QColor xray{0xFF, 0x9F, 0x1C};
inline constexpr QColor focus{0xE6, 0xEA, 0xEE};
inline constexpr QColor plot{0xB0, 0xA4, 0xD8}; ///< violet: no alarm's hue
} // namespace colour

/// What a text is for; its size follows from the role and the window's scale.
enum class TextRole : int {
    Caption, ///< names of fields, 16 px at the reference
    Body,    ///< 18 px
    Strong,  ///< 18 px semi-bold
    Title,   ///< 22 px semi-bold
    Value,   ///< 26 px
    Alarm,   ///< 32 px
    Permit,  ///< 44 px
};

inline constexpr int referenceWidth = 2560;
inline constexpr int referenceHeight = 1440;

/// 1 at the reference of 2560 x 1440; the smaller of the two fractions otherwise.
double scaleFor(const QSize& window);

QFont font(TextRole role, double scale);

/// The scale under which `widget` is shown, as its window was told; 1 before.
double scaleOf(const QWidget* widget);

/// Gives `widget` its role; the font follows now and at every later change of scale.
void setTextRole(QWidget* widget, TextRole role);

/// Sets the fonts of `root` and of all its children that have a role.
void applyScale(QWidget* root, double scale);

/// `length` at the reference, in pixels of the present scale; at least 1 for anything above 0.
int px(const QWidget* widget, double length);

/// Fusion, Inter, the dark palette and the style sheet.
void apply(QApplication& application);

/// Contrast of two opaque colours as WCAG 2.2 defines it, 1 to 21.
double contrast(const QColor& a, const QColor& b);

} // namespace console::theme
