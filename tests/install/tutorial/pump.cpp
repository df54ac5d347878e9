// A simulated syringe pump: it infuses only while fresh commands arrive under the permit that it gave last.
#include <liena/distributed_system.hpp>
#include <liena/message_binding.hpp>

#include <csignal>
#include <iostream>

using namespace std::chrono_literals;
using liena::SessionEvent;

struct Infuse {
    std::uint32_t permit = 0;
    float rate = 0; // mL/h
};
using InfuseBinding = liena::MessageBinding<Infuse, liena::Bind<"permit", &Infuse::permit>, liena::Bind<"rate", &Infuse::rate>>;

struct PumpStatus {
    std::uint32_t permit = 0;
    float rate = 0;    // mL/h
    double volume = 0; // mL
};
using StatusBinding = liena::MessageBinding<PumpStatus, liena::Bind<"permit", &PumpStatus::permit>, liena::Bind<"rate", &PumpStatus::rate>,
                                            liena::Bind<"volume", &PumpStatus::volume>>;

/// Every function runs on the network thread.
class Pump {
public:
    Pump(liena::DistributedSystem& system, const InfuseBinding& command, const StatusBinding& report)
        : m_system(system), m_command(command), m_report(report)
    {
        m_system.confirmHold(true);
    }

    void infuse(const liena::Message& command)
    {
        Infuse wanted;
        if (!m_command.read(command, wanted) || wanted.permit != m_now.permit)
            return; // of another message set, or meant for a time before the last stop
        if (wanted.rate == 0)
            return hold("the cockpit stopped it");
        if (wanted.rate != m_now.rate)
            std::cout << "infusing " << wanted.rate << " mL/h under permit " << wanted.permit << std::endl;
        m_now.rate = wanted.rate;
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
        if (m_now.rate > 0 && std::chrono::steady_clock::now() > m_leaseEnd)
            hold("no fresh command");
        m_now.volume += m_now.rate * 0.020 / 3600;
        if (++m_turns % 5 != 0)
            return;
        auto status = m_system.report("PumpStatus").value();
        m_report.write(m_now, status);
        m_system.publish(std::move(status));
    }

private:
    void hold(const char* why)
    {
        if (m_now.rate > 0) {
            std::cout << "holds: " << why << std::endl;
            ++m_now.permit; // what was commanded until now is over, whatever still arrives
        }
        m_now.rate = 0;
        m_system.confirmHold(true);
    }

    liena::DistributedSystem& m_system;
    InfuseBinding m_command;
    StatusBinding m_report;
    /// The permits begin with the time, so that none of before a restart comes again.
    PumpStatus m_now{.permit = static_cast<std::uint32_t>(liena::Timestamp::now().ns / 1'000'000'000)};
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
    const auto set = liena.messageSet(liena.self().id);
    const auto infuse = InfuseBinding::to(set, "Infuse");
    const auto status = StatusBinding::to(set, "PumpStatus");
    if (!infuse || !status) {
        std::cerr << "pump: " << (infuse ? status.error() : infuse.error()).what << '\n';
        return 1;
    }
    Pump pump(liena, infuse.value(), status.value());
    liena.subscribe("Infuse", [&](const liena::Message& command) { pump.infuse(command); }).value();
    liena.subscribe([&](const SessionEvent& event) { pump.hear(event); });
    liena.every(20ms, [&] { pump.work(); });
    liena.start();
    int signal = 0;
    sigwait(&ends, &signal);
    liena.stop();
}
