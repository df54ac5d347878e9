// Warming up, measuring, over: by time since the link was ready.
#pragma once

#include "measure/options.hpp"
#include "measure/stamp.hpp"

namespace liena::compare {

class Phases {
public:
    explicit Phases(const Options& options)
        : m_warmUp(static_cast<std::int64_t>(options.warmUp * 1e9)), m_measured(static_cast<std::int64_t>(options.seconds * 1e9))
    {}

    void begin(Instant now) { m_start = now; }
    bool begun() const { return m_start != Instant{}; }
    bool isMeasured(Instant at) const { return begun() && at >= m_start + m_warmUp && !isOver(at); }
    bool isOver(Instant at) const { return begun() && at >= end(); }
    Instant end() const { return m_start + m_warmUp + m_measured; }

private:
    Nanoseconds m_warmUp;
    Nanoseconds m_measured;
    Instant m_start{};
};

} // namespace liena::compare
