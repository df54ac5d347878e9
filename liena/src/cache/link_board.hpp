// What other threads may see of the sessions: copies of one moment, written by the network thread.
#pragma once

#include "cache/inheriting_mutex.hpp"
#include "liena/message_set.hpp"
#include "liena/session_event.hpp"

#include <algorithm>
#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

namespace liena::cache {

/// Under the lock pointers are exchanged and copied, nothing else: neither the network thread nor a reader ever waits while the other
/// copies figures or asks for memory.
class LinkBoard {
public:
    void show(const LinkStatus& status)
    {
        auto shown = std::make_shared<const LinkStatus>(status);
        const std::lock_guard lock(m_mutex);
        const auto [entry, isNew] = m_links.try_emplace(status.peer);
        entry->second.swap(shown); // what was shown before goes after the lock
        if (isNew)
            m_linkCount.store(m_links.size(), std::memory_order_relaxed);
    }

    std::vector<LinkStatus> links() const
    {
        std::vector<std::shared_ptr<const LinkStatus>> shown;
        shown.reserve(m_linkCount.load(std::memory_order_relaxed)); // all are shown before the network thread runs
        {
            const std::lock_guard lock(m_mutex);
            for (const auto& [peer, status] : m_links)
                shown.push_back(status);
        }
        std::vector<LinkStatus> all;
        all.reserve(shown.size());
        for (const auto& status : shown)
            all.push_back(*status);
        return all;
    }

    /// Sessions that carry messages.
    std::size_t openLinks() const
    {
        const std::lock_guard lock(m_mutex);
        return static_cast<std::size_t>(
            std::count_if(m_links.begin(), m_links.end(), [](const auto& entry) { return carriesMessages(entry.second->state); }));
    }

    std::optional<LinkStatus> link(DeviceId peer) const
    {
        const auto shown = copyOf(m_links, peer);
        return shown ? std::optional(*shown) : std::nullopt;
    }

    /// What decides whether a message may be sent, of one moment.
    struct SendFacts {
        std::shared_ptr<const MessageSet> set; ///< of the message's owner; null: not known
        SessionState state = SessionState::Closed;
        bool standsBy = false;
    };

    SendFacts sendFacts(DeviceId target, DeviceId owner) const
    {
        const std::lock_guard lock(m_mutex);
        const auto link = m_links.find(target);
        const auto set = m_sets.find(owner);
        return {set != m_sets.end() ? set->second : nullptr, link != m_links.end() ? link->second->state : SessionState::Closed,
                !m_incidents->empty()};
    }

    void showDrops(DeviceId peer, std::vector<DropCount> drops)
    {
        auto shown = std::make_shared<const std::vector<DropCount>>(std::move(drops));
        const std::lock_guard lock(m_mutex);
        m_drops[peer].swap(shown);
    }

    std::vector<DropCount> drops(DeviceId peer) const
    {
        const auto shown = copyOf(m_drops, peer);
        return shown ? *shown : std::vector<DropCount>();
    }

    void showIncidents(std::vector<Incident> incidents)
    {
        auto shown = std::make_shared<const std::vector<Incident>>(std::move(incidents));
        const std::lock_guard lock(m_mutex);
        m_incidents.swap(shown);
    }

    std::vector<Incident> incidents() const { return *incidentsShown(); }
    bool standsBy() const { return !incidentsShown()->empty(); }

    void showSet(DeviceId device, std::shared_ptr<const MessageSet> set)
    {
        const std::lock_guard lock(m_mutex);
        m_sets[device].swap(set);
    }

    std::shared_ptr<const MessageSet> set(DeviceId device) const { return copyOf(m_sets, device); }

private:
    template <typename T>
    using Shown = std::map<DeviceId, std::shared_ptr<const T>>;

    template <typename T>
    std::shared_ptr<const T> copyOf(const Shown<T>& shown, DeviceId device) const
    {
        const std::lock_guard lock(m_mutex);
        const auto found = shown.find(device);
        return found != shown.end() ? found->second : nullptr;
    }

    std::shared_ptr<const std::vector<Incident>> incidentsShown() const
    {
        const std::lock_guard lock(m_mutex);
        return m_incidents;
    }

    mutable InheritingMutex m_mutex;
    Shown<LinkStatus> m_links;
    std::atomic<std::size_t> m_linkCount = 0;
    Shown<std::vector<DropCount>> m_drops;
    std::shared_ptr<const std::vector<Incident>> m_incidents = std::make_shared<const std::vector<Incident>>(); ///< never null
    Shown<MessageSet> m_sets;
};

} // namespace liena::cache
