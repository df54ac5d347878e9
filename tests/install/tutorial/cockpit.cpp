// The other side of the pump: a person types what it shall do.
#include <liena/distributed_system.hpp>

#include <iostream>
#include <sstream>

using namespace std::chrono_literals;
using liena::SessionEvent;

/// Every function runs on the network thread.
class Cockpit {
public:
    explicit Cockpit(liena::DistributedSystem& system) : m_system(system), m_pump(system.topology().device("pump").value().id) {}

    void obey(const std::string& line)
    {
        std::istringstream words(line);
        std::string verb;
        words >> verb;
        liena::Result<void> result = liena::ok();
        if (verb == "open") {
            result = m_system.openChannel(m_pump);
        } else if (verb == "reopen") {
            result = m_system.reopenChannel(m_pump);
        } else if (verb == "start") {
            double rate = 0;
            words >> rate;
            m_permit = m_shownPermit; // only a person takes up the permit that the pump offers
            result = infuse(rate);
            m_rate = result ? rate : 0;
        } else if (verb == "stop") {
            result = infuse(0);
            m_rate = 0;
        } else {
            std::cout << "open, reopen, start RATE, stop\n";
        }
        if (!result)
            std::cout << verb << " refused: " << result.error().what << std::endl;
    }

    void hear(const SessionEvent& event)
    {
        if (event.kind == SessionEvent::Kind::StateChanged) {
            std::cout << "session " << toString(event.from) << " -> " << toString(event.to) << std::endl;
            if (!carriesMessages(event.to))
                m_rate = 0; // only a new "start" begins again
        } else if (event.kind == SessionEvent::Kind::Lost) {
            std::cout << "lost: " << explain(event.diagnosis.cause) << std::endl;
        } else if (event.kind != SessionEvent::Kind::SendFailed) {
            std::cout << toString(event.kind) << ' ' << event.message << event.detail << std::endl;
        }
    }

    void show(const liena::Message& status)
    {
        m_shownPermit = status.get<std::uint32_t>("permit");
        const auto rate = status.get<double>("rate");
        if (rate != m_shownRate)
            std::cout << status.toString() << std::endl;
        m_shownRate = rate;
        if (m_permit != m_shownPermit)
            m_rate = 0; // the pump held in the meantime
    }

    void work() // each 50 ms
    {
        if (m_rate > 0 && !infuse(m_rate))
            m_rate = 0;
    }

private:
    liena::Result<void> infuse(double rate)
    {
        auto command = m_system.command(m_pump, "Infuse");
        if (!command)
            return command.as_failure();
        return m_system.send(m_pump, command.value().set("permit", m_permit).set("rate", rate));
    }

    liena::DistributedSystem& m_system;
    liena::DeviceId m_pump;
    std::uint32_t m_permit = 0;      // of the last start
    std::uint32_t m_shownPermit = 0; // of the newest status
    double m_rate = 0;               // mL/h, commanded
    double m_shownRate = 0;          // mL/h, reported
};

int main()
{
    liena::Settings settings;
    settings.topology = "topology.xml";
    settings.device = "cockpit";
    settings.registry = {"devices"};
    settings.certificate = "pki/cockpit.crt";
    settings.key = "pki/cockpit.key";
    settings.authority = "pki/ca.crt";
    auto system = liena::DistributedSystem::create(settings);
    if (!system) {
        std::cerr << "cockpit: " << system.error().what << '\n';
        return 1;
    }
    auto& liena = *system.value();
    Cockpit cockpit(liena);
    liena.subscribe("PumpStatus", [&](const liena::Message& status) { cockpit.show(status); }).value();
    liena.subscribe([&](const SessionEvent& event) { cockpit.hear(event); });
    liena.every(50ms, [&] { cockpit.work(); });
    liena.start();
    liena.post([&] { cockpit.obey("open"); });
    for (std::string line; std::getline(std::cin, line);)
        liena.post([&cockpit, line] { cockpit.obey(line); });
    liena.stop();
}
