// Which incident's sheet is open, and the way it comes out.
#include "widgets/sheet_deck.hpp"

#include "model/device_node.hpp"
#include "widgets/diagnosis_sheet.hpp"

#include <QApplication>
#include <QResizeEvent>

#include <optional>
#include <utility>

namespace console {

SheetDeck::SheetDeck(IncidentModel& incidents, QWidget* parent) : QWidget(parent), m_incidents(incidents), m_sheet(new DiagnosisSheet(this))
{
    setAccessibleName(tr("Diagnosis"));
    hide();
    connect(m_sheet, &DiagnosisSheet::foldRequested, this, &SheetDeck::fold);
    connect(&m_incidents, &IncidentModel::interruptionBegan, this, &SheetDeck::take);
    connect(&m_incidents, &IncidentModel::interruptionEnded, this, &SheetDeck::choose);
    connect(&m_incidents, &IncidentModel::interruptionDecided, this, &SheetDeck::decide);
    connect(&m_incidents, &IncidentModel::incidentRaised, this, &SheetDeck::take);
    connect(&m_incidents, &IncidentModel::incidentEnded, this, &SheetDeck::choose);
    connect(&m_incidents, &IncidentModel::incidentChanged, this, &SheetDeck::choose);
}

// This console's own links come before others, since only those can be re-opened from here; among them the robot's comes first, since it
// moves in the patient.
int SheetDeck::urgency(quint64 incident) const
{
    const IncidentRecord* record = m_incidents.incident(incident);
    if (record == nullptr)
        return 0;
    const bool robots = kindOf(record->a) == DeviceKind::Hand || kindOf(record->b) == DeviceKind::Hand;
    const int stage = record->stage == LossStage::Lost ? 8 : record->stage == LossStage::Interrupted ? 4 : 0;
    return 1 + stage + (record->peer != 0 ? 2 : 0) + (robots ? 1 : 0);
}

void SheetDeck::take(quint64 incident)
{
    if (m_open != 0 && urgency(incident) > urgency(m_open))
        open(incident);
    else
        choose();
}

void SheetDeck::choose()
{
    const IncidentRecord* open = m_incidents.incident(m_open);
    if (open && !open->folded)
        return;
    m_open = 0;
    for (const auto* records : {&m_incidents.incidents(), &m_incidents.interruptions()})
        for (const IncidentRecord& record : *records)
            if (!record.folded && (m_open == 0 || urgency(record.id) > urgency(m_open)))
                m_open = record.id;
    if (m_open != 0) {
        comeOut();
    } else if (isVisible()) {
        const bool hadKeys = isAncestorOf(QApplication::focusWidget());
        hide();
        if (hadKeys)
            Q_EMIT closed();
    }
}

/// The sheet of an interruption that did not heal is now the incident's: it stays where it is, and takes the keys.
void SheetDeck::decide(quint64 interruption, quint64 incident)
{
    if (m_open != interruption || !isVisible())
        return;
    m_open = incident;
    Q_EMIT opened();
    m_sheet->focusChecks();
}

/// One that healed has nothing left to say.
void SheetDeck::fold(quint64 incident)
{
    const auto* record = m_incidents.incident(incident);
    if (record != nullptr && record->stage == LossStage::Healed)
        m_incidents.forgetInterruption(record->peer);
    else
        m_incidents.setFolded(incident, true);
}

void SheetDeck::open(quint64 incident)
{
    const quint64 before = m_open;
    m_open = incident;
    m_incidents.setFolded(incident, false);
    if (before != incident && m_incidents.incident(before))
        m_incidents.setFolded(before, true);
    comeOut();
}

/// At once, without a movement that would take a part of the time in which it must be there.
void SheetDeck::comeOut()
{
    show();
    raise();
    m_sheet->resize(size());
    Q_EMIT opened();
    // While it may heal there is nothing to do, and the hand keeps the keys.
    if (const auto* record = m_incidents.incident(m_open); record != nullptr && record->stage == LossStage::Lost)
        m_sheet->focusChecks();
}

void SheetDeck::resizeEvent(QResizeEvent* event) { m_sheet->resize(event->size()); }

void SheetDeck::refresh(const SessionModel& sessions, const PromptSurroundings& around, Instant now)
{
    m_incidents.forgetHealed(now);
    std::vector<std::pair<quint64, QString>> chips;
    std::optional<std::pair<IncidentRecord, PromptContent>> open;
    for (const auto* records : {&m_incidents.incidents(), &m_incidents.interruptions()})
        for (const IncidentRecord& record : *records) {
            PromptContent content = promptContent(record, sessions, around, now);
            if (record.id == m_open)
                open.emplace(record, std::move(content));
            else
                chips.emplace_back(record.id, std::move(content.folded));
        }
    if (open) // a button that goes gives the focus away, and who hears of it may change the records
        m_sheet->setContent(open->first, open->second);
    Q_EMIT chipsChanged(chips);
}

} // namespace console
