// What a device needs to know before it can take part.
#pragma once

#include "liena/log.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace liena {

struct Settings {
    std::filesystem::path topology; ///< the file that every device of the system holds, the same bytes
    std::string device;             ///< this device: its name in the topology, or its id as `0x40018208`

    /// Folders with message sets, one file per device type; what they hold is pinned. Not searched below.
    std::vector<std::filesystem::path> registry;

    /// Folder for sets learnt from peers. Empty: `$XDG_STATE_HOME/liena/sets`, or `~/.local/state/liena/sets`.
    std::filesystem::path store;

    // PEM files; needed when the topology says `tls`.
    std::filesystem::path certificate;
    std::filesystem::path key;
    std::filesystem::path authority;

    /// The site's revocation list, PEM. Empty: the file `.crl` beside the authority's (`ca.crl` for `ca.crt`); none there means that nobody
    /// is revoked. It is read again whenever it changes.
    std::filesystem::path revocations;

    std::string software = "liena"; ///< name and version of the program, shown to peers; at most 64 bytes

    /// Mode `none` listens on loopback addresses only, unless this says that an open network is meant.
    bool allowInsecureNetwork = false;

    /// Where the log lines go; stderrLog() writes them as text or as JSON.
    LogSink log = stderrLog();

    /// The audit file (liena/audit.hpp). Empty: none is written. When it cannot be written any more, no new session opens.
    std::filesystem::path audit;

    /// Folder for the socket on which `liena monitor` sees this device, `<id>.sock`, for its own user only; statusFolder() is where the
    /// monitor looks. Empty: none is made.
    std::filesystem::path status;
};

} // namespace liena
