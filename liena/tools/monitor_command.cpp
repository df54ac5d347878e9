// Attaches to the devices' sockets and shows what they say.
#include "monitor_command.hpp"

#include "monitor_page.hpp"
#include "refusal.hpp"
#include "report_file.hpp"

#include <liena/device_id.hpp>
#include <liena/log.hpp>
#include <liena/status.hpp>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
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
    "A device that says nothing for 3 s, as it is frozen or hangs, is named instead of its links; --once does not wait longer.\n"
    "Without --once the monitor goes on until Ctrl-C. A device that has gone is named (where no page is drawn, once on the\n"
    "error output), and watched again when it is back; so is one that is started later.\n\n"
    "Examples:\n"
    "  liena monitor                        all devices of this user on this computer\n"
    "  liena monitor robot 0x40018208       some of them, by name or id\n"
    "  liena monitor --json --once | jq '.links[] | {peer, state}'\n\n"
    "Exit codes: 0 a device was seen, 1 none was there or the output was not written, 2 wrong use of the\n"
    "command line.";

using Clock = std::chrono::steady_clock;

constexpr int linesForOnce = 2;
constexpr std::chrono::seconds longestSilence{3};         // a device speaks each second
constexpr std::chrono::milliseconds betweenAttaches{500}; // a device that lets nobody in is not asked without end
constexpr std::size_t longestLine = 1024UL * 1024UL;

/// One device that is watched.
struct Watched {
    int socket = -1; ///< -1: its program takes no connection, or has gone
    std::string id;
    Clock::time_point heard = Clock::now();
    std::string received;
    std::string line; ///< the newest whole one
    int lines = 0;
    bool gone = false; ///< it ended the connection, and has said nothing since
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
            if (one.socket >= 0)
                ::close(one.socket);
    }

    int run()
    {
        attach();
        if (m_watched.empty()) {
            fmt::print(stderr, "liena monitor: {}", noneText());
            return 1;
        }
        while ((!m_options.once || !m_watched.empty()) && turn()) {
        }
        if (!m_written)
            return refuse("monitor", m_written.error().what);
        tellUnknown();
        if (m_options.once)
            tellSilent();
        return m_seen ? 0 : 1;
    }

private:
    std::string noneText() const
    {
        return fmt::format("no device offers its status in {}. Start one as this user, or name its folder with --folder\n",
                           m_options.folder);
    }

    void attach()
    {
        m_attached = Clock::now();
        std::error_code failure;
        for (const auto& entry : std::filesystem::directory_iterator(m_options.folder, failure))
            if (entry.path().extension() == ".sock")
                attachTo(entry.path());
    }

    void attachTo(const std::filesystem::path& file)
    {
        const auto known = m_watched.find(file.string());
        if (known != m_watched.end() && known->second.socket >= 0)
            return;
        int failure = 0;
        const int socket = connectTo(file.string(), failure);
        // A frozen program's waiting list is full: it is there all the same, and has to be named.
        if (socket < 0 && failure != EAGAIN) {
            if (known != m_watched.end() && !known->second.gone)
                m_watched.erase(known);
            return;
        }
        auto& one = m_watched[file.string()];
        if (one.gone && socket >= 0)
            one.heard = Clock::now(); // its silence begins anew
        one.socket = socket;
        one.id = "0x" + file.stem().string();
    }

    /// -1 with the reason in `failure`; waits for nobody.
    static int connectTo(const std::string& file, int& failure)
    {
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        if (file.size() >= sizeof address.sun_path)
            return -1;
        std::copy(file.begin(), file.end(), address.sun_path);
        const int socket = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
        if (socket >= 0 && ::connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0)
            return socket;
        failure = errno;
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
        constexpr int longestWait = 500;
        if (::poll(waits.data(), waits.size(), longestWait) < 0 && errno != EINTR)
            return false;
        for (const auto& wait : waits)
            if (wait.revents != 0)
                read(wait.fd);
        if (m_live)
            draw(); // without news, too: a silence is some
        else
            tellUnknown();
        if (!m_written || (m_options.once && allShown()))
            return false;
        if (!m_options.once && Clock::now() - m_attached >= betweenAttaches)
            attach(); // devices that were started since, or again
        return true;
    }

    void read(int socket)
    {
        const auto at = std::find_if(m_watched.begin(), m_watched.end(), [&](const auto& entry) { return entry.second.socket == socket; });
        auto& one = at->second;
        char bytes[65536];
        const auto count = ::recv(socket, bytes, sizeof bytes, 0);
        if (count < 0 && (errno == EINTR || errno == EAGAIN))
            return;
        if (count <= 0 || one.received.size() > longestLine) {
            ::close(socket);
            if (m_options.once)
                m_watched.erase(at);
            else
                markGone(one);
            return;
        }
        one.received.append(bytes, static_cast<std::size_t>(count));
        for (auto end = one.received.find('\n'); end != std::string::npos; end = one.received.find('\n')) {
            one.line = one.received.substr(0, end);
            one.received.erase(0, end + 1);
            take(one);
        }
    }

    void markGone(Watched& one)
    {
        one.socket = -1;
        one.received.clear();
        if (!m_live && !one.gone && isWanted(one))
            fmt::print(stderr, "liena monitor: {}", gonePage(one.status, one.id));
        one.gone = true;
    }

    void take(Watched& one)
    {
        auto status = JsonValue::parse(one.line);
        if (!status)
            return;
        one.status = std::move(*status);
        one.heard = Clock::now();
        one.gone = false;
        ++one.lines;
        // The first line has no rates yet: who asks once gets the second.
        if (!isWanted(one) || (m_options.once && one.lines != linesForOnce))
            return;
        m_seen = true;
        if (!m_live && m_written) // a log that has holes is none: what is not written ends the monitor
            m_written = printReport((m_options.json ? one.line : monitorPage(one.status)) + '\n');
    }

    bool isWanted(const Watched& one) const
    {
        const auto& names = m_options.devices;
        return names.empty() || std::any_of(names.begin(), names.end(), [&](const std::string& name) { return isCalled(one, name); });
    }
    static bool isCalled(const Watched& one, const std::string& name)
    {
        return name == one.id || name == one.status["device"].text() || name == one.status["id"].text();
    }

    static std::chrono::seconds silenceOf(const Watched& one)
    {
        return std::chrono::duration_cast<std::chrono::seconds>(Clock::now() - one.heard);
    }
    static bool isSilent(const Watched& one) { return silenceOf(one) >= longestSilence; }

    /// Of everyone who speaks; until its first line, a device may be the one that was asked for by name.
    bool allShown() const
    {
        return std::all_of(m_watched.begin(), m_watched.end(), [this](const auto& entry) {
            const Watched& one = entry.second;
            return one.lines >= linesForOnce || isSilent(one) || (one.lines > 0 && !isWanted(one));
        });
    }

    /// Of those asked for; beside JSON it is no line of the output.
    void tellSilent() const
    {
        for (const auto& [file, one] : m_watched)
            if (one.lines < linesForOnce && isWanted(one))
                fmt::print(m_options.json ? stderr : stdout, "{}", silentPage(one.status, one.id, silenceOf(one)));
    }

    /// A line for each name that was given and nobody has; nothing before all have told theirs, or are silent.
    std::string unknownText() const
    {
        std::vector<std::string> there;
        for (const auto& [file, one] : m_watched) {
            if (one.lines == 0 && !isSilent(one))
                return {};
            const auto name = printable(one.status["device"].text());
            there.push_back(name.empty() ? one.id : name);
        }
        const auto others =
            there.empty() ? std::string() : fmt::format("; there {} {}", there.size() == 1 ? "is" : "are", fmt::join(there, ", "));
        std::string text;
        for (const auto& name : m_options.devices)
            if (std::none_of(m_watched.begin(), m_watched.end(), [&](const auto& entry) { return isCalled(entry.second, name); }))
                text += fmt::format("no device '{}' offers its status in {}{}\n", printable(name), m_options.folder, others);
        return text;
    }

    /// Once: where nothing is drawn, a device that comes later is heard.
    void tellUnknown()
    {
        if (m_live || m_unknownTold)
            return;
        const auto text = unknownText();
        m_unknownTold = !text.empty();
        fmt::print(stderr, "{}", text);
    }

    static std::string pageOf(const Watched& one)
    {
        if (one.gone && (one.socket < 0 || !isSilent(one)))
            return gonePage(one.status, one.id) + '\n';
        if (isSilent(one))
            return silentPage(one.status, one.id, silenceOf(one)) + '\n';
        return one.status.isNull() ? std::string() : monitorPage(one.status) + '\n';
    }

    void draw() const
    {
        std::string page = "\x1b[H\x1b[2J";
        for (const auto& [file, one] : m_watched)
            if (isWanted(one))
                page += pageOf(one);
        page += m_watched.empty() ? noneText() : unknownText();
        page += "Ctrl-C ends the monitor; the devices do not notice.\n";
        fmt::print("{}", page);
        std::fflush(stdout);
    }

    MonitorOptions m_options;
    bool m_live;
    bool m_seen = false;
    Result<void> m_written = ok();
    bool m_unknownTold = false;
    Clock::time_point m_attached{};
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
