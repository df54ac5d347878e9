// A mutex under which a real-time thread never waits for one that waits for a processor.
#pragma once

#include <pthread.h>

namespace liena::cache {

/// Whoever holds it runs at the priority of whoever waits for it (PTHREAD_PRIO_INHERIT): the network thread may have a real-time priority,
/// and the application's threads, which share these locks with it, have none. Where the system has no such mutex it is a plain one.
class InheritingMutex {
public:
    InheritingMutex()
    {
        pthread_mutexattr_t attributes;
        ::pthread_mutexattr_init(&attributes);
        ::pthread_mutexattr_setprotocol(&attributes, PTHREAD_PRIO_INHERIT);
        if (::pthread_mutex_init(&m_mutex, &attributes) != 0)
            ::pthread_mutex_init(&m_mutex, nullptr);
        ::pthread_mutexattr_destroy(&attributes);
    }
    ~InheritingMutex() { ::pthread_mutex_destroy(&m_mutex); }
    InheritingMutex(const InheritingMutex&) = delete;
    InheritingMutex& operator=(const InheritingMutex&) = delete;

    void lock() { ::pthread_mutex_lock(&m_mutex); }
    void unlock() { ::pthread_mutex_unlock(&m_mutex); }

private:
    pthread_mutex_t m_mutex;
};

} // namespace liena::cache
