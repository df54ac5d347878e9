// A scroll area whose content a finger drags.
#pragma once

class QAbstractScrollArea;

namespace console {

/// From then on a finger that moves up or down on what `area` shows takes the content along, line by line where it scrolls by lines, and
/// presses nothing there; one that stays presses what is under it when it leaves. The content stays where the finger leaves it: nothing
/// glides away under the next touch. An area that shows everything is as without this; so are mouse, wheel and keys. GUI thread, once for
/// each area; nothing that stops or is held may lie in one, since it would hear of a finger when that leaves.
void scrollByTouch(QAbstractScrollArea& area);

} // namespace console
