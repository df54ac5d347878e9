// Which keys are down, so that each is known again when it comes up.
#include "widgets/held_keys.hpp"

#include <algorithm>
#include <utility>

namespace console {

std::optional<int> HeldKeys::press(quint32 scanCode, int code)
{
    const auto same = std::find_if(m_down.begin(), m_down.end(), [scanCode, code](const Key& key) {
        return key.scanCode == scanCode && (scanCode != 0 || key.code == code);
    });
    if (same == m_down.end())
        m_down.push_back({scanCode, code});
    else if (same->code != code)
        return std::exchange(same->code, code);
    return std::nullopt;
}

QList<int> HeldKeys::release(quint32 scanCode, int code)
{
    if (const auto known = take([scanCode](const Key& key) { return scanCode != 0 && key.scanCode == scanCode; }); !known.isEmpty())
        return known;
    if (!take([code](const Key& key) { return key.code == code; }).isEmpty())
        return {code};
    // Scan codes that differ are two keys for certain; what lacks one may be either.
    return take([scanCode](const Key& key) { return scanCode == 0 || key.scanCode == 0; }) << code;
}

/// The last one first: motion ends before the pictures do that it went by.
template <typename Which>
QList<int> HeldKeys::take(Which which)
{
    const auto taken = std::stable_partition(m_down.begin(), m_down.end(), [&which](const Key& key) { return !which(key); });
    QList<int> codes;
    for (auto key = taken; key != m_down.end(); ++key)
        codes.prepend(key->code);
    m_down.erase(taken, m_down.end());
    return codes;
}

} // namespace console
