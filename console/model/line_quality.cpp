// A line's jitter and loss against their limits, with hysteresis in value and in time.
#include "model/line_quality.hpp"

namespace console {

/// What is not known is neither good nor bad: the judgement stands, and its time begins anew.
void LineQuality::Threshold::judge(std::optional<double> value, double bad, double good, Instant now)
{
    const bool turns = value && (above ? *value < good : *value > bad);
    if (!turns) {
        since.reset();
        return;
    }
    if (!since)
        since = now;
    if (now - *since >= (above ? clearAfter : raiseAfter)) {
        above = !above;
        since.reset();
    }
}

std::optional<double> LineQuality::lossPercent() const
{
    if (m_marks.size() < 2 || m_marks.back().at - m_marks.front().at < leastSpan)
        return std::nullopt;
    const auto received = m_marks.back().received - m_marks.front().received;
    const auto missed = m_marks.back().missed - m_marks.front().missed;
    if (received + missed == 0)
        return std::nullopt;
    return 100.0 * static_cast<double>(missed) / static_cast<double>(received + missed);
}

void LineQuality::note(const LinkFigures& figures, const LineLimits& limits, Instant now)
{
    const bool anew =
        !m_marks.empty() && (figures.heartbeatsReceived < m_marks.back().received || figures.heartbeatsMissed < m_marks.back().missed);
    if (anew)
        m_marks.clear();
    m_marks.push_back({now, figures.heartbeatsReceived, figures.heartbeatsMissed});
    while (m_marks.size() > mostMarks || (m_marks.size() > 2 && m_marks[1].at <= now - lossSpan))
        m_marks.pop_front();
    m_jitter.judge(figures.jitter ? std::optional<double>(milliseconds(*figures.jitter)) : std::nullopt, limits.jitterMs,
                   limits.jitterGoodMs, now);
    m_loss.judge(lossPercent(), limits.lossPercent, limits.lossGoodPercent, now);
    m_packetsPassed = m_packetsPassed || figures.packetsPass;
    if (m_packetsPassed)
        m_packets.judge(figures.packetsPass ? 0.0 : 1.0, 0.5, 0.5, now);
}

} // namespace console
