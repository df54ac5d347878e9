// The devices' reports as the console's values.
#include "link/translate.hpp"

#include <algorithm>

namespace console {

namespace {

template <std::size_t size>
std::array<double, size> reals(const liena::Message& message, std::string_view field)
{
    const auto values = message.get<std::vector<double>>(field);
    std::array<double, size> result{};
    std::copy_n(values.begin(), std::min(values.size(), size), result.begin());
    return result;
}

XrayGeometry geometry(const liena::Message& m)
{
    XrayGeometry value;
    value.primaryAngle = m.get<double>("primary_angle");
    value.secondaryAngle = m.get<double>("secondary_angle");
    value.sourceDetectorDistance = m.get<double>("source_detector_distance");
    value.sourceObjectDistance = m.get<double>("source_object_distance");
    return value;
}

void readMotion(const liena::Message& m, RobotStatus& status)
{
    status.guidewirePosition = m.get<double>("guidewire_position");
    status.guidewireAngle = m.get<double>("guidewire_angle");
    status.catheterPosition = m.get<double>("catheter_position");
    status.catheterAngle = m.get<double>("catheter_angle");
    status.guidewireVelocity = m.get<double>("guidewire_velocity");
    status.guidewireRotation = m.get<double>("guidewire_rotation");
    status.catheterVelocity = m.get<double>("catheter_velocity");
    status.catheterRotation = m.get<double>("catheter_rotation");
}

} // namespace

RobotStatus robotStatus(const liena::Message& m)
{
    RobotStatus status;
    status.state = m.get<RobotState>("state");
    status.permit = m.get<quint32>("permit");
    status.owner = m.get<quint32>("owner");
    status.engaged = m.get<bool>("engaged");
    status.holdConfirmed = m.get<bool>("hold_confirmed");
    status.holdSinceNs = m.get<std::uint64_t>("hold_since_ns");
    status.lastSequence = m.get<quint32>("last_sequence");
    status.appliedCommands = m.get<std::uint64_t>("applied_commands");
    status.refusedCommands = m.get<std::uint64_t>("refused_commands");
    readMotion(m, status);
    status.guidewireForce = m.get<double>("guidewire_force");
    status.guidewireTorque = m.get<double>("guidewire_torque");
    status.guidewireGripperClosed = m.get<bool>("guidewire_gripper_closed");
    status.catheterGripperClosed = m.get<bool>("catheter_gripper_closed");
    status.limitSwitches = m.get<quint16>("limit_switches");
    status.contrastRemaining = m.get<double>("contrast_remaining");
    status.emergencyStopToken = m.get<std::uint64_t>("emergency_stop_token");
    status.faultCode = m.get<quint16>("fault_code");
    status.clearance = m.get<Clearance>("clear_to_arm");
    return status;
}

DriveStatus driveStatus(const liena::Message& m)
{
    DriveStatus status;
    const auto enabled = reals<driveCount>(m, "enabled");
    std::transform(enabled.begin(), enabled.end(), status.enabled.begin(), [](double value) { return value != 0; });
    status.current = reals<driveCount>(m, "current");
    status.temperature = reals<driveCount>(m, "temperature");
    status.followingError = reals<driveCount>(m, "following_error");
    status.busVoltage = reals<driveCount>(m, "bus_voltage");
    return status;
}

TipPose tipPose(const liena::Message& m)
{
    TipPose pose;
    pose.valid = m.get<bool>("valid");
    pose.position = reals<3>(m, "position");
    pose.quaternion = reals<4>(m, "quaternion");
    pose.error = m.get<double>("error");
    return pose;
}

TravelLimits travelLimits(const liena::Message& m)
{
    const auto range = [&m](std::string_view field) {
        const auto ends = reals<2>(m, field);
        return TravelRange{ends[0], ends[1]};
    };
    return {{range("guidewire_soft"), range("guidewire_hard")}, {range("catheter_soft"), range("catheter_hard")}};
}

InjectionStatus injectionStatus(const liena::Message& m)
{
    InjectionStatus status;
    status.injection = m.get<quint32>("injection");
    status.delivered = m.get<double>("delivered");
    // The wire counts from 1.
    status.progress = static_cast<InjectionProgress>(std::clamp(m.get<int>("state"), 1, 5) - 1);
    status.reason = text(m.get<std::string_view>("reason"));
    return status;
}

ArmStatus armStatus(const liena::Message& m)
{
    ArmStatus status;
    status.positions = reals<6>(m, "positions");
    status.velocities = reals<6>(m, "velocities");
    status.torques = reals<6>(m, "torques");
    status.brake = m.get<bool>("brake");
    status.phase = m.get<ArmPhase>("state");
    status.holding = m.get<bool>("holding");
    status.refusedCommands = m.get<std::uint64_t>("refused_commands");
    return status;
}

AcquisitionStatus acquisitionStatus(const liena::Message& m)
{
    AcquisitionStatus status;
    status.mode = m.get<AcquisitionMode>("mode");
    status.beamOn = m.get<bool>("beam_on");
    status.tubeVoltage = m.get<double>("tube_voltage");
    status.tubeCurrent = m.get<double>("tube_current");
    status.pulseWidth = m.get<double>("pulse_width");
    status.pulseRate = m.get<double>("pulse_rate");
    status.fluoroscopyTime = m.get<double>("fluoroscopy_time");
    status.airKerma = m.get<double>("air_kerma");
    status.airKermaRate = m.get<double>("air_kerma_rate");
    status.doseAreaProduct = m.get<double>("dose_area_product");
    status.geometry = geometry(m);
    status.geometry.table = reals<3>(m, "table_position");
    status.framesAcquired = m.get<std::uint64_t>("frames_acquired");
    status.framesSent = m.get<std::uint64_t>("frames_sent");
    status.framesWithheld = m.get<std::uint64_t>("frames_withheld");
    return status;
}

std::shared_ptr<const XrayFrame> xrayFrame(std::shared_ptr<const liena::Message> message, Duration clockUncertainty)
{
    const auto& m = *message;
    auto frame = std::make_shared<XrayFrame>();
    frame->frame = m.get<quint32>("frame");
    frame->acquisition = m.get<quint32>("acquisition");
    frame->source = m.get<PictureSource>("source");
    frame->rows = m.get<int>("rows");
    frame->columns = m.get<int>("columns");
    frame->bitsStored = m.get<int>("bits_stored");
    frame->photometric = m.get<Photometric>("photometric");
    frame->encoding = m.get<PixelEncoding>("encoding");
    frame->quality = m.get<int>("quality");
    frame->intensity = m.get<IntensityRelationship>("pixel_intensity_relationship");
    frame->imagerPixelSpacing = m.get<double>("imager_pixel_spacing");
    frame->windowCentre = m.get<double>("window_centre");
    frame->windowWidth = m.get<double>("window_width");
    frame->geometry = geometry(m);
    frame->mask = m.get<bool>("mask");
    frame->rung = m.get<int>("rung");
    frame->rate = m.get<double>("rate");
    frame->askedRate = m.get<double>("asked_rate");
    frame->askedEncoding = m.get<PixelEncoding>("asked_encoding");
    frame->captureNs = m.get<std::uint64_t>("capture_ns");
    frame->arrival = m.arrival();
    // The way from the pulse to the sending is on one clock, the way from there to here on two that were compared. A capture time after the
    // sending is a lie or a fault: such a picture has no age that could be trusted.
    if (m.latency() && m.timestamp().ns >= frame->captureNs) {
        frame->beforeSending = Duration(static_cast<Duration::rep>(m.timestamp().ns - frame->captureNs));
        frame->ageAtArrival = *m.latency() + frame->beforeSending;
        frame->ageUncertainty = clockUncertainty;
    }
    frame->pixels = m.get<std::span<const std::byte>>("pixels");
    frame->encodedBytes = frame->pixels.size();
    frame->owner = std::move(message);
    return frame;
}

QString text(std::string_view utf8) { return QString::fromUtf8(utf8.data(), static_cast<qsizetype>(utf8.size())); }

} // namespace console
