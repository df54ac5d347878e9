// The shell around LineProbing and MeasuredRun.
#include "system/line_measurement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <utility>

namespace liena::system {

using namespace std::chrono_literals;
using protocol::ProbeWay;

namespace {

constexpr auto answerLimit = 2s;
constexpr std::uint32_t mostAnswersWaiting = 8;
constexpr std::uint32_t mostProbesWaiting = 2048;
constexpr std::uint32_t largestImageInUse = 2U << 20U; // made in a third of a millisecond

/// Repeated beyond what a VPN's compressor looks back, since this is the network thread and megabytes of it would take milliseconds.
std::shared_ptr<const std::vector<std::byte>> noise(std::size_t size)
{
    constexpr std::size_t repeated = 65537;
    auto made = std::make_shared<std::vector<std::byte>>(size);
    auto& bytes = *made;
    std::uint64_t state = 0x9E3779B97F4A7C15ULL; // xorshift64 (Marsaglia 2003)
    for (std::size_t at = 0; at < std::min(size, repeated); ++at) {
        state ^= state << 13U;
        state ^= state >> 7U;
        state ^= state << 17U;
        bytes[at] = static_cast<std::byte>(state >> 32U);
    }
    for (std::size_t at = repeated; at < size; at += repeated)
        std::memcpy(bytes.data() + at, bytes.data(), std::min(repeated, size - at));
    return made;
}

Result<void> check(const MeasurementPlan& plan)
{
    const auto wrong = [](std::string what) { return fail(Errc::InvalidArgument, std::move(what)); };
    if (plan.empty())
        return wrong("a measurement has at least one phase");
    for (const auto& phase : plan) {
        if (phase.duration <= 0ns || phase.duration > 1h)
            return wrong(fmt::format("phase {} of the measurement must last more than nothing and at most an hour", phase.name));
        for (const auto* stream : {&phase.prompt, &phase.packets, &phase.images})
            if (!(stream->perSecond >= 0 && stream->perSecond <= 1e6) || stream->atOnce > session::LineProbing::mostUnderWay)
                return wrong(fmt::format("phase {} of the measurement: at most 1 000 000 probes a second, or 1 024 at once", phase.name));
        const auto mostPrompt = protocol::maximumPromptPadding;
        if (phase.prompt.bytes > mostPrompt || phase.packets.bytes > mostPrompt || phase.images.bytes > protocol::maximumProbePadding)
            return wrong(fmt::format("phase {} of the measurement: probes have at most {} bytes, images {}", phase.name, mostPrompt,
                                     protocol::maximumProbePadding));
    }
    return ok();
}

std::uint32_t largestOf(const MeasurementPlan& plan)
{
    std::uint32_t largest = 0;
    for (const auto& phase : plan)
        largest = std::max({largest, phase.prompt.bytes, phase.packets.bytes, phase.images.isUsed() ? phase.images.bytes : 0});
    return largest;
}

/// The most that a phase asks for; 0 for as much as goes.
MeasuringLimits limitsOf(const MeasurementPlan& plan)
{
    double probes = 0;
    double bulk = 0;
    bool allProbes = false;
    bool allBulk = false;
    for (const auto& phase : plan) {
        probes = std::max(probes, phase.prompt.perSecond + phase.packets.perSecond);
        bulk = std::max(bulk, phase.images.perSecond * (phase.images.bytes + protocol::probeHeadSize));
        allProbes = allProbes || phase.prompt.atOnce > 0 || phase.packets.atOnce > 0;
        allBulk = allBulk || phase.images.atOnce > 0;
    }
    MeasuringLimits limits;
    limits.probesPerSecond = allProbes ? 0 : static_cast<std::uint32_t>(probes) + 1;
    limits.bulkBytesPerSecond = allBulk ? 0 : static_cast<std::uint64_t>(bulk) + 1;
    limits.longest = std::chrono::ceil<std::chrono::seconds>(session::LineProbing::longest(plan));
    return limits;
}

} // namespace

LineMeasurement::LineMeasurement(ModuleHost& host, std::string peer, Ways ways)
    : m_host(host), m_peer(std::move(peer)), m_ways(std::move(ways)), m_timer(host.io())
{}

Result<void> LineMeasurement::start(MeasurementPlan plan, DistributedSystem::MeasurementHandler done)
{
    if (m_asked)
        return fail(Errc::Busy, fmt::format("the line to {} is being measured already", m_peer));
    if (auto checked = check(plan); !checked)
        return checked;
    const auto& budget = m_host.measuring();
    if (!budget.allowed)
        return fail(Errc::Forbidden, "this device measures no lines (Settings::measuring)");
    Asked asked;
    const auto wanted = limitsOf(plan);
    asked.inUse = m_host.isInUse();
    if (const auto lines = m_host.measuredLines(); asked.inUse && !lines.empty())
        return fail(Errc::Busy, session::oneAtATime(lines.front()));
    asked.agreed = session::grantOf(wanted, budget, asked.inUse);
    if (asked.agreed.longest < wanted.longest)
        return fail(Errc::Forbidden,
                    fmt::format("this device{} measures for at most {} s at once, and this would take {}; measure for a shorter time",
                                asked.inUse ? " is in use and" : "", asked.agreed.longest.count(), wanted.longest.count()));
    const auto largest = largestOf(plan);
    if (asked.inUse && largest > largestImageInUse)
        return fail(Errc::Forbidden,
                    fmt::format("this device is in use and sends images of at most {} bytes to measure", largestImageInUse));
    m_padding = noise(largest);
    asked.run = static_cast<std::uint32_t>(m_host.freshToken()) | 1U;
    asked.plan = std::move(plan);
    asked.done = std::move(done);
    m_asked = std::move(asked);
    const auto duration = std::chrono::milliseconds(wanted.longest).count();
    m_ways.prompt(protocol::MeasureRequest{m_asked->run, static_cast<std::uint32_t>(duration), m_asked->agreed.probesPerSecond,
                                           m_asked->agreed.bulkBytesPerSecond},
                  mostAnswersWaiting);
    m_timer.after(answerLimit, [this] {
        stop(fmt::format("{} does not answer: its software is older than measurements, or the line is silent", m_peer));
    });
    return ok();
}

void LineMeasurement::stop(const std::string& why)
{
    if (!m_asked)
        return;
    m_ways.prompt(protocol::MeasureRequest{m_asked->run, 0, 0, 0}, mostAnswersWaiting);
    finish(why);
}

void LineMeasurement::heard(const protocol::MeasureRequest& request)
{
    const auto lines = m_host.measuredLines();
    const auto measured = lines.empty() ? std::string_view() : std::string_view(lines.front());
    m_ways.prompt(m_answering.answer(request, m_host.measuring(), m_host.isInUse(), m_host.now().mono, measured), mostAnswersWaiting);
}

void LineMeasurement::heard(const protocol::MeasureAnswer& answer)
{
    if (!m_asked || answer.run != m_asked->run)
        return;
    const auto detail = printable(answer.detail.value, 256);
    if (answer.verdict != protocol::MeasureVerdict::Granted)
        return finish(fmt::format("{} {}: {}", m_peer, m_asked->probing ? "ended the measurement" : "refuses to be measured", detail));
    if (!m_asked->probing)
        begin(answer);
}

void LineMeasurement::begin(const protocol::MeasureAnswer& answer)
{
    auto& asked = *m_asked;
    const std::chrono::milliseconds granted(answer.durationMs);
    if (granted < asked.agreed.longest && granted < session::LineProbing::longest(asked.plan))
        return stop(fmt::format("{}{} is measured for at most {} s at once; measure for a shorter time", m_peer,
                                answer.inUse ? " is in use and" : "", answer.durationMs / 1000));
    asked.inUse = asked.inUse || answer.inUse;
    asked.agreed.probesPerSecond = session::lower(asked.agreed.probesPerSecond, answer.probesPerSecond);
    asked.agreed.bulkBytesPerSecond = session::lower(asked.agreed.bulkBytesPerSecond, answer.bulkBytesPerSecond);
    asked.limits = asked.agreed;
    asked.limits.bulkBytesPerSecond = bulkLimit();
    asked.bulkLeft = m_ways.bulkLeft();
    asked.bulkWaits = m_ways.bulkWaits();
    asked.probing.emplace(asked.plan, asked.limits, m_host.now().mono);
    pump();
}

/// What the path carries becomes known, and changes, while it is measured.
std::uint64_t LineMeasurement::bulkLimit() const
{
    const auto agreed = m_asked->agreed.bulkBytesPerSecond;
    const auto known = m_ways.bulkRate();
    const auto rate = known ? std::optional(known->bytesPerSecond) : std::nullopt;
    return m_asked->inUse ? session::shareOfPath(agreed, m_host.measuring(), rate) : agreed;
}

/// Sends what is due, and comes again when more is.
void LineMeasurement::pump()
{
    if (!m_asked || !m_asked->probing)
        return;
    auto& probing = *m_asked->probing;
    constexpr int mostInOneTurn = 64; // between them others have theirs
    int sent = 0;
    const auto now = m_host.now().mono;
    for (auto order = probing.next(now); order; order = ++sent < mostInOneTurn ? probing.next(now) : std::nullopt)
        send(*order);
    if (probing.isOver()) {
        m_ways.prompt(protocol::MeasureRequest{m_asked->run, 0, 0, 0}, mostAnswersWaiting);
        return finish({});
    }
    m_timer.at(sent < mostInOneTurn ? probing.wakeAt() : now, [this] {
        m_host.turned();
        pump();
    });
}

void LineMeasurement::send(const session::LineProbing::Order& order)
{
    const protocol::ProbeHead head{m_asked->run, order.way, order.sequence, order.sentNs};
    const auto padding = std::span<const std::byte>(*m_padding).first(std::min<std::size_t>(order.bytes, m_padding->size()));
    if (order.way == ProbeWay::Image)
        return m_ways.image(head, {m_padding, padding}, order.expires);
    const protocol::Probe probe{head.run, head.way, head.sequence, head.sentNs, {{padding.begin(), padding.end()}}};
    if (order.way == ProbeWay::Packet)
        (void)m_ways.packet(probe); // where there is no way it is lost, which is what is found
    else
        m_ways.prompt(probe, mostProbesWaiting);
}

int LineMeasurement::running() const { return (m_asked ? 1 : 0) + (m_answering.isRunningAt(m_host.now().mono) ? 1 : 0); }

bool LineMeasurement::admits(std::uint8_t lane, const protocol::DatagramHeader& header)
{
    return m_answering.isRunning() && m_answering.admits(lane, header, m_host.now().mono);
}

bool LineMeasurement::heardProbe(ProbeWay arrived, std::span<const std::byte> part)
{
    const auto probe = protocol::decodeProbe(part);
    const auto echo = probe ? m_answering.echoOf(*probe, arrived) : std::nullopt;
    if (!echo)
        return false;
    if (arrived == ProbeWay::Packet)
        (void)m_ways.packet(*echo);
    else
        m_ways.prompt(*echo, mostProbesWaiting);
    return true;
}

bool LineMeasurement::heardEcho(const protocol::ProbeEcho& echo)
{
    if (!m_asked || echo.run != m_asked->run || !m_asked->probing)
        return false;
    m_asked->probing->heard(echo, m_host.now().mono);
    pump();
    return true;
}

void LineMeasurement::sessionEnded()
{
    m_answering.end();
    finish(fmt::format("the session with {} was interrupted, lost or closed", m_peer));
}

void LineMeasurement::housekeeping()
{
    if (!m_asked && !m_answering.isRunning())
        return;
    const bool inUse = m_host.isInUse();
    if (const auto told = m_answering.endIfInUse(inUse))
        m_ways.prompt(*told, mostAnswersWaiting);
    // Those that began at rest, for a peer in use, may be several.
    if (m_asked && inUse && (!m_asked->inUse || m_host.measuredLines().size() > 1))
        stop("this device came into use: commands or images flow");
    if (!m_asked || !m_asked->probing)
        return;
    const auto limit = bulkLimit();
    m_asked->limits.bulkBytesPerSecond = session::lower(m_asked->limits.bulkBytesPerSecond, limit);
    m_asked->probing->limitImages(limit, m_host.now().mono);
}

void LineMeasurement::finish(const std::string& failure)
{
    if (!m_asked)
        return;
    m_timer.cancel();
    const auto asked = std::move(*m_asked);
    m_asked.reset();
    m_padding.reset();
    Measurement measurement;
    measurement.failure = failure;
    measurement.inUse = asked.inUse;
    measurement.imagesFlowed = asked.probing && (asked.bulkWaits || m_ways.bulkWaits() || m_ways.bulkLeft() > asked.bulkLeft);
    measurement.limits = asked.limits;
    if (const auto known = m_ways.bulkRate()) {
        measurement.bulkRate = known->bytesPerSecond;
        measurement.bulkRateAge = m_host.now().mono - known->shown;
    }
    if (asked.probing)
        measurement.phases = asked.probing->figures();
    asked.done(measurement);
}

} // namespace liena::system
