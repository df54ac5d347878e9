// The masters that this console has, and what the hand says through the one in use, brought into the model.
#pragma once

#include "app/command_line.hpp"
#include "input/keyboard_master.hpp"
#include "input/master_rack.hpp"
#include "model/console_models.hpp"

#include <QObject>
#include <QStringList>

#include <memory>
#include <vector>

namespace console {

/// GUI thread only. A signal comes when the model already has what it tells of.
class HandDesk : public QObject {
    Q_OBJECT
public:
    static constexpr std::chrono::seconds scaleAnnounced{5}; ///< how long it is said what the scale was before

    HandDesk(const Options& options, ConsoleModels& models, QObject* parent = nullptr);
    ~HandDesk() override;

    /// Makes the masters besides the keyboard and reads the recording; false with one sentence in `error` when it cannot.
    bool prepare(QString* error);

    KeyboardMaster& keyboard() { return m_keyboard; }
    MasterRack& rack() { return m_rack; }
    QString legend() const { return m_rack.inUse().legend(); }

    /// Once in each run of the loop: what the devices say.
    void poll(Instant now);
    void rezero(Instant now);

    bool listening() const { return m_rack.listening(); }
    void setListening(bool listening);

    /// A person's choice, heard only while nothing is armed.
    void choose(console::MasterKind kind);

    /// Which master it is and what it lacks, when it is not alive.
    QString missing() const;

Q_SIGNALS:
    /// Comes before the edges that follow from it: a dead-man that is lost ends in Hold, one that is let go in Armed.
    void lifeChanged();
    void inUseChanged();
    void deadManChanged(bool pressed);
    void armHeldChanged(bool held);
    void pedalChanged(bool down);
    void injectHeldChanged(bool held);
    void resetHeldChanged(bool held);
    void holdRequested();

private:
    void add(std::unique_ptr<MasterDevice> device);
    void connectRack();
    void read(Instant now);
    RobotForce robotForce(Instant now) const;
    void stepScale(int steps);
    void note();
    void noteRemarks();

    const Options& m_options;
    ConsoleModels& m_models;
    KeyboardMaster m_keyboard;
    std::vector<std::unique_ptr<MasterDevice>> m_devices; ///< all but the keyboard
    MasterRack m_rack{m_keyboard};
    double m_scale = 1;
    double m_scaleBefore = 1;
    std::optional<Instant> m_scaleChanged;
    QString m_noted;       ///< what the log last says of the master in use
    QStringList m_remarks; ///< the notes of masters that are in the log
};

} // namespace console
