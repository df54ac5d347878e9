// What a person calls a device's report.
#pragma once

#include <QString>

namespace console {

/// `report of its state` for RobotStatus; a message that another set has keeps its name.
QString reportTitle(const QString& message);

} // namespace console
