// Words in, lines out, and questions in turn.
#include "scale/mesh_device.hpp"

#include <algorithm>
#include <condition_variable>
#include <iostream>
#include <mutex>
#include <thread>

namespace liena::bench {

namespace {

using Clock = std::chrono::steady_clock;

/// On a thread of its own, as an application's control loop: the thread that sends has no timer of ours that would cost while nobody asks.
class Asker {
public:
    Asker(MeshDevice& device, double rate)
        : m_device(device), m_period(static_cast<std::int64_t>(1e9 / rate)), m_thread([this](const std::stop_token& stop) { run(stop); })
    {}

    void ask(bool on)
    {
        {
            const std::lock_guard lock(m_mutex);
            m_asking = on;
        }
        m_changed.notify_one();
    }

private:
    void run(const std::stop_token& stop)
    {
        auto due = Clock::now();
        std::unique_lock lock(m_mutex);
        while (m_changed.wait(lock, stop, [this] { return m_asking; })) {
            lock.unlock();
            due = std::max(due + m_period, Clock::now());
            std::this_thread::sleep_until(due);
            m_device.post([this] { m_device.ask(); });
            lock.lock();
        }
    }

    MeshDevice& m_device;
    std::chrono::nanoseconds m_period;
    std::mutex m_mutex;
    std::condition_variable_any m_changed;
    bool m_asking = false;
    std::jthread m_thread; ///< last: it uses the others
};

} // namespace

std::string meshDeviceName(std::size_t index) { return "d" + std::to_string(index); }

MeshDevice::MeshDevice(const MeshDeviceOptions& options)
{
    for (std::size_t k = 1; k < options.devices; ++k)
        m_peers.push_back((options.index + k) % options.devices);
    // The k-th neighbour to the right, up to half way round.
    for (std::size_t k = 1; k <= options.devices / 2; ++k)
        if (2 * k != options.devices || options.index < k)
            m_toOpen.push_back(m_peers[k - 1]);
}

MeshCounts MeshDevice::tally() const
{
    MeshCounts counts;
    counts.at = std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
    counts.troubles = m_troubles;
    counts.asked = m_asked;
    counts.heard = m_heard;
    counts.answered = m_answered;
    return counts;
}

int runMeshDevice(const MeshDeviceOptions& options)
{
    const auto device = options.plain ? plainDevice(options) : lienaDevice(options);
    Asker asker(*device, options.rate);
    std::cout << "ready" << std::endl;
    for (std::string word; std::getline(std::cin, word);) {
        if (word == "open") {
            std::cout << device->open() << std::endl;
        } else if (word == "counts") {
            std::cout << device->counts() << std::endl;
        } else if (word == "begin" || word == "end") {
            asker.ask(word == "begin");
            std::cout << "ok" << std::endl;
        } else if (word == "latencies") {
            for (const auto latency : device->takeLatencies())
                std::cout << latency << ' ';
            std::cout << std::endl;
        }
    }
    return 0;
}

} // namespace liena::bench
