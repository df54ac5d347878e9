// The second press of a double click: a person who double-clicks a button has one wish.
#pragma once

class QElapsedTimer;

namespace console {

/// Asked at each press, whether by mouse or key; GUI thread. True for one within the desktop's double-click time after the last that was a
/// wish: the button may offer the opposite by then. Else `since`, which belongs to that button alone, begins anew.
bool isDoubleClick(QElapsedTimer& since);

} // namespace console
