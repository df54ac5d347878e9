// What a device needs to know before it can take part.
#pragma once

#include "liena/log.hpp"
#include "liena/measurement.hpp"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace liena {

/// How packets are marked for the network (DSCP, RFC 2474): 0 to 63, and 0 for no mark. They have an effect where the hospital's switches
/// are told what they mean, and are harmless elsewhere.
struct PacketMarks {
    std::uint8_t prompt = 46; ///< safety, control, status and the session itself: expedited forwarding (RFC 3246)
    std::uint8_t bulk = 34;   ///< images: AF41 (RFC 2597)
};

/// What the network thread asks of the operating system; all but `attention` off by default, and create() fails with what is missing when
/// it is not permitted. docs/OPERATING.md says what each is good for.
struct RealTimeOptions {
    /// SCHED_FIFO, 1 to 99; 0: an ordinary thread. With a priority it looks for work without sleeping for nine tenths of the time at the
    /// most, so that the kernel does not stop it for the rest of a second (sched_rt_runtime_us).
    int priority = 0;
    std::vector<int> processors;         ///< that it may run on; empty: all
    bool lockMemory = false;             ///< of the whole process, also what it has later: no page of it is ever fetched from disk
    std::chrono::microseconds search{0}; ///< that it looks for work before it sleeps; costs a processor
    /// That the kernel asks the network card itself before the thread sleeps (SO_BUSY_POLL): for this device's sockets, and of no use for
    /// peers on the same computer.
    std::chrono::microseconds cardSearch{0};
    /// That the thread stays awake where the next message is due at once, since waking up takes longer than all else of a round trip. While
    /// prompt messages follow each other within 150 us it looks for the next one for up to 100 us; and where those that it sends to a peer
    /// are answered within 150 us, it looks from sending until the answer. That is a processor's time for as long as this lasts, and none
    /// otherwise. False: it sleeps whenever it has nothing to do. Of no effect beside `search`.
    bool attention = true;
};

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

    PacketMarks marks;
    RealTimeOptions realTime;

    /// How much of measuring this device takes on, at rest and in use; see DistributedSystem::measure().
    MeasuringBudget measuring;

    /// `liena bench --live`: who may use the status socket, this device's user alone, may also have a line measured through it. Off, that
    /// socket reads nothing.
    bool measureOnRequest = false;

    /// At most so many threads seal and open the bytes of images beside the network thread, while those take much of its time: 0 to 4.
    /// Nothing: as many as the process may use processors beyond two, and none beside `realTime.search` or `realTime.processors`.
    std::optional<unsigned> bulkWorkers;

    /// Where the log lines go; stderrLog() writes them as text or as JSON.
    LogSink log = stderrLog();

    /// The audit file (liena/audit.hpp). Empty: none is written. When it cannot be written any more, no new session opens.
    std::filesystem::path audit;

    /// Folder for the socket on which `liena monitor` sees this device, `<id>.sock`, for its own user only; statusFolder() is where the
    /// monitor looks. Empty: none is made.
    std::filesystem::path status;
};

} // namespace liena
