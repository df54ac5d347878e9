// Granting, and holding the peer to it.
#include "session/measured_run.hpp"

#include <algorithm>
#include <limits>

namespace liena::session {

using namespace std::chrono_literals;
using protocol::MeasureAnswer;
using protocol::MeasureVerdict;
using protocol::ProbeWay;

namespace {

constexpr double burst = 0.1; // seconds of an allowance that may come at once
constexpr auto grace = 1s;    // for what is under way when the time is over

MeasureAnswer refusal(std::uint32_t run, MeasureVerdict verdict, bool inUse, std::string_view why)
{
    MeasureAnswer answer;
    answer.run = run;
    answer.verdict = verdict;
    answer.inUse = inUse;
    answer.detail.value = why;
    return answer;
}

} // namespace

MeasuringLimits grantOf(const MeasuringLimits& asked, const MeasuringBudget& budget, bool inUse)
{
    const auto& most = inUse ? budget.inUse : budget.atRest;
    MeasuringLimits granted;
    granted.probesPerSecond = lower(asked.probesPerSecond, most.probesPerSecond);
    granted.bulkBytesPerSecond = lower(asked.bulkBytesPerSecond, most.bulkBytesPerSecond);
    granted.longest = std::min(asked.longest, most.longest);
    return granted;
}

std::uint64_t shareOfPath(std::uint64_t bulkBytesPerSecond, const MeasuringBudget& budget, std::optional<double> bulkRate)
{
    const double share = bulkRate.value_or(assumedBulkRate) * budget.share;
    return lower(bulkBytesPerSecond, std::max<std::uint64_t>(1, static_cast<std::uint64_t>(share)));
}

std::string oneAtATime(std::string_view line)
{
    return "this device is in use, and its line to " + std::string(line) + " is being measured: one at a time, wait until that is over";
}

void Allowance::restart(double perSecond, Instant now)
{
    m_perSecond = perSecond;
    m_left = perSecond * burst + 1;
    m_filled = now;
}

bool Allowance::isLeft(Instant now)
{
    if (m_perSecond <= 0)
        return true;
    m_left = std::min(m_left + m_perSecond * std::chrono::duration<double>(now - m_filled).count(), m_perSecond * burst + 1);
    m_filled = now;
    return m_left > 0;
}

MeasureAnswer MeasuredRun::answer(const protocol::MeasureRequest& request, const MeasuringBudget& budget, bool inUse, Instant now,
                                  std::string_view measured)
{
    if (request.durationMs == 0) {
        if (request.run == m_run)
            end();
        return refusal(request.run, MeasureVerdict::Ended, inUse, "ended as asked");
    }
    if (!budget.allowed || request.run == 0)
        return refusal(request.run, MeasureVerdict::NotAllowed, inUse, "this device lets nobody measure its lines");
    if (isRunningAt(now))
        return refusal(request.run, MeasureVerdict::Busy, inUse, "a measurement of this line runs already");
    if (inUse && !measured.empty())
        return refusal(request.run, MeasureVerdict::Busy, inUse, oneAtATime(measured));
    MeasuringLimits asked{request.probesPerSecond, request.bulkBytesPerSecond, std::chrono::seconds(request.durationMs / 1000 + 1)};
    const auto granted = grantOf(asked, budget, inUse);
    const auto duration = std::min(std::chrono::milliseconds(request.durationMs), std::chrono::milliseconds(granted.longest));
    m_run = request.run;
    m_inUse = inUse;
    m_ends = now + duration;
    // Of a rhythm and its allowance none is exact: what is a little early is no fault.
    constexpr double tolerance = 1.05;
    m_probes.restart(granted.probesPerSecond * tolerance, now);
    m_bulk.restart(static_cast<double>(granted.bulkBytesPerSecond) * tolerance, now);
    m_decisions = {};
    m_heard = {};
    MeasureAnswer answer{m_run,
                         MeasureVerdict::Granted,
                         inUse,
                         static_cast<std::uint32_t>(duration.count()),
                         granted.probesPerSecond,
                         granted.bulkBytesPerSecond,
                         {}};
    return answer;
}

bool MeasuredRun::isRunningAt(Instant now) const { return m_run != 0 && now < m_ends + grace; }

bool MeasuredRun::admits(std::uint8_t lane, const protocol::DatagramHeader& header, Instant now)
{
    if (lane >= mostLanes)
        return false;
    auto& decision = m_decisions[lane];
    auto& allowance = lane == 0 ? m_probes : m_bulk;
    if (lane == 0 || decision.message != header.timestamp) {
        decision.message = header.timestamp;
        decision.admitted = isRunningAt(now) && allowance.isLeft(now);
    }
    if (decision.admitted)
        allowance.spend(lane == 0 ? 1 : header.length);
    return decision.admitted;
}

std::optional<protocol::ProbeEcho> MeasuredRun::echoOf(const protocol::ProbeHead& probe, ProbeWay arrived)
{
    if (m_run == 0 || probe.run != m_run || probe.way != arrived)
        return std::nullopt;
    return protocol::ProbeEcho{probe.run, probe.way, probe.sequence, probe.sentNs, ++m_heard[static_cast<std::size_t>(arrived)]};
}

std::optional<MeasureAnswer> MeasuredRun::endIfInUse(bool inUse)
{
    if (m_run == 0 || m_inUse || !inUse)
        return std::nullopt;
    auto told = refusal(m_run, MeasureVerdict::Ended, true, "the device came into use: commands or images flow");
    end();
    return told;
}

} // namespace liena::session
