// Enter, of which some desktops make a press of every button and some do not: what it does is each button's own to say.
#pragma once

#include <QKeyEvent>

namespace console {

/// Return, or Enter of the key pad.
inline bool isEnter(const QKeyEvent& event) { return event.key() == Qt::Key_Return || event.key() == Qt::Key_Enter; }

} // namespace console
