// Which alarms a console shows now.
#pragma once

#include "theatre.hpp"

namespace console::test {

/// Null when there is none, or its cause has ended.
inline const Alarm* present(const Theatre& theatre, AlarmCondition condition)
{
    for (const auto& one : theatre.models().alarms.alarms())
        if (one.condition == condition && one.present)
            return &one;
    return nullptr;
}

inline bool isPresent(const Theatre& theatre, AlarmCondition condition, AlarmPriority priority)
{
    const auto* alarm = present(theatre, condition);
    return alarm != nullptr && alarm->priority == priority;
}

} // namespace console::test
