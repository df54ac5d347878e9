// `liena audit`: whether an audit file is whole.
#pragma once

namespace CLI {
class App;
}

namespace liena::tools {

/// When the command runs it leaves the exit status in `exitCode`: 0 whole, 1 not, or the file cannot be read.
void addAuditCommand(CLI::App& app, int& exitCode);

} // namespace liena::tools
