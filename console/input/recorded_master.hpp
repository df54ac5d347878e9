// A hand that was recorded: plays a CSV of time, x, y, z, buttons.
#pragma once

#include "input/hand_scale.hpp"
#include "input/master_device.hpp"

#include <QString>

#include <optional>
#include <vector>

namespace console {

struct HandSample {
    double time = 0;                      ///< s, from 0, rising
    PositionTracker::Position position{}; ///< mm
    unsigned buttons = 0;                 ///< bit 0 dead-man, bit 1 clutch
};

/// Header line `time,x,y,z,buttons`, then at least two samples. On failure nothing, and `error` names line, column and remedy.
std::optional<std::vector<HandSample>> readRecording(const QString& text, const QString& file, QString* error);

/// x turns the guidewire (10 degrees per millimetre), y moves the catheter, z moves the guidewire, advance positive.
///
/// Its dead-man is what was recorded and no person's: it borrows the keyboard's.
class RecordedMaster : public MasterDevice {
    Q_OBJECT
public:
    explicit RecordedMaster(std::vector<HandSample> samples, QObject* parent = nullptr);

    static std::vector<HandSample> load(const QString& path, QString* error); ///< empty on failure

    MasterKind kind() const override { return MasterKind::Recorded; }
    QString name() const override;
    QString legend() const override;
    MasterLife life(Instant now) const override;
    bool borrowsDeadMan() const override { return true; }
    MasterReading read(Instant now) override;

    /// Plays from the beginning.
    void rezero(Instant now) override;
    void requireRelease() override {}

    Duration length() const;

protected:
    void listeningChanged() override {}

private:
    HandSample at(double time) const;

    std::vector<HandSample> m_samples;
    PositionTracker m_tracker;
    std::optional<Instant> m_begin;
};

} // namespace console
