// Measurements that are no single fault: how fast a stand-by is known, how often it is false, what an idle session costs, how sessions
// share a line, and the soak.
#pragma once

#include <cstdint>
#include <string>

namespace liena::lab {

struct StudyOptions {
    int repetitions = 5;
    int lossSeconds = 30; ///< at each rate of loss
    double soakHours = 1;
    int soakInterval = 30; ///< seconds from fault to fault
    std::uint64_t seed = 1;
    bool ordinary = false; ///< without real-time priority
    bool keep = false;
};

/// Each prints what it measured, with the machine's own largest stall, and returns whether what must hold held.
bool studySpread(const StudyOptions& options);
bool studyLoss(const StudyOptions& options);
bool studyMemory(const StudyOptions& options);
bool studyShare(const StudyOptions& options);
bool soak(const StudyOptions& options);

} // namespace liena::lab
