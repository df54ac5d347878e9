// The incidents that this console holds.
#include "model/incident_model.hpp"

#include "model/session_model.hpp"

#include <algorithm>

namespace console {

namespace {

constexpr std::chrono::minutes flapWindow{2};
constexpr std::size_t mostFlaps = 10'000;
constexpr std::chrono::seconds atOnce{2};

} // namespace

bool beganTogether(const SessionModel& sessions, const IncidentModel& incidents)
{
    std::vector<Instant> began;
    for (const auto& link : sessions.links()) {
        if (!link.own)
            continue;
        const auto* incident = incidents.ofPair(link.a, link.b);
        if (incident == nullptr)
            return false;
        began.push_back(incident->since);
    }
    if (began.empty())
        return false;
    const auto [first, last] = std::minmax_element(began.begin(), began.end());
    return *last - *first <= atOnce;
}

IncidentModel::IncidentModel(QObject* parent) : QObject(parent) {}

const IncidentRecord* IncidentModel::incident(quint64 id) const
{
    for (const auto* records : {&m_incidents, &m_interruptions})
        if (const auto place = std::ranges::find(*records, id, &IncidentRecord::id); place != records->end())
            return &*place;
    return nullptr;
}

IncidentRecord* IncidentModel::find(quint64 id) { return const_cast<IncidentRecord*>(incident(id)); }

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
    const auto interruption = incident.peer != 0 ? takeInterruption(incident.peer) : std::nullopt;
    const bool counted = interruption && interruption->stage == LossStage::Interrupted;
    m_incidents.push_back(incident);
    auto& raised = m_incidents.back();
    raised.flaps = counted ? interruption->flaps : countFlaps(incident.a, incident.b, now);
    if (counted) {
        raised.since = interruption->since;
        raised.sinceWallMs = interruption->sinceWallMs;
    }
    ++m_raised;
    if (interruption)
        Q_EMIT interruptionDecided(interruption->id, incident.id);
    Q_EMIT incidentRaised(incident.id);
}

IncidentRecord* IncidentModel::interruptionOf(quint32 peer)
{
    const auto place = std::ranges::find(m_interruptions, peer, &IncidentRecord::peer);
    return place == m_interruptions.end() ? nullptr : &*place;
}

std::optional<IncidentRecord> IncidentModel::takeInterruption(quint32 peer)
{
    const auto* known = interruptionOf(peer);
    if (known == nullptr)
        return std::nullopt;
    const auto taken = *known;
    m_interruptions.erase(m_interruptions.begin() + (known - m_interruptions.data()));
    return taken;
}

void IncidentModel::interrupt(IncidentRecord interruption, Instant now)
{
    if (ofPair(interruption.a, interruption.b) != nullptr)
        return;
    const auto before = takeInterruption(interruption.peer);
    // An incident's number is drawn from 64 bits; a device's id is none of them but by a chance that is met here.
    interruption.id = before ? before->id : interruption.peer;
    while (find(interruption.id) != nullptr)
        ++interruption.id;
    interruption.stage = LossStage::Interrupted;
    interruption.folded = before && before->folded;
    interruption.flaps = countFlaps(interruption.a, interruption.b, now);
    const auto id = interruption.id;
    m_interruptions.push_back(std::move(interruption));
    Q_EMIT interruptionBegan(id);
}

void IncidentModel::heal(quint32 peer, Instant now)
{
    auto* record = interruptionOf(peer);
    if (record == nullptr || record->stage == LossStage::Healed)
        return;
    record->stage = LossStage::Healed;
    record->healed = now;
    Q_EMIT incidentChanged(record->id);
}

void IncidentModel::forgetInterruption(quint32 peer)
{
    if (const auto taken = takeInterruption(peer))
        Q_EMIT interruptionEnded(taken->id);
}

void IncidentModel::forgetHealed(Instant now)
{
    const auto isOver = [now](const IncidentRecord& record) {
        return record.stage == LossStage::Healed && now - record.healed >= healedShown;
    };
    for (auto over = std::ranges::find_if(m_interruptions, isOver); over != m_interruptions.end();
         over = std::ranges::find_if(m_interruptions, isOver))
        forgetInterruption(over->peer);
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
