// Makes the views that say what the console is and let a person set it up, and connects them.
#pragma once

#include "app/command_line.hpp"
#include "model/console_models.hpp"

#include <QObject>

namespace console {

class CockpitWindow;

/// GUI thread only. `models` outlives it.
class ViewDesk : public QObject {
    Q_OBJECT
public:
    ViewDesk(const Options& options, ConsoleModels& models, QObject* parent = nullptr);

    /// Gives the window its views.
    void build(CockpitWindow& window);

private:
    const Options& m_options;
    ConsoleModels& m_models;
};

} // namespace console
