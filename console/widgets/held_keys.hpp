// Which keys are down, so that each is known again when it comes up.
#pragma once

#include <QList>

#include <optional>
#include <vector>

namespace console {

/// A key is known by its scan code, and keeps the code (Qt::Key) that it was pressed with: which one it comes up with depends on the
/// modifiers, the layout and the locks of that moment. Where the platform gives no scan code (0) a key is known by its code alone.
///
/// Letting go always counts: what came up and cannot be told counts as every key that it may have been.
class HeldKeys {
public:
    /// A key goes down; a repeat is no press. What it was held as until now, if that was another code: nobody heard it come up.
    std::optional<int> press(quint32 scanCode, int code);

    /// A key comes up; a repeat is no release. The codes that what came up was pressed with, in the reverse order of the presses; of a key
    /// whose press was not heard its own code as well.
    QList<int> release(quint32 scanCode, int code);

    void clear() { m_down.clear(); }

private:
    struct Key {
        quint32 scanCode;
        int code;
    };

    template <typename Which>
    QList<int> take(Which which);

    std::vector<Key> m_down;
};

} // namespace console
