// Hiring, giving work, and letting go.
#include "transport/worker_threads.hpp"

#include <boost/asio/post.hpp>

#include <algorithm>
#include <system_error>
#include <utility>

namespace liena::transport {

namespace asio = boost::asio;

WorkerThreads::WorkerThreads(asio::io_context& network, std::function<void()> prepare, Start start)
    : m_network(network), m_prepare(std::move(prepare)), m_start(std::move(start))
{}

WorkerThreads::~WorkerThreads() { stop(); }

void WorkerThreads::resize(std::size_t count)
{
    // What it did last may still wait to be finished here. A thread is gone when the kernel says so: it may be long about its last steps,
    // on a processor that others use, and this one must not wait for it.
    std::erase_if(m_leaving, [](const auto& one) { return one->jobs == 0 && one->thread.hasEnded(); });
    while (m_threads.size() < count && hire()) {
    }
    while (m_threads.size() > count)
        retire();
}

bool WorkerThreads::hire()
{
    auto worker = std::make_unique<Worker>();
    worker->open = std::make_unique<asio::executor_work_guard<asio::io_context::executor_type>>(worker->context.get_executor());
    try {
        worker->thread = m_start([this, raw = worker.get()] { live(*raw); });
    } catch (const std::system_error&) {
        m_lacks = true; // the network thread does the work itself
        return false;
    }
    m_lacks = false;
    m_threads.push_back(std::move(worker));
    return true;
}

void WorkerThreads::live(Worker& worker)
{
    m_prepare();
    worker.context.run();
}

void WorkerThreads::retire()
{
    m_leaving.push_back(std::move(m_threads.back()));
    m_threads.pop_back();
    m_leaving.back()->open.reset();
}

void WorkerThreads::run(std::shared_ptr<Job> job)
{
    auto* worker =
        std::min_element(m_threads.begin(), m_threads.end(), [](const auto& a, const auto& b) { return a->jobs < b->jobs; })->get();
    ++worker->jobs;
    asio::post(worker->context, [this, worker, job = std::move(job)]() mutable {
        const auto begin = std::chrono::steady_clock::now();
        job->work();
        const auto busy = std::chrono::steady_clock::now() - begin;
        // The worker is there as long as it has jobs.
        asio::post(m_network, [this, worker, job = std::move(job), busy] {
            --worker->jobs;
            m_busy.workers += busy;
            job->finish();
        });
    });
}

void WorkerThreads::stop()
{
    resize(0);
    for (auto& worker : m_leaving) {
        worker->context.stop();
        worker->thread.join();
    }
}

} // namespace liena::transport
