// The threads beside the network thread that work on bulk, and how many there are.
#pragma once

#include "liena/settings.hpp"
#include "tasks/load_balancer.hpp"
#include "transport/worker_threads.hpp"

#include <boost/asio/io_context.hpp>

#include <chrono>

namespace liena::system {

/// Network thread; stop() and the destructor after its end.
class ElasticWork {
public:
    ElasticWork(boost::asio::io_context& network, const Settings& settings);

    transport::WorkerThreads& workers() { return m_workers; }

    /// From time to time. False when a thread could not be had, and could before.
    bool balance(std::chrono::steady_clock::time_point now);

    void stop() { m_workers.stop(); }

private:
    transport::WorkerThreads m_workers;
    tasks::LoadBalancer m_balancer;
    std::chrono::steady_clock::time_point m_begin;
};

} // namespace liena::system
