// The preferences in force: read at the start, shown in their view, kept when a person changes them.
#pragma once

#include "app/command_line.hpp"
#include "app/preference_store.hpp"
#include "model/console_models.hpp"

#include <QObject>

namespace console {

class CockpitWindow;
class PictureDesk;
class PreferencesView;

/// GUI thread only; what it is given outlives it. What the command line says wins for this run and is not kept. Without a file in the
/// options there are the defaults, and changes last for this run.
class PreferenceDesk : public QObject {
    Q_OBJECT
public:
    PreferenceDesk(const Options& options, ConsoleModels& models, PictureDesk& pictures, QObject* parent = nullptr);

    /// Gives the window its view and brings what was kept into force.
    void build(CockpitWindow& window);

    const Preferences& preferences() const { return m_preferences; }

    /// Refused, with a sentence in the view, while something is armed.
    void change(const Preferences& wanted);

private:
    void read();
    void apply();
    void followPermit();
    bool kept() const { return !m_options.preferences.isEmpty(); }
    QString overruled() const;
    void note(const QString& trouble);

    const Options& m_options;
    ConsoleModels& m_models;
    PictureDesk& m_pictures;
    PreferenceStore m_store;
    Preferences m_preferences;
    Preferences m_inForce; ///< what was last brought into force
    CockpitWindow* m_window = nullptr;
    PreferencesView* m_view = nullptr; ///< the window's
};

} // namespace console
