// The surgeon's one screen: regions A to J, what they show and what they ask for.
#pragma once

#include "model/console_models.hpp"
#include "widgets/cockpit_layout.hpp"
#include "widgets/held_keys.hpp"
#include "widgets/view_stack.hpp"

#include <QTimer>
#include <QWidget>

#include <optional>

namespace console {

class AlarmBand;
class ClosingNote;
class DosePanel;
class InterruptionCard;
class LinksRail;
class MotionBar;
class RobotPanel;
class SheetDeck;
class StatusStrip;
class TrendsPane;

/// Shows the models on its own clock and emits what a person asks for; owns nothing of what it shows. GUI thread only. `models` must
/// outlive the window.
///
/// Keys: F1 cockpit, F2 topology, F3 plots, F4 log, F6 conditions, F7 screens, F10 and F11 reference or scene beside the live picture,
/// Ctrl+, (with a comma) preferences, Ctrl+1 … Ctrl+9 saved layouts, F8 alarm self-test, F9 audio pause, F12 panic hold, Esc emergency
/// stop, wherever the focus is, the last three with any modifiers (UrgentKeys). F5 does nothing yet. All other keys belong to the hand
/// while the cockpit itself has the focus and may be seen; while a sheet, a view or another window has it, the hand has none, and
/// `handFocusChanged(false)` says so before the first key goes elsewhere. Space and Enter are never handed on, nor is what is pressed with
/// Ctrl, Alt or Meta. A key that comes up is told with the code that it was pressed with (HeldKeys).
///
/// It is not closed while somebody relies on it (closingBar()).
class CockpitWindow : public QWidget {
    Q_OBJECT
public:
    explicit CockpitWindow(ConsoleModels& models, QWidget* parent = nullptr);
    ~CockpitWindow() override;

    /// Each takes the widget and gives it its region; before that a pane says what is missing.
    void setLiveView(QWidget* view);
    void setReferenceView(QWidget* view);
    void setSceneView(QWidget* view);
    void setMiniTopology(QWidget* view);
    void setTopologyView(QWidget* view);
    void setLogView(QWidget* view);

    /// Over E, F and G when it is asked for; takes the widget.
    void addView(View view, QWidget* widget);

    void setOperator(const QString& user);
    void setPatient(const QString& name, const QString& id);
    void setRehearsal(bool rehearsal);
    void setKeyLegend(const QString& legend);

    /// The hand's key for RESET STOP, which counts as holding that button.
    void setResetHeld(bool held);
    void setTrendSpan(TrendSpan span);

    /// Which picture stands beside the live one; F10 and F11 change it.
    void setArrangement(Arrangement arrangement);
    Arrangement arrangement() const { return m_arrangement; }

    /// The screen that the cockpit was on is gone, which the models then say: the hand has no keys until a person clicks into the cockpit
    /// or presses F1.
    void noteScreenGone();

    /// Nobody sees this computer's screen, and why, which the models then say; empty: somebody may. Meanwhile it is as if another window
    /// were the active one, whatever Qt takes for it: the hand has no keys, and nothing in the motion bar can be held.
    void setUnseen(const QString& why);

    /// Also one that is minimised or hidden.
    void comeToTheFront();

    /// The incident that was asked for is in the logs.
    void showIncidentMarked();

    /// What became of a report that was to be kept.
    void showReportNote(const QString& note);

    /// Everything as of `now`. The window's own clock renews what moves twenty times a second, the rest four times.
    void refresh(Instant now);

    View view() const { return m_views.present(); }
    void showView(View view);

    /// The hand may use the keys.
    bool handHasKeys() const { return m_handHasKeys; }

    QRect regionGeometry(Region region) const { return regionRect(region, size(), m_arrangement); }

Q_SIGNALS:
    void openRequested(quint32 peer);
    void openAllRequested();
    void closeRequested(quint32 peer);
    void reopenRequested(quint32 peer);
    void reopenAllRequested();
    void probeRequested(quint32 peer);
    void dismissRequested(quint64 incident);
    void reportRequested(const QString& text); ///< what the diagnosis says, to be kept
    void patientSideCallRequested();           ///< its number is shown
    void interruptionReadRequested();
    void emergencyStopRequested(const QString& reason);
    void emergencyStopResetRequested();
    void armHoldChanged(bool held);
    void pedalChanged(bool held);
    void injectHoldChanged(bool held);
    void masterChosen(console::MasterKind kind);
    void forceAccepted(double newtons);
    void acknowledgeRequested(quint64 alarm);
    void audioPauseRequested();
    void incidentMarkRequested();
    void alarmTestRequested();
    void alarmTestAnswered(bool seenAndHeard);
    void panicHoldRequested();
    void closed(); ///< nobody relies on it: the program ends
    void closingRefused(const QString& why, const QString& first);
    void viewRequested(console::View view);
    void arrangementChanged(console::Arrangement arrangement);
    void layoutRequested(int place);
    void handKeyPressed(int key);
    void handKeyReleased(int key);
    void handFocusChanged(bool handHasKeys);

protected:
    void paintEvent(QPaintEvent* event) override;
    void focusInEvent(QFocusEvent* event) override;
    void focusOutEvent(QFocusEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void showEvent(QShowEvent* event) override;
    void hideEvent(QHideEvent* event) override;
    void changeEvent(QEvent* event) override;
    void closeEvent(QCloseEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;
    void keyReleaseEvent(QKeyEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;

private:
    void placeRegions();
    void connectIntents();
    void connectModels();
    void addKeys();
    void replace(Region region, QWidget*& present, QWidget* view);
    void stack();
    void addViewKeys();
    void toggleView(View view);
    void updateHandKeys();
    void noteClick();
    void noteKeyDown(const QKeyEvent& event);
    void tick();
    void refreshStrip(Instant now);
    void refreshStates(Instant now);
    void refreshCourses(Instant now);
    void refreshDeck(Instant now);
    void refreshSoon();
    void refreshSound(Instant now);

    ConsoleModels& m_models;
    CockpitLayout* m_layout;
    StatusStrip* m_strip;
    AlarmBand* m_band;
    LinksRail* m_rail;
    QWidget* m_live;
    QWidget* m_reference;
    QWidget* m_scene;
    RobotPanel* m_robot;
    DosePanel* m_dose;
    TrendsPane* m_trends;
    MotionBar* m_motion;
    InterruptionCard* m_away;
    ClosingNote* m_closing;
    SheetDeck* m_deck;
    ViewStack m_views;
    QTimer m_clock;
    int m_ticks = 0;
    bool m_refreshDue = false;
    bool m_handHasKeys = false;
    HeldKeys m_held;
    Arrangement m_arrangement = Arrangement::Usual;
    QString m_operator;
    std::optional<Instant> m_procedureSince;
};

} // namespace console
