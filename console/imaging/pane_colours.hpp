// The picture panes' colours: for dim rooms. Red, yellow and cyan belong to alarms, and only `caution` is one's.
#pragma once

#include <QColor>

namespace console::pane_colours {

inline constexpr QColor background{0x0E, 0x11, 0x14};
inline constexpr QColor vessel{0x8E, 0x84, 0x9C};
inline constexpr QColor wire{0xD8, 0xDE, 0xE6};
inline constexpr QColor roadmap{0xC0, 0x8C, 0xFF};
inline constexpr QColor tip{0x9B, 0xE0, 0x8A};
inline constexpr QColor stale{0x6F, 0x77, 0x80};
inline constexpr QColor cArm{0x5E, 0x68, 0x73};
inline constexpr QColor text{0xC8, 0xCD, 0xD3};
inline constexpr QColor secondary{0x92, 0x9A, 0xA3};
inline constexpr QColor line{0x55, 0x5E, 0x68};
inline constexpr QColor caution{0x40, 0xCD, 0xE0}; ///< of the alarm for a reduced picture, and only while that stands
inline constexpr QColor focus{0xE6, 0xEA, 0xEE};

} // namespace console::pane_colours
