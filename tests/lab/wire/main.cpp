// lab_wire: joins TAP devices in the network namespaces whose descriptors it inherits.
#include "wire/wire.hpp"

#include <unistd.h>

#include <cstdio>
#include <exception>
#include <string>
#include <vector>

int main(int argc, char** argv)
{
    using namespace liena::lab;
    const std::vector<std::string> words(argv + 1, argv + argc);
    const bool longFrames = !words.empty() && words.front() == "--long-frames";
    const std::size_t first = longFrames ? 1 : 0;
    if (words.size() < first + 2) {
        std::fputs("usage: lab_wire [--long-frames] SEED NAMESPACE-DESCRIPTOR...\nStarted by `lab`; obeys lines on its input.\n", stderr);
        return 2;
    }
    try {
        std::vector<Tap> taps;
        for (std::size_t i = first + 1; i < words.size(); ++i)
            taps.emplace_back(std::stoi(words[i]), i - first - 1, longFrames ? Frames::Long : Frames::Single);
        Wire wire(std::move(taps), std::stoull(words[first]));
        std::puts("0 ready");
        std::fflush(stdout);
        wire.run(STDIN_FILENO, STDOUT_FILENO);
    } catch (const std::exception& failure) {
        std::fprintf(stderr, "lab_wire: %s\n", failure.what());
        return 1;
    }
    return 0;
}
