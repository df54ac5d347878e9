// From received messages to models.
#include "link/message_intake.hpp"

#include "link/translate.hpp"

#include <QDateTime>

#include <stdexcept>

namespace console {

bool MessageIntake::dispatch(const liena::Message& message)
{
    const auto& name = message.name();
    const auto at = message.arrival();
    if (name == "RobotStatus")
        m_models.instrument.receiveRobot(robotStatus(message), at);
    else if (name == "TipPose")
        m_models.instrument.receiveTip(tipPose(message), at);
    else if (name == "DriveStatus")
        m_models.instrument.receiveDrives(driveStatus(message), at);
    else if (name == "InjectionReport")
        m_models.instrument.receiveInjection(injectionStatus(message));
    else if (name == "AcquisitionStatus")
        m_models.xray.receive(acquisitionStatus(message), at);
    else if (name == "ArmStatus")
        m_models.arm.receive(armStatus(message), at);
    else
        return false;
    return true;
}

bool MessageIntake::take(const liena::Message& message)
{
    const auto sender = m_models.sessions.titleOf(message.origin().value());
    try {
        if (dispatch(message))
            return true;
        complain(QObject::tr("%1 is sent by %2 and not known to this console; it is not shown").arg(text(message.name()), sender));
    } catch (const std::logic_error& mistake) {
        complain(QObject::tr("%1 of %2 does not have the fields that this console knows (%3); compare the message sets")
                     .arg(text(message.name()), sender, text(mistake.what())));
    }
    return false;
}

void MessageIntake::complain(const QString& complaint)
{
    if (m_complained.contains(complaint))
        return;
    m_complained.insert(complaint);
    m_models.log.append(LogKind::Trouble, complaint, QDateTime::currentMSecsSinceEpoch());
}

} // namespace console
