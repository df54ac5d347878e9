// compare_canary: says for how long the processors kept an idle thread of high priority from running, once its input ends.
#include "measure/result_line.hpp"

#include "support/canary.hpp"

#include <iostream>
#include <string>
#include <vector>

int main()
{
    using namespace liena;
    const test::Canary canary(std::chrono::microseconds(500));
    for (std::string line; std::getline(std::cin, line);) {
    }
    std::vector<double> begins, ends;
    for (const auto& stall : canary.stalls()) {
        begins.push_back(static_cast<double>(stall.begin) / 1e6);
        ends.push_back(static_cast<double>(stall.end) / 1e6);
    }
    compare::ResultLine line;
    line.add("begin_ms", begins).add("end_ms", ends);
    line.print();
    return 0;
}
