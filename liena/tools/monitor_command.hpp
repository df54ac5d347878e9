// `liena monitor`: what the devices of this computer see of their sessions, live.
#pragma once

namespace CLI {
class App;
}

namespace liena::tools {

/// When the command runs it leaves the exit status in `exitCode`: 0 a device was seen, 1 none was there.
void addMonitorCommand(CLI::App& app, int& exitCode);

} // namespace liena::tools
