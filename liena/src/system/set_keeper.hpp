// Checks and keeps the message sets that peers send, away from the network thread: a disk may take longer than a heartbeat.
#pragma once

#include "session/session_machine.hpp"
#include "topology/local_store.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/thread_pool.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace liena::system {

/// Used on the network thread; the work is done on a thread of its own, which starts with the first set.
class SetKeeper {
public:
    using Done = std::function<void(session::SetHeard)>;

    /// Without a store nothing can be learnt.
    SetKeeper(boost::asio::io_context& io, std::optional<LocalStore> store) : m_io(io), m_store(std::move(store)) {}
    ~SetKeeper() { finish(); }

    /// `done` is called on the network thread.
    void learn(DeviceId peer, const Sha256& hash, std::vector<std::byte> xml, Done done);

    /// Waits for what is being written.
    void finish();

private:
    session::SetHeard keep(DeviceId peer, const Sha256& hash, const std::vector<std::byte>& xml);

    boost::asio::io_context& m_io;
    std::optional<LocalStore> m_store;
    std::unique_ptr<boost::asio::thread_pool> m_thread;
};

} // namespace liena::system
