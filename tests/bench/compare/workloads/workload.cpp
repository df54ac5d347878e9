// Which workload the options mean.
#include "workloads/workload.hpp"

namespace liena::compare {

std::unique_ptr<LinkEvents> makeWorkload(Transport& transport, const Options& options)
{
    switch (options.workload) {
    case WorkloadKind::RoundTrip:
    case WorkloadKind::Paced:
        return makeRoundTrip(transport, options);
    case WorkloadKind::Load:
        return makeLoad(transport, options);
    case WorkloadKind::Frames:
    case WorkloadKind::Messages:
        break;
    }
    return makeThroughput(transport, options);
}

} // namespace liena::compare
