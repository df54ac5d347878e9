// A cockpit whose alarms are looked at when the test says so.
#pragma once

#include "app/alarm_watch.hpp"
#include "invented_cockpit.hpp"

#include <optional>

namespace console::test {

/// A cockpit with everything open, or just started, watched ten times a second.
struct Watched {
    InventedCockpit cockpit;
    AlarmWatch watch{cockpit.models, robotId};
    Instant now = cockpit.now;
    quint64 delivered = cockpit.models.picture.paintedCount();

    explicit Watched(bool open = true)
    {
        if (open)
            cockpit.openAll();
        look();
    }

    ConsoleModels& models() { return cockpit.models; }
    void look() { watch.update(now, delivered); }

    std::optional<AlarmPriority> priorityOf(AlarmCondition condition)
    {
        look();
        for (const auto& alarm : models().alarms.alarms())
            if (alarm.condition == condition && alarm.present)
                return alarm.priority;
        return std::nullopt;
    }

    /// Of the alarm that is present; 0 when there is none.
    quint64 idOf(AlarmCondition condition)
    {
        look();
        for (const auto& alarm : models().alarms.alarms())
            if (alarm.condition == condition && alarm.present)
                return alarm.id;
        return 0;
    }

    /// It is gone, and has been for as long as an end may take.
    bool ends(AlarmCondition condition)
    {
        look();
        now += AlarmList::longestEndDelay;
        return !priorityOf(condition);
    }

    RobotStatus robot() const { return cockpit.models.instrument.robot().value; }
    void receive(const RobotStatus& status) { models().instrument.receiveRobot(status, now); }

    void tell(PermitEventKind kind)
    {
        PermitEvent event;
        event.kind = kind;
        models().permit.apply(event, now);
    }

    /// It says so under a permit that nothing was armed by.
    void robotHolds()
    {
        auto status = robot();
        status.state = RobotState::Hold;
        status.holdConfirmed = true;
        status.permit = permitNumber + 1;
        receive(status);
        PermitEvent event;
        event.kind = PermitEventKind::RobotReported;
        event.robot = status.state;
        event.holdConfirmed = true;
        event.permit = status.permit;
        models().permit.apply(event, now);
    }

    template <typename Change>
    void figuresOf(quint32 peer, Change change)
    {
        auto figures = models().sessions.linkTo(peer)->figures;
        change(figures);
        models().sessions.setLinkFigures(peer, figures, now);
    }
};

} // namespace console::test
