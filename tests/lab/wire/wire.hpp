// A switch between TAP devices that loses, delays, reorders, doubles and breaks frames as it is told.
#pragma once

#include "wire/impairment.hpp"
#include "wire/late_spans.hpp"
#include "wire/orders.hpp"
#include "wire/tap.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <queue>
#include <string>
#include <vector>

namespace liena::lab {

/// A frame goes from its port through the impairment of its pair, then through the rate limit of the port it goes to.
class Wire {
public:
    Wire(std::vector<Tap> taps, std::uint64_t seed);

    /// Obeys lines from `input` until its end, and answers each on `output`: `<monotonic ns> ok` when it is in force.
    void run(int input, int output);

private:
    struct Port {
        std::uint64_t rate = 0;
        std::size_t queueLimit = 0;
        std::size_t queued = 0;
        SteadyTime free; ///< when the last frame has left
        bool plugged = true;
    };
    struct Pair {
        explicit Pair(std::uint64_t seed) : draw(seed) {}
        Impairment impairment;
        ImpairmentDraw draw;
        SteadyTime lastDue; ///< what does not overtake comes not before it
        std::uint64_t passed = 0;
        std::uint64_t lost = 0;
    };
    using Frame = std::shared_ptr<std::vector<std::byte>>;
    struct Waiting {
        SteadyTime due;
        std::uint64_t order = 0;
        std::size_t port = 0;
        bool leaving = false; ///< it has passed the rate limit
        Frame frame;

        bool operator<(const Waiting& other) const { return due != other.due ? due > other.due : order > other.order; }
    };

    bool readOrders(int input, int output);
    std::string obey(const WireOrder& order);
    std::string obeyLink(const LinkOrder& order);
    std::string counts();
    std::string late();
    void readFrames(std::size_t port);
    void forward(std::size_t from, std::size_t to, const Frame& frame, Protocol protocol, SteadyTime now);
    void enqueue(std::size_t to, const Frame& frame, SteadyTime now);
    void deliverDue(SteadyTime now);
    Pair& pair(std::size_t from, std::size_t to) { return m_pairs[from * m_taps.size() + to]; }

    std::vector<Tap> m_taps;
    std::vector<Port> m_ports;
    std::vector<Pair> m_pairs;
    std::priority_queue<Waiting> m_waiting;
    std::uint64_t m_order = 0;
    LateSpans m_late;
    std::string m_unread;
    std::vector<std::byte> m_buffer;
};

} // namespace liena::lab
