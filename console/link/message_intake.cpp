// From received messages to models.
#include "link/message_intake.hpp"

#include "link/translate.hpp"

#include <QDateTime>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>

namespace console {

namespace {

struct Route {
    std::string_view message;
    DeviceKind from;
    void (*put)(ConsoleModels& models, const liena::Message& message);
};

constexpr std::array routes{
    Route{"RobotStatus", DeviceKind::Hand,
          [](ConsoleModels& models, const liena::Message& m) { models.instrument.receiveRobot(robotStatus(m), m.arrival()); }},
    Route{"TipPose", DeviceKind::Hand,
          [](ConsoleModels& models, const liena::Message& m) { models.instrument.receiveTip(tipPose(m), m.arrival()); }},
    Route{"DriveStatus", DeviceKind::Hand,
          [](ConsoleModels& models, const liena::Message& m) { models.instrument.receiveDrives(driveStatus(m), m.arrival()); }},
    Route{"TravelLimits", DeviceKind::Hand,
          [](ConsoleModels& models, const liena::Message& m) { models.instrument.receiveTravel(travelLimits(m)); }},
    Route{"InjectionReport", DeviceKind::Hand,
          [](ConsoleModels& models, const liena::Message& m) { models.instrument.receiveInjection(injectionStatus(m), m.arrival()); }},
    Route{"AcquisitionStatus", DeviceKind::Eye,
          [](ConsoleModels& models, const liena::Message& m) { models.xray.receive(acquisitionStatus(m), m.arrival()); }},
    Route{"ArmStatus", DeviceKind::Arm,
          [](ConsoleModels& models, const liena::Message& m) { models.arm.receive(armStatus(m), m.arrival()); }},
};

} // namespace

bool MessageIntake::take(quint32 origin, const liena::Message& message)
{
    const auto sender = m_models.sessions.titleOf(origin);
    const auto* route = std::find_if(routes.begin(), routes.end(), [&message](const Route& one) { return one.message == message.name(); });
    if (route == routes.end()) {
        complain(QObject::tr("%1 is sent by %2 and not known to this console; it is not shown").arg(text(message.name()), sender));
        return false;
    }
    const auto expected = m_models.sessions.firstPeer(route->from);
    if (expected != origin) {
        complain(expected ? QObject::tr("%1 of %2 is not shown: this console works with %3")
                                .arg(text(message.name()), sender, m_models.sessions.titleOf(*expected))
                          : QObject::tr("%1 of %2 is not shown: it is no device of that kind").arg(text(message.name()), sender));
        return false;
    }
    try {
        route->put(m_models, message);
        return true;
    } catch (const std::logic_error& mistake) {
        complain(QObject::tr("%1 of %2 does not have the fields that this console knows (%3); compare the message sets")
                     .arg(text(message.name()), sender, text(mistake.what())));
        return false;
    }
}

void MessageIntake::complain(const QString& complaint)
{
    if (m_complained.contains(complaint))
        return;
    m_complained.insert(complaint);
    m_models.log.append(LogKind::Trouble, complaint, QDateTime::currentMSecsSinceEpoch());
}

} // namespace console
