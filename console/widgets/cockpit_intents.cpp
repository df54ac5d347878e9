// What a person asks for in the regions, handed on by the window; and when the models bring it up to date.
#include "widgets/alarm_band.hpp"
#include "widgets/cockpit_window.hpp"
#include "widgets/diagnosis_sheet.hpp"
#include "widgets/interruption_card.hpp"
#include "widgets/links_rail.hpp"
#include "widgets/motion_bar.hpp"
#include "widgets/sheet_deck.hpp"

namespace console {

void CockpitWindow::connectIntents()
{
    // What was clicked or pressed is done: the keys are the hand's again, so that a further Space or arrow is no second wish.
    const auto done = [this](auto signal) {
        return [this, signal](auto... what) {
            Q_EMIT(this->*signal)(what...);
            setFocus();
        };
    };
    connect(m_rail, &LinksRail::openRequested, this, done(&CockpitWindow::openRequested));
    connect(m_rail, &LinksRail::closeRequested, this, done(&CockpitWindow::closeRequested));
    connect(m_rail, &LinksRail::reopenRequested, this, done(&CockpitWindow::reopenRequested));
    connect(m_rail, &LinksRail::openAllRequested, this, done(&CockpitWindow::openAllRequested));
    connect(m_rail, &LinksRail::topologyRequested, this, [this] { showView(View::Topology); });
    connect(m_band, &AlarmBand::acknowledgeRequested, this, done(&CockpitWindow::acknowledgeRequested));
    connect(m_band, &AlarmBand::audioPauseRequested, this, done(&CockpitWindow::audioPauseRequested));
    connect(m_band, &AlarmBand::markRequested, this, done(&CockpitWindow::incidentMarkRequested));
    connect(m_band, &AlarmBand::selfTestRequested, this, done(&CockpitWindow::alarmTestRequested));
    connect(m_band, &AlarmBand::selfTestAnswered, this, done(&CockpitWindow::alarmTestAnswered));
    connect(m_band, &AlarmBand::sheetRequested, m_deck, &SheetDeck::open);
    connect(m_deck, &SheetDeck::chipsChanged, m_band, &AlarmBand::setFoldedSheets);
    connect(m_deck, &SheetDeck::closed, this, [this] { setFocus(); });
    connect(m_deck, &SheetDeck::opened, this, [this] { refreshDeck(std::chrono::steady_clock::now()); });
    const DiagnosisSheet* sheet = m_deck->sheet();
    connect(sheet, &DiagnosisSheet::reopenRequested, this, &CockpitWindow::reopenRequested);
    connect(sheet, &DiagnosisSheet::reopenAllRequested, this, &CockpitWindow::reopenAllRequested);
    connect(sheet, &DiagnosisSheet::probeRequested, this, &CockpitWindow::probeRequested);
    connect(sheet, &DiagnosisSheet::dismissRequested, this, &CockpitWindow::dismissRequested);
    connect(sheet, &DiagnosisSheet::silenceRequested, this, [this] {
        if (!m_models.alarms.audioPauseLeft(std::chrono::steady_clock::now())) // it silences, and never the other way
            Q_EMIT audioPauseRequested();
    });
    connect(sheet, &DiagnosisSheet::reportRequested, this, &CockpitWindow::reportRequested);
    connect(sheet, &DiagnosisSheet::callRequested, this, &CockpitWindow::patientSideCallRequested);
    connect(m_away, &InterruptionCard::readRequested, this, done(&CockpitWindow::interruptionReadRequested));
    connect(m_motion, &MotionBar::emergencyStopRequested, this, &CockpitWindow::emergencyStopRequested);
    connect(m_motion, &MotionBar::emergencyStopResetRequested, this, &CockpitWindow::emergencyStopResetRequested);
    connect(m_motion, &MotionBar::armHoldChanged, this, &CockpitWindow::armHoldChanged);
    connect(m_motion, &MotionBar::pedalChanged, this, &CockpitWindow::pedalChanged);
    connect(m_motion, &MotionBar::injectHoldChanged, this, &CockpitWindow::injectHoldChanged);
    connect(m_motion, &MotionBar::masterChosen, this, done(&CockpitWindow::masterChosen));
    connect(m_motion, &MotionBar::forceAccepted, this, done(&CockpitWindow::forceAccepted));
}

void CockpitWindow::connectModels()
{
    const auto now = [this] { refresh(std::chrono::steady_clock::now()); };
    connect(&m_models.alarms, &AlarmList::changed, this, [this] {
        m_band->setAlarms(m_models.alarms.alarms());
        refreshSound(std::chrono::steady_clock::now());
    });
    const auto test = [this] { m_band->setSelfTest(m_models.selfTest.step(), m_models.selfTest.signal(), m_models.selfTest.isBrief()); };
    connect(&m_models.selfTest, &AlarmSelfTest::changed, this, test);
    test();
    connect(&m_models.permit, &PermitModel::phaseChanged, this, now);
    // One loss is told by many signals; it is shown once, in the same turn of the event loop.
    connect(&m_models.sessions, &SessionModel::linkStateChanged, this, &CockpitWindow::refreshSoon);
    connect(&m_models.sessions, &SessionModel::topologyChanged, this, &CockpitWindow::refreshSoon);
    connect(&m_models.interruption, &InterruptionAccount::changed, this, &CockpitWindow::refreshSoon);
    connect(&m_models.incidents, &IncidentModel::incidentChanged, this, &CockpitWindow::refreshSoon);
    connect(&m_models.incidents, &IncidentModel::incidentEnded, this, &CockpitWindow::refreshSoon);
}

} // namespace console
