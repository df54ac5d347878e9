// What the application's threads hand to the network thread for sending: bounded, one wake-up per burst.
#pragma once

#include "cache/inheriting_mutex.hpp"
#include "liena/device_id.hpp"
#include "liena/message.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <iterator>
#include <mutex>
#include <utility>
#include <vector>

namespace liena::cache {

/// The bounds are those of each priority by itself: a command or a stop is never refused because images wait. All leave in one order.
class Outbox {
public:
    struct Letter {
        DeviceId target; ///< broadcast: to every open session
        Message message;
    };

    using Letters = std::vector<Letter>;

    static constexpr std::size_t mostLetters = 4096;
    static constexpr std::size_t mostBytes = std::size_t{64} << 20U;

    /// `wake` is called under no lock when something waits; not again before it was taken.
    explicit Outbox(std::function<void()> wake) : m_wake(std::move(wake)) {}

    /// False when too many of the message's priority wait.
    bool put(DeviceId target, Message message)
    {
        const auto size = message.encodedSize();
        const auto priority = static_cast<std::size_t>(message.definition().priority);
        bool first = false;
        Letters spare; // goes after the lock
        {
            std::unique_lock lock(m_mutex);
            auto& load = m_loads.at(priority);
            for (;;) {
                if (load.letters >= mostLetters || (load.bytes + size > mostBytes && load.letters > 0))
                    return false;
                if (m_letters.size() < m_letters.capacity())
                    break;
                makeRoom(lock, spare);
            }
            first = !m_ended && !std::exchange(m_woken, true);
            ++load.letters;
            load.bytes += size;
            m_letters.push_back({target, std::move(message)});
        }
        if (first)
            m_wake();
        return true;
    }

    /// `letters` is empty before; the memory that it has is used for those that come next.
    void take(Letters& letters)
    {
        const std::lock_guard lock(m_mutex);
        letters.swap(m_letters);
        m_loads = {};
        m_woken = false;
    }

    /// The same out of turn: whoever was woken still comes, and finds what is put meanwhile.
    void withdraw(Letters& letters)
    {
        const std::lock_guard lock(m_mutex);
        letters.swap(m_letters);
        m_loads = {};
    }

    /// Nobody takes any more, and nobody is woken.
    void end()
    {
        const std::lock_guard lock(m_mutex);
        m_ended = true;
    }

private:
    /// What waits of one priority.
    struct Load {
        std::size_t letters = 0;
        std::size_t bytes = 0;
    };

    /// The network thread must not wait while this one asks for memory.
    void makeRoom(std::unique_lock<InheritingMutex>& lock, Letters& spare)
    {
        const auto wanted = std::max(fewest, 2 * m_letters.capacity());
        lock.unlock();
        spare = {};
        spare.reserve(wanted);
        lock.lock();
        if (m_letters.size() >= wanted)
            return; // others were quicker
        spare.assign(std::make_move_iterator(m_letters.begin()), std::make_move_iterator(m_letters.end()));
        m_letters.swap(spare);
    }

    static constexpr std::size_t fewest = 16;

    InheritingMutex m_mutex;
    Letters m_letters;
    std::array<Load, 4> m_loads{}; ///< by priority
    bool m_woken = false;          ///< and has not taken yet
    bool m_ended = false;
    std::function<void()> m_wake;
};

} // namespace liena::cache
