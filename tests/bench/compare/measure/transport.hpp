// What a transport under comparison offers the workloads: one end of one link.
#pragma once

#include "measure/stamp.hpp"

#include <cstddef>
#include <functional>

namespace liena::compare {

/// What happens on a link; all on the transport's own thread.
class LinkEvents {
public:
    virtual ~LinkEvents() = default;
    virtual void ready() = 0; ///< messages can flow
    virtual void commandReceived(const Command& command) = 0;
    virtual void frameReceived(const Stamp& stamp, std::size_t size) = 0;
};

class Transport {
public:
    virtual ~Transport() = default;

    /// Runs `task` each `period` on the transport's thread, by DueGrid's rule. Before run().
    virtual void every(Nanoseconds period, std::function<void()> task) = 0;

    /// Makes the link and serves it until stop().
    virtual void run(LinkEvents& events) = 0;

    /// From any thread.
    virtual void stop() = 0;

    /// From the transport's thread.
    virtual void sendCommand(const Command& command) = 0;

    /// From any thread: `frameBytes` bytes of the options.
    virtual void sendFrame(const Stamp& stamp) = 0;
};

} // namespace liena::compare
