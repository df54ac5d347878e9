// Numbers in words and on panels.
#pragma once

#include <QString>

#include <cmath>

namespace console {

/// The value that whoever reads it finds.
inline double asShown(double value, int decimals) { return QString::number(value, 'f', decimals).toDouble(); }

/// With so many decimals, and with a minus sign, no hyphen; what is shown as zero has none.
inline QString numberText(double value, int decimals)
{
    const bool negative = asShown(value, decimals) < 0;
    return (negative ? QStringLiteral("\u2212") : QString()) + QString::number(std::abs(value), 'f', decimals);
}

} // namespace console
