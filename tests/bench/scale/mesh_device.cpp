// Sessions with all others, questions in turn, and answers.
#include "scale/mesh_device.hpp"

#include "liena/distributed_system.hpp"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <future>
#include <iostream>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <type_traits>

namespace liena::bench {

namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using Kind = SessionEvent::Kind;

constexpr auto openingLimit = 120s;

template <typename T>
T valueOf(Result<T> result)
{
    if (!result)
        throw std::runtime_error(result.error().what);
    if constexpr (!std::is_void_v<T>)
        return std::move(result.value());
}

Settings settingsOf(const MeshDeviceOptions& options)
{
    Settings settings;
    settings.device = meshDeviceName(options.index);
    settings.topology = options.folder / "topology.xml";
    settings.registry = {options.folder / "sets"};
    settings.store = options.folder / ("store-" + settings.device);
    settings.certificate = options.folder / "pki" / (settings.device + ".crt");
    settings.key = options.folder / "pki" / (settings.device + ".key");
    settings.authority = options.folder / "pki" / "ca.crt";
    settings.software = "scale";
    settings.log = [](LogLevel, std::string_view) {};
    return settings;
}

class MeshDevice {
public:
    explicit MeshDevice(const MeshDeviceOptions& options)
        : m_options(options), m_system(valueOf(DistributedSystem::create(settingsOf(options))))
    {
        // Of each pair one end opens: the k-th neighbour to the right, up to half way round.
        for (std::size_t k = 1; k <= options.devices / 2; ++k)
            if (2 * k != options.devices || options.index < k)
                m_toOpen.push_back(idOf((options.index + k) % options.devices));
        for (std::size_t k = 1; k < options.devices; ++k)
            m_peers.push_back(idOf((options.index + k) % options.devices));
        m_system->subscribe([this](const SessionEvent& event) { heard(event); });
        valueOf(m_system->subscribe("Asked", [this](const Message& message) { answer(message); }));
        valueOf(m_system->subscribe("Answered", [this](const Message& message) { note(message); }));
        m_system->start();
        m_asker = std::jthread([this](const std::stop_token& stop) { askInTurn(stop); });
    }

    ~MeshDevice()
    {
        m_asker = {};
        m_system->stop();
    }
    MeshDevice(const MeshDevice&) = delete;
    MeshDevice& operator=(const MeshDevice&) = delete;

    void open()
    {
        const auto limit = Clock::now() + openingLimit;
        for (const auto peer : m_toOpen)
            while (!isUsable(peer) && Clock::now() < limit)
                openOnce(peer, limit);
        std::unique_lock lock(m_mutex);
        while (usable() < m_peers.size() && Clock::now() < limit)
            m_changed.wait_for(lock, 5ms);
        std::cout << "opened " << usable() << std::endl;
    }

    void ask(bool on)
    {
        {
            const std::lock_guard lock(m_askMutex);
            m_asking = on;
        }
        m_askChanged.notify_one();
        std::cout << "ok" << std::endl;
    }

    void tellCounts() const
    {
        std::uint64_t heartbeats = 0;
        std::uint64_t missed = 0;
        for (const auto& link : m_system->links()) {
            heartbeats += link.heartbeatsReceived;
            missed += link.heartbeatsMissed;
        }
        const auto now = std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
        std::cout << std::fixed << now << ' ' << usable() << ' ' << heartbeats << ' ' << missed << ' ' << m_troubles << ' ' << m_retries
                  << ' ' << m_asked << ' ' << m_heard << ' ' << m_answered << std::endl;
    }

    void tellLatencies()
    {
        std::promise<std::vector<std::int64_t>> taken;
        m_system->post([&] { taken.set_value(std::exchange(m_latencies, {})); });
        for (const auto latency : taken.get_future().get())
            std::cout << latency << ' ';
        std::cout << std::endl;
    }

private:
    // Places in the definitions of `Asked` and `Answered`.
    static constexpr std::size_t numberField = 0;
    static constexpr std::size_t sentField = 1;

    static std::int64_t nowNs() { return std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now().time_since_epoch()).count(); }

    DeviceId idOf(std::size_t index) const { return m_system->topology().find(meshDeviceName(index))->id; }

    /// Open, and a heartbeat was heard: a command would be taken.
    static bool isUsable(const LinkStatus& link) { return link.state == SessionState::Open && link.peerEpoch != 0; }

    bool isUsable(DeviceId peer) const
    {
        const auto links = m_system->links();
        return std::any_of(links.begin(), links.end(), [&](const LinkStatus& link) { return link.peer == peer && isUsable(link); });
    }

    std::size_t usable() const
    {
        const auto links = m_system->links();
        return static_cast<std::size_t>(std::count_if(links.begin(), links.end(), [](const LinkStatus& link) { return isUsable(link); }));
    }

    void openOnce(DeviceId peer, Clock::time_point limit)
    {
        std::unique_lock lock(m_mutex);
        const auto failed = m_failed;
        (void)m_system->openChannel(peer); // an attempt in hand is waited for as well
        while (!isUsable(peer) && m_failed == failed && Clock::now() < limit)
            m_changed.wait_for(lock, 5ms);
        m_retries += m_failed != failed ? 1U : 0U;
    }

    void heard(const SessionEvent& event)
    {
        const bool failed = event.kind == Kind::OpenFailed;
        const bool trouble = event.kind == Kind::Interrupted || event.kind == Kind::Lost || event.kind == Kind::MessagesDropped ||
                             event.kind == Kind::SendFailed || event.kind == Kind::LocalStall || event.to == SessionState::Suspect;
        if (!failed && !trouble && event.kind != Kind::Opened)
            return;
        if (trouble && m_troubles++ == 0)
            std::cerr << meshDeviceName(m_options.index) << ": " << toString(event.kind) << ' ' << event.detail << '\n';
        const std::lock_guard lock(m_mutex);
        m_failed += failed ? 1U : 0U;
        m_changed.notify_one();
    }

    /// On a thread of its own, as an application's control loop: the network thread has no timer of ours that would cost while nobody asks.
    void askInTurn(const std::stop_token& stop)
    {
        const auto period = std::chrono::nanoseconds(static_cast<std::int64_t>(1e9 / m_options.rate));
        auto due = Clock::now();
        std::unique_lock lock(m_askMutex);
        while (m_askChanged.wait(lock, stop, [this] { return m_asking; })) {
            lock.unlock();
            due = std::max(due + period, Clock::now());
            std::this_thread::sleep_until(due);
            m_system->post([this] { ask(); });
            lock.lock();
        }
    }

    void ask()
    {
        const auto peer = m_peers[m_next++ % m_peers.size()];
        auto message = valueOf(m_system->command(peer, "Asked"));
        message.set(numberField, m_asked + 1).set(sentField, nowNs());
        if (m_system->send(peer, std::move(message)))
            ++m_asked;
        else
            ++m_troubles;
    }

    void answer(const Message& asked)
    {
        ++m_heard;
        auto message = valueOf(m_system->report("Answered"));
        message.set(numberField, asked.get<std::uint64_t>(numberField)).set(sentField, asked.get<std::int64_t>(sentField));
        if (!m_system->send(asked.origin(), std::move(message)))
            ++m_troubles;
    }

    void note(const Message& answered)
    {
        m_latencies.push_back(nowNs() - answered.get<std::int64_t>(sentField));
        ++m_answered;
    }

    MeshDeviceOptions m_options;
    std::vector<DeviceId> m_toOpen;
    std::vector<DeviceId> m_peers;
    std::mutex m_mutex;
    std::condition_variable m_changed;
    std::size_t m_failed = 0;
    std::uint64_t m_retries = 0;
    std::atomic<std::uint64_t> m_troubles = 0;
    std::mutex m_askMutex;
    std::condition_variable_any m_askChanged;
    bool m_asking = false;
    std::atomic<std::uint64_t> m_asked = 0;
    std::atomic<std::uint64_t> m_heard = 0;
    std::atomic<std::uint64_t> m_answered = 0;

    // The network thread's
    std::size_t m_next = 0;
    std::vector<std::int64_t> m_latencies; ///< ns

    std::unique_ptr<DistributedSystem> m_system;
    std::jthread m_asker;
};

} // namespace

std::string meshDeviceName(std::size_t index) { return "d" + std::to_string(index); }

int runMeshDevice(const MeshDeviceOptions& options)
{
    MeshDevice device(options);
    std::cout << "ready" << std::endl;
    for (std::string word; std::getline(std::cin, word);) {
        if (word == "open")
            device.open();
        else if (word == "begin" || word == "end")
            device.ask(word == "begin");
        else if (word == "counts")
            device.tellCounts();
        else if (word == "latencies")
            device.tellLatencies();
    }
    return 0;
}

} // namespace liena::bench
