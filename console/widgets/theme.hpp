// Colours, type and scale of the cockpit, each with a name; the only place where a colour is written down.
#pragma once

#include "model/preferences.hpp"

#include <QColor>
#include <QFont>

class QApplication;
class QWidget;

namespace console::theme {

/// The greys of the surroundings; each level of brightness has its own. Distinct within a level.
struct Greys {
    QColor background;
    QColor panel;
    QColor raised;
    QColor line;
    QColor strongLine;
    QColor bright; ///< the one thing to read first
    QColor text;
    QColor secondary;
    QColor stale; ///< always with a mark
    QColor hover; ///< of a button
    QColor pressed;
};

const Greys& greys(Brightness brightness);

namespace detail {
extern Greys present;
} // namespace detail

// Contrast on `background` in brackets, at the usual brightness. Red, yellow and cyan are the alarms' own: nothing else may use them, and
// they are the same at each brightness.
namespace colour {
inline const QColor& background = detail::present.background;
inline const QColor& panel = detail::present.panel;
inline const QColor& raised = detail::present.raised;
inline const QColor& line = detail::present.line;
inline const QColor& strongLine = detail::present.strongLine;
inline const QColor& bright = detail::present.bright;       ///< 17:1
inline const QColor& text = detail::present.text;           ///< 11.8:1
inline const QColor& secondary = detail::present.secondary; ///< 6.7:1
inline const QColor& stale = detail::present.stale;         ///< 5.4:1
inline constexpr QColor onAlarm{0x0B, 0x0D, 0x0F};          ///< on medium, low, armed and X-ray surfaces
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

/// In the faces that are in the program: LiENa Sans, which is Inter with figures of one width and a slashed zero, and LiENa Hei for
/// Chinese.
QFont font(TextRole role, double scale);

/// The scale under which `widget` is shown, as its window was told; 1 before.
double scaleOf(const QWidget* widget);

/// Gives `widget` its role; the font follows now and at every later change of scale.
void setTextRole(QWidget* widget, TextRole role);

/// Sets the fonts of `root` and of all its children that have a role.
void applyScale(QWidget* root, double scale);

/// `length` at the reference, in pixels of the present scale; at least 1 for anything above 0.
int px(const QWidget* widget, double length);

inline constexpr int leastTouchSide = 24; ///< pixels (WCAG 2.2, target size)

/// The side of what a finger must hit: 12 mm on a screen of 27 inches, whatever its resolution, and never below leastTouchSide.
int touchSide(const QWidget* widget);

/// The side of what permits, starts or stops a movement, an injection or the beam: 20 mm there, and never below twice leastTouchSide.
int safetySide(const QWidget* widget);

/// Between two of those: 5 mm, so that a finger in a glove does not meet the next.
int safetyGap(const QWidget* widget);

/// Fusion, the typefaces, the dark palette and the style sheet; and every place stays where it is, also in a language that is written from
/// right to left: what is painted tells left from right, of the patient and of the hand.
void apply(QApplication& application);

/// The surroundings in that brightness: the greys, the palette, the style sheet, and every widget that has an ink of its own. The picture
/// panes have colours of their own, which it does not touch. Takes some tens of milliseconds: not while instruments move.
void setBrightness(QApplication& application, Brightness brightness);
Brightness brightness();

/// The style sheet in the greys of that level.
QString styleSheet(Brightness brightness);

/// Contrast of two opaque colours as WCAG 2.2 defines it, 1 to 21.
double contrast(const QColor& a, const QColor& b);

} // namespace console::theme
