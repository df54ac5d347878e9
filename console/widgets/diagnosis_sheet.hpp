// The diagnosis prompt of one lost link: what, since when, is the patient safe, what is seen, why, and what to do.
#pragma once

#include "model/incident_model.hpp"

#include <QElapsedTimer>
#include <QFrame>

class QLabel;
class QScrollArea;
class QVBoxLayout;

namespace console {

class FigureLabel;
class RollCall;
class SheetButton;

/// Docked and not modal. Enter re-opens nothing: the focus is on Run checks, and only a click or Space on the button itself re-opens.
class DiagnosisSheet : public QFrame {
    Q_OBJECT
public:
    explicit DiagnosisSheet(QWidget* parent = nullptr);

    void setContent(const IncidentRecord& incident, const PromptContent& content);
    quint64 incident() const { return m_incident; }
    void focusChecks();

    /// What became of the report; until another incident is shown.
    void showNote(const QString& note);

Q_SIGNALS:
    void reopenRequested(quint32 peer);
    void reopenAllRequested();
    void probeRequested(quint32 peer);
    void dismissRequested(quint64 incident);
    void foldRequested(quint64 incident);
    void silenceRequested();
    void callRequested(); ///< how the patient side is called is shown large
    void reportRequested(const QString& text);

private:
    QWidget* makeHead();
    QWidget* makeBody();
    QVBoxLayout* makePatientSide(QWidget* body);
    QVBoxLayout* makeFindings(QWidget* body);
    QWidget* makeDetails(QWidget* body);
    QWidget* makeActions();
    QWidget* makeGiveUp();
    QLabel* addSection(QVBoxLayout* column, const QString& heading);
    void connectActions();
    void connectShown();
    void setCall(const QString& call);
    void showCall(bool large);
    void setReopening(const PromptContent& content);
    void setActions(const IncidentRecord& incident, const PromptContent& content);

    quint64 m_incident = 0;
    QString m_report;
    QElapsedTimer m_saved;  ///< since the report was asked for last
    QElapsedTimer m_called; ///< the same of a call
    quint32 m_peer = 0;
    FigureLabel* m_since = nullptr;
    QLabel* m_headline = nullptr;
    QLabel* m_directions = nullptr;
    QLabel* m_flaps = nullptr;
    QLabel* m_note = nullptr;
    QLabel* m_patient = nullptr;
    QLabel* m_call = nullptr;
    RollCall* m_rollCall = nullptr;
    QLabel* m_seen = nullptr;
    QLabel* m_evidence = nullptr;
    QLabel* m_cause = nullptr;
    QLabel* m_lastTry = nullptr;
    QLabel* m_details = nullptr;
    QWidget* m_detailsPart = nullptr;
    QScrollArea* m_body = nullptr;
    SheetButton* m_fold = nullptr;
    SheetButton* m_silence = nullptr;
    SheetButton* m_save = nullptr;
    SheetButton* m_showDetails = nullptr;
    SheetButton* m_showCall = nullptr;
    SheetButton* m_checks = nullptr;
    SheetButton* m_reopen = nullptr;
    SheetButton* m_reopenAll = nullptr;
    SheetButton* m_giveUp = nullptr;
    SheetButton* m_reallyGiveUp = nullptr;
    SheetButton* m_keep = nullptr;
    QWidget* m_actions = nullptr;
    QWidget* m_giveUpRow = nullptr;
};

} // namespace console
