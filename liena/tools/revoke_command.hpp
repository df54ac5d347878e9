// `liena pki revoke`: takes a certificate's validity back before its end.
#pragma once

namespace CLI {
class App;
}

namespace liena::tools {

/// Adds the sub-command of `liena pki`; when it runs it leaves the exit status in `exitCode`: 0 done, 1 refused.
void addRevokeCommand(CLI::App& pki, int& exitCode);

} // namespace liena::tools
