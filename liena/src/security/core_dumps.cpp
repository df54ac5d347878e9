// What a crash may leave behind of a process that holds keys.
#include "liena/certificates.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

namespace liena {

void keepKeysOutOfCoreDumps()
{
    const rlimit none{0, 0};
    ::setrlimit(RLIMIT_CORE, &none);
    // The limit does not bind a program that the kernel pipes cores to; the filter does: no private or shared memory of any kind.
    const int filter = ::open("/proc/self/coredump_filter", O_WRONLY | O_CLOEXEC);
    if (filter < 0)
        return;
    [[maybe_unused]] const auto written = ::write(filter, "0", 1);
    ::close(filter);
}

} // namespace liena
