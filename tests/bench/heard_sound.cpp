// A window is moved over the samples by the millisecond, until the pitch of a high burst prevails in it.
#include "heard_sound.hpp"

#include "model/alarm_burst.hpp"
#include "support/sound_samples.hpp"

#include <algorithm>

namespace console::test {

namespace {

constexpr std::size_t pitchWindow = soundRate / 50; ///< so long that the pitches of two priorities cannot be confused
constexpr std::size_t step = soundRate / 1000;
constexpr double clearly = 4; ///< times as much

bool soundsHigh(const std::int16_t* samples)
{
    if (loudness(samples, pitchWindow) < loud)
        return false;
    const auto powerOf = [samples](AlarmPriority priority) { return power(samples, pitchWindow, burstOf(priority).front().pitch); };
    return powerOf(AlarmPriority::High) > clearly * std::max(powerOf(AlarmPriority::Medium), powerOf(AlarmPriority::Low));
}

/// After the last millisecond of silence in it. Without one it touches what it cut short, and its end is the latest that it can be.
std::size_t beginningIn(const std::int16_t* samples)
{
    std::size_t quiet = 0;
    std::size_t beginning = pitchWindow - 1;
    for (std::size_t i = 0; i < pitchWindow; ++i) {
        if (!isSound(samples[i])) {
            ++quiet;
            continue;
        }
        beginning = quiet >= step ? i : beginning;
        quiet = 0;
    }
    return beginning;
}

} // namespace

void HeardSound::add(std::span<const std::int16_t> block, Instant arrived)
{
    m_samples.insert(m_samples.end(), block.begin(), block.end());
    m_blocks.push_back({m_samples.size(), arrived});
    const auto lastSound = std::find_if(block.rbegin(), block.rend(), isSound);
    m_quiet = std::size_t(lastSound - block.rbegin()) + (lastSound == block.rend() ? m_quiet : 0);
    if (!m_onsets.first && lastSound != block.rend())
        m_onsets.first = arrived;
    lookForHigh();
}

void HeardSound::lookForHigh()
{
    for (; !m_onsets.high && m_looked + pitchWindow <= m_samples.size(); m_looked += step)
        if (const auto* samples = m_samples.data() + m_looked; soundsHigh(samples))
            m_onsets.high = timeOf(m_looked + beginningIn(samples));
}

void HeardSound::forget()
{
    m_samples.assign(std::min(m_quiet, step), 0);
    m_blocks.clear();
    m_looked = 0;
    m_onsets = {};
}

Duration HeardSound::silence() const { return durationOf(m_quiet); }

Instant HeardSound::timeOf(std::size_t place) const { return std::ranges::upper_bound(m_blocks, place, {}, &Block::end)->arrived; }

} // namespace console::test
