// One press, one injection: when a held button asks the robot for contrast.
#pragma once

#include "model/instant.hpp"
#include "model/robot_values.hpp"

#include <QString>

#include <chrono>
#include <optional>

namespace console {

/// What is asked for: the defaults of the robot's message set.
inline constexpr double plannedInjection = 5;     ///< mL
inline constexpr double plannedInjectionRate = 2; ///< mL/s

/// Why no injection can be asked for now, in the order in which a person would mend it.
enum class InjectionBar : std::uint8_t { None, NotArmed, RobotUnheard, Running, NotEnough };

struct InjectionReadings {
    bool held = false;
    bool armed = false; ///< Armed or Engaged: the robot takes no injection else
    bool robotFresh = false;
    bool running = false;    ///< one that was asked for before has not ended
    double contrastLeft = 0; ///< mL
};

/// Pure. A hold counts when it began and stayed while an injection was possible; then it asks once, and must be let go of before it asks
/// again. What is on its way cannot be taken back from here by letting go: every hold and every stop ends it at the robot.
class InjectionOrder {
public:
    static constexpr std::chrono::milliseconds hold{1000};
    static constexpr std::chrono::milliseconds answerLimit{500};

    /// True once for a hold that is long enough: now ask, and note() the number.
    bool advance(const InjectionReadings& readings, Instant now);

    InjectionBar bar() const { return m_bar; }
    double progress(Instant now) const; ///< of the hold, 0 to 1

    /// It was asked for under that number.
    void note(quint32 number, Instant now);

    /// The robot told of it; also what could not be sent is refused.
    void hear(const InjectionStatus& status);

    /// Asked for, and the robot has not said a word about it for too long. Until it does, or another is asked for.
    bool unanswered(Instant now) const { return m_asked && now - m_asked->at > answerLimit; }
    bool awaited() const { return m_asked.has_value(); }

private:
    enum class Stage : std::uint8_t { Released, Holding, Spent };
    struct Asked {
        quint32 number = 0;
        Instant at;
    };

    Stage m_stage = Stage::Released;
    Instant m_since;
    InjectionBar m_bar = InjectionBar::NotArmed;
    std::optional<Asked> m_asked;
};

} // namespace console
