// The watchers' socket and its thread.
#include "transport/status_server.hpp"

#include "transport/close_on_exec.hpp"
#include "transport/timer.hpp"

#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/write.hpp>

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <list>
#include <string_view>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

namespace liena::transport {

namespace asio = boost::asio;
using asio::local::stream_protocol;
using namespace std::chrono_literals;

namespace {

constexpr auto period = 1s;

auto unusable(const std::filesystem::path& file, std::string_view reason)
{
    return fail(Errc::AddressUnavailable, fmt::format("no status for `liena monitor` at {}: {}", file.string(), reason));
}

/// A folder that others could write to would let them put a socket of theirs in its place.
Result<void> makeFolder(const std::filesystem::path& folder)
{
    std::error_code ignored;
    std::filesystem::create_directories(folder.parent_path(), ignored);
    if (::mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST)
        return unusable(folder, std::strerror(errno));
    struct stat status {};
    if (::lstat(folder.c_str(), &status) != 0)
        return unusable(folder, std::strerror(errno));
    if (!S_ISDIR(status.st_mode) || status.st_uid != ::geteuid() || (status.st_mode & 022U) != 0)
        return unusable(folder, fmt::format("it must be a folder of this program's user that no other may write to; run: chmod 700 {}",
                                            folder.string()));
    return ok();
}

/// A socket that a program left behind when it was killed; one that answers is another program's.
Result<void> removeDead(asio::io_context& io, const std::filesystem::path& file)
{
    struct stat status {};
    if (::lstat(file.c_str(), &status) != 0)
        return ok();
    if (!S_ISSOCK(status.st_mode))
        return unusable(file, "something else has that name; remove it");
    stream_protocol::socket trial(io);
    boost::system::error_code error;
    trial.connect(stream_protocol::endpoint(file.string()), error);
    if (!error)
        return unusable(file, "another program with this device's id runs and offers its status there");
    ::unlink(file.c_str());
    return ok();
}

} // namespace

struct StatusServer::State {
    struct Watcher {
        explicit Watcher(stream_protocol::socket accepted) : socket(std::move(accepted)) { closeOnExec(socket.native_handle()); }
        stream_protocol::socket socket;
        std::string line;    ///< on its way
        std::string reply;   ///< waits behind it
        std::string request; ///< so far
        bool requested = false;
        std::function<void()> gone; ///< of who was asked
        std::array<char, 64> bytes{};
    };

    State(std::filesystem::path socketFile, std::function<std::string()> makeLine, Requests takesRequests)
        : file(std::move(socketFile)), line(std::move(makeLine)), requests(std::move(takesRequests))
    {}

    Result<void> listen()
    {
        if (file.string().size() >= sizeof(sockaddr_un::sun_path))
            return unusable(file, "the path is too long for a local socket; choose a shorter folder");
        if (auto made = makeFolder(file.parent_path()); !made)
            return made;
        if (auto free = removeDead(io, file); !free)
            return free;
        boost::system::error_code error;
        acceptor.open(stream_protocol(), error);
        closeOnExec(acceptor.native_handle());
        if (!error)
            acceptor.bind(stream_protocol::endpoint(file.string()), error);
        if (!error && ::chmod(file.c_str(), 0600) != 0)
            error = {errno, boost::system::system_category()};
        if (!error)
            acceptor.listen(static_cast<int>(mostWatchers), error);
        if (error)
            return unusable(file, error.message());
        return ok();
    }

    void accept()
    {
        acceptor.async_accept([this](const boost::system::error_code& error, stream_protocol::socket socket) {
            if (error)
                return pause.after(period, [this] { accept(); });
            if (watchers.size() < mostWatchers) {
                auto watcher = std::make_shared<Watcher>(std::move(socket));
                watchers.push_back(watcher);
                say(watcher, line());
                hear(watcher);
                if (watchers.size() == 1)
                    beat();
            }
            accept();
        });
    }

    void beat()
    {
        pulse.after(period, [this] {
            if (watchers.empty())
                return;
            const auto text = line();
            for (const auto& watcher : std::list(watchers))
                say(watcher, text);
            beat();
        });
    }

    /// A watcher that has not taken its last line yet misses this one.
    void say(const std::shared_ptr<Watcher>& watcher, const std::string& text)
    {
        if (!watcher->line.empty())
            return;
        watcher->line = text + '\n';
        asio::async_write(watcher->socket, asio::buffer(watcher->line),
                          [this, watcher](const boost::system::error_code& error, std::size_t) {
                              watcher->line.clear();
                              if (error)
                                  watchers.remove(watcher);
                              else if (!watcher->reply.empty())
                                  say(watcher, std::exchange(watcher->reply, {}));
                          });
    }

    /// To notice that it has gone, and to take its request.
    void hear(const std::shared_ptr<Watcher>& watcher)
    {
        watcher->socket.async_read_some(asio::buffer(watcher->bytes),
                                        [this, watcher](const boost::system::error_code& error, std::size_t count) {
                                            if (!error && take(watcher, {watcher->bytes.data(), count}))
                                                return hear(watcher);
                                            boost::system::error_code ignored;
                                            watcher->socket.close(ignored);
                                            watchers.remove(watcher);
                                            if (auto gone = std::exchange(watcher->gone, nullptr))
                                                gone();
                                        });
    }

    /// False when it sent more than one request may have.
    bool take(const std::shared_ptr<Watcher>& watcher, std::string_view bytes)
    {
        if (!requests)
            return true;
        if (watcher->requested || watcher->request.size() + bytes.size() > longestRequest)
            return false;
        watcher->request += bytes;
        const auto end = watcher->request.find('\n');
        if (end == std::string::npos)
            return true;
        watcher->requested = true;
        watcher->request.resize(end);
        const auto reply = [this, asked = std::weak_ptr(watcher)](const std::string& text) {
            asio::post(io, [this, asked, text] {
                if (const auto there = asked.lock())
                    answer(there, text);
            });
        };
        watcher->gone = requests(watcher->request, reply);
        return true;
    }

    /// Unlike a line of the status, it is not missed by a watcher that is slow.
    void answer(const std::shared_ptr<Watcher>& watcher, const std::string& text)
    {
        if (watcher->line.empty())
            return say(watcher, text);
        watcher->reply += (watcher->reply.empty() ? "" : "\n") + text;
    }

    std::filesystem::path file;
    std::function<std::string()> line;
    Requests requests; ///< null: none are taken
    asio::io_context io{1};
    stream_protocol::acceptor acceptor{io};
    Timer pause{io};
    Timer pulse{io};
    std::list<std::shared_ptr<Watcher>> watchers;
    std::thread thread;
};

StatusServer::StatusServer(std::unique_ptr<State> state) : m_state(std::move(state)) {}

Result<std::unique_ptr<StatusServer>> StatusServer::open(const std::filesystem::path& socket, std::function<std::string()> line,
                                                         Requests requests)
{
    auto state = std::make_unique<State>(socket, std::move(line), std::move(requests));
    if (auto listening = state->listen(); !listening)
        return listening.as_failure();
    state->accept();
    state->thread = std::thread([raw = state.get()] { raw->io.run(); });
    return std::unique_ptr<StatusServer>(new StatusServer(std::move(state)));
}

StatusServer::~StatusServer()
{
    m_state->io.stop();
    m_state->thread.join();
    ::unlink(m_state->file.c_str());
}

} // namespace liena::transport
