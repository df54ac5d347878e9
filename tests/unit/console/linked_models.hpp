// The models of a console that is linked with a robot, an arm and an X-ray system, as its topology has them.
#pragma once

#include "model/console_models.hpp"

#include <liena/device_id.hpp>

namespace console::test {

inline const liena::DeviceId cockpit(0x40018208);
inline const liena::DeviceId robot(0x00008208);
inline const liena::DeviceId arm(0x60008208);
inline const liena::DeviceId xray(0x20010208);

inline void fill(ConsoleModels& models)
{
    SessionModel::Topology topology;
    const auto add = [&topology](liena::DeviceId id, const char* title, bool self) {
        DeviceNode node;
        node.id = id.value();
        node.title = QString::fromLatin1(title);
        node.self = self;
        topology.devices.push_back(node);
    };
    add(cockpit, "Cockpit", true);
    add(robot, "Robot", false);
    add(arm, "Arm", false);
    add(xray, "X-ray", false);
    topology.links = {
        {robot.value(), cockpit.value()}, {arm.value(), cockpit.value()}, {xray.value(), cockpit.value()}, {robot.value(), arm.value()}};
    models.sessions.setTopology(topology);
}

} // namespace console::test
