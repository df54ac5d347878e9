// A key as a keyboard's driver sends it: which one it is, and what it means at that moment. QTest's keys have no scan code.
#pragma once

#include <QApplication>
#include <QKeyEvent>
#include <QWidget>

namespace console::test {

/// The scan codes of X11 on a PC's keyboard.
namespace scan {
inline constexpr quint32 r = 27;
inline constexpr quint32 d = 40;
inline constexpr quint32 f = 41;
inline constexpr quint32 g = 42;
inline constexpr quint32 padUp = 80; ///< 8 while Num Lock is on
} // namespace scan

/// What the letters are while AltGr is held, where Qt has no name for it.
namespace altGr {
inline constexpr int f = 0x110; ///< D with a stroke
inline constexpr int g = 0x14a; ///< eng
} // namespace altGr

inline void sendKey(QWidget* receiver, QEvent::Type type, quint32 scanCode, int code, bool repeat = false)
{
    QKeyEvent event(type, code, Qt::NoModifier, scanCode, 0, 0, QString(), repeat);
    QApplication::sendEvent(receiver, &event);
}

} // namespace console::test
