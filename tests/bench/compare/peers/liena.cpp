// peer_liena: LiENa's end, on its public headers; the topology in the files says which mode and which addresses.
#include "workloads/peer.hpp"

#include "liena/distributed_system.hpp"

#include <atomic>
#include <cstdio>
#include <future>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

namespace liena::compare {

namespace {

template <typename T>
T valueOf(Result<T> result)
{
    if (!result)
        throw std::runtime_error(result.error().what);
    if constexpr (!std::is_void_v<T>)
        return std::move(result.value());
}

Settings settingsOf(const Options& options)
{
    Settings settings;
    const auto pki = options.files / "pki";
    settings.device = options.role == Role::Client ? "near" : "far";
    settings.topology = options.files / "topology.xml";
    settings.registry = {options.files / "sets"};
    settings.store = options.files / ("store-" + settings.device);
    settings.certificate = pki / (settings.device + ".crt");
    settings.key = pki / (settings.device + ".key");
    settings.authority = pki / "ca.crt";
    settings.software = "comparison";
    settings.log = [](LogLevel, std::string_view) {};
    if (options.spins)
        settings.realTime.search = std::chrono::seconds(1); // the longest there is: messages come more often
    settings.realTime.attention = !options.asleep;
    settings.bulkWorkers = options.workers;
    return settings;
}

/// Subscribes and sends on the network thread, so that no message changes threads; frames may come from another.
class LienaLink final : public Transport {
public:
    explicit LienaLink(const Options& options)
        : m_client(options.role == Role::Client),
          m_command(options.packets ? "Nudge" : "Move"),
          m_echo(options.packets ? "Nudged" : "Moved"),
          m_frame(frameOf(options)),
          m_pixels(std::make_shared<const std::vector<std::byte>>(options.frameBytes)),
          m_system(valueOf(DistributedSystem::create(settingsOf(options)))),
          m_peer(m_system->topology().find(m_client ? "far" : "near")->id)
    {}

    void every(Nanoseconds period, std::function<void()> task) override { m_system->every(period, std::move(task)); }

    void run(LinkEvents& events) override
    {
        m_events = &events;
        subscribe();
        if (m_client)
            m_system->every(std::chrono::milliseconds(50), [this] { makeReady(); });
        m_system->start();
        m_ended.get_future().wait();
        m_system->stop();
    }

    void stop() override { m_ended.set_value(); }

    /// The client gives commands, the echo reports.
    void sendCommand(const Command& command) override
    {
        auto message = valueOf(m_client ? m_system->command(m_peer, m_command) : m_system->report(m_echo));
        message.set(numberField, command.stamp.number).set(sentField, command.stamp.sentNs);
        for (std::size_t i = 0; i < command.values.size(); ++i)
            message.set(bodyField + i, command.values[i]);
        tellRefusal(m_system->send(m_peer, std::move(message)));
    }

    void sendFrame(const Stamp& stamp) override
    {
        auto message = valueOf(m_system->report(streamOf(stamp) > 0 ? secondFrame : m_frame));
        message.set(numberField, stamp.number).set(sentField, stamp.sentNs).lend(bodyField, m_pixels, *m_pixels);
        tellRefusal(m_system->send(m_peer, std::move(message)));
    }

private:
    static constexpr std::string_view secondFrame = "SecondFrame"; ///< a number of its own, and so a lane

    // Places in the definitions of `Move`, `Nudge`, their echoes, `Frame`, `SecondFrame`, `State` and `Block`.
    static constexpr std::size_t numberField = 0;
    static constexpr std::size_t sentField = 1;
    static constexpr std::size_t bodyField = 2;

    static std::string_view frameOf(const Options& options)
    {
        if (options.workload != WorkloadKind::Load)
            return "Block";
        return options.status ? "State" : "Frame";
    }

    static Stamp stampOf(const Message& message) { return {message.get<std::uint64_t>(numberField), message.get<std::int64_t>(sentField)}; }

    /// Once: what is missing at the other end shows how often.
    void tellRefusal(const Result<void>& sent)
    {
        if (!sent && !m_refused.exchange(true))
            std::fprintf(stderr, "peer over LiENa: %s\n", sent.error().what.c_str());
    }

    void subscribe()
    {
        const auto command = [this](const Message& message) {
            Command received;
            received.stamp = stampOf(message);
            for (std::size_t i = 0; i < received.values.size(); ++i)
                received.values[i] = message.get<double>(bodyField + i);
            m_events->commandReceived(received);
        };
        const auto frame = [this](const Message& message) {
            m_events->frameReceived(stampOf(message), message.get<std::span<const std::byte>>(bodyField).size());
        };
        for (const auto& name : {m_command, m_echo})
            valueOf(m_system->subscribe(name, command));
        for (const auto name : {std::string_view("Frame"), secondFrame, std::string_view("State"), std::string_view("Block")})
            valueOf(m_system->subscribe(name, frame));
        m_system->subscribe([](const SessionEvent& event) { tell(event); });
    }

    /// What spoils a measurement.
    static void tell(const SessionEvent& event)
    {
        using Kind = SessionEvent::Kind;
        if (event.kind == Kind::Interrupted || event.kind == Kind::Lost || event.kind == Kind::MessagesDropped ||
            event.kind == Kind::LocalStall)
            std::fprintf(stderr, "peer over LiENa: %s %s\n", std::string(toString(event.kind)).c_str(), event.detail.c_str());
    }

    /// Opens the session as soon as the echo is there. Control messages are refused before its first heartbeat.
    void makeReady()
    {
        if (m_ready)
            return;
        const auto links = m_system->links();
        if (links.front().state == SessionState::Closed)
            (void)m_system->openChannel(m_peer);
        m_ready = links.front().state == SessionState::Open && links.front().clockOffset.has_value();
        if (m_ready)
            m_events->ready();
    }

    bool m_client;
    bool m_ready = false;
    std::atomic<bool> m_refused = false;
    LinkEvents* m_events = nullptr;
    std::string m_command;
    std::string m_echo;
    std::string_view m_frame;
    std::shared_ptr<const std::vector<std::byte>> m_pixels;
    std::unique_ptr<DistributedSystem> m_system;
    DeviceId m_peer;
    std::promise<void> m_ended;
};

} // namespace

} // namespace liena::compare

int main(int argc, char** argv)
{
    using namespace liena::compare;
    runPeer(argc, argv, "LiENa", [](const Options& options) { return std::make_unique<LienaLink>(options); });
}
