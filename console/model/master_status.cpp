// The one word that each master and each life of one has.
#include "model/master_status.hpp"

#include "model/motion_permit.hpp"

#include <QCoreApplication>

namespace console {

namespace {

struct Text {
    Q_DECLARE_TR_FUNCTIONS(console::MasterStatus)
};

} // namespace

bool masterMayChange(PermitPhase phase)
{
    return phase != PermitPhase::Arming && phase != PermitPhase::Armed && phase != PermitPhase::Engaged;
}

QString word(MasterKind kind)
{
    switch (kind) {
    case MasterKind::Keyboard:
        return Text::tr("Keyboard");
    case MasterKind::SpaceMouse:
        return Text::tr("3-D mouse");
    case MasterKind::GamePad:
        return Text::tr("Game pad");
    case MasterKind::HapticSimulated:
        return Text::tr("Haptic, SIMULATED");
    case MasterKind::Recorded:
        return Text::tr("RECORDED hand");
    }
    return {};
}

QString word(MasterLife life)
{
    switch (life) {
    case MasterLife::Gone:
        return Text::tr("gone");
    case MasterLife::Silent:
        return Text::tr("silent");
    case MasterLife::Unheard:
        return Text::tr("not heard");
    case MasterLife::Unreleased:
        return Text::tr("let go first");
    case MasterLife::Alive:
        return Text::tr("alive");
    }
    return {};
}

} // namespace console
