// What a roadmap does not survive.
#include "model/roadmap_state.hpp"

#include <QDateTime>

#include <algorithm>
#include <cmath>

namespace console {

namespace {

constexpr double tableStep = 0.1; ///< mm, from which on it is another place

/// Negated, so that a number that is none counts as a movement.
bool moved(double before, double now, double tolerance) { return !(std::abs(now - before) <= tolerance); }

/// Around the circle: 179 and -179 degrees are two apart.
bool turned(double before, double now) { return moved(0, std::remainder(now - before, 360), RoadmapState::angleTolerance); }

bool differ(const std::array<double, 3>& one, const std::array<double, 3>& other, double tolerance)
{
    return moved(one[0], other[0], tolerance) || moved(one[1], other[1], tolerance) || moved(one[2], other[2], tolerance);
}

} // namespace

RoadmapState::RoadmapState(QObject* parent) : QObject(parent) {}

void RoadmapState::begin(const RoadmapBasis& basis)
{
    m_basis = basis;
    m_reason.clear();
    m_displaced = 0;
    Q_EMIT changed();
    checkTable();
}

void RoadmapState::end()
{
    if (!m_basis)
        return;
    m_basis.reset();
    m_reason.clear();
    Q_EMIT changed();
}

QString RoadmapState::line() const
{
    if (!m_basis)
        return {};
    if (!m_reason.isEmpty())
        return tr("ROADMAP REMOVED: %1").arg(m_reason);
    const auto taken = QDateTime::fromMSecsSinceEpoch(static_cast<qint64>(m_basis->lastNs / 1'000'000));
    return tr("Vessels of %1, run %2").arg(taken.toString(QStringLiteral("HH:mm:ss"))).arg(m_basis->about.acquisition);
}

void RoadmapState::checkPicture(const XrayFrame& about)
{
    if (!isValid())
        return;
    const auto& before = m_basis->about;
    const auto& was = before.geometry;
    const auto& is = about.geometry;
    if (turned(was.primaryAngle, is.primaryAngle) || turned(was.secondaryAngle, is.secondaryAngle))
        remove(tr("the C-arm turned"));
    else if (moved(was.sourceDetectorDistance, is.sourceDetectorDistance, distanceTolerance) ||
             moved(was.sourceObjectDistance, is.sourceObjectDistance, distanceTolerance))
        remove(tr("the distances of the C-arm changed"));
    else if (before.rows != about.rows || before.columns != about.columns || before.imagerPixelSpacing != about.imagerPixelSpacing)
        remove(tr("the zoom changed"));
    else if (before.source != about.source)
        remove(tr("the pictures come from elsewhere"));
}

void RoadmapState::noteTable(const std::array<double, 3>& table, Instant at)
{
    if (m_tables.empty() || differ(m_tables.back().table, table, tableStep))
        m_tables.push_back({at, table});
    if (m_tables.size() > tablesKept) {
        m_tables.pop_front();
        m_tableForgotten = true;
    }
    checkTable();
}

/// Against where the table stood at the run's first picture; what was first reported later is taken for that.
void RoadmapState::checkTable()
{
    if (!isValid() || m_tables.empty())
        return;
    const auto taken = m_basis->about.arrival;
    const auto later = std::find_if(m_tables.begin(), m_tables.end(), [taken](const TablePlace& place) { return place.at > taken; });
    if (later == m_tables.begin() && m_tableForgotten)
        return remove(tr("the table moved"));
    const auto basis = later == m_tables.begin() ? later : later - 1;
    if (std::any_of(basis, m_tables.end(), [&](const TablePlace& place) { return differ(basis->table, place.table, tableTolerance); }))
        remove(tr("the table moved"));
}

void RoadmapState::checkDisplacement(double share)
{
    if (!isValid())
        return;
    m_displaced = moved(0, share, displacementTolerance) ? m_displaced + 1 : 0;
    if (m_displaced >= displacementsThatCount)
        remove(tr("the patient moved"));
}

void RoadmapState::remove(const QString& reason)
{
    m_reason = reason;
    Q_EMIT changed();
}

} // namespace console
