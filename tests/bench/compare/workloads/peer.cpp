// One end, from its command line to the end of its input.
#include "workloads/peer.hpp"

#include "workloads/workload.hpp"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>
#include <thread>

namespace liena::compare {

[[noreturn]] void runPeer(int argc, char** argv, const std::string& name, const TransportMaker& make)
{
    std::signal(SIGPIPE, SIG_IGN);
    const auto options = readOptions(argc, argv, name);
    try {
        const auto transport = make(options);
        const auto workload = makeWorkload(*transport, options);
        std::thread([&stopped = *transport] {
            for (std::string line; std::getline(std::cin, line);) {
            }
            stopped.stop();
        }).detach();
        transport->run(*workload);
        std::fflush(stdout);
        std::_Exit(0); // the thread that reads the input may still wait for it
    } catch (const std::exception& failure) {
        std::fprintf(stderr, "peer over %s: %s\n", name.c_str(), failure.what());
        std::_Exit(1);
    }
}

} // namespace liena::compare
