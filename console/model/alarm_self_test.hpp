// The alarm self-test: every colour and every sound once, and a person's word that they were seen and heard.
#pragma once

#include "model/alarm_list.hpp"

#include <QObject>

#include <chrono>
#include <optional>

namespace console {

/// GUI thread only. Once per start of the program, and needed to arm. What it shows is said to be a test.
///
/// ```
///             begin                                    confirm
///   NotDone ─────────► High ─► Medium ─► Low ─► Asking ───────► Passed
///      ▲                 │        │       │       │
///      └─── a high alarm, or armed ───────┴───────┤ refuse
///   Failed ◄──────────────────────────────────────┘
///      └── begin ─► High
/// ```
class AlarmSelfTest : public QObject {
    Q_OBJECT
public:
    enum class Step : std::uint8_t { NotDone, High, Medium, Low, Asking, Passed, Failed };

    explicit AlarmSelfTest(QObject* parent = nullptr);

    Step step() const { return m_step; }
    bool passed() const { return m_step == Step::Passed; }

    /// What is shown and heard for the test now.
    std::optional<AlarmPriority> signal() const;
    bool running() const { return signal().has_value() || m_step == Step::Asking; }

    /// Nothing, while it runs or has passed.
    void begin(Instant now);

    /// Only while it asks: nobody can confirm what was not shown.
    void confirm();
    void refuse();

    /// Ten times a second. `disturbed`: a high alarm stands or instruments may move; the test then makes room and has to be repeated.
    void update(bool disturbed, Instant now);

    static constexpr std::chrono::milliseconds highTime{3200};
    static constexpr std::chrono::milliseconds mediumTime{2000};
    static constexpr std::chrono::milliseconds lowTime{1200};

Q_SIGNALS:
    void changed();

private:
    void enter(Step step, Instant now);

    Step m_step = Step::NotDone;
    Instant m_since;
};

} // namespace console
