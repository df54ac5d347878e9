// What the two ends do with a link while it is measured; the same for every transport.
#pragma once

#include "measure/options.hpp"
#include "measure/transport.hpp"

#include <memory>

namespace liena::compare {

/// The end that the options name. The client of the round trips, and the echo of all other workloads, prints the latencies or rates.
std::unique_ptr<LinkEvents> makeWorkload(Transport& transport, const Options& options);

std::unique_ptr<LinkEvents> makeRoundTrip(Transport& transport, const Options& options);
std::unique_ptr<LinkEvents> makeLoad(Transport& transport, const Options& options);
std::unique_ptr<LinkEvents> makeThroughput(Transport& transport, const Options& options);

} // namespace liena::compare
