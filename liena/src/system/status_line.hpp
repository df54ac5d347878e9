// What a device says about itself to a monitor: one JSON object.
#pragma once

#include "audit/audit_log.hpp"
#include "cache/link_board.hpp"
#include "liena/system_topology.hpp"

#include <chrono>
#include <map>
#include <string>

namespace liena::system {

/// One thread. Rates are those since the line before.
class StatusLine {
public:
    using Instant = std::chrono::steady_clock::time_point;

    /// `audit` may be null. All must outlive this.
    StatusLine(const TopologyDevice& self, const SystemTopology& topology, std::string software, const cache::LinkBoard& board,
               audit::AuditLog* audit);

    std::string make(Instant now, std::chrono::system_clock::time_point wall);

private:
    std::string linkOf(const LinkStatus& link, Instant now);
    std::string rates(const LinkStatus& link, Instant now);
    std::string dropsOf(DeviceId peer) const;
    std::string incidents() const;
    std::string auditOf(Instant now) const;

    const TopologyDevice& m_self;
    const SystemTopology& m_topology;
    std::string m_software;
    const cache::LinkBoard& m_board;
    audit::AuditLog* m_audit;
    Instant m_begun = std::chrono::steady_clock::now();
    std::map<DeviceId, LinkStatus> m_before;
    Instant m_beforeAt;
};

} // namespace liena::system
