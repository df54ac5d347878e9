// Sessions that last as long as a measurement, and the question to a device that runs.
#include "bench_run.hpp"

#include "bench_report.hpp"
#include "bench_watch.hpp"
#include "json_value.hpp"

#include <liena/certificates.hpp>
#include <liena/log.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <mutex>
#include <optional>
#include <utility>

#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

namespace liena::tools {

using namespace std::chrono_literals;
using Kind = SessionEvent::Kind;
using Clock = std::chrono::steady_clock;

namespace {

constexpr auto retryPause = 200ms;
constexpr auto endLimit = 2s;

/// What the network thread tells the one that waits.
class BenchNews {
public:
    explicit BenchNews(BenchWatch& watch) : m_watch(watch) {}

    void take(const SessionEvent& event, DeviceId peer)
    {
        if (event.peer != peer || (event.kind != Kind::Opened && event.kind != Kind::OpenFailed))
            return;
        {
            const std::lock_guard lock(m_mutex);
            m_opened = m_opened || event.kind == Kind::Opened;
            if (event.kind == Kind::OpenFailed)
                m_failed = event;
        }
        m_watch.ring();
    }
    void take(const Measurement& measurement)
    {
        {
            const std::lock_guard lock(m_mutex);
            m_done = measurement;
        }
        m_watch.ring();
    }

    bool isOpened() const
    {
        const std::lock_guard lock(m_mutex);
        return m_opened;
    }
    std::optional<SessionEvent> takeFailure()
    {
        const std::lock_guard lock(m_mutex);
        return std::exchange(m_failed, std::nullopt);
    }
    std::optional<Measurement> done() const
    {
        const std::lock_guard lock(m_mutex);
        return m_done;
    }

private:
    BenchWatch& m_watch;
    mutable std::mutex m_mutex;
    bool m_opened = false;
    std::optional<SessionEvent> m_failed;
    std::optional<Measurement> m_done;
};

/// It still closes what was before. A session that is open there is another's, and not to be asked for twice: the question itself makes
/// the peer doubt it.
bool passes(RejectReason reason) { return reason == RejectReason::Busy; }

std::string remedyFor(RejectReason reason, const std::string& peer)
{
    if (reason == RejectReason::AlreadyOpen)
        return "The program of this device runs, on another computer: measure there with --live";
    return fmt::format("`liena probe {}` says what stands between", peer);
}

Result<void> open(DistributedSystem& system, const TopologyDevice& peer, BenchWatch& watch, BenchNews& news, std::chrono::seconds limit)
{
    const auto deadline = Clock::now() + limit;
    (void)system.openChannel(peer.id); // the peer may have begun already
    while (!news.isOpened()) {
        auto until = deadline;
        if (const auto failed = news.takeFailure()) {
            if (!passes(failed->reason))
                return fail(Errc::NetworkFailure,
                            fmt::format("no session with {}: {}. {}", peer.name, failed->detail, remedyFor(failed->reason, peer.name)));
            until = Clock::now() + retryPause;
        }
        const auto outcome = watch.wait(until);
        if (outcome == BenchWatch::Outcome::Told)
            return fail(Errc::Stopped, "stopped before a session was open");
        if (outcome == BenchWatch::Outcome::TimedOut && Clock::now() >= deadline)
            return fail(Errc::NetworkFailure, fmt::format("no session with {} within {} s. {}", peer.name, limit.count(),
                                                          remedyFor(RejectReason::None, peer.name)));
        if (outcome == BenchWatch::Outcome::TimedOut)
            (void)system.openChannel(peer.id);
    }
    return ok();
}

Result<Measurement> measure(DistributedSystem& system, const TopologyDevice& peer, const MeasurementPlan& plan, BenchWatch& watch,
                            BenchNews& news)
{
    if (auto begun = system.measure(peer.id, plan, [&news](const Measurement& done) { news.take(done); }); !begun)
        return begun.as_failure();
    auto limit = Clock::time_point::max();
    while (!news.done()) {
        const auto outcome = watch.wait(limit);
        if (outcome == BenchWatch::Outcome::TimedOut)
            return fail(Errc::Stopped, "stopped");
        if (outcome == BenchWatch::Outcome::Told) {
            system.stopMeasuring(peer.id);
            limit = Clock::now() + endLimit;
        }
    }
    return *news.done();
}

Result<Measurement> measureWith(DistributedSystem& system, const TopologyDevice& peer, const MeasurementPlan& plan, BenchWatch& watch,
                                std::chrono::seconds limit)
{
    BenchNews news(watch);
    system.subscribe([&news, id = peer.id](const SessionEvent& event) { news.take(event, id); });
    system.start();
    auto opened = open(system, peer, watch, news, limit);
    auto measured = opened ? measure(system, peer, plan, watch, news) : Result<Measurement>(opened.as_failure());
    system.stop(); // in order: nobody is left to believe that this device was lost
    return measured;
}

/// A folder that goes with the object.
class PassingFolder {
public:
    PassingFolder()
    {
        auto name = (std::filesystem::temp_directory_path() / "liena-bench.XXXXXX").string();
        if (::mkdtemp(name.data()) != nullptr)
            m_path = name;
    }
    ~PassingFolder()
    {
        std::error_code ignored;
        if (!m_path.empty())
            std::filesystem::remove_all(m_path, ignored);
    }
    PassingFolder(const PassingFolder&) = delete;
    PassingFolder& operator=(const PassingFolder&) = delete;
    const std::filesystem::path& path() const { return m_path; }

private:
    std::filesystem::path m_path;
};

/// 0 when the kernel gives none. It is free again until a device takes it, a moment later.
std::uint16_t freePort()
{
    const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* general = reinterpret_cast<sockaddr*>(&address);
    const bool bound = ::bind(socket, general, size) == 0 && ::getsockname(socket, general, &size) == 0;
    ::close(socket);
    return bound ? ntohs(address.sin_port) : std::uint16_t{0};
}

std::string pairOf(const SystemTopology& topology, const TopologyDevice& from, const TopologyDevice& to)
{
    const auto& timing = topology.link(from.id, to.id)->timing;
    const auto us = [](std::chrono::nanoseconds time) { return std::chrono::duration_cast<std::chrono::microseconds>(time).count(); };
    auto xml = fmt::format("<topology xmlns=\"urn:liena:topology:1\" name=\"bench\" version=\"1.0\">\n"
                           "<timing heartbeat=\"{}us\" suspect=\"{}us\" lost=\"{}us\" reconnect=\"{}us\"/>\n<security mode=\"{}\"/>\n",
                           us(timing.heartbeat), us(timing.suspect), us(timing.lost), us(timing.reconnect),
                           topology.security() == SecurityMode::Tls ? "tls" : "none");
    for (const auto* device : {&from, &to})
        xml += fmt::format("<device name=\"{}\" id=\"{}\" message-set=\"{}\" host=\"127.0.0.1\" port=\"{}\"/>\n", device->name,
                           device->id.toString(), device->messageSet, freePort());
    return xml + fmt::format("<link between=\"{} {}\"/>\n</topology>\n", from.name, to.name);
}

Settings settingsIn(const std::filesystem::path& folder, const std::string& device, const std::vector<std::filesystem::path>& registry)
{
    Settings settings;
    settings.topology = folder / "topology.xml";
    settings.device = device;
    settings.registry = registry;
    settings.store = folder / ("sets-" + device);
    settings.certificate = folder / "pki" / (device + ".crt");
    settings.key = folder / "pki" / (device + ".key");
    settings.authority = folder / "pki" / "ca.crt";
    settings.software = "liena bench";
    settings.log = stderrLog(LogLevel::Error);
    return settings;
}

int connectTo(const std::filesystem::path& file)
{
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    const auto name = file.string();
    if (name.size() >= sizeof address.sun_path)
        return -1;
    std::copy(name.begin(), name.end(), address.sun_path);
    const int socket = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (socket >= 0 && ::connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0)
        return socket;
    ::close(socket);
    return -1;
}

/// The measurement, as soon as a whole line of `received` is one; `begun` turns true at the line that says so.
std::optional<Measurement> takeMeasurement(std::string& received, bool& begun)
{
    for (auto end = received.find('\n'); end != std::string::npos; end = received.find('\n')) {
        const auto json = JsonValue::parse(received.substr(0, end));
        received.erase(0, end + 1);
        begun = begun || (json && (*json)["measure"].text() == "begun");
        if (auto found = json ? measurementFrom((*json)["measurement"]) : std::nullopt)
            return found;
    }
    return std::nullopt;
}

Result<Measurement> awaitMeasurement(int socket, const std::string& device, std::chrono::seconds longest, BenchWatch& watch)
{
    constexpr auto answerLimit = 3s;
    constexpr std::size_t mostBytes = std::size_t{16} << 20U;
    std::string received;
    bool begun = false;
    const auto since = Clock::now();
    while (true) {
        const auto outcome = watch.wait(since + (begun ? longest : answerLimit), socket);
        if (outcome == BenchWatch::Outcome::Told)
            return fail(Errc::Stopped, fmt::format("stopped; {} ends the measurement", device));
        if (outcome == BenchWatch::Outcome::TimedOut && begun)
            return fail(Errc::NetworkFailure, fmt::format("{} did not end its measurement in time", device));
        if (outcome == BenchWatch::Outcome::TimedOut)
            return fail(Errc::Forbidden, fmt::format("{} answers no requests to measure: start it with --measure-on-request "
                                                     "(Settings::measureOnRequest), or measure before the procedure without --live",
                                                     device));
        char bytes[65536];
        const auto count = ::recv(socket, bytes, sizeof bytes, MSG_DONTWAIT);
        if (count == 0 || (count < 0 && errno != EAGAIN && errno != EINTR) || received.size() > mostBytes)
            return fail(Errc::NetworkFailure, fmt::format("{} closed its status socket", device));
        if (count > 0)
            received.append(bytes, static_cast<std::size_t>(count));
        if (auto found = takeMeasurement(received, begun))
            return std::move(*found);
    }
}

} // namespace

Result<Measurement> measureAsDevice(const BenchEnds& ends, const MeasurementPlan& plan)
{
    BenchWatch watch;
    auto system = DistributedSystem::create(ends.from);
    if (!system)
        return system.as_failure();
    const auto peer = system.value()->topology().device(ends.to);
    if (!peer)
        return peer.as_failure();
    return measureWith(*system.value(), peer.value(), plan, watch, ends.openLimit);
}

Result<Measurement> measureLocally(const SystemTopology& topology, const TopologyDevice& from, const TopologyDevice& to,
                                   const std::vector<std::filesystem::path>& registry, const MeasurementPlan& plan)
{
    BenchWatch watch;
    const PassingFolder folder;
    if (folder.path().empty())
        return fail(Errc::FileUnwritable, fmt::format("no folder for the moment can be made: {}", std::strerror(errno)));
    std::ofstream file(folder.path() / "topology.xml");
    if (!(file << pairOf(topology, from, to) << std::flush))
        return fail(Errc::FileUnwritable,
                    fmt::format("cannot write {}: {}", (folder.path() / "topology.xml").string(), std::strerror(errno)));
    const auto authority = CertificateAuthority::create(folder.path() / "pki", "liena bench", std::chrono::hours(72));
    if (!authority)
        return authority.as_failure();
    for (const auto* device : {&from, &to})
        if (auto issued = authority.value().issue(device->id, device->name, std::chrono::hours(48)); !issued)
            return issued.as_failure();
    auto there = DistributedSystem::create(settingsIn(folder.path(), to.name, registry));
    if (!there)
        return there.as_failure();
    there.value()->start();
    auto here = DistributedSystem::create(settingsIn(folder.path(), from.name, registry));
    if (!here)
        return here.as_failure();
    auto measured = measureWith(*here.value(), to, plan, watch, 10s);
    there.value()->stop();
    return measured;
}

Result<Measurement> measureLive(const LiveRequest& request)
{
    BenchWatch watch;
    const int socket = connectTo(request.socket);
    if (socket < 0)
        return fail(Errc::NetworkFailure,
                    fmt::format("{} does not run here as this user: nothing answers at {}. Name its folder with --folder", request.device,
                                request.socket.string()));
    const auto& line = request.order;
    const bool sent = ::send(socket, line.data(), line.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(line.size());
    const auto longest = 2 * request.whole + 10s;
    auto measured = sent ? awaitMeasurement(socket, request.device, longest, watch)
                         : Result<Measurement>(fail(Errc::NetworkFailure, request.device + " closed its status socket"));
    ::close(socket);
    return measured;
}

} // namespace liena::tools
