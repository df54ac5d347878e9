// What the person at this console may do.
#pragma once

#include <QString>

#include <cstdint>

namespace console {

enum class OperatorRole : std::uint8_t {
    Operator, ///< everything
    Observer, ///< looks, opens links, and stops: arms nothing, gives no beam, resets no stop
};

/// operator, observer.
QString word(OperatorRole role);

} // namespace console
