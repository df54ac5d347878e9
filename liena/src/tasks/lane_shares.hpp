// How the bulk lanes of a peer share what may leave for it.
#pragma once

#include <numeric>
#include <optional>
#include <span>
#include <vector>

namespace liena::tasks {

/// Pure. Each lane as much of the limit as it has of what all together would send. All in bytes per second; 0 is a lane that is not paced
/// or has no connection: nothing limits it, since its rate is not known before it stands.
inline std::vector<std::optional<double>> sharesOf(std::optional<double> limit, std::span<const double> steadyRates)
{
    const double sum = std::accumulate(steadyRates.begin(), steadyRates.end(), 0.0);
    std::vector<std::optional<double>> shares;
    for (const double rate : steadyRates)
        shares.push_back(limit && rate > 0 ? std::optional(*limit * rate / sum) : std::nullopt);
    return shares;
}

} // namespace liena::tasks
