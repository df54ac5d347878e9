// What a person sees first: what this is, how it stands, and how to begin.
#pragma once

#include "widgets/program_facts.hpp"

#include <QFrame>

class QTimer;

namespace console {

class SheetButton;

/// A view like the others: the picture, the alarms and the motion bar stay in sight. It goes by its button or F1, and by itself when the
/// first session opens; never by Esc, which is the emergency stop. `models` must outlive it.
class StartView : public QFrame {
    Q_OBJECT
public:
    StartView(const ConsoleModels& models, ProgramFacts program, QWidget* parent = nullptr);

    void refresh();

Q_SIGNALS:
    void leaveRequested();
    void aboutRequested();

protected:
    void showEvent(QShowEvent* event) override;
    void hideEvent(QHideEvent* event) override;

private:
    QWidget* makeSteps();

    const ConsoleModels& m_models;
    const ProgramFacts m_program;
    SheetButton* m_leave;
    SheetButton* m_about;
    FactList* m_facts;
    QTimer* m_clock;
};

} // namespace console
