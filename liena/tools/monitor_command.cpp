// Attaches to the devices' sockets and shows what they say.
#include "monitor_command.hpp"

#include "monitor_page.hpp"

#include <liena/device_id.hpp>
#include <liena/log.hpp>
#include <liena/status.hpp>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

namespace liena::tools {

namespace {

struct MonitorOptions {
    std::string folder = statusFolder().string();
    std::vector<std::string> devices;
    bool json = false;
    bool once = false;
};

constexpr auto monitorFooter =
    "Every liena-device and console offers its status on a local socket in its user's run-time folder, readable by that user alone. The\n"
    "monitor only listens: it takes no part in the system, holds no link, sends nothing, and a device does not wait for it.\n\n"
    "LATENCY is the median of the last 200 ms, from the peer's clock to ours, with its uncertainty: half the least delay seen. A link\n"
    "whose latency is smaller than its uncertainty is as fast as can be told. MISSED counts heartbeats; UDP says whether the datagram "
    "path\n"
    "works both ways (if not, heartbeats and motion commands use TCP alone). docs/OPERATING.md says what each cause means.\n\n"
    "Examples:\n"
    "  liena monitor                        all devices of this user on this computer\n"
    "  liena monitor robot 0x40018208       some of them, by name or id\n"
    "  liena monitor --json --once | jq '.links[] | {peer, state}'\n\n"
    "Exit codes: 0 a device was seen, 1 none was there, 2 wrong use of the command line.";

constexpr int linesForOnce = 2;
constexpr std::size_t longestLine = 1024UL * 1024UL;

/// One device that is watched.
struct Watched {
    int socket = -1;
    std::string received;
    std::string line; ///< the newest whole one
    int lines = 0;
    JsonValue status;
};

class Monitor {
public:
    explicit Monitor(MonitorOptions options)
        : m_options(std::move(options)), m_live(!m_options.json && !m_options.once && isatty(STDOUT_FILENO) == 1)
    {}
    ~Monitor()
    {
        for (const auto& [file, one] : m_watched)
            ::close(one.socket);
    }

    int run()
    {
        attach();
        if (m_watched.empty()) {
            fmt::print(stderr,
                       "liena monitor: no device offers its status in {}. Start one as this user, or name its folder with --folder\n",
                       m_options.folder);
            return 1;
        }
        while (!m_watched.empty() && turn()) {
        }
        return m_seen ? 0 : 1;
    }

private:
    void attach()
    {
        std::error_code failure;
        for (const auto& entry : std::filesystem::directory_iterator(m_options.folder, failure))
            if (entry.path().extension() == ".sock" && !m_watched.contains(entry.path().string()))
                if (const int socket = connectTo(entry.path().string()); socket >= 0)
                    m_watched[entry.path().string()].socket = socket;
    }

    static int connectTo(const std::string& file)
    {
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        if (file.size() >= sizeof address.sun_path)
            return -1;
        std::copy(file.begin(), file.end(), address.sun_path);
        const int socket = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
        if (socket >= 0 && ::connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0)
            return socket;
        if (socket >= 0)
            ::close(socket); // what is left of a program that was killed
        return -1;
    }

    /// Waits for something to show; false when enough was shown.
    bool turn()
    {
        std::vector<pollfd> waits;
        for (const auto& [file, one] : m_watched)
            waits.push_back({one.socket, POLLIN, 0});
        constexpr int longestWait = 1500;
        if (::poll(waits.data(), waits.size(), longestWait) < 0 && errno != EINTR)
            return false;
        bool news = false;
        for (const auto& wait : waits)
            if (wait.revents != 0)
                news = read(wait.fd) || news;
        if (news && m_live)
            draw();
        if (m_options.once && allShown())
            return false;
        if (m_live)
            attach(); // devices that were started since
        return true;
    }

    bool read(int socket)
    {
        const auto at = std::find_if(m_watched.begin(), m_watched.end(), [&](const auto& entry) { return entry.second.socket == socket; });
        auto& one = at->second;
        char bytes[65536];
        const auto count = ::recv(socket, bytes, sizeof bytes, 0);
        if (count < 0 && errno == EINTR)
            return false;
        if (count <= 0 || one.received.size() > longestLine) {
            ::close(socket);
            m_watched.erase(at);
            return true;
        }
        one.received.append(bytes, static_cast<std::size_t>(count));
        bool news = false;
        for (auto end = one.received.find('\n'); end != std::string::npos; end = one.received.find('\n')) {
            one.line = one.received.substr(0, end);
            one.received.erase(0, end + 1);
            news = take(one) || news;
        }
        return news;
    }

    bool take(Watched& one)
    {
        auto status = JsonValue::parse(one.line);
        if (!status)
            return false;
        one.status = std::move(*status);
        ++one.lines;
        // The first line has no rates yet: who asks once gets the second.
        if (!isWanted(one.status) || (m_options.once && one.lines != linesForOnce))
            return false;
        m_seen = true;
        if (m_options.json)
            fmt::print("{}\n", one.line);
        else if (!m_live)
            fmt::print("{}\n", monitorPage(one.status));
        std::fflush(stdout);
        return true;
    }

    bool isWanted(const JsonValue& status) const
    {
        const auto& names = m_options.devices;
        const auto isNamed = [&](const std::string& name) { return name == status["device"].text() || name == status["id"].text(); };
        return names.empty() || std::any_of(names.begin(), names.end(), isNamed);
    }

    bool allShown() const
    {
        return std::all_of(m_watched.begin(), m_watched.end(), [](const auto& entry) { return entry.second.lines >= linesForOnce; });
    }

    void draw() const
    {
        std::string page = "\x1b[H\x1b[2J";
        for (const auto& [file, one] : m_watched)
            if (!one.status.isNull() && isWanted(one.status))
                page += monitorPage(one.status) + '\n';
        page += "Ctrl-C ends the monitor; the devices do not notice.\n";
        fmt::print("{}", page);
        std::fflush(stdout);
    }

    MonitorOptions m_options;
    bool m_live;
    bool m_seen = false;
    std::map<std::string, Watched> m_watched;
};

} // namespace

void addMonitorCommand(CLI::App& app, int& exitCode)
{
    const auto options = std::make_shared<MonitorOptions>();
    auto* command =
        app.add_subcommand("monitor", "Watch the sessions of this computer's devices: states, rates, latency, drops, incidents");
    command->footer(monitorFooter);
    command->add_option("DEVICE", options->devices, "Only these, by name or id as 0x40018208");
    command->add_option("--folder", options->folder, "Where the devices' sockets are")->capture_default_str();
    command->add_flag("--json", options->json, "One JSON object per device and second, as the devices write it");
    command->add_flag("--once", options->once, "Show each device once, with the rates of one second, and end");
    command->callback([options, &exitCode] { exitCode = Monitor(*options).run(); });
}

} // namespace liena::tools
