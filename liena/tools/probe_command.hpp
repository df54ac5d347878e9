// `liena probe`: what stands between this computer and a device.
#pragma once

namespace CLI {
class App;
}

namespace liena::tools {

/// When the command runs it leaves the exit status in `exitCode`: 0 the way is free, 1 it is not.
void addProbeCommand(CLI::App& app, int& exitCode);

} // namespace liena::tools
