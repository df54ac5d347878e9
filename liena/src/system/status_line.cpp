// Writing a device's state as JSON.
#include "system/status_line.hpp"

#include "liena/json_line.hpp"
#include "liena/log.hpp"
#include "liena/status.hpp"
#include "system/audit_entries.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include <unistd.h>

namespace liena {

std::filesystem::path statusFolder()
{
    if (const char* runtime = std::getenv("XDG_RUNTIME_DIR"); runtime != nullptr && *runtime != '\0')
        return std::filesystem::path(runtime) / "liena";
    return fmt::format("/tmp/liena-{}", ::geteuid());
}

std::filesystem::path statusSocket(const std::filesystem::path& folder, DeviceId device)
{
    return folder / fmt::format("{:08x}.sock", device.value());
}

} // namespace liena

namespace liena::system {

namespace {

constexpr double longestSpan = 3;     // seconds that a rate may speak of
constexpr std::size_t mostDrops = 16; // of one link, the largest

double milliseconds(std::chrono::nanoseconds duration) { return std::chrono::duration<double, std::milli>(duration).count(); }

void addMilliseconds(JsonLine& json, std::string_view name, const std::optional<std::chrono::nanoseconds>& duration)
{
    if (duration)
        json.add(name, milliseconds(*duration));
    else
        json.put(name, "null");
}

std::string arrayOf(const std::vector<std::string>& objects)
{
    std::string array = "[";
    for (const auto& object : objects)
        array += (array.size() > 1 ? "," : "") + object;
    return array + "]";
}

std::chrono::system_clock::time_point timeOf(Timestamp stamp)
{
    return std::chrono::system_clock::time_point(
        std::chrono::duration_cast<std::chrono::system_clock::duration>(std::chrono::nanoseconds(static_cast<std::int64_t>(stamp.ns))));
}

} // namespace

StatusLine::StatusLine(const TopologyDevice& self, const SystemTopology& topology, std::string software, const cache::LinkBoard& board,
                       audit::AuditLog* audit)
    : m_self(self), m_topology(topology), m_software(std::move(software)), m_board(board), m_audit(audit)
{}

std::string StatusLine::make(Instant now, std::chrono::system_clock::time_point wall)
{
    JsonLine json;
    json.add("time", timeText(wall)).add("device", m_self.name).add("id", m_self.id.toString());
    json.add("software", std::string_view(m_software), 64).add("system", m_topology.name()).add("pid", ::getpid());
    json.add("uptime_s", std::chrono::duration<double>(now - m_begun).count()).add("stands_by", m_board.standsBy());
    std::vector<std::string> links;
    for (const auto& link : m_board.links())
        links.push_back(linkOf(link, now));
    m_beforeAt = now;
    json.put("links", arrayOf(links)).put("incidents", incidents());
    return json.put("audit", auditOf(now)).text();
}

std::string StatusLine::linkOf(const LinkStatus& link, Instant now)
{
    JsonLine json;
    json.add("peer", nameIn(m_topology, link.peer)).add("id", link.peer.toString());
    json.add("state", toString(link.state)).add("peer_state", toString(link.peerState));
    addMilliseconds(json, "silence_ms", link.lastHeard ? std::optional(std::chrono::nanoseconds(now - *link.lastHeard)) : std::nullopt);
    addMilliseconds(json, "latency_ms", link.latency);
    addMilliseconds(json, "latency_uncertainty_ms",
                    link.clockOffset ? std::optional(link.clockUncertainty) : std::optional<std::chrono::nanoseconds>());
    addMilliseconds(json, "round_trip_ms", link.roundTrip);
    addMilliseconds(json, "jitter_ms", std::optional(link.jitter));
    addMilliseconds(json, "clock_offset_ms", link.clockOffset);
    json.put("rates", rates(link, now));
    json.add("messages_in", link.messagesReceived).add("messages_out", link.messagesSent).add("messages_dropped", link.messagesDropped);
    json.add("bytes_in", link.bytesReceived).add("bytes_out", link.bytesSent).add("queued", link.queuedMessages);
    json.add("heartbeats", link.heartbeatsReceived).add("heartbeats_missed", link.heartbeatsMissed);
    json.add("interruptions", link.interruptions).add("epoch", link.epoch).add("peer_epoch", link.peerEpoch);
    json.add("to_peer_connected", link.toPeerConnected).add("from_peer_connected", link.fromPeerConnected);
    json.add("local_address", link.localAddress).add("remote_address", link.remoteAddress);
    json.add("datagrams", link.packetsHeard > 0 && link.packetsHeardByPeer > 0).add("bulk_lanes", static_cast<unsigned>(link.bulkLanes));
    json.add("bulk_lanes_in", static_cast<unsigned>(link.bulkLanesIn)).add("bulk_workers", static_cast<unsigned>(link.bulkWorkers));
    json.put("bulk_rate", link.bulkRate ? fmt::format("{:.0f}", *link.bulkRate) : "null").add("bulk_queued_bytes", link.bulkQueuedBytes);
    json.put("bulk_rate_age_s", link.bulkRate ? fmt::format("{:.1f}", std::chrono::duration<double>(link.bulkRateAge).count()) : "null");
    json.add("superseded", link.messagesSuperseded);
    json.put("incident", link.incident != 0 ? fmt::format("\"{:016x}\"", link.incident) : "null");
    json.put("drops", dropsOf(link.peer));
    m_before.insert_or_assign(link.peer, link);
    return json.text();
}

/// Null before there is a line to compare with.
std::string StatusLine::rates(const LinkStatus& link, Instant now)
{
    const auto before = m_before.find(link.peer);
    const auto seconds = std::chrono::duration<double>(now - m_beforeAt).count();
    if (before == m_before.end() || seconds < 0.1 || seconds > longestSpan)
        return "null";
    const auto rate = [&](std::uint64_t newer, std::uint64_t older) {
        return newer < older ? 0.0 : static_cast<double>(newer - older) / seconds;
    };
    JsonLine json;
    json.add("messages_in", rate(link.messagesReceived, before->second.messagesReceived));
    json.add("messages_out", rate(link.messagesSent, before->second.messagesSent));
    json.add("bytes_in", rate(link.bytesReceived, before->second.bytesReceived));
    json.add("bytes_out", rate(link.bytesSent, before->second.bytesSent));
    json.add("dropped", rate(link.messagesDropped, before->second.messagesDropped));
    return json.text();
}

std::string StatusLine::dropsOf(DeviceId peer) const
{
    auto drops = m_board.drops(peer);
    std::stable_sort(drops.begin(), drops.end(), [](const DropCount& a, const DropCount& b) { return a.count > b.count; });
    if (drops.size() > mostDrops)
        drops.resize(mostDrops);
    std::vector<std::string> objects;
    for (const auto& drop : drops)
        objects.push_back(
            JsonLine().add("message", drop.message).add("cause", std::string_view(drop.cause), 128).add("count", drop.count).text());
    return arrayOf(objects);
}

std::string StatusLine::incidents() const
{
    std::vector<std::string> objects;
    for (const auto& incident : m_board.incidents()) {
        std::vector<std::string> holds;
        for (const auto& hold : incident.holds)
            holds.push_back(JsonLine().add("device", nameIn(m_topology, hold.device)).add("holding", hold.holding).text());
        JsonLine json;
        json.add("id", fmt::format("{:016x}", incident.id))
            .add("a", nameIn(m_topology, incident.a))
            .add("b", nameIn(m_topology, incident.b));
        json.add("cause", toString(incident.cause)).add("since", timeText(timeOf(incident.since))).put("holds", arrayOf(holds));
        objects.push_back(json.text());
    }
    return arrayOf(objects);
}

std::string StatusLine::auditOf(Instant now) const
{
    if (m_audit == nullptr)
        return "null";
    const auto status = m_audit->status(now);
    JsonLine json;
    json.add("file", m_audit->path().string()).add("entries", status.entries).add("head", status.head.toHex()).add("lost", status.lost);
    return json.add("detail", status.detail).text();
}

} // namespace liena::system
