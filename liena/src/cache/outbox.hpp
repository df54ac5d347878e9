// What the application's threads hand to the network thread for sending: bounded, one wake-up per burst.
#pragma once

#include "liena/device_id.hpp"
#include "liena/message.hpp"

#include <cstddef>
#include <functional>
#include <mutex>
#include <utility>
#include <vector>

namespace liena::cache {

class Outbox {
public:
    struct Letter {
        DeviceId target; ///< broadcast: to every open session
        Message message;
    };

    using Letters = std::vector<Letter>;

    static constexpr std::size_t mostLetters = 4096;
    static constexpr std::size_t mostBytes = std::size_t{64} << 20U;

    /// `wake` is called under no lock when the outbox was empty.
    explicit Outbox(std::function<void()> wake) : m_wake(std::move(wake)) {}

    /// False when the outbox is full.
    bool put(DeviceId target, Message message)
    {
        const auto size = message.encodedSize();
        bool first = false;
        {
            const std::lock_guard lock(m_mutex);
            if (m_letters.size() >= mostLetters || (m_bytes + size > mostBytes && !m_letters.empty()))
                return false;
            first = m_letters.empty();
            m_bytes += size;
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
        m_bytes = 0;
    }

private:
    std::mutex m_mutex;
    Letters m_letters;
    std::size_t m_bytes = 0;
    std::function<void()> m_wake;
};

} // namespace liena::cache
