// Threads beside the network thread for what takes long and can wait: sealing and opening the bytes of bulk lanes.
#pragma once

#include "transport/worker_thread.hpp"

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <utility>
#include <vector>

namespace liena::transport {

/// Called on the network thread only; it has no lock. Each thread has a queue of its own and sleeps while that is empty.
class WorkerThreads {
public:
    /// What a job does on its thread, and what is done with it on the network thread afterwards. The latter also holds what the former
    /// needs, so that everything dies where it was made.
    class Job {
    public:
        virtual ~Job() = default;
        virtual void work() = 0;
        virtual void finish() = 0;
    };

    /// Starts a thread that runs that, or throws std::system_error.
    using Start = std::function<WorkerThread(std::function<void()>)>;

    /// `prepare` is the first thing that a new thread does.
    WorkerThreads(boost::asio::io_context& network, std::function<void()> prepare) : WorkerThreads(network, std::move(prepare), startThread)
    {}
    WorkerThreads(boost::asio::io_context& network, std::function<void()> prepare, Start start);
    ~WorkerThreads();
    WorkerThreads(const WorkerThreads&) = delete;
    WorkerThreads& operator=(const WorkerThreads&) = delete;

    /// A thread that is not wanted any more does what it was given and ends; nobody waits for it, and a later call finds it gone. There are
    /// fewer than `count` where the system has no more.
    void resize(std::size_t count);
    std::size_t count() const { return m_threads.size(); }

    /// The last one that was wanted could not be had.
    bool lacks() const { return m_lacks; }

    /// On the thread with the fewest jobs; there must be one.
    void run(std::shared_ptr<Job> job);

    struct Busy {
        std::chrono::nanoseconds network{}; ///< spent by the network thread on what a worker could have done
        std::chrono::nanoseconds workers{}; ///< all together
        std::size_t connections = 0;        ///< that moved bytes
    };

    /// Since the last call.
    Busy takeBusy()
    {
        ++m_turn;
        return std::exchange(m_busy, {});
    }
    void noteTime(std::chrono::nanoseconds onNetworkThread) { m_busy.network += onNetworkThread; }
    /// `mark` is the connection's own, 0 in the beginning.
    void noteBytes(std::uint64_t& mark) { m_busy.connections += std::exchange(mark, m_turn) != m_turn ? 1 : 0; }

    /// The network thread has ended; what its context still holds is harmless as long as this object lives.
    void stop();

private:
    struct Worker {
        boost::asio::io_context context{1};
        std::unique_ptr<boost::asio::executor_work_guard<boost::asio::io_context::executor_type>> open;
        WorkerThread thread;
        std::size_t jobs = 0; ///< given and not finished
    };

    static WorkerThread startThread(std::function<void()> life) { return WorkerThread(std::move(life)); }
    bool hire();
    void live(Worker& worker);
    void retire();

    boost::asio::io_context& m_network;
    std::function<void()> m_prepare;
    Start m_start;
    bool m_lacks = false;
    std::vector<std::unique_ptr<Worker>> m_threads;
    std::list<std::unique_ptr<Worker>> m_leaving;
    Busy m_busy;
    std::uint64_t m_turn = 1;
};

} // namespace liena::transport
