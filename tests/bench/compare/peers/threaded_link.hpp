// A link over a library that receives on threads of its own: the rhythm of the workload, and what must not run on those threads.
#pragma once

#include "measure/options.hpp"
#include "measure/transport.hpp"

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <vector>

namespace liena::compare {

/// What arrives is handed on at once on the library's thread, so that no hop to another is measured; only the credit of a throughput run is
/// handed to the thread of run(), since the answer to it may wait for acknowledgements that the library's thread brings.
class ThreadedLink : public Transport {
public:
    explicit ThreadedLink(const Options& options);

    void every(Nanoseconds period, std::function<void()> task) override;
    void run(LinkEvents& events) override;
    void stop() override;

protected:
    /// Makes the link; returns when messages can flow, or when isStopped().
    virtual void connect() = 0;

    /// For the library's threads.
    void received(const Command& command);
    void received(const Stamp& stamp, std::size_t size) { m_events->frameReceived(stamp, size); }

    const Options& options() const { return m_options; }
    bool isClient() const { return m_options.role == Role::Client; }
    bool isStopped();

private:
    struct PeriodicTask {
        Nanoseconds period;
        Instant due;
        std::function<void()> run;
    };

    void runDue();
    Instant nextDue() const;

    Options m_options;
    LinkEvents* m_events = nullptr;
    std::vector<PeriodicTask> m_tasks;
    std::mutex m_mutex;
    std::condition_variable m_wake;
    std::optional<Command> m_credit; ///< the newest holds for all
    bool m_stopped = false;
};

} // namespace liena::compare
