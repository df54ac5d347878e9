// Region J: the motion permit with its conditions, the hand, and the buttons that arm, image and stop.
#pragma once

#include "model/console_models.hpp"

#include <QFrame>

class QLabel;
class QLayout;
class QStackedLayout;

namespace console {

class ElidedLabel;
class GuardList;
class HandBlock;
class HoldButton;
class MasterRow;
class PermitBlock;
class SmallButton;
class StopButton;

class MotionBar : public QFrame {
    Q_OBJECT
public:
    explicit MotionBar(const ConsoleModels& models, QWidget* parent = nullptr);

    /// Which keys do what.
    struct KeyLegend {
        QString stop; ///< first, and brighter: what stops
        QString hand; ///< from the input device in use
        QString views;
    };
    void setKeyLegend(const KeyLegend& legend);

    /// How a held button is shown, whichever way it is held.
    void setPedalShown(bool held);

    /// By the hand's key. It counts from a press while the stop is shown, and as long as the button itself would.
    void setResetHeld(bool held);

    /// Nobody sees it: nothing of it is held, and nothing can be until somebody may see it again.
    void setUnseen(bool unseen);

    void refresh(Instant now);

Q_SIGNALS:
    void emergencyStopRequested(const QString& reason);
    void emergencyStopResetRequested();
    void armHoldChanged(bool held);
    void pedalChanged(bool held);
    void injectHoldChanged(bool held);
    void masterChosen(console::MasterKind kind);
    void forceAccepted(double newtons); ///< as it was shown
    void checklistRequested();

private:
    QLayout* makeState();
    QLayout* makeFoot();
    void nameButtons();
    void connectButtons();
    void refreshArm(Instant now);
    void refreshReset(Instant now);
    quint64 stopInForce() const; ///< as the robot reported last; 0: none
    void refreshInject(Instant now);
    QString injectText(Instant now) const;
    void refreshForce(Instant now);

    static constexpr std::chrono::milliseconds resetHold{1500};
    static constexpr std::chrono::seconds forceStands{1};        ///< long enough to be read and pressed, however the force trembles
    static constexpr std::chrono::milliseconds forceIsRead{300}; ///< a press sooner than that was meant for what stood there before

    const ConsoleModels& m_models;
    PermitBlock* m_permit;
    GuardList* m_guards;
    HandBlock* m_hand;
    HoldButton* m_arm;
    HoldButton* m_reset;
    HoldButton* m_inject;
    HoldButton* m_pedal;
    StopButton* m_stop;
    MasterRow* m_masters;
    SmallButton* m_acceptForce;
    QLabel* m_stopKeys;
    ElidedLabel* m_handKeys;
    ElidedLabel* m_viewKeys;
    QStackedLayout* m_armOrReset = nullptr;
    std::optional<Instant> m_resetSince;
    quint64 m_resetToken = 0;            ///< of the stop that stood there when its reset was begun last; 0: none since it was stopped
    std::optional<Instant> m_forceSince; ///< when the force on its button was written there; nothing while there is none
    double m_forceShown = 0;             ///< N
    bool m_forceRead = false;            ///< it stood there long enough before it was pressed
    bool m_resetAsked = false;
};

} // namespace console
