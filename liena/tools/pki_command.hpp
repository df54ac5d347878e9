// `liena pki`: a site's authority, its devices' certificates, and what a certificate says.
#pragma once

namespace CLI {
class App;
}

namespace liena::tools {

/// Adds the sub-command; when it runs it leaves the exit status in `exitCode`: 0 done, 1 refused.
void addPkiCommand(CLI::App& app, int& exitCode);

} // namespace liena::tools
