// The one word that each state has, wherever it is shown.
#include "model/alarm_list.hpp"
#include "model/arm_state.hpp"
#include "model/device_node.hpp"
#include "model/event_log.hpp"
#include "model/link_state.hpp"
#include "model/operator_role.hpp"
#include "model/picture_state.hpp"
#include "model/report_title.hpp"
#include "model/robot_values.hpp"
#include "model/xray_frame.hpp"
#include "model/xray_state.hpp"

#include <QCoreApplication>

#include <array>

namespace console {

namespace {

struct Text {
    Q_DECLARE_TR_FUNCTIONS(console::Words)
};

/// The entry of a table at an enumerator; nothing for a value that the enumeration does not have.
template <typename Enum, std::size_t size>
QString at(const std::array<const char*, size>& table, Enum value, int first = 0)
{
    const auto place = static_cast<std::size_t>(static_cast<int>(value) - first);
    return place < size ? Text::tr(table.at(place)) : QString();
}

} // namespace

QString word(OperatorRole role)
{
    static constexpr std::array table{QT_TRANSLATE_NOOP("console::Words", "operator"), QT_TRANSLATE_NOOP("console::Words", "observer")};
    return at(table, role);
}

QString word(LinkState state)
{
    static constexpr std::array table{QT_TRANSLATE_NOOP("console::Words", "closed"),      QT_TRANSLATE_NOOP("console::Words", "opening"),
                                      QT_TRANSLATE_NOOP("console::Words", "open"),        QT_TRANSLATE_NOOP("console::Words", "suspect"),
                                      QT_TRANSLATE_NOOP("console::Words", "interrupted"), QT_TRANSLATE_NOOP("console::Words", "stand-by"),
                                      QT_TRANSLATE_NOOP("console::Words", "re-opening"),  QT_TRANSLATE_NOOP("console::Words", "closing")};
    return at(table, state);
}

QString word(PictureRole role)
{
    static constexpr std::array table{QT_TRANSLATE_NOOP("console::Words", "LIVE"), QT_TRANSLATE_NOOP("console::Words", "LAST IMAGE HOLD"),
                                      QT_TRANSLATE_NOOP("console::Words", "REVIEW"), QT_TRANSLATE_NOOP("console::Words", "ROADMAP")};
    return at(table, role);
}

QString word(DeviceKind kind)
{
    switch (kind) {
    case DeviceKind::Hand:
        return QStringLiteral("hand");
    case DeviceKind::Eye:
        return QStringLiteral("eye");
    case DeviceKind::Brain:
        return QStringLiteral("brain");
    case DeviceKind::Arm:
        return QStringLiteral("arm");
    case DeviceKind::Special:
        break;
    }
    return QStringLiteral("special");
}

DeviceKind kindOf(quint32 id)
{
    switch (id >> 29U) {
    case 0:
        return DeviceKind::Hand;
    case 1:
        return DeviceKind::Eye;
    case 2:
        return DeviceKind::Brain;
    case 3:
        return DeviceKind::Arm;
    default:
        return DeviceKind::Special;
    }
}

QString DeviceNode::idText() const { return QStringLiteral("0x%1").arg(id, 8, 16, QLatin1Char('0')); }

QString word(RobotState state)
{
    static constexpr std::array table{QT_TRANSLATE_NOOP("console::Words", "off"),     QT_TRANSLATE_NOOP("console::Words", "hold"),
                                      QT_TRANSLATE_NOOP("console::Words", "ready"),   QT_TRANSLATE_NOOP("console::Words", "armed"),
                                      QT_TRANSLATE_NOOP("console::Words", "engaged"), QT_TRANSLATE_NOOP("console::Words", "emergency stop"),
                                      QT_TRANSLATE_NOOP("console::Words", "fault")};
    return at(table, state);
}

QString faultText(quint16 code)
{
    static constexpr std::array table{QT_TRANSLATE_NOOP("console::Words", "no fault"), QT_TRANSLATE_NOOP("console::Words", "force stop"),
                                      QT_TRANSLATE_NOOP("console::Words", "drive fault"), QT_TRANSLATE_NOOP("console::Words", "watchdog"),
                                      QT_TRANSLATE_NOOP("console::Words", "command stream lost")};
    const auto text = at(table, code);
    return text.isEmpty() ? Text::tr("fault %1").arg(code) : text;
}

QString word(InjectionProgress progress)
{
    static constexpr std::array table{QT_TRANSLATE_NOOP("console::Words", "accepted"), QT_TRANSLATE_NOOP("console::Words", "running"),
                                      QT_TRANSLATE_NOOP("console::Words", "done"), QT_TRANSLATE_NOOP("console::Words", "stopped"),
                                      QT_TRANSLATE_NOOP("console::Words", "refused")};
    return at(table, progress);
}

QString word(AcquisitionMode mode)
{
    static constexpr std::array table{QT_TRANSLATE_NOOP("console::Words", "stop"), QT_TRANSLATE_NOOP("console::Words", "fluoroscopy"),
                                      QT_TRANSLATE_NOOP("console::Words", "acquisition"), QT_TRANSLATE_NOOP("console::Words", "spin")};
    return at(table, mode);
}

QString word(ArmPhase phase)
{
    static constexpr std::array table{QT_TRANSLATE_NOOP("console::Words", "off"), QT_TRANSLATE_NOOP("console::Words", "hold"),
                                      QT_TRANSLATE_NOOP("console::Words", "moving"), QT_TRANSLATE_NOOP("console::Words", "fault")};
    return at(table, phase);
}

QString word(PictureSource source)
{
    static constexpr std::array table{QT_TRANSLATE_NOOP("console::Words", "LIVE"), QT_TRANSLATE_NOOP("console::Words", "SIMULATED"),
                                      QT_TRANSLATE_NOOP("console::Words", "RECORDED")};
    return at(table, source, 1);
}

QString word(PictureCondition condition)
{
    static constexpr std::array table{QT_TRANSLATE_NOOP("console::Words", "NO PICTURE"), QT_TRANSLATE_NOOP("console::Words", "LIVE"),
                                      QT_TRANSLATE_NOOP("console::Words", "AGE UNKNOWN"), QT_TRANSLATE_NOOP("console::Words", "FROZEN"),
                                      QT_TRANSLATE_NOOP("console::Words", "LAST IMAGE HOLD")};
    return at(table, condition);
}

QString word(AlarmPriority priority)
{
    static constexpr std::array table{QT_TRANSLATE_NOOP("console::Words", "low"), QT_TRANSLATE_NOOP("console::Words", "medium"),
                                      QT_TRANSLATE_NOOP("console::Words", "high")};
    return at(table, priority);
}

QString word(LogKind kind)
{
    static constexpr std::array table{QT_TRANSLATE_NOOP("console::Words", "note"),     QT_TRANSLATE_NOOP("console::Words", "link"),
                                      QT_TRANSLATE_NOOP("console::Words", "permit"),   QT_TRANSLATE_NOOP("console::Words", "alarm"),
                                      QT_TRANSLATE_NOOP("console::Words", "operator"), QT_TRANSLATE_NOOP("console::Words", "trouble")};
    return at(table, kind);
}

QString reportTitle(const QString& message)
{
    static constexpr struct {
        const char* message;
        const char* title;
    } table[] = {
        {"RobotStatus", QT_TRANSLATE_NOOP("console::Words", "report of its state")},
        {"DriveStatus", QT_TRANSLATE_NOOP("console::Words", "report of its drives")},
        {"TravelLimits", QT_TRANSLATE_NOOP("console::Words", "limits of its axes")},
        {"TipPose", QT_TRANSLATE_NOOP("console::Words", "position of the tip")},
        {"AcquisitionStatus", QT_TRANSLATE_NOOP("console::Words", "report of beam and dose")},
        {"XrayFrame", QT_TRANSLATE_NOOP("console::Words", "picture")},
        {"ArmStatus", QT_TRANSLATE_NOOP("console::Words", "report of its state")},
    };
    for (const auto& row : table)
        if (message == QLatin1String(row.message))
            return Text::tr(row.title);
    return message;
}

} // namespace console
