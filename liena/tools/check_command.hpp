// `liena check`: message sets and topologies, each by itself and all together.
#pragma once

namespace CLI {
class App;
}

namespace liena::tools {

/// When the command was given, `exitCode` is set while the command line is parsed.
void addCheckCommand(CLI::App& app, int& exitCode);

} // namespace liena::tools
