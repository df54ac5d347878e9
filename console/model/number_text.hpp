// Numbers in words and on panels.
#pragma once

#include <QString>

#include <cmath>

namespace console {

inline bool isShownAsZero(double value, int decimals) { return std::round(value * std::pow(10, decimals)) == 0; }

/// With so many decimals, and with a minus sign, no hyphen; what is shown as zero has none.
inline QString numberText(double value, int decimals)
{
    const bool negative = value < 0 && !isShownAsZero(value, decimals);
    return (negative ? QStringLiteral("\u2212") : QString()) + QString::number(std::abs(value), 'f', decimals);
}

} // namespace console
