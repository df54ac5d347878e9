// Whose session a UDP packet belongs to, without asking every session of the device each time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>

namespace liena::system {

/// Network thread. It remembers who owned a token, and asks that one again each time: nobody has to tell it that a session begins or ends.
/// A token that nobody owns is not remembered, so strangers cannot fill it.
template <typename Module>
class PacketOwners {
public:
    /// `modules`: a container of pairs of which the second points to a Module. They outlive this object, or forget() was called. Null when
    /// no session has the token.
    template <typename Modules>
    Module* find(std::uint64_t token, const Modules& modules)
    {
        if (const auto known = m_owners.find(token); known != m_owners.end()) {
            if (known->second->owns(token))
                return known->second;
            m_owners.erase(known);
        }
        for (const auto& [peer, module] : modules)
            if (module->owns(token)) {
                remember(token, *module, modules.size());
                return &*module;
            }
        return nullptr;
    }

    void forget() { m_owners.clear(); }
    std::size_t size() const { return m_owners.size(); }

private:
    /// Sessions that are over leave their tokens here until there are as many as of living ones.
    void remember(std::uint64_t token, Module& module, std::size_t modules)
    {
        if (m_owners.size() >= 2 * modules)
            m_owners.clear();
        m_owners.emplace(token, &module);
    }

    std::unordered_map<std::uint64_t, Module*> m_owners;
};

} // namespace liena::system
