// What other threads may see of the sessions: copies of one moment, written by the network thread.
#pragma once

#include "liena/message_set.hpp"
#include "liena/session_event.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace liena::cache {

class LinkBoard {
public:
    void show(const LinkStatus& status)
    {
        const std::lock_guard lock(m_mutex);
        m_links.insert_or_assign(status.peer, status);
    }

    std::vector<LinkStatus> links() const
    {
        const std::lock_guard lock(m_mutex);
        std::vector<LinkStatus> all;
        for (const auto& [peer, status] : m_links)
            all.push_back(status);
        return all;
    }

    /// Sessions that carry messages.
    std::size_t openLinks() const
    {
        const std::lock_guard lock(m_mutex);
        return static_cast<std::size_t>(
            std::count_if(m_links.begin(), m_links.end(), [](const auto& entry) { return carriesMessages(entry.second.state); }));
    }

    std::optional<LinkStatus> link(DeviceId peer) const
    {
        const std::lock_guard lock(m_mutex);
        const auto found = m_links.find(peer);
        return found != m_links.end() ? std::optional(found->second) : std::nullopt;
    }

    void showDrops(DeviceId peer, std::vector<DropCount> drops)
    {
        const std::lock_guard lock(m_mutex);
        m_drops.insert_or_assign(peer, std::move(drops));
    }

    std::vector<DropCount> drops(DeviceId peer) const
    {
        const std::lock_guard lock(m_mutex);
        const auto found = m_drops.find(peer);
        return found != m_drops.end() ? found->second : std::vector<DropCount>();
    }

    void showIncidents(std::vector<Incident> incidents)
    {
        const std::lock_guard lock(m_mutex);
        m_incidents = std::move(incidents);
    }

    std::vector<Incident> incidents() const
    {
        const std::lock_guard lock(m_mutex);
        return m_incidents;
    }

    bool standsBy() const
    {
        const std::lock_guard lock(m_mutex);
        return !m_incidents.empty();
    }

    void showSet(DeviceId device, std::shared_ptr<const MessageSet> set)
    {
        const std::lock_guard lock(m_mutex);
        m_sets.insert_or_assign(device, std::move(set));
    }

    /// Whether `set` is that of the device.
    bool hasSet(DeviceId device, const MessageSet& set) const
    {
        const std::lock_guard lock(m_mutex);
        const auto found = m_sets.find(device);
        return found != m_sets.end() && found->second && (found->second.get() == &set || found->second->hash() == set.hash());
    }

    std::shared_ptr<const MessageSet> set(DeviceId device) const
    {
        const std::lock_guard lock(m_mutex);
        const auto found = m_sets.find(device);
        return found != m_sets.end() ? found->second : nullptr;
    }

private:
    mutable std::mutex m_mutex;
    std::map<DeviceId, LinkStatus> m_links;
    std::map<DeviceId, std::vector<DropCount>> m_drops;
    std::vector<Incident> m_incidents;
    std::map<DeviceId, std::shared_ptr<const MessageSet>> m_sets;
};

} // namespace liena::cache
