// Where diagnosis sheets come out of the alarm band; what is not open there is a chip in the band.
#pragma once

#include "model/incident_model.hpp"

#include <QWidget>

#include <utility>
#include <vector>

namespace console {

class DiagnosisSheet;

/// One sheet is open at a time. It stays until its incident ends or it is folded; it never vanishes. That of an interruption comes before
/// it is known whether the link heals, and goes some seconds after it did.
class SheetDeck : public QWidget {
    Q_OBJECT
public:
    explicit SheetDeck(IncidentModel& incidents, QWidget* parent = nullptr);

    void refresh(const SessionModel& sessions, const PromptSurroundings& around, Instant now);

    /// Opens the sheet of an incident and folds the one that was open.
    void open(quint64 incident);

    DiagnosisSheet* sheet() const { return m_sheet; }
    bool isOpen() const { return m_open != 0; }

Q_SIGNALS:
    void chipsChanged(const std::vector<std::pair<quint64, QString>>& chips);
    void opened(); ///< a sheet came out, or has become an incident's
    void closed(); ///< the last sheet went, and had the keys

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    void take(quint64 incident);
    void choose();
    void decide(quint64 interruption, quint64 incident);
    void fold(quint64 incident);
    int urgency(quint64 incident) const;
    void comeOut();

    IncidentModel& m_incidents;
    DiagnosisSheet* m_sheet;
    quint64 m_open = 0;
};

} // namespace console
