// Which rate and encoding the way to the viewers carries: a declared ladder.
#pragma once

#include "frame_encoder.hpp"
#include "xray_machine.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace liena::devices {

/// How pictures are taken and encoded.
struct PictureRung {
    unsigned divisor = 1; ///< one pulse of so many that were asked for
    Encoding encoding = Encoding::Raw;
    unsigned quality = 0; ///< as FrameEncoder says

    friend bool operator==(const PictureRung&, const PictureRung&) = default;
};

/// `7.5 of 15 /s, lossy 75`: for logs.
std::string describe(const PictureRung& rung, double askedRate);

/// How far the ladder may go. Who asks for lossy pictures permits those, and with Lossless no worse ones.
enum class Reduction : std::uint8_t { None, Lossless, Lossy };

/// The way to one viewer since the last look.
struct PathReading {
    std::optional<double> bulkRate; ///< bytes per second that it can count on
    std::uint64_t withheld = 0;     ///< pictures that did not leave
};

/// The rungs, best first, for pictures asked for as raw:
///
///     raw        full rate, 1/2                      lossy 75   full rate, 1/2
///     lossless   full rate, 1/2                      lossy 50   full rate, 1/2, 1/3, 1/4
///     lossy 90   full rate, 1/2
///
/// First the rate, then the encoding: 7.5 pictures a second are usual in low-dose work, a wire of a third of a millimetre is what a lossy
/// encoding blurs first, and a pulse that is not emitted is dose saved. So each encoding is tried at half the rate before the next one
/// begins. Lossless costs no pixel and still comes after raw at half the rate: it costs computing time, which is age. Only the last
/// encoding goes below half, for then nothing else is left, and no rung lowers the rate below `leastRate`: pictures further apart would
/// count as frozen. Behind the last rung the library withholds. Where lossy pictures are not permitted, lossless is the last encoding.
/// Pictures asked for as JPEG-LS or JPEG begin there. Every acquisition mode has the same ladder.
///
/// Down to the best lighter rung that the known rate carries, once it did not carry the present one for `patience`: a computer or a network
/// that stands still for some milliseconds lowers it for a moment only. By one as soon as two pictures were withheld within
/// `withheldWindow`. Up after `patience` without a withheld picture: to the best rung that the known rate
/// carried all the time with `headroom`; by one where the rate was unknown for some of the time, so that the whole way up takes 4.4 s at 15
/// or 30 pulses a second. With `leastHeadroom` it takes `longPatience`, and goes by one. A step up that fails within `proven` makes the
/// next wait: `firstWait`, then twice as long each time, at most `longestWait`; unless the rate is far above the one that was relied on.
///
/// Pictures that use next to nothing of the known rate do not show whether the way carries more by now, and with them it would never be
/// known. Then the next better rung is tried for `trial` though the rate does not carry it, and that is a climb as any other.
///
/// An encoding that fails is left at once, for the next lighter rung that works, and tried again each `measureAgain`, on pictures that are
/// not sent in it.
///
/// A picture that takes longer to make than until the next pulse makes that one fall out, and a rate that is told and not kept is none. So
/// a rung on which even the quickest of the last four took longer is left as well, for the next one on which they have the time, and not
/// taken; one above only where a fifth of the time would be left.
///
/// Sizes are measured as pictures are encoded, assumed before. What is encoded only to be measured, toMeasure() says: each encoding once,
/// and on a lower rung the better ones again, since the way up is judged by them. Of several viewers the worst decides. Pure: time comes
/// from the caller.
class PictureLadder {
public:
    static constexpr double leastRate = 5; ///< /s
    static constexpr double fill = 0.9;    ///< of the known rate: the most that a rung stepped down to may need
    static constexpr double headroom = 1.25;
    static constexpr double leastHeadroom = 1.05;
    static constexpr std::chrono::milliseconds patience{350};
    static constexpr std::chrono::milliseconds longPatience{1500};
    static constexpr std::chrono::seconds withheldWindow{1};
    static constexpr std::chrono::seconds proven{10};
    static constexpr std::chrono::seconds firstWait{2};
    static constexpr std::chrono::seconds longestWait{30};
    static constexpr std::chrono::seconds measureAgain{2};
    static constexpr double telling = 0.1; ///< of the known rate: what uses less does not show whether it is still true
    static constexpr std::chrono::seconds trial{1};
    static constexpr double spare = 0.2; ///< of the time between two pulses: is left on a rung that is climbed to

    PictureLadder(Encoding asked, unsigned quality, Reduction permitted);

    /// Before each pulse; true when the rung has changed. `askedRate`: pictures per second, above 0.
    bool update(SteadyTime now, double askedRate, std::span<const PathReading> viewers);

    /// What the newest picture came to in the encoding of `rung`, what its pixels were before, and how long the encoding took.
    void measured(SteadyTime now, const PictureRung& rung, std::size_t encoded, std::size_t unencoded,
                  std::chrono::nanoseconds encoding = {});

    /// So long the newest picture took from its pulse until it could be encoded.
    void taken(std::chrono::nanoseconds time) { m_taking.note(time); }

    /// The encoding of `rung` could not hold the newest picture: its rungs are left out until it is measured() again.
    void failed(SteadyTime now, const PictureRung& rung);

    /// At the last update pictures took longer to make than until the next pulse, so that the rung was left if there is a lower one.
    bool tookTooLong() const { return m_tookTooLong; }

    /// Some rung is left whose encoding does not fail.
    bool works() const;

    /// Whose encoding the newest picture is to be measured in, besides its own; mostly none.
    std::optional<PictureRung> toMeasure(SteadyTime now) const;

    const PictureRung& rung() const { return m_rungs[m_step]; }
    std::size_t step() const { return m_step; } ///< 0: as asked
    const std::vector<PictureRung>& rungs() const { return m_rungs; }

private:
    /// Of the last four pictures.
    class Times {
    public:
        void note(std::chrono::nanoseconds time) { m_last[m_count++ % m_last.size()] = time; }
        bool isFull() const { return m_count >= m_last.size(); }
        /// A computer that stands still makes some of them late, not each. 0 while none is known.
        std::chrono::nanoseconds least() const
        {
            const auto end = m_last.begin() + static_cast<std::ptrdiff_t>(std::min(m_count, m_last.size()));
            return m_count > 0 ? *std::min_element(m_last.begin(), end) : std::chrono::nanoseconds::zero();
        }

    private:
        std::array<std::chrono::nanoseconds, 4> m_last{};
        std::size_t m_count = 0;
    };

    struct Cost {
        Encoding encoding = Encoding::Raw;
        unsigned quality = 0;
        double share = 1;                   ///< of the bytes before encoding
        std::optional<SteadyTime> measured; ///< or found to fail
        bool fails = false;
        Times times{};
    };

    void declare(Reduction permitted);
    std::size_t costOf(const PictureRung& rung) const;
    double load(std::size_t step) const; ///< bytes per second
    bool isPermitted(std::size_t step) const;
    bool fails(std::size_t step) const { return m_costs[costOf(m_rungs[step])].fails; }
    bool takesTooLong(std::size_t step) const;
    void leave(SteadyTime now);
    void breakPromise(SteadyTime now);

    void hear(SteadyTime now, std::span<const PathReading> viewers);
    void noteWithheld(SteadyTime now, std::uint64_t count);
    std::size_t lighter() const;
    std::size_t above() const;
    std::size_t better() const;
    bool isSteady(SteadyTime now);
    bool isTooHeavy(SteadyTime now);
    void stepDown(SteadyTime now);
    void endWatch(SteadyTime now);
    void climbTo(std::size_t step, SteadyTime now);
    bool mayClimb(SteadyTime now) const;
    bool tellsNothing() const;
    void beginWatch(SteadyTime now);

    std::vector<Cost> m_costs;
    std::vector<PictureRung> m_rungs;
    std::size_t m_step = 0;
    bool m_tookTooLong = false;
    Times m_taking;
    double m_askedRate = 15;
    double m_unencoded = 0; ///< bytes of the newest picture's pixels; 0 before the first

    std::optional<SteadyTime> m_updated;
    std::optional<double> m_rate; ///< known now, of the worst viewer
    std::uint64_t m_withheld = 0; ///< within the window
    SteadyTime m_lastWithheld;
    std::optional<SteadyTime> m_heavySince; ///< the known rate does not carry the present rung
    SteadyTime m_settled;                   ///< the pictures of a heavier rung have left by then

    SteadyTime m_watchBegan;                 ///< nothing was withheld since
    std::optional<double> m_carriedRate;     ///< the least of the rates that were known since
    bool m_wasUnknown = true;                ///< the rate, at some time since
    std::optional<SteadyTime> m_steadySince; ///< the known rate carries the next better rung, if barely
    std::optional<SteadyTime> m_climbed;     ///< and not proven
    SteadyTime m_trialEnds;
    std::optional<double> m_promise; ///< the rate that the climb relied on
    std::optional<double> m_broken;  ///< a promise that was not kept
    std::chrono::nanoseconds m_wait{firstWait};
    SteadyTime m_notBefore;
};

} // namespace liena::devices
