// What the lab prints: a row per fault, for people and for programs.
#pragma once

#include "runner/judge.hpp"
#include "runner/statistics.hpp"

#include <map>
#include <string>
#include <vector>

namespace liena::lab {

struct Row {
    std::string fault;
    std::string row;
    std::string sentence;
    int repetitions = 0;
    Sample cockpitDetects; ///< ms
    Sample robotDetects;
    Sample detects;     ///< both
    Sample calmDetects; ///< those on whose way no processor stood still for a millisecond
    Sample stops;
    Sample reopens;
    Tally tally;
    double stall = 0; ///< ms, the machine's own largest during this row
    std::map<std::string, int> seen;
    std::map<std::string, int> notes;
    std::vector<std::string> broken;

    bool holds() const { return broken.empty() && tally.broken() == 0; }
};

void printHead();
void printRow(const Row& row);
std::string toJson(const std::vector<Row>& rows);

} // namespace liena::lab
