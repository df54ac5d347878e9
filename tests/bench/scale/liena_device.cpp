// A device of a mesh as an application has it: sessions with all others.
#include "scale/mesh_device.hpp"

#include "liena/distributed_system.hpp"

#include <algorithm>
#include <condition_variable>
#include <future>
#include <iostream>
#include <mutex>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace liena::bench {

namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using Kind = SessionEvent::Kind;

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

class LienaDevice final : public MeshDevice {
public:
    explicit LienaDevice(const MeshDeviceOptions& options)
        : MeshDevice(options), m_name(meshDeviceName(options.index)), m_system(valueOf(DistributedSystem::create(settingsOf(options))))
    {
        m_system->subscribe([this](const SessionEvent& event) { heard(event); });
        valueOf(m_system->subscribe("Asked", [this](const Message& message) { answer(message); }));
        valueOf(m_system->subscribe("Answered", [this](const Message& message) { note(message); }));
        m_system->start();
    }

    ~LienaDevice() override { m_system->stop(); }
    LienaDevice(const LienaDevice&) = delete;
    LienaDevice& operator=(const LienaDevice&) = delete;

    MeshCounts open() override
    {
        const auto limit = Clock::now() + openingLimit;
        for (const auto index : m_toOpen)
            while (!isUsable(idOf(index)) && Clock::now() < limit)
                openOnce(idOf(index), limit);
        std::unique_lock lock(m_mutex);
        while (usable() < m_peers.size() && Clock::now() < limit)
            m_changed.wait_for(lock, 5ms);
        return counts();
    }

    MeshCounts counts() override
    {
        auto all = tally();
        for (const auto& link : m_system->links()) {
            all.heartbeats += link.heartbeatsReceived;
            all.missed += link.heartbeatsMissed;
        }
        all.sessionEnds = usable();
        all.retries = m_retries;
        return all;
    }

    std::vector<std::int64_t> takeLatencies() override
    {
        std::promise<std::vector<std::int64_t>> taken;
        m_system->post([&] { taken.set_value(std::exchange(m_latencies, {})); });
        return taken.get_future().get();
    }

    void post(std::function<void()> work) override { m_system->post(std::move(work)); }

    void ask() override
    {
        const auto peer = idOf(m_peers[m_next++ % m_peers.size()]);
        auto message = valueOf(m_system->command(peer, "Asked"));
        message.set(numberField, m_asked + 1).set(sentField, nowNs());
        if (m_system->send(peer, std::move(message)))
            ++m_asked;
        else
            ++m_troubles;
    }

private:
    // Places in the definitions of `Asked` and `Answered`.
    static constexpr std::size_t numberField = 0;
    static constexpr std::size_t sentField = 1;

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
            std::cerr << m_name << ": " << toString(event.kind) << ' ' << event.detail << '\n';
        const std::lock_guard lock(m_mutex);
        m_failed += failed ? 1U : 0U;
        m_changed.notify_one();
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

    std::string m_name;
    std::mutex m_mutex;
    std::condition_variable m_changed;
    std::size_t m_failed = 0;
    std::uint64_t m_retries = 0;

    // The network thread's
    std::size_t m_next = 0;
    std::vector<std::int64_t> m_latencies; ///< ns

    std::unique_ptr<DistributedSystem> m_system;
};

} // namespace

std::unique_ptr<MeshDevice> lienaDevice(const MeshDeviceOptions& options) { return std::make_unique<LienaDevice>(options); }

} // namespace liena::bench
