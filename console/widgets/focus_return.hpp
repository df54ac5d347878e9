// Where the keyboard goes when the control that has it goes.
#pragma once

class QWidget;

namespace console {

/// Before `going`, or what is in it, is hidden, disabled or deleted: its window takes the keyboard. Qt would give it to the next control,
/// where a press of Space that was meant for this one would do another thing.
void returnFocus(QWidget* going);

} // namespace console
