// The alarm self-test: every colour and every sound once, and a person's word that they were seen and heard.
#pragma once

#include "model/alarm_list.hpp"
#include "model/motion_permit.hpp"

#include <QObject>

#include <chrono>
#include <optional>

namespace console {

/// GUI thread only. Needed before each arming: arming uses it up, a stand-by makes it void, and unused it lasts for ten minutes. The first
/// of a run plays each burst whole; those after it only as much as tells the three apart, so that nobody learns to click it away. What it
/// shows is said to be a test.
///
/// ```
///             begin                                    confirm            armed            no longer armed
///   NotDone ─────────► High ─► Medium ─► Low ─► Asking ───────► Passed ─────────► InUse ─────────────────► NotDone
///      ▲                 │        │       │       │ │             │
///      └─── a high alarm, or no answer ───┴───────┘ │ refuse      └── ten minutes, or a stand-by ─► NotDone
///   Failed ◄────────────────────────────────────────┘
///      └── begin ─► High
/// ```
class AlarmSelfTest : public QObject {
    Q_OBJECT
public:
    enum class Step : std::uint8_t { NotDone, High, Medium, Low, Asking, Passed, Failed, InUse };

    explicit AlarmSelfTest(QObject* parent = nullptr);

    Step step() const { return m_step; }
    bool passed() const { return m_step == Step::Passed; }
    int passedInAll() const { return m_passes; }

    /// What is shown and heard for the test now.
    std::optional<AlarmPriority> signal() const;

    /// Not the first of this run: only the beginnings are played.
    bool isBrief() const { return m_passes > 0; }
    bool running() const { return signal().has_value() || m_step == Step::Asking; }

    /// Nothing, while it runs, has passed, or instruments are armed.
    void begin(Instant now);

    /// Only while it asks: nobody can confirm what was not shown.
    void confirm();
    void refuse();

    /// With every phase that the permit enters.
    void follow(PermitPhase phase, Instant now);

    /// Ten times a second. `disturbed`: a high alarm stands; the test then makes room and has to be repeated.
    void update(bool disturbed, Instant now);

    struct Times {
        std::chrono::milliseconds high;
        std::chrono::milliseconds medium;
        std::chrono::milliseconds low;
    };
    static constexpr Times whole{std::chrono::milliseconds(3200), std::chrono::milliseconds(2000), std::chrono::milliseconds(1200)};

    /// Five of the ten pulses, all three, both.
    static constexpr Times brief{std::chrono::milliseconds(1300), std::chrono::milliseconds(1100), std::chrono::milliseconds(900)};

    /// What was heard longer ago than that, nobody can vouch for.
    static constexpr std::chrono::seconds answerTime{60};
    static constexpr std::chrono::minutes validity{10};

Q_SIGNALS:
    void changed();

private:
    void enter(Step step, Instant now);

    Step m_step = Step::NotDone;
    Instant m_since;
    int m_passes = 0;
};

} // namespace console
