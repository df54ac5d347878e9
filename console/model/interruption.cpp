// The account's stages, and what of it is kept.
#include "model/interruption.hpp"

#include <algorithm>

namespace console {

namespace {

constexpr int mostNames = 8; // more links than a console has; names come from a file

/// Each part by itself: the X-ray system's report stays when the robot is silent.
void renew(SystemSnapshot& kept, const SystemSnapshot& fresh)
{
    if (fresh.robot) {
        kept.robot = fresh.robot;
        kept.robotAt = fresh.robotAt;
        kept.tip = fresh.tip;
        kept.drives = fresh.drives;
    }
    if (fresh.xray) {
        kept.xray = fresh.xray;
        kept.xrayAt = fresh.xrayAt;
        kept.picturesReceived = fresh.picturesReceived;
    }
}

} // namespace

InterruptionAccount::InterruptionAccount(QObject* parent) : QObject(parent) {}

void InterruptionAccount::note(const SystemSnapshot& present)
{
    if (m_stage == Stage::None)
        renew(m_before, present);
    m_present = present;
}

void InterruptionAccount::forgetOld(Instant since)
{
    if (m_before.robot && m_before.robotAt < since - beforeLimit) {
        m_before.robot.reset();
        m_before.tip.reset();
        m_before.drives.reset();
    }
    if (m_before.xray && m_before.xrayAt < since - beforeLimit)
        m_before.xray.reset();
}

void InterruptionAccount::begin(const QString& what, Instant since, qint64 sinceWallMs)
{
    if (m_stage == Stage::None) {
        forgetOld(since);
        m_sinceWallMs = sinceWallMs;
        m_lasted = {};
        m_losses = 0;
        m_lost.clear();
    }
    if (m_stage != Stage::Running) {
        m_lostSince = since;
        m_since = since;
        m_stage = Stage::Running;
    }
    ++m_losses;
    if (!what.isEmpty() && !m_lost.contains(what) && m_lost.size() < mostNames)
        m_lost << what;
    Q_EMIT changed();
}

void InterruptionAccount::end(Instant now)
{
    if (m_stage != Stage::Running)
        return;
    m_lasted += std::max(Duration::zero(), Duration(now - m_lostSince));
    m_stage = Stage::Unread;
    m_since = now;
    Q_EMIT changed();
}

bool InterruptionAccount::acknowledge(Instant now)
{
    if (!readable(now))
        return false;
    m_stage = Stage::None;
    m_since = now;
    // What is compared next time begins here.
    m_before = m_present;
    Q_EMIT changed();
    return true;
}

} // namespace console
