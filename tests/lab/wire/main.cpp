// lab_wire: joins TAP devices in the network namespaces whose descriptors it inherits.
#include "wire/wire.hpp"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <exception>

int main(int argc, char** argv)
{
    using namespace liena::lab;
    if (argc < 3) {
        std::fputs("usage: lab_wire SEED NAMESPACE-DESCRIPTOR...\nStarted by `lab`; obeys lines on its input.\n", stderr);
        return 2;
    }
    try {
        std::vector<Tap> taps;
        for (int i = 2; i < argc; ++i)
            taps.emplace_back(std::atoi(argv[i]), static_cast<std::size_t>(i - 2));
        Wire wire(std::move(taps), std::strtoull(argv[1], nullptr, 10));
        std::puts("0 ready");
        std::fflush(stdout);
        wire.run(STDIN_FILENO, STDOUT_FILENO);
    } catch (const std::exception& failure) {
        std::fprintf(stderr, "lab_wire: %s\n", failure.what());
        return 1;
    }
    return 0;
}
