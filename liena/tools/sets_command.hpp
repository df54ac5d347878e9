// `liena sets`: which message sets devices may show here, and the acceptance of another.
#pragma once

namespace CLI {
class App;
}

namespace liena::tools {

void addSetsCommand(CLI::App& app, int& exitCode);

} // namespace liena::tools
