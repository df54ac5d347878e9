// The main program of every peer.
#pragma once

#include "measure/options.hpp"
#include "measure/transport.hpp"

#include <functional>
#include <memory>
#include <string>

namespace liena::compare {

using TransportMaker = std::function<std::unique_ptr<Transport>(const Options&)>;

/// Runs the workload over what `make` makes until standard input ends, or the link; then the program ends.
[[noreturn]] void runPeer(int argc, char** argv, const std::string& name, const TransportMaker& make);

} // namespace liena::compare
