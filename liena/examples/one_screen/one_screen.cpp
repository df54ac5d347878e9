// Loads a topology, opens a channel to the robot, sends it one message and prints what comes back.
#include <liena/distributed_system.hpp>

#include <iostream>
#include <semaphore>

int main()
{
    liena::Settings settings;
    settings.topology = "topologies/cerebrovascular.xml";
    settings.device = "cockpit";
    settings.registry = {"resources/devices"};
    settings.certificate = "pki/cockpit.crt";
    settings.key = "pki/cockpit.key";
    settings.authority = "pki/ca.crt";
    std::binary_semaphore arrived{0};
    const auto system = liena::DistributedSystem::create(settings);
    if (!system) {
        std::cerr << system.error().what << '\n';
        return 1;
    }
    auto& liena = *system.value();
    liena.cache().setNotification([&] { arrived.release(); });
    liena.start();
    const auto robot = liena.topology().find("robot")->id;
    liena.openChannel(robot).value();
    for (int shown = 0; shown < 3;) {
        arrived.acquire();
        const auto [events, messages] = liena.cache().drain();
        for (const auto& event : events) {
            std::cout << toString(event.kind) << ' ' << event.detail << '\n';
            if (event.kind == liena::SessionEvent::Kind::Opened)
                liena.send(robot, liena.report("OperatorNote").value().set("text", "good morning")).value();
            if (event.kind == liena::SessionEvent::Kind::OpenFailed)
                return 1;
        }
        for (const auto& message : messages)
            std::cout << message.toString() << '\n', ++shown;
    }
}
