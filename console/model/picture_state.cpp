// The rule that tells a live picture from a frozen one.
#include "model/picture_state.hpp"

#include <algorithm>

namespace console {

namespace {

constexpr std::chrono::seconds rateWindow{1};
constexpr std::chrono::seconds firstPictureGrace{1};

/// More than two thirds are enough; two thirds are not.
bool enough(double shown, double expected) { return expected <= 0 || 3 * shown > 2 * expected; }

/// Not by a tenth of them, nor by the one more or less that a second of counting has.
bool nearly(double shown, double expected) { return expected - shown <= std::max(1.0, expected / 10); }

/// Of one whose times are known.
Duration wayOf(const PictureStamp& stamp) { return stamp.arrived - *stamp.captured - stamp.beforeSending; }

} // namespace

PictureState::PictureState(QObject* parent) : QObject(parent) {}

/// When what moves in it was taken, as well as the clocks can tell: a temporal filter shows that later.
std::optional<Instant> PictureState::shown(const PictureStamp& stamp) const
{
    const bool compared = stamp.captured && stamp.uncertainty <= clockUncertaintyLimit(limit());
    return compared ? std::optional<Instant>(*stamp.captured - stamp.filterDelay) : std::nullopt;
}

std::optional<Instant> PictureState::earliest(const PictureStamp& stamp) const
{
    const auto known = shown(stamp);
    return known ? std::optional<Instant>(*known - stamp.uncertainty) : std::nullopt;
}

void PictureState::setProfile(PictureProfile profile)
{
    if (m_profile == profile)
        return;
    m_profile = profile;
    Q_EMIT profileChanged();
}

void PictureState::expect(double perSecond, Instant now)
{
    if (perSecond > 0 && m_expected <= 0)
        m_expectedSince = now;
    if (m_expected <= 0)
        m_refusedSince = false;
    const double before = expectedRate();
    const bool ends = m_expected > 0 && perSecond <= 0;
    m_expected = std::max(perSecond, 0.0);
    noteRate(before, now);
    if (ends)
        Q_EMIT runEnded();
}

/// What the X-ray system says that it sends of what it acquires.
double PictureState::expectedRate() const
{
    const bool reduced = m_newest && m_newest->reduction.stands() && m_newest->reduction.rate > 0;
    return reduced ? std::min(m_expected, m_newest->reduction.rate) : m_expected;
}

/// What is shown is counted over a second: for so long after a rise it holds pictures of the lower rate.
void PictureState::noteRate(double before, Instant now)
{
    if (expectedRate() <= before)
        return;
    const bool again = m_rose && now - *m_rose < rateWindow;
    m_rateBefore = again ? std::min(m_rateBefore, before) : before;
    if (!again) // else a rate that goes up and down would never be asked for
        m_rose = now;
}

void PictureState::setLinkUp(bool up) { m_linkUp = up; }

double PictureState::paintedPerSecond(Instant now) const
{
    return static_cast<double>(std::count_if(m_paints.begin(), m_paints.end(), [now](Instant at) { return at > now - rateWindow; })) /
           seconds(rateWindow);
}

/// None was painted since they are expected: what stands there is of a run before.
bool PictureState::awaitsFirst() const { return !m_newest || m_newest->painted < m_expectedSince; }

PictureCondition PictureState::condition(Instant now) const
{
    if (!m_newest)
        return PictureCondition::None;
    if (m_expected <= 0)
        return PictureCondition::Held;
    if (!m_linkUp)
        return PictureCondition::Frozen;
    if (awaitsFirst())
        return now - m_expectedSince <= firstPictureGrace ? PictureCondition::Held : PictureCondition::Frozen;
    const auto taken = shownAtEarliest();
    if (now - taken.value_or(m_newest->painted) > limit())
        return PictureCondition::Frozen;
    return taken ? PictureCondition::Live : PictureCondition::Unknown;
}

PictureReading PictureState::reading(Instant now) const
{
    PictureReading reading;
    reading.condition = condition(now);
    reading.expectedPerSecond = expectedRate();
    reading.overdue = awaitsFirst() && m_expected > 0 && now - m_expectedSince > firstPictureGrace;
    if (reading.overdue && m_refusedSince)
        reading.refusal = m_refusal;
    if (!m_newest)
        return reading;
    reading.source = m_newest->source;
    reading.reduction = m_newest->reduction;
    reading.mayGuide = mayGuide(m_newest->source);
    reading.frame = m_newest->frame;
    reading.captureNs = m_newest->captureNs;
    if (const auto taken = shown(*m_newest)) {
        reading.age = now - *taken;
        reading.uncertainty = m_newest->uncertainty;
        reading.network = wayOf(*m_newest);
    }
    reading.processing = m_newest->painted - m_newest->arrived + m_newest->filterDelay;
    reading.shownPerSecond = paintedPerSecond(now);
    reading.atRate = enough(reading.shownPerSecond, reading.expectedPerSecond);
    const bool rising = m_rose && now - *m_rose < rateWindow;
    const double asked = rising ? std::min(m_rateBefore, reading.expectedPerSecond) : reading.expectedPerSecond;
    reading.keepsRate = enough(reading.shownPerSecond, asked);
    reading.slow = !nearly(reading.shownPerSecond, asked);
    if (reading.condition == PictureCondition::Live && reading.atRate)
        reading.liveFor = now - m_liveSince;
    if (reading.condition == PictureCondition::Frozen)
        reading.frozenFor = now - m_newest->painted;
    if (reading.condition == PictureCondition::Unknown && m_unknownSince)
        reading.unknownFor = now - std::max(*m_unknownSince, m_expectedSince);
    return reading;
}

Duration PictureState::filterRoom() const
{
    const auto taken = shownAtEarliest();
    if (!taken || m_expected <= 0)
        return Duration::zero();
    return std::max(limit() - filterMargin - (m_newest->painted - *taken - m_newest->filterDelay), Duration::zero());
}

void PictureState::notePainted(const PictureStamp& stamp)
{
    if (stamp.role != PictureRole::Live)
        return;
    if (m_newest && m_newest->frame == stamp.frame && m_newest->acquisition == stamp.acquisition && m_newest->captureNs == stamp.captureNs)
        return;
    const auto taken = earliest(stamp);
    const bool young = taken && stamp.painted - *taken <= limit();
    const auto before = shownAtEarliest(); // where that passed the limit, the picture was frozen until now
    const bool gap =
        !m_newest || stamp.painted - before.value_or(m_newest->painted) > limit() || m_newest->acquisition != stamp.acquisition;
    if (gap || !young)
        m_liveSince = stamp.painted;
    if (taken)
        m_unknownSince.reset();
    else if (!m_unknownSince)
        m_unknownSince = stamp.painted;
    const PictureReduction reductionBefore = m_newest ? m_newest->reduction : PictureReduction();
    const double rateBefore = expectedRate();
    m_newest = stamp;
    noteRate(rateBefore, stamp.painted);
    ++m_painted;
    noteStages(stamp);
    m_paints.push_back(stamp.painted);
    while (m_paints.front() < stamp.painted - 2 * rateWindow)
        m_paints.pop_front();
    Q_EMIT painted(stamp.frame);
    if (reductionBefore != stamp.reduction)
        Q_EMIT reductionChanged(stamp.reduction);
}

void PictureState::noteStages(const PictureStamp& stamp)
{
    if (!shown(stamp))
        return;
    const auto waiting = stamp.painted - stamp.arrived - stamp.decoding - stamp.filters - stamp.window;
    m_stages.note({stamp.beforeSending, wayOf(stamp), waiting, stamp.decoding, stamp.filters, stamp.window, stamp.filterDelay},
                  stamp.painted);
}

void PictureState::notePresented(quint32 frame, Duration presenting)
{
    if (m_newest && m_newest->frame == frame && shown(*m_newest))
        m_stages.notePresented(presenting);
}

void PictureState::noteRefused(const QString& reason)
{
    m_refusedSince = true;
    if (m_refusal == reason)
        return;
    m_refusal = reason;
    Q_EMIT refused(reason);
}

} // namespace console
