// Measures sessions on this computer, TLS on: how long an opening takes, beside the two bare TLS handshakes that it contains, and how soon
// a silent peer is noticed. So that the machine's noise meets all of them alike: `session_bench --benchmark_enable_random_interleaving=true
// --benchmark_repetitions=10`.
#include "bare_handshake.hpp"
#include "child_process.hpp"
#include "percentiles.hpp"
#include "test_system.hpp"

#include <QCoreApplication>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

using namespace liena;
using namespace liena::test;
using Kind = SessionEvent::Kind;

namespace {

constexpr auto referenceTiming = R"(heartbeat="20ms" suspect="70ms" lost="110ms" reconnect="500ms")"; ///< of a real system
constexpr auto patience = std::chrono::seconds(10);

double milliseconds(std::chrono::nanoseconds span) { return std::chrono::duration<double, std::milli>(span).count(); }

TestSystem cockpitAndRobot(const std::string& timing = TestSystem::Options().timing)
{
    return {{reference::cockpit, reference::robot}, {"cockpit robot"}, {"tls", timing}};
}

auto isOf(Kind kind)
{
    return [kind](const SessionEvent& event) { return event.kind == kind; };
}

auto becomes(SessionState state)
{
    return [state](const SessionEvent& event) { return event.kind == Kind::StateChanged && event.to == state; };
}

/// A device whose events are waited for asleep: a thread that asks again and again would take a processor from what is measured.
class AwaitedDevice {
public:
    explicit AwaitedDevice(Settings settings)
        : m_device(std::move(settings),
                   [this](DistributedSystem& system) { system.subscribe([this](const SessionEvent& event) { note(event); }); })
    {}

    DistributedSystem* operator->() { return &*m_device; }

    /// The first event for which `wanted` holds of those that no call has passed yet; nothing when it does not come.
    template <typename Wanted>
    std::optional<SessionEvent> await(Wanted wanted)
    {
        const auto limit = std::chrono::steady_clock::now() + patience;
        std::unique_lock lock(m_mutex);
        while (m_came.wait_until(lock, limit, [this] { return !m_events.empty(); })) {
            const auto event = m_events.front();
            m_events.pop_front();
            if (wanted(event))
                return event;
        }
        return std::nullopt;
    }

private:
    void note(const SessionEvent& event)
    {
        const std::lock_guard lock(m_mutex);
        m_events.push_back(event);
        m_came.notify_one();
    }

    std::mutex m_mutex;
    std::condition_variable m_came;
    std::deque<SessionEvent> m_events;
    TestDevice m_device; ///< ends first: it uses the others
};

/// The times of one benchmark's iterations: their mean is Google Benchmark's own, their percentiles are counters beside it.
class IterationTimes {
public:
    explicit IterationTimes(benchmark::State& state) : m_state(state) {}

    void add(std::chrono::nanoseconds span)
    {
        m_state.SetIterationTime(std::chrono::duration<double>(span).count());
        m_milliseconds.push_back(milliseconds(span));
    }

    void tell()
    {
        m_state.counters["p50_ms"] = percentileOf(m_milliseconds, 0.50);
        m_state.counters["p99_ms"] = percentileOf(m_milliseconds, 0.99);
        m_state.counters["max_ms"] = percentileOf(m_milliseconds, 1.0);
    }

private:
    benchmark::State& m_state;
    std::vector<double> m_milliseconds;
};

/// From the request to Open: two connections, one each way, and the dialogue on them. Closing is not measured.
void openSession(benchmark::State& state)
{
    auto system = cockpitAndRobot();
    AwaitedDevice robot(system.settingsOf("robot"));
    AwaitedDevice cockpit(system.settingsOf("cockpit"));
    const auto peer = system.idOf("robot");
    IterationTimes times(state);
    for (auto _ : state) {
        const auto asked = cockpit->openChannel(peer);
        const auto opened = asked ? cockpit.await(isOf(Kind::Opened)) : std::nullopt;
        if (!opened)
            return state.SkipWithError("the devices did not open a session");
        times.add(opened->duration);
        const auto closed = cockpit->closeChannel(peer);
        if (!closed || !cockpit.await(becomes(SessionState::Closed)) || !robot.await(becomes(SessionState::Closed)))
            return state.SkipWithError("the devices did not close their session");
    }
    times.tell();
}
BENCHMARK(openSession)->UseManualTime()->Unit(benchmark::kMillisecond);

/// What no opening can be faster than by doing less of its own: two handshakes with the same certificates, one after the other.
void twoBareHandshakes(benchmark::State& state)
{
    auto system = cockpitAndRobot();
    BareHandshakes bare(system, "cockpit", "robot");
    IterationTimes times(state);
    for (auto _ : state) {
        const auto first = bare.next();
        times.add(first + bare.next());
    }
    times.tell();
}
BENCHMARK(twoBareHandshakes)->UseManualTime()->Unit(benchmark::kMillisecond);

/// From the moment at which the peer's process is frozen, so that nothing closes and nothing comes, to the loss; at the earliest after
/// `lost`, 110 ms, since it was heard last.
void noticeFrozenPeer(benchmark::State& state)
{
    IterationTimes times(state);
    for (auto _ : state) {
        auto system = cockpitAndRobot(referenceTiming);
        ChildProcess robot(QStringLiteral("liena-device"), QStringList{QStringLiteral("robot")} + system.argumentsOf("robot"));
        if (!robot.waitForLine(QStringLiteral("listening on")))
            return state.SkipWithError("the robot does not listen");
        AwaitedDevice cockpit(system.settingsOf("cockpit"));
        if (!cockpit->openChannel(system.idOf("robot")) || !cockpit.await(isOf(Kind::Opened)))
            return state.SkipWithError("the devices did not open a session");
        const auto frozen = std::chrono::steady_clock::now();
        robot.freeze();
        const auto lost = cockpit.await(becomes(SessionState::Reconnecting));
        if (!lost)
            return state.SkipWithError("nobody noticed that the robot is frozen");
        times.add(lost->at - frozen);
    }
    times.tell();
}
BENCHMARK(noticeFrozenPeer)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(20);

/// The largest time that this process was kept from running while nothing else happened: what the machine itself adds.
double largestStall()
{
    double largest = 0;
    auto last = std::chrono::steady_clock::now();
    const auto end = last + std::chrono::seconds(2);
    while (last < end) {
        const auto now = std::chrono::steady_clock::now();
        largest = std::max(largest, milliseconds(now - last));
        last = now;
    }
    return largest;
}

} // namespace

int main(int argc, char** argv)
{
    const QCoreApplication application(argc, argv);
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv))
        return 1;
    benchmark::AddCustomContext("largest_stall_ms", std::to_string(largestStall()));
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return 0;
}
