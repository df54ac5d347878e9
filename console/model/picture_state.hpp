// What stands on the live image now: its age, whether it is live, and how many are painted.
#pragma once

#include "model/instant.hpp"
#include "model/picture_reduction.hpp"
#include "model/picture_stages.hpp"
#include "model/profile_limits.hpp"
#include "model/xray_frame.hpp"

#include <QObject>
#include <QString>

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>

namespace console {

/// What a picture is for. Set where the picture is made, and never changed: only a live one can ever stand for the present.
enum class PictureRole : std::uint8_t {
    Live,    ///< the newest that came
    Hold,    ///< last image hold, beside the live picture
    Review,  ///< from the last minute
    Roadmap, ///< the newest that came, once more, under the vessels of a run
};

/// LIVE, LAST IMAGE HOLD, REVIEW, ROADMAP.
QString word(PictureRole role);

/// The times of one painted picture. The view hands it over when it has painted the picture, not before.
struct PictureStamp {
    quint32 frame = 0;
    quint32 acquisition = 0;
    PictureSource source = PictureSource::Recorded;
    PictureRole role = PictureRole::Live; ///< any other is not noted
    PictureReduction reduction;
    quint64 captureNs = 0;
    std::optional<Instant> captured; ///< XrayFrame::captured()
    Duration uncertainty{};          ///< of `captured`, to either side
    Duration beforeSending{};        ///< the part of `captured` to `arrived` that passed at the X-ray system
    Instant arrived;
    Duration decoding{}; ///< what the stages here took of the time from `arrived` to `painted`
    Duration filters{};
    Duration window{};
    Duration filterDelay{}; ///< what a temporal filter adds to the age of what moves
    Instant painted;
};

enum class PictureCondition : std::uint8_t {
    None,    ///< nothing was painted yet
    Live,    ///< younger than the limit, whichever way the clocks err
    Unknown, ///< pictures come, but their age cannot be told well enough: never good enough for motion
    Frozen,  ///< should be live and is not: a fault
    Held,    ///< last image hold: the pedal is up, and nothing is expected
};

/// NO PICTURE, LIVE, AGE UNKNOWN, FROZEN, LAST IMAGE HOLD.
QString word(PictureCondition condition);

/// One moment of the picture, for the chip in its corner and for the guards.
struct PictureReading {
    PictureCondition condition = PictureCondition::None;
    PictureSource source = PictureSource::Recorded;
    PictureReduction reduction;
    quint32 frame = 0;
    quint64 captureNs = 0;
    std::optional<Duration> age;     ///< of the newest painted picture, capture to now
    Duration uncertainty{};          ///< of `age`, to either side
    std::optional<Duration> network; ///< NET: from the sending to the arrival
    Duration processing{};           ///< PROC: arrival to paint, with the filter's delay
    bool mayGuide = false;           ///< the source is one that instruments may be moved by
    double shownPerSecond = 0;
    double expectedPerSecond = 0; ///< acquired, or what the X-ray system says that it sends of that; 0: nothing is expected
    bool atRate = false;          ///< more than two thirds of that are shown
    bool keepsRate = false;       ///< the same, where a rate that rose within the last second is not asked for yet
    bool slow = false;            ///< noticeably fewer than that rate are shown: for caution
    Duration liveFor{};           ///< without a gap beyond the limit, at the rate
    std::optional<Duration> frozenFor;
    std::optional<Duration> unknownFor; ///< of pictures of this run
    bool overdue = false; ///< the first picture since they are expected should have been painted by now; another may stand there, frozen
    QString refusal;      ///< overdue, though pictures came since they are expected: why the last one was not shown
};

/// GUI thread only.
class PictureState : public QObject {
    Q_OBJECT
public:
    explicit PictureState(QObject* parent = nullptr);

    PictureReading reading(Instant now) const;

    PictureProfile profile() const { return m_profile; }
    Duration limit() const { return ageLimit(m_profile); }
    void setProfile(PictureProfile profile);

    /// A rehearsal on simulated devices: a recording may stand for the live picture, and everything says so. Never in a procedure.
    void setRehearsal(bool rehearsal) { m_rehearsal = rehearsal; }
    bool isRehearsal() const { return m_rehearsal; }

    /// Instruments may be moved by a picture of that source.
    bool mayGuide(PictureSource source) const { return source != PictureSource::Recorded || m_rehearsal; }

    quint64 paintedCount() const { return m_painted; }

    /// Of pictures whose age was known.
    const PictureStages& stages() const { return m_stages; }
    const std::optional<PictureStamp>& newest() const { return m_newest; }

    /// The earliest at which what moves in the newest picture can have been taken: what every limit of age is held against. Nothing when
    /// the clocks are not compared well enough.
    std::optional<Instant> shownAtEarliest() const { return m_newest ? earliest(*m_newest) : std::nullopt; }

    /// Pictures should come now (beam on, pedal down, link open), so many a second; 0: nothing is expected.
    void expect(double perSecond, Instant now);

    /// The link to the X-ray system does not carry pictures: what should be live is frozen, however young.
    void setLinkUp(bool up);

    /// What the newest picture leaves of the limit for a temporal filter's delay and for the time that the picture will stand on the
    /// screen: limit − NET − PROC without filter − what the clocks may err − `filterMargin`. Zero while the age is unknown.
    Duration filterRoom() const;

    /// By so much the next picture may come later than this one did: without it, a filter that uses its room would let each picture
    /// freeze for a moment before the next one is there, and motion would be held for it.
    static constexpr std::chrono::milliseconds filterMargin{20};

    /// From the view's paint; a picture that is painted again is not a new one, and one that is held or reviewed is none.
    void notePainted(const PictureStamp& stamp);

    /// That picture's window was handed over to the screen, so long after its paint.
    void notePresented(quint32 frame, Duration presenting);

    /// From the pipeline: a picture could not be shown, and why, in words that are no sentence. One line per cause.
    void noteRefused(const QString& reason);
    const QString& lastRefusal() const { return m_refusal; }

Q_SIGNALS:
    void painted(quint32 frame);
    void refused(const QString& reason);

    /// With the first picture that is reduced otherwise than the one before it, or no longer.
    void reductionChanged(const console::PictureReduction& reduction);

    /// Nothing is expected any more; also when nothing of the run was painted.
    void runEnded();
    void profileChanged();

private:
    PictureCondition condition(Instant now) const;
    bool awaitsFirst() const;
    std::optional<Instant> shown(const PictureStamp& stamp) const;
    std::optional<Instant> earliest(const PictureStamp& stamp) const;
    double paintedPerSecond(Instant now) const;
    double expectedRate() const;
    void noteRate(double before, Instant now);
    void noteStages(const PictureStamp& stamp);

    std::optional<PictureStamp> m_newest;
    std::deque<Instant> m_paints; ///< of the last two seconds
    PictureStages m_stages;
    Instant m_liveSince;                   ///< start of the present unbroken run
    std::optional<Instant> m_unknownSince; ///< the age of what was painted
    Instant m_expectedSince;
    double m_expected = 0;
    double m_rateBefore = 0;       ///< what was expected before it rose
    std::optional<Instant> m_rose; ///< when it did so last
    bool m_linkUp = false;
    bool m_rehearsal = false;
    PictureProfile m_profile = PictureProfile::Neuro;
    quint64 m_painted = 0;
    QString m_refusal;
    bool m_refusedSince = false; ///< pictures are expected
};

} // namespace console
