// Runs each fault some times: implementation.
#include "runner/campaign.hpp"

#include <algorithm>

namespace liena::lab {

SystemPlan planOf(Cast cast) { return cast == Cast::Pair ? plans::pair() : plans::withPictures(); }

void Campaign::prepare(Cast cast)
{
    if (m_rig && m_cast == cast)
        return;
    m_judge.reset();
    m_rig.reset();
    m_cast = cast;
    m_rig = std::make_unique<Rig>(planOf(cast), RigOptions{m_options.seed, m_options.ordinary, m_options.keep});
    m_judge = std::make_unique<Judge>(*m_rig);
    m_rig->startAll();
}

Row Campaign::run(const Fault& fault)
{
    Row row;
    row.fault = fault.name;
    row.row = fault.row;
    row.sentence = fault.sentence;
    const int wanted = fault.most > 0 && !m_options.repetitionsAsked ? std::min(fault.most, m_options.repetitions) : m_options.repetitions;
    (void)m_canary.takeLargest();
    for (int i = 0; i < wanted; ++i)
        repeat(fault, row);
    row.stall = m_canary.takeLargest();
    return row;
}

void Campaign::repeat(const Fault& fault, Row& row)
{
    ++row.repetitions;
    Outcome outcome;
    bool stuck = false;
    try {
        prepare(fault.cast);
        Scene scene(*m_rig, m_random);
        try {
            fault.run(scene);
        } catch (const Stuck& reason) {
            scene.fails(reason.what);
            stuck = true;
        }
        outcome = scene.outcome();
        row.tally.add(m_judge->judge(outcome.broken));
    } catch (const std::exception& failure) {
        outcome.broken.push_back(failure.what());
        stuck = true;
    }
    if (stuck) // what is left of it says nothing about the next fault
        m_rig.reset();
    for (const auto& detects : {outcome.cockpitDetects, outcome.robotDetects})
        noteDetection(outcome, detects, row);
    row.cockpitDetects.add(outcome.cockpitDetects);
    row.robotDetects.add(outcome.robotDetects);
    row.stops.add(outcome.stops);
    row.reopens.add(outcome.reopens);
    if (!outcome.seen.empty())
        ++row.seen[outcome.seen];
    for (const auto& note : outcome.notes)
        ++row.notes[note];
    row.broken.insert(row.broken.end(), outcome.broken.begin(), outcome.broken.end());
}

/// A processor that stood still on the way to it speaks for the machine, not for the product.
void Campaign::noteDetection(const Outcome& outcome, const std::optional<double>& detects, Row& row)
{
    constexpr double calm = 1; // ms
    row.detects.add(detects);
    if (detects && m_canary.largestBetween(outcome.began, outcome.began + static_cast<std::int64_t>(*detects * 1e6)) < calm)
        row.calmDetects.add(detects);
}

} // namespace liena::lab
