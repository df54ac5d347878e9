// `liena bench`: is the line between two devices good enough for a procedure?
#pragma once

namespace CLI {
class App;
}

namespace liena::tools {

void addBenchCommand(CLI::App& app, int& exitCode);

} // namespace liena::tools
