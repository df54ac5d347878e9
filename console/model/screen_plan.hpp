// Which window stands on which screen, and which picture is beside the live one.
#pragma once

#include <QList>
#include <QString>

#include <cstdint>

namespace console {

/// Where pictures stand in the cockpit. In none of them is another picture larger than the live one, and in all of them it is in sight.
enum class Arrangement : std::uint8_t {
    Usual,           ///< the live picture is the large one, in D
    ReferenceBeside, ///< reference and live have changed places
    SceneBeside,     ///< scene and live have changed places
};
inline constexpr int arrangementCount = 3;
QString word(Arrangement arrangement);

/// A key pressed again takes back what it did.
Arrangement swapped(Arrangement present, Arrangement wanted);

/// What a person chose; screens by their names, empty for none.
struct ScreenLayout {
    QString name;
    Arrangement arrangement = Arrangement::Usual;
    QString cockpit;
    QString second;
    QString third;

    bool operator==(const ScreenLayout&) const = default;
};

/// What is possible of it now.
struct ScreenPlan {
    QString cockpit; ///< empty only when there is no screen at all
    QString second;  ///< empty: that window is closed
    QString third;
    bool folded = false; ///< a screen that was asked for is not there

    bool operator==(const ScreenPlan&) const = default;
};

/// The cockpit comes first: it takes the screen that is left, and windows without a screen of their own close. `screens` has the primary
/// one first.
ScreenPlan planFor(const ScreenLayout& layout, const QList<QString>& screens);

} // namespace console
