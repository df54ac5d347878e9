// What this software is, how it stands, and the licences of its parts.
#pragma once

#include "widgets/program_facts.hpp"

#include <QFrame>

namespace console {

class SheetButton;

/// A view like the others. `models` must outlive it.
class AboutView : public QFrame {
    Q_OBJECT
public:
    AboutView(const ConsoleModels& models, ProgramFacts program, QWidget* parent = nullptr);

Q_SIGNALS:
    void leaveRequested();

protected:
    void showEvent(QShowEvent* event) override;

private:
    const ConsoleModels& m_models;
    const ProgramFacts m_program;
    SheetButton* m_leave;
    FactList* m_facts;
    FactList* m_licences;
};

} // namespace console
