// From the library's values to the console's: every message and session value that the console understands.
#pragma once

#include "model/arm_state.hpp"
#include "model/incident.hpp"
#include "model/link_figures.hpp"
#include "model/robot_values.hpp"
#include "model/session_model.hpp"
#include "model/xray_frame.hpp"
#include "model/xray_state.hpp"

#include <liena/message.hpp>
#include <liena/session_event.hpp>
#include <liena/system_topology.hpp>

#include <memory>

namespace console {

// The message must be of the name that the function says. One whose set lacks a field throws std::logic_error: a set that was learnt from a
// peer may have the name and not the fields, so callers catch it where messages come in.
RobotStatus robotStatus(const liena::Message& message);
DriveStatus driveStatus(const liena::Message& message);
TipPose tipPose(const liena::Message& message);
TravelLimits travelLimits(const liena::Message& message);
InjectionStatus injectionStatus(const liena::Message& message);
ArmStatus armStatus(const liena::Message& message);
AcquisitionStatus acquisitionStatus(const liena::Message& message);

/// The frame keeps `message` and points into its pixels.
std::shared_ptr<const XrayFrame> xrayFrame(std::shared_ptr<const liena::Message> message, Duration clockUncertainty);

LinkState linkState(liena::SessionState state);
LossKind lossKind(liena::LossCause cause);
ProbeFinding probeFinding(liena::ProbeResult result);
LinkDiagnosis linkDiagnosis(const liena::Diagnosis& diagnosis);

/// How long a command that the robot's set declares may take there and back before it comes too old: a command is as old as the robot's
/// heartbeat that it echoes, which may have been here for a heartbeat's period.
Duration roundTripCarried(const liena::MessageDefinition& command, const liena::LinkTiming& timing);

/// Rates are of the time between the two readings; zero without a previous one.
LinkFigures linkFigures(const liena::LinkStatus& status, const liena::LinkStatus* previous, Duration between);

SessionModel::Topology topologyValues(const liena::SystemTopology& topology, liena::DeviceId self);

QString text(std::string_view utf8);

} // namespace console
