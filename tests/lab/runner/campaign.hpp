// Runs each fault some times on a system that is kept as long as the cast allows.
#pragma once

#include "runner/faults.hpp"
#include "runner/table.hpp"
#include "support/canary.hpp"

#include <memory>
#include <random>
#include <vector>

namespace liena::lab {

struct CampaignOptions {
    int repetitions = 5;
    bool repetitionsAsked = false;
    std::uint64_t seed = 1;
    bool ordinary = false; ///< without real-time priority
    bool keep = false;
};

class Campaign {
public:
    explicit Campaign(CampaignOptions options) : m_options(options), m_random(options.seed) {}

    Row run(const Fault& fault);

private:
    void prepare(Cast cast);
    void repeat(const Fault& fault, Row& row);
    void noteDetection(const Outcome& outcome, const std::optional<double>& detects, Row& row);

    CampaignOptions m_options;
    std::mt19937_64 m_random;
    test::Canary m_canary;
    Cast m_cast = Cast::Pair;
    std::unique_ptr<Rig> m_rig;
    std::unique_ptr<Judge> m_judge;
};

SystemPlan planOf(Cast cast);

} // namespace liena::lab
