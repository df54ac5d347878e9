// A local socket on which other programs of the same user may watch: one line at once, and then one each second.
#pragma once

#include "liena/error.hpp"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

namespace liena::transport {

/// Has a thread of its own: neither a slow watcher nor a hundred of them reach the network thread. What a watcher sends is thrown away
/// unread, unless the owner takes requests.
class StatusServer {
public:
    static constexpr std::size_t mostWatchers = 8;
    static constexpr std::size_t longestRequest = 256; ///< bytes with its end; a watcher that sends more is let go

    /// A line to that watcher, if it is still there; any thread, while the server lives.
    using Reply = std::function<void(const std::string& line)>;

    /// One line of a watcher, on the server's thread; what it returns is called when the watcher leaves. One request per watcher.
    using Requests = std::function<std::function<void()>(const std::string& line, Reply reply)>;

    /// Makes the folder (mode 0700, this user's) and the socket (0600). `line` gives what is to be said, without the line's end; it is
    /// called on the server's thread while somebody watches.
    static Result<std::unique_ptr<StatusServer>> open(const std::filesystem::path& socket, std::function<std::string()> line,
                                                      Requests requests = nullptr);

    ~StatusServer(); ///< ends the thread and removes the socket
    StatusServer(const StatusServer&) = delete;
    StatusServer& operator=(const StatusServer&) = delete;

private:
    struct State;
    explicit StatusServer(std::unique_ptr<State> state);
    std::unique_ptr<State> m_state;
};

} // namespace liena::transport
