// Why the cockpit was not closed, and what comes first.
#pragma once

#include "model/console_models.hpp"

#include <QFrame>

#include <chrono>
#include <optional>

class QLabel;

namespace console {

/// Not modal, and it takes the focus from nobody. It is shown when somebody wanted to close the cockpit and could not, follows what stands
/// in the way, and goes when nothing does any more, or after a while.
class ClosingNote : public QFrame {
    Q_OBJECT
public:
    static constexpr std::chrono::seconds shownFor{15};

    explicit ClosingNote(const ConsoleModels& models, QWidget* parent = nullptr);

    /// Somebody wanted to close it.
    void ask(Instant now);

    void refresh(Instant now);

private:
    const ConsoleModels& m_models;
    QLabel* m_why;
    QLabel* m_first;
    std::optional<Instant> m_asked;
};

} // namespace console
