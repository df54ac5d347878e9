// liena: the command line of the middleware.
#include "audit_command.hpp"
#include "bench_command.hpp"
#include "check_command.hpp"
#include "monitor_command.hpp"
#include "pki_command.hpp"
#include "probe_command.hpp"
#include "refusal.hpp"
#include "report_file.hpp"
#include "sets_command.hpp"

#include <liena/version.hpp>

#include <CLI/CLI.hpp>

#include <exception>
#include <iostream>

namespace {

constexpr int wrongUse = 2;

int run(int argc, char** argv)
{
    CLI::App app("Checks, prepares and watches systems of LiENa devices.", "liena");
    int exitCode = 0;
    app.set_version_flag("--version", std::string("liena ") + liena::versionText);
    app.require_subcommand(1);
    app.footer("`liena COMMAND --help` explains a command, with examples.\n"
               "Exit codes: 0 done, 1 the command found errors or failed, 2 wrong use of the command line. `liena bench` has more.");
    liena::tools::addCheckCommand(app, exitCode);
    liena::tools::addPkiCommand(app, exitCode);
    liena::tools::addProbeCommand(app, exitCode);
    liena::tools::addMonitorCommand(app, exitCode);
    liena::tools::addBenchCommand(app, exitCode);
    liena::tools::addAuditCommand(app, exitCode);
    liena::tools::addSetsCommand(app, exitCode);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : wrongUse;
    }
    // What is short waits in the library's buffer until here.
    if (const auto written = liena::tools::flushOutput(); !written)
        return liena::tools::refuse(app.get_subcommands().front()->get_name(), written.error().what);
    return exitCode;
}

} // namespace

int main(int argc, char** argv)
{
    try {
        return run(argc, argv);
    } catch (const std::exception& error) {
        std::cerr << "liena: " << error.what() << '\n';
        return 1;
    }
}
