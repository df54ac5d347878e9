// The one word that each state has, wherever it is shown.
#include "model/alarm_list.hpp"
#include "model/arm_state.hpp"
#include "model/device_node.hpp"
#include "model/event_log.hpp"
#include "model/link_state.hpp"
#include "model/picture_state.hpp"
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

QString word(LinkState state)
{
    static constexpr std::array table{QT_TR_NOOP("closed"),      QT_TR_NOOP("opening"),  QT_TR_NOOP("open"),       QT_TR_NOOP("suspect"),
                                      QT_TR_NOOP("interrupted"), QT_TR_NOOP("stand-by"), QT_TR_NOOP("re-opening"), QT_TR_NOOP("closing")};
    return at(table, state);
}

QString word(PictureRole role)
{
    static constexpr std::array table{QT_TR_NOOP("LIVE"), QT_TR_NOOP("LAST IMAGE HOLD"), QT_TR_NOOP("REVIEW")};
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
    static constexpr std::array table{QT_TR_NOOP("off"),     QT_TR_NOOP("hold"),           QT_TR_NOOP("ready"), QT_TR_NOOP("armed"),
                                      QT_TR_NOOP("engaged"), QT_TR_NOOP("emergency stop"), QT_TR_NOOP("fault")};
    return at(table, state);
}

QString faultText(quint16 code)
{
    static constexpr std::array table{QT_TR_NOOP("no fault"), QT_TR_NOOP("force stop"), QT_TR_NOOP("drive fault"), QT_TR_NOOP("watchdog"),
                                      QT_TR_NOOP("command stream lost")};
    const auto text = at(table, code);
    return text.isEmpty() ? Text::tr("fault %1").arg(code) : text;
}

QString word(InjectionProgress progress)
{
    static constexpr std::array table{QT_TR_NOOP("accepted"), QT_TR_NOOP("running"), QT_TR_NOOP("done"), QT_TR_NOOP("stopped"),
                                      QT_TR_NOOP("refused")};
    return at(table, progress);
}

QString word(AcquisitionMode mode)
{
    static constexpr std::array table{QT_TR_NOOP("stop"), QT_TR_NOOP("fluoroscopy"), QT_TR_NOOP("acquisition"), QT_TR_NOOP("spin")};
    return at(table, mode);
}

QString word(ArmPhase phase)
{
    static constexpr std::array table{QT_TR_NOOP("off"), QT_TR_NOOP("hold"), QT_TR_NOOP("moving"), QT_TR_NOOP("fault")};
    return at(table, phase);
}

QString word(PictureSource source)
{
    static constexpr std::array table{QT_TR_NOOP("LIVE"), QT_TR_NOOP("SIMULATED"), QT_TR_NOOP("RECORDED")};
    return at(table, source, 1);
}

QString word(PictureCondition condition)
{
    static constexpr std::array table{QT_TR_NOOP("NO PICTURE"), QT_TR_NOOP("LIVE"), QT_TR_NOOP("AGE UNKNOWN"), QT_TR_NOOP("FROZEN"),
                                      QT_TR_NOOP("LAST IMAGE HOLD")};
    return at(table, condition);
}

QString word(AlarmPriority priority)
{
    static constexpr std::array table{QT_TR_NOOP("low"), QT_TR_NOOP("medium"), QT_TR_NOOP("high")};
    return at(table, priority);
}

QString word(LogKind kind)
{
    static constexpr std::array table{QT_TR_NOOP("note"),  QT_TR_NOOP("link"),     QT_TR_NOOP("permit"),
                                      QT_TR_NOOP("alarm"), QT_TR_NOOP("operator"), QT_TR_NOOP("trouble")};
    return at(table, kind);
}

} // namespace console
