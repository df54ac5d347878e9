// The frames of the last minute, for review.
#include "imaging/cine_ring.hpp"

#include <algorithm>
#include <iterator>
#include <unistd.h>
#include <utility>
#include <vector>

namespace console {

std::size_t CineRing::usualBytes()
{
    constexpr std::size_t mebibyte = std::size_t(1) << 20U;
    const auto pages = ::sysconf(_SC_PHYS_PAGES);
    const auto pageSize = ::sysconf(_SC_PAGESIZE);
    const auto memory = pages > 0 && pageSize > 0 ? static_cast<std::size_t>(pages) * static_cast<std::size_t>(pageSize) : 0;
    return std::clamp(memory / 4, 512 * mebibyte, 4096 * mebibyte);
}

void CineRing::add(const XrayFrame& frame)
{
    if (frame.pixels.size() > m_mostBytes)
        return;
    const auto bytes = std::make_shared<const std::vector<std::byte>>(frame.pixels.begin(), frame.pixels.end());
    auto copy = std::make_shared<XrayFrame>(frame);
    copy->owner = bytes;
    copy->pixels = *bytes;
    std::vector<std::shared_ptr<const XrayFrame>> gone; // let go outside the lock
    const std::lock_guard lock(m_mutex);
    m_bytes += bytes->size();
    m_frames.push_back(std::move(copy));
    while (m_bytes > m_mostBytes || frame.arrival - m_frames.front()->arrival > longest) {
        gone.push_back(m_frames.front());
        dropOldest();
    }
}

void CineRing::dropOldest()
{
    m_bytes -= m_frames.front()->pixels.size();
    m_frames.pop_front();
    ++m_first;
}

CineRing::Range CineRing::range() const
{
    const std::lock_guard lock(m_mutex);
    return {m_first, m_first + m_frames.size()};
}

std::shared_ptr<const XrayFrame> CineRing::at(quint64 number) const
{
    const std::lock_guard lock(m_mutex);
    if (number < m_first || number >= m_first + m_frames.size())
        return nullptr;
    return m_frames[static_cast<std::size_t>(number - m_first)];
}

CineRing::OfMoment CineRing::frameOf(Instant moment) const
{
    const std::lock_guard lock(m_mutex);
    const auto next =
        std::upper_bound(m_frames.begin(), m_frames.end(), moment, [](Instant at, const auto& frame) { return at < frame->arrival; });
    if (next == m_frames.begin())
        return {m_first > 0 ? MomentPicture::Gone : MomentPicture::NotTaken};
    if (moment - (*std::prev(next))->arrival > longestGap)
        return {MomentPicture::NotTaken};
    return {MomentPicture::Kept, m_first + static_cast<quint64>(next - m_frames.begin()) - 1};
}

std::size_t CineRing::bytes() const
{
    const std::lock_guard lock(m_mutex);
    return m_bytes;
}

Duration CineRing::span() const
{
    const std::lock_guard lock(m_mutex);
    return m_frames.empty() ? Duration::zero() : m_frames.back()->arrival - m_frames.front()->arrival;
}

} // namespace console
