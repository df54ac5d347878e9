// Which incident's sheet is open, and the way it comes out.
#include "widgets/sheet_deck.hpp"

#include "model/device_node.hpp"
#include "widgets/diagnosis_sheet.hpp"

#include <QPropertyAnimation>
#include <QResizeEvent>

namespace console {

namespace {

constexpr int slideMs = 40; // seen to come from the band, and read at once

} // namespace

SheetDeck::SheetDeck(IncidentModel& incidents, QWidget* parent)
    : QWidget(parent), m_incidents(incidents), m_sheet(new DiagnosisSheet(this)), m_slide(new QPropertyAnimation(m_sheet, "pos", this))
{
    setAccessibleName(tr("Diagnosis"));
    hide();
    m_slide->setDuration(slideMs);
    connect(m_sheet, &DiagnosisSheet::foldRequested, this, [this](quint64 id) { m_incidents.setFolded(id, true); });
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
    return 1 + (record->peer != 0 ? 2 : 0) + (robots ? 1 : 0);
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
    const auto& all = m_incidents.incidents();
    m_open = 0;
    for (const IncidentRecord& record : all)
        if (!record.folded && (m_open == 0 || urgency(record.id) > urgency(m_open)))
            m_open = record.id;
    if (m_open != 0) {
        slideOut();
    } else if (isVisible()) {
        hide();
        Q_EMIT closed();
    }
}

void SheetDeck::open(quint64 incident)
{
    const quint64 before = m_open;
    m_open = incident;
    m_incidents.setFolded(incident, false);
    if (before != incident && m_incidents.incident(before))
        m_incidents.setFolded(before, true);
    slideOut();
}

void SheetDeck::slideOut()
{
    show();
    raise();
    m_sheet->resize(size());
    m_slide->stop();
    m_slide->setStartValue(QPoint(0, -height()));
    m_slide->setEndValue(QPoint(0, 0));
    m_slide->start();
    m_sheet->focusChecks();
    Q_EMIT opened();
}

void SheetDeck::resizeEvent(QResizeEvent* event) { m_sheet->resize(event->size()); }

void SheetDeck::refresh(const SessionModel& sessions, const PromptSurroundings& around, Instant now)
{
    std::vector<std::pair<quint64, QString>> chips;
    for (const IncidentRecord& record : m_incidents.incidents()) {
        const PromptContent content = promptContent(record, sessions, around, now);
        if (record.id == m_open)
            m_sheet->setContent(record, content);
        else
            chips.emplace_back(record.id, content.folded);
    }
    Q_EMIT chipsChanged(chips);
}

} // namespace console
