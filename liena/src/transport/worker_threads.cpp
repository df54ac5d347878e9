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
    asio::post(m_network, [this, raw = &worker] {
        const auto gone = std::find_if(m_leaving.begin(), m_leaving.end(), [&](const auto& one) { return one.get() == raw; });
        if (gone == m_leaving.end() || !(*gone)->thread.joinable())
            return;
        (*gone)->thread.join(); // it has nothing left to do
        m_leaving.erase(gone);
    });
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
        // The thread's own end is posted behind this, so that the worker is there.
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
        if (worker->thread.joinable())
            worker->thread.join();
    }
}

} // namespace liena::transport
