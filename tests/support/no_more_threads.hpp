// A process that is at its limit of threads.
#pragma once

#include <cstddef>

#include <pthread.h>

namespace liena::test {

/// While it lives nothing can start a std::thread: one would get a stack that no address space holds.
class NoMoreThreads {
public:
    NoMoreThreads()
    {
        pthread_attr_t tooMuch;
        ::pthread_getattr_default_np(&m_before);
        ::pthread_getattr_default_np(&tooMuch);
        ::pthread_attr_setstacksize(&tooMuch, std::size_t{1} << 47U);
        ::pthread_setattr_default_np(&tooMuch);
        ::pthread_attr_destroy(&tooMuch);
    }
    ~NoMoreThreads()
    {
        ::pthread_setattr_default_np(&m_before);
        ::pthread_attr_destroy(&m_before);
    }
    NoMoreThreads(const NoMoreThreads&) = delete;
    NoMoreThreads& operator=(const NoMoreThreads&) = delete;

private:
    pthread_attr_t m_before{};
};

} // namespace liena::test
