// A one-shot timer whose handler never runs after cancel() or the timer's end, also when it was already due.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <utility>

namespace liena::transport {

/// Network thread only.
class Timer {
public:
    explicit Timer(boost::asio::io_context& io) : m_state(std::make_shared<State>(io)) {}
    ~Timer() { cancel(); }
    Timer(const Timer&) = delete;
    Timer& operator=(const Timer&) = delete;

    /// Replaces what was set before.
    void at(std::chrono::steady_clock::time_point when, std::function<void()> handler)
    {
        const auto generation = ++m_state->generation;
        m_state->handler = std::move(handler);
        m_state->timer.expires_at(when);
        m_state->timer.async_wait([state = m_state, generation](const boost::system::error_code& error) {
            if (!error && generation == state->generation)
                std::exchange(state->handler, nullptr)();
        });
    }

    void after(std::chrono::nanoseconds delay, std::function<void()> handler)
    {
        at(std::chrono::steady_clock::now() + delay, std::move(handler));
    }

    void cancel()
    {
        ++m_state->generation;
        m_state->handler = nullptr;
        m_state->timer.cancel();
    }

private:
    struct State {
        explicit State(boost::asio::io_context& io) : timer(io) {}
        boost::asio::steady_timer timer;
        std::function<void()> handler;
        std::uint64_t generation = 0;
    };
    std::shared_ptr<State> m_state; ///< shared with a wait in flight
};

} // namespace liena::transport
