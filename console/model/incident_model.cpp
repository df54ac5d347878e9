// The incidents that this console holds.
#include "model/incident_model.hpp"

#include <algorithm>

namespace console {

namespace {

constexpr std::chrono::minutes flapWindow{2};
constexpr std::size_t mostFlaps = 10'000;

} // namespace

IncidentModel::IncidentModel(QObject* parent) : QObject(parent) {}

IncidentRecord* IncidentModel::find(quint64 id)
{
    const auto place = std::find_if(m_incidents.begin(), m_incidents.end(), [id](const IncidentRecord& record) { return record.id == id; });
    return place == m_incidents.end() ? nullptr : &*place;
}

const IncidentRecord* IncidentModel::incident(quint64 id) const
{
    const auto place = std::find_if(m_incidents.begin(), m_incidents.end(), [id](const IncidentRecord& record) { return record.id == id; });
    return place == m_incidents.end() ? nullptr : &*place;
}

const IncidentRecord* IncidentModel::ofPair(quint32 a, quint32 b) const
{
    const auto place = std::find_if(m_incidents.begin(), m_incidents.end(), [a, b](const IncidentRecord& record) {
        return (record.a == a && record.b == b) || (record.a == b && record.b == a);
    });
    return place == m_incidents.end() ? nullptr : &*place;
}

int IncidentModel::countFlaps(quint32 a, quint32 b, Instant now)
{
    std::erase_if(m_flaps, [now](const Flap& flap) { return flap.at < now - flapWindow; });
    m_flaps.push_back({std::min(a, b), std::max(a, b), now});
    if (m_flaps.size() > mostFlaps)
        m_flaps.pop_front();
    return static_cast<int>(std::count_if(m_flaps.begin(), m_flaps.end(),
                                          [a, b](const Flap& flap) { return flap.a == std::min(a, b) && flap.b == std::max(a, b); }));
}

void IncidentModel::raise(const IncidentRecord& incident, Instant now)
{
    if (auto* known = find(incident.id)) {
        known->cause = incident.cause;
        known->causeOfA = incident.causeOfA;
        known->causeOfB = incident.causeOfB;
        known->holds = incident.holds;
        if (incident.diagnosis)
            known->diagnosis = incident.diagnosis;
        Q_EMIT incidentChanged(incident.id);
        return;
    }
    m_incidents.push_back(incident);
    m_incidents.back().flaps = countFlaps(incident.a, incident.b, now);
    ++m_raised;
    Q_EMIT incidentRaised(incident.id);
}

void IncidentModel::end(quint64 id)
{
    if (std::erase_if(m_incidents, [id](const IncidentRecord& record) { return record.id == id; }) > 0)
        Q_EMIT incidentEnded(id);
}

void IncidentModel::setHolds(quint64 id, std::vector<HoldLine> holds)
{
    auto* record = find(id);
    if (record == nullptr)
        return;
    record->holds = std::move(holds);
    Q_EMIT incidentChanged(id);
}

void IncidentModel::setDiagnosis(quint64 id, const LinkDiagnosis& diagnosis)
{
    auto* record = find(id);
    if (record == nullptr)
        return;
    record->diagnosis = diagnosis;
    record->probing = false;
    Q_EMIT incidentChanged(id);
}

void IncidentModel::setReopenFailure(quint64 id, const QString& reason)
{
    auto* record = find(id);
    if (record == nullptr)
        return;
    record->reopenFailure = reason;
    ++record->reopenTries;
    Q_EMIT incidentChanged(id);
}

void IncidentModel::setProbing(quint64 id, bool probing)
{
    auto* record = find(id);
    if (record == nullptr || record->probing == probing)
        return;
    record->probing = probing;
    Q_EMIT incidentChanged(id);
}

void IncidentModel::setFolded(quint64 id, bool folded)
{
    auto* record = find(id);
    if (record == nullptr || record->folded == folded)
        return;
    record->folded = folded;
    Q_EMIT incidentChanged(id);
}

} // namespace console
