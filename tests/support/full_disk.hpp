// A disk that is full, for as long as a test wants.
#pragma once

#include <csignal>
#include <sys/resource.h>

namespace liena::test {

/// While it lives no file of this process grows: a full disk. Sockets and pipes are no files.
class FullDisk {
public:
    FullDisk()
    {
        std::signal(SIGXFSZ, SIG_IGN);
        ::getrlimit(RLIMIT_FSIZE, &m_before);
        rlimit limit = m_before;
        limit.rlim_cur = 1;
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FullDisk() { ::setrlimit(RLIMIT_FSIZE, &m_before); }

private:
    rlimit m_before{};
};

} // namespace liena::test
