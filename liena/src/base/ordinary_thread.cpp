// Asking the kernel for what a thread has that inherits nothing special.
#include "base/ordinary_thread.hpp"

#include <pthread.h>
#include <sched.h>
#include <unistd.h>

namespace liena::base {

void runAsOrdinaryThread()
{
    const sched_param parameters{};
    (void)::pthread_setschedparam(::pthread_self(), SCHED_OTHER, &parameters); // less is always permitted
    cpu_set_t processors;
    if (::sched_getaffinity(::getpid(), sizeof processors, &processors) == 0)
        (void)::sched_setaffinity(0, sizeof processors, &processors);
}

} // namespace liena::base
