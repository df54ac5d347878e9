// Everything the console knows, in one place: what widgets show and the composition root feeds.
#pragma once

#include "model/alarm_list.hpp"
#include "model/alarm_log_model.hpp"
#include "model/alarm_self_test.hpp"
#include "model/arm_state.hpp"
#include "model/event_log.hpp"
#include "model/hand_state.hpp"
#include "model/incident_model.hpp"
#include "model/injection_order.hpp"
#include "model/instrument_state.hpp"
#include "model/interruption.hpp"
#include "model/operator_role.hpp"
#include "model/permit_model.hpp"
#include "model/picture_state.hpp"
#include "model/recorder_state.hpp"
#include "model/roadmap_state.hpp"
#include "model/session_model.hpp"
#include "model/trend_book.hpp"
#include "model/xray_state.hpp"

namespace console {

/// Owned by the composition root; outlives every widget.
struct ConsoleModels {
    SessionModel sessions;
    IncidentModel incidents;
    InterruptionAccount interruption;
    InstrumentState instrument;
    InjectionOrder injection;
    XraySystemState xray;
    ArmState arm;
    PictureState picture;
    RoadmapState roadmap;
    PermitModel permit;
    HandState hand;
    AlarmList alarms;
    AlarmLogModel alarmLog{alarms};
    AlarmSelfTest selfTest;
    RecorderState recorder;
    EventLog log;
    TrendBook trends;
    OperatorRole role = OperatorRole::Operator;
    bool screenGone = false; ///< the cockpit's own: the hand has no keys until a person clicks into the cockpit or presses F1
    QString unseen;          ///< why nobody sees this computer's screen, in words; empty: somebody may
    QString remoteInput;     ///< remoteInputOf() this session
    QString patientSide;     ///< how a person there is called; empty: not set up
};

} // namespace console
