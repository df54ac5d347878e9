// Beginning and end of a thread.
#include "transport/worker_thread.hpp"

#include <cstddef>
#include <memory>
#include <system_error>

namespace liena::transport {

namespace {

using Life = std::function<void()>;

constexpr std::size_t workerStack = 512 * 1024; // sealing and opening records takes some ten KiB of it, more under a sanitizer

void* liveAsWorker(void* given)
{
    const std::unique_ptr<Life> life(static_cast<Life*>(given));
    (*life)();
    return nullptr;
}

} // namespace

WorkerThread::WorkerThread(Life life)
{
    auto given = std::make_unique<Life>(std::move(life));
    pthread_attr_t attributes;
    ::pthread_attr_init(&attributes);
    ::pthread_attr_setstacksize(&attributes, workerStack);
    pthread_t handle{};
    const int error = ::pthread_create(&handle, &attributes, liveAsWorker, given.get());
    ::pthread_attr_destroy(&attributes);
    if (error != 0)
        throw std::system_error(error, std::generic_category(), "thread");
    (void)given.release(); // the thread's own
    m_handle = handle;
}

bool WorkerThread::hasEnded()
{
    if (m_handle && ::pthread_tryjoin_np(*m_handle, nullptr) == 0)
        m_handle.reset();
    return !m_handle;
}

void WorkerThread::join()
{
    if (m_handle)
        ::pthread_join(*m_handle, nullptr);
    m_handle.reset();
}

} // namespace liena::transport
