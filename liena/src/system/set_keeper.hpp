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

    /// Starts a pool of one thread, or throws what is a std::exception.
    using Start = std::function<std::unique_ptr<boost::asio::thread_pool>()>;

    /// Without a store nothing can be learnt.
    SetKeeper(boost::asio::io_context& io, std::optional<LocalStore> store) : SetKeeper(io, std::move(store), startThread) {}
    SetKeeper(boost::asio::io_context& io, std::optional<LocalStore> store, Start start)
        : m_io(io), m_store(std::move(store)), m_start(std::move(start))
    {}
    ~SetKeeper() { finish(); }

    /// `done` is called on the network thread, not from here.
    void learn(DeviceId peer, const Sha256& hash, std::vector<std::byte> xml, Done done);

    /// Waits for what is being written.
    void finish();

private:
    static std::unique_ptr<boost::asio::thread_pool> startThread() { return std::make_unique<boost::asio::thread_pool>(1); }
    session::SetHeard keep(DeviceId peer, const Sha256& hash, const std::vector<std::byte>& xml);

    boost::asio::io_context& m_io;
    std::optional<LocalStore> m_store;
    Start m_start;
    std::unique_ptr<boost::asio::thread_pool> m_thread;
};

} // namespace liena::system
