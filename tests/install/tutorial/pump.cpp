// A simulated syringe pump: it infuses only while fresh commands arrive under the permit that it gave last.
#include <liena/distributed_system.hpp>

#include <csignal>
#include <iostream>

using namespace std::chrono_literals;
using liena::SessionEvent;

/// Every function runs on the network thread.
class Pump {
public:
    explicit Pump(liena::DistributedSystem& system) : m_system(system) { m_system.confirmHold(true); }

    void infuse(const liena::Message& command)
    {
        if (command.get<std::uint32_t>("permit") != m_permit)
            return; // meant for a time before the last stop
        const auto rate = command.get<double>("rate");
        if (rate == 0)
            return hold("the cockpit stopped it");
        if (rate != m_rate)
            std::cout << "infusing " << rate << " mL/h under permit " << m_permit << std::endl;
        m_rate = rate;
        m_leaseEnd = std::chrono::steady_clock::now() + 300ms;
        m_system.confirmHold(false);
    }

    void hear(const SessionEvent& event)
    {
        if (event.kind == SessionEvent::Kind::StateChanged)
            std::cout << "session " << toString(event.from) << " -> " << toString(event.to) << std::endl;
        if (event.kind == SessionEvent::Kind::StateChanged && !carriesMessages(event.to))
            hold("the session is not open");
        if (event.kind == SessionEvent::Kind::StandByBegan)
            hold("the system stands by");
    }

    void work() // each 20 ms
    {
        if (m_rate > 0 && std::chrono::steady_clock::now() > m_leaseEnd)
            hold("no fresh command");
        m_volume += m_rate * 0.020 / 3600;
        if (++m_turns % 5 == 0)
            m_system.publish(m_system.report("PumpStatus").value().set("permit", m_permit).set("rate", m_rate).set("volume", m_volume));
    }

private:
    void hold(const char* why)
    {
        if (m_rate > 0) {
            std::cout << "holds: " << why << std::endl;
            ++m_permit; // what was commanded until now is over, whatever still arrives
        }
        m_rate = 0;
        m_system.confirmHold(true);
    }

    liena::DistributedSystem& m_system;
    /// Begins with the time, so that no permit of before a restart comes again.
    std::uint32_t m_permit = static_cast<std::uint32_t>(liena::Timestamp::now().ns / 1'000'000'000);
    double m_rate = 0;   // mL/h
    double m_volume = 0; // mL
    std::chrono::steady_clock::time_point m_leaseEnd;
    int m_turns = 0;
};

int main()
{
    sigset_t ends;
    sigemptyset(&ends);
    sigaddset(&ends, SIGINT);
    sigaddset(&ends, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &ends, nullptr); // before the network thread exists: then only sigwait gets them

    liena::Settings settings;
    settings.topology = "topology.xml";
    settings.device = "pump";
    settings.registry = {"devices"};
    settings.certificate = "pki/pump.crt";
    settings.key = "pki/pump.key";
    settings.authority = "pki/ca.crt";
    auto system = liena::DistributedSystem::create(settings);
    if (!system) {
        std::cerr << "pump: " << system.error().what << '\n';
        return 1;
    }
    auto& liena = *system.value();
    Pump pump(liena);
    liena.subscribe("Infuse", [&](const liena::Message& command) { pump.infuse(command); }).value();
    liena.subscribe([&](const SessionEvent& event) { pump.hear(event); });
    liena.every(20ms, [&] { pump.work(); });
    liena.start();
    int signal = 0;
    sigwait(&ends, &signal);
    liena.stop();
}
