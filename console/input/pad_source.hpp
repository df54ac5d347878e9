// What game pads say, whoever hears them.
#pragma once

#include <QString>
#include <QStringList>

#include <array>
#include <cstdint>
#include <vector>

namespace console {

/// Named by their place, since every maker prints other letters on them.
enum class PadButton : std::uint8_t { East, Start, RightShoulder, Up, Down };
inline constexpr std::size_t padButtonCount = 5;

/// Sticks from -1 to 1, right and down positive; triggers from 0, let go, to 1.
enum class PadAxis : std::uint8_t { LeftX, LeftY, RightX, RightY, LeftTrigger };
inline constexpr std::size_t padAxisCount = 5;

struct PadState {
    std::array<double, padAxisCount> axes{};
    std::array<bool, padButtonCount> buttons{};

    double axis(PadAxis which) const { return axes.at(static_cast<std::size_t>(which)); }
    bool down(PadButton which) const { return buttons.at(static_cast<std::size_t>(which)); }
    bool operator==(const PadState&) const = default;
};

struct PadStep {
    enum class What : std::uint8_t { Came, Went, Changed };

    What what = What::Changed;
    PadState state; ///< whole, after the step
};

/// One pad is heard; others that are there are named only.
class PadSource {
public:
    PadSource() = default;
    PadSource(const PadSource&) = delete;
    PadSource& operator=(const PadSource&) = delete;
    virtual ~PadSource() = default;

    /// What happened since the last call, in order; a button that was let go and pressed again in between is two steps.
    virtual std::vector<PadStep> poll() = 0;

    virtual QString name() const = 0;       ///< of the pad that is heard
    virtual QStringList others() const = 0; ///< that are there and not heard
    virtual QString trouble() const = 0;    ///< why no pad can be heard; empty when one could
};

} // namespace console
