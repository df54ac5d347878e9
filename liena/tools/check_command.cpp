// Prints findings as editors can jump to them, and counts them.
#include "check_command.hpp"

#include <liena/system_topology.hpp>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <vector>

namespace liena::tools {

namespace {

std::string counted(std::ptrdiff_t count, const char* thing) { return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s"); }

int check(const std::vector<std::filesystem::path>& files)
{
    const auto findings = checkFiles(files);
    for (const auto& finding : findings)
        fmt::print(stderr, "{}\n", finding.toString());
    const auto errors =
        std::count_if(findings.begin(), findings.end(), [](const Finding& finding) { return finding.severity == Severity::Error; });
    fmt::print("{} checked: {}, {}\n", counted(static_cast<std::ptrdiff_t>(files.size()), "file"), counted(errors, "error"),
               counted(static_cast<std::ptrdiff_t>(findings.size()) - errors, "warning"));
    return errors > 0 ? 1 : 0;
}

} // namespace

void addCheckCommand(CLI::App& app, int& exitCode)
{
    auto* command = app.add_subcommand("check", "Check message sets and topologies, and how they fit together");
    command->footer("Name a topology together with the message sets of its devices: then its ids and flows are checked against them.\n\n"
                    "Examples:\n"
                    "  liena check topologies/cerebrovascular.xml resources/devices/*.xml\n"
                    "  liena check my-device.xml\n\n"
                    "Exit codes: 0 no errors (warnings allowed), 1 errors, 2 wrong use of the command line.");
    const auto files = std::make_shared<std::vector<std::filesystem::path>>();
    command->add_option("FILE", *files, "Message sets and topologies, in any order")->required();
    command->callback([files, &exitCode] { exitCode = check(*files); });
}

} // namespace liena::tools
