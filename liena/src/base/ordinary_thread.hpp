// For threads that must not stand in the network thread's way.
#pragma once

namespace liena::base {

/// Threads inherit the priority and the processors of whoever makes them, which may be a network thread with both of its own. From here on
/// the calling thread has ordinary priority and the processors of the process's first thread.
void runAsOrdinaryThread();

} // namespace liena::base
