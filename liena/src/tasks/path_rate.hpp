// How fast bulk may leave so that no queue builds on the path: control then finds it empty.
#pragma once

#include "liena/device_id.hpp"
#include "tasks/fair_share.hpp"
#include "tasks/path_calm.hpp"
#include "tasks/path_memory.hpp"
#include "tasks/piece_wait.hpp"
#include "tasks/second_look.hpp"
#include "transport/path_facts.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

namespace liena::tasks {

/// What the bulk of a lane, or of several, is known to be carried at.
struct KnownRate {
    double bytesPerSecond = 0;
    std::chrono::steady_clock::time_point shown; ///< last, by what was sent
};

/// Pure. The rate grows while a round trip takes what it takes on the idle path, and falls below what was delivered as soon as it takes
/// longer: the difference is a queue that control would wait behind. Growth is quick up to the rate at which a queue was met last, gentle
/// near it, and bolder with each step beyond it, so that a path that heals is used within moments. On a slow path, where a step too far is
/// a long queue before it shows, a rate at which a queue was met twice is tried again after a while only, and gently. Round trips of a long
/// path vary without any queue: what is late by a part of a round trip only, while all that was sent arrives, costs the rate little, and
/// what goes on while less is sent, or far below a rate that passed, is held for the path's own. Where a long path turns out to be calm
/// (PathCalm), commands are to wait as little as on a short one: a rate at which a queue was met twice is tried again after a while only
/// there, too. What does not become shorter while bulk yields is no queue but another, longer way.
///
/// A computer or a network that stands still for a moment looks like a queue, or like a path that carries a tenth. So on a long way a queue
/// at a rate that passed just before is believed when it is seen twice, and on a short one what came at once is seen to drain first
/// (SecondLook). A rate that fell deep at once is raised again soon, and steps beyond a ceiling are bold up to the highest of late only,
/// which a moment's standstill does not change.
///
/// The lanes of one session share its path, and the rate is that of all of them together: each sends at an even part of it, by how many are
/// in a burst at the moment, and judges what it delivers as many times over. A burst that ends gives its part back at once, and one that
/// begins takes what another lane has learnt meanwhile.
///
/// In the spirit of delay-based congestion control (LEDBAT, RFC 6817; TIMELY, SIGCOMM 2015), with the kernel's own congestion control
/// below it: that one decides what the network bears at all.
class PathRate {
public:
    using Instant = std::chrono::steady_clock::time_point;
    using Nanoseconds = std::chrono::nanoseconds;

    static constexpr double least = 125'000;    ///< bytes per second: 1 Mbit/s
    static constexpr double first = 12'500'000; ///< before anything is known: 100 Mbit/s
    static constexpr double most = 12.5e9;      ///< 100 Gbit/s: no limit worth the name
    static constexpr double tried = 1.25;       ///< times the rate: what the end of a burst may leave at

    PathRate() = default;
    ~PathRate();
    PathRate(const PathRate&) = delete;
    PathRate& operator=(const PathRate&) = delete;

    /// With whom it shares the interface, and on behalf of the session with which device; null: with nobody.
    void shareWith(std::shared_ptr<FairShare> share, DeviceId session = {});
    DeviceId session() const { return m_session; }

    /// Before anything is known of the path: with this rate instead of `first`.
    void beginAt(double bytesPerSecond) { m_rate = std::clamp(bytesPerSecond, least, most); }

    /// While something is being sent: at each write that begins or ends, and now and then during one. `goesOn`: with what is being written
    /// that is not all.
    void observe(const transport::PathFacts& facts, Instant now, bool goesOn = true);

    /// From now on the facts are those of another connection.
    void restart();

    /// There is nothing more to send for now, but `unsent` bytes that the kernel has.
    void pause(Instant now, std::uint32_t unsent = 0);

    /// Who sends at the rate: is told when the others of the session made it another one between two looks. Until the next shareWith().
    class Sender {
    public:
        virtual void rateChanged() = 0;

    protected:
        ~Sender() = default;
    };
    void serve(Sender& sender) { m_sender = &sender; }

    /// So many lanes of its session are in a burst from now on.
    void shareAmong(std::size_t lanes, Instant now);

    /// It has more than one write to send: the others of its session make room.
    bool isBurst() const { return m_isBurst; }

    /// When the kernel will have sent what it had when the pause began.
    Instant leaves() const { return m_leaves; }

    /// Whether what is written now is the last of a burst. While a calm long way is learnt, that leaves faster than the rate: a whole burst
    /// too fast would be over before it told anything, and a command at its end would wait for all of it.
    void endsBurst(bool ends);

    /// Bytes per second at which to send.
    double rate() const { return std::min(part() * (m_draining ? m_drain : m_tries ? tried : 1.0), m_limit.value_or(most)); }

    /// Not more than this, whatever the path seems to carry; nothing: no limit.
    void limit(std::optional<double> bytesPerSecond) { m_limit = bytesPerSecond; }

    /// The rate of all lanes of the session together, without the moments in which a queue drains.
    double steady() const { return m_rate; }

    /// Moves it, and what it remembers as the path's, by so many bytes per second.
    void shift(double bytesPerSecond);

    /// When so much was sent last that others may learn from what it told.
    Instant judged() const { return m_judged; }

    /// In queues before the narrowest place, as last seen.
    Nanoseconds waiting() const { return m_waiting; }

    /// Bytes per second that the path is known to carry of this lane, with the part of it that was left to the lane of late; nothing until
    /// the path was filled once.
    std::optional<double> known() const;

    /// When what was sent last showed what the path carries.
    Instant shown() const { return m_shown; }

    /// The largest segment in bytes that a control message should wait for: a quarter of a millisecond of the path, within bounds.
    std::size_t segment() const;

private:
    /// From one decision to the next.
    struct Window {
        PathPoint begin;
        Nanoseconds windowClosed{};
        bool first = true; ///< after a pause: the acknowledgements of what was sent in it are still to come
    };

    struct Burst {
        Instant begin;
        std::optional<Instant> end;
        std::uint64_t bytesSent = 0; ///< before it
        bool alone = true;           ///< of those nothing was under way any more
        bool tries = false;          ///< its end left faster than the rate
    };

    transport::PathFacts asOfSession(const transport::PathFacts& facts, Instant now);
    transport::PathFacts asOfLate(transport::PathFacts facts, Instant now);
    void enter(bool goesOn, Instant now);
    void forgetQueues();
    void decide(const transport::PathFacts& facts, Instant now);
    void judgeBurst(const transport::PathFacts& facts, Instant now);
    bool looksAgain(const transport::PathFacts& facts, Instant now);
    bool mayStillDrain(const transport::PathFacts& facts, std::uint64_t acknowledgedBefore) const;
    void judgeFrom(const transport::PathFacts& facts, Instant now);
    void goOn(const transport::PathFacts& facts, Instant now);
    bool isAlone() const { return !m_share || m_share->isAlone(*this); }
    bool isCalm(const transport::PathFacts& facts) const;
    bool mayTry() const;
    bool isEffective(const transport::PathFacts& facts) const;
    bool hasWaited(const transport::PathFacts& facts) const;
    bool hasQueue(const transport::PathFacts& facts, Instant now) const;
    double mayBeUnderWay(const transport::PathFacts& facts, Instant now) const;
    bool mayBeUnrest(const transport::PathFacts& facts) const;
    Nanoseconds unrest(const transport::PathFacts& facts) const;
    bool carriesWhatIsSent(const transport::PathFacts& facts, Instant now) const;
    void learnFrom(const PathRate& other);
    double part() const { return m_rate / static_cast<double>(m_lanes); }
    Nanoseconds timeOf(double bytes) const;
    Nanoseconds timeToNotice() const;
    Nanoseconds pauseBetweenSteps() const;
    Nanoseconds pauseInDoubt(const transport::PathFacts& facts) const;
    bool isSlow() const;
    std::optional<Nanoseconds> usualWait() const;
    Nanoseconds tolerated(const transport::PathFacts& facts) const;
    void meetQueue(const transport::PathFacts& facts, double delivered, bool allCame, Instant now);
    bool takenForUnrest(const transport::PathFacts& facts, double delivered, Instant now);
    double doubtedBelow(Instant now) const;
    void yield(const transport::PathFacts& facts);
    std::uint64_t whenForgotten(const transport::PathFacts& facts) const;
    void grow(const transport::PathFacts& facts, double delivered, double quickStep, Instant now);
    bool listen(const transport::PathFacts& facts, Instant now);
    void doubtCeiling(Instant now);
    void growInDoubt(const transport::PathFacts& facts, Instant now);

    std::shared_ptr<FairShare> m_share;
    DeviceId m_session;
    Sender* m_sender = nullptr;
    std::size_t m_lanes = 1; ///< of the session, in a burst: so many parts has the rate
    SharedBytes m_bytes;
    std::uint64_t m_sent = 0; ///< as the session's, when seen last
    double m_usualPart = 1;   ///< of the rate, of late
    bool m_isBurst = false;
    Instant m_leaves{};
    Instant m_judged{};
    Nanoseconds m_waiting{};
    double m_rate = first;
    std::optional<double> m_limit;
    std::optional<double> m_ceiling;       ///< delivered when a queue was met last
    std::optional<double> m_ceilingBefore; ///< the fall that is doubted, or was last
    double m_highest = 0;                  ///< of the ceilings of late; beyond another one steps are bold up to there only, on a long way
    bool m_doubted = false;                ///< the rate fell so deep at once that the ceiling is to be met again, soon
    double m_delivered = 0;                ///< bytes per second, of late
    Instant m_shown{};
    bool m_isLong = false; ///< the way, when looked at last
    bool m_tries = false;  ///< what the path carries beyond the rate, now
    bool m_draining = false;
    double m_drain = 1;            ///< of the rate, while it drains
    std::uint64_t m_effective = 0; ///< what is acknowledged below this says nothing of the rate as it is now
    double m_step = 1;             ///< the next one near the ceiling
    Instant m_nextStep{};
    std::optional<Instant> m_confirmed; ///< a slow or calm path's ceiling, met twice: tried again from then on, and gently
    std::optional<Window> m_window;
    PathCourse m_course; ///< in the last windows: on a slow path one of them is a packet or two
    PathDepartures m_departures;
    RoundTripOfLate m_ofLate;
    SecondLook m_look;
    std::optional<Instant> m_stoodStill; ///< what a second look found last, since the rate fell deep
    StandingWait m_standing;             ///< since bulk yielded
    Nanoseconds m_least{};               ///< that a round trip takes, as last known
    UsualWait m_usualWait;               ///< below the ceiling
    PieceWait m_pieceWait;
    Nanoseconds m_unrest{}; ///< by which round trips on this path vary without a queue of ours, as far as it was seen
    Instant m_unrestSeen{};
    PathCalm m_calm;
    double m_proven = 0; ///< bytes per second that passed without a queue, of late
    double m_passed = 0; ///< the rate at the last verdict, when that met no queue
    Instant m_provenFaded{};
    std::optional<Burst> m_burst; ///< nothing was decided since it began
};

} // namespace liena::tasks
