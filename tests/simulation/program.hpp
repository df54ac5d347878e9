// One run of a device's program, from its start to its end: its clocks, its timers, and its turn to run.
#pragma once

#include "device_clock.hpp"
#include "network.hpp"

#include <functional>
#include <memory>
#include <utility>

namespace liena::simulation {

class Program {
public:
    Program(Network& network, const DeviceClock& clock, HostIndex host) : m_network(network), m_clock(clock), m_host(host) {}
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    HostIndex host() const { return m_host; }
    Network& network() { return m_network; }
    const DeviceClock& clock() const { return m_clock; }

    /// What this program can know of the time.
    session::Now now() const
    {
        const auto world = m_network.time().now();
        return {m_clock.mono(world), m_clock.wall(world)};
    }

    /// Later in the same moment, unless the program has ended by then.
    void post(std::function<void()> work)
    {
        m_network.time().after(Nanoseconds::zero(), [this, alive = std::weak_ptr(m_alive), work = std::move(work)]() mutable {
            if (!alive.expired())
                m_network.programs().whenRunning(m_host, std::move(work));
        });
    }

    /// Keeps what ended until nothing on the call stack needs it.
    void bury(std::shared_ptr<void> ended)
    {
        if (ended)
            post([ended = std::move(ended)] {});
    }

    /// Calls back once, at a moment of this program's monotonic clock.
    class Timer {
    public:
        explicit Timer(Program& program) : m_program(program) {}

        void at(Instant local, std::function<void()> callback)
        {
            m_armed = std::make_shared<std::function<void()>>(std::move(callback));
            auto& network = m_program.m_network;
            network.time().at(m_program.m_clock.worldAt(local), [&network, host = m_program.m_host, armed = std::weak_ptr(m_armed)] {
                if (armed.expired())
                    return;
                network.programs().whenRunning(host, [armed] {
                    if (const auto due = armed.lock())
                        (*due)();
                });
            });
        }
        void after(Nanoseconds delay, std::function<void()> callback) { at(m_program.now().mono + delay, std::move(callback)); }
        void cancel() { m_armed.reset(); }

    private:
        Program& m_program;
        std::shared_ptr<std::function<void()>> m_armed;
    };

private:
    Network& m_network;
    const DeviceClock& m_clock;
    HostIndex m_host;
    std::shared_ptr<int> m_alive = std::make_shared<int>(0);
};

} // namespace liena::simulation
