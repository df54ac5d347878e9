// What a process asks of the scheduler and of memory so that its network thread is not kept waiting (sched(7), mlockall(2)).
#pragma once

#include "liena/error.hpp"
#include "liena/settings.hpp"
#include "tasks/attention.hpp"

#include <cstddef>

namespace boost::asio {
class io_context;
}

namespace liena::system {

/// That the calling thread may use.
std::size_t usableProcessors();

/// Checks all options, on a thread of its own where they belong to a thread, and locks the memory. The error names what is not permitted
/// and how to permit it.
Result<void> prepareRealTime(const RealTimeOptions& options);

/// The network thread's life: takes priority and processors, then works until the context is stopped. While `attention` is awake it does
/// not sleep, unless the options forbid it or it has one processor only: then whoever is to answer needs that. With real-time priority it
/// sleeps now and then in any case (ProcessorShare).
void runNetworkThread(boost::asio::io_context& context, const RealTimeOptions& options, tasks::Attention& attention);

} // namespace liena::system
