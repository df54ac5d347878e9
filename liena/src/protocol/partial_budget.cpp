// Keeping a few buffers.
#include "protocol/partial_budget.hpp"

#include <algorithm>
#include <utility>

namespace liena::protocol {

namespace {

constexpr std::size_t mostSpare = 8;
constexpr std::size_t leastWorth = 16 * 1024; // below, the heap is as good

} // namespace

bool PartialBudget::keep(std::size_t bytes)
{
    const auto most = m_limit / 4;
    while (m_kept + bytes > most && !m_spare.empty())
        dropOldest();
    if (m_kept + bytes > most)
        return false;
    m_kept += bytes;
    return true;
}

void PartialBudget::dropOldest()
{
    m_kept -= m_spare.front().capacity();
    m_spare.erase(m_spare.begin());
    m_unneeded = std::min(m_unneeded, m_spare.size());
}

void PartialBudget::trim(std::chrono::steady_clock::time_point now)
{
    if (now - m_looked < idleAfter)
        return;
    m_looked = now;
    if (m_unneeded > 0)
        dropOldest();
    m_unneeded = m_spare.size();
}

PartialBudget::Buffer PartialBudget::buffer(std::size_t bytes)
{
    if (bytes < leastWorth)
        return {};
    const auto fits = std::find_if(m_spare.begin(), m_spare.end(),
                                   [&](const FieldBytes& spare) { return spare.capacity() >= bytes && spare.capacity() / 2 <= bytes; });
    Buffer buffer;
    if (fits != m_spare.end()) {
        buffer.bytes = std::move(*fits);
        m_spare.erase(fits);
        m_unneeded = std::min(m_unneeded, m_spare.size());
        buffer.room = buffer.bytes.capacity();
    } else if (keep(bytes)) {
        buffer.bytes.reserve(bytes);
        buffer.room = bytes;
    }
    return buffer;
}

void PartialBudget::recycle(FieldBytes&& used)
{
    const auto room = used.capacity();
    if (room < leastWorth || room > m_limit / 8)
        return;
    if (m_spare.size() >= mostSpare)
        dropOldest();
    if (!keep(room))
        return;
    used.clear();
    m_spare.reserve(mostSpare); // else a vector that grows would copy them
    m_spare.push_back(std::move(used));
}

} // namespace liena::protocol
