// What a kernel does with what is written to a paced connection, in virtual time.
#pragma once

#include <algorithm>
#include <chrono>

namespace liena::test {

/// It takes what is written until it has 4 ms of it, and then nothing before half of that has left (TCP_NOTSENT_LOWAT, tcp(7)). That goes
/// in pieces of a segment, each as much later than the one before as that one takes at the pace of the moment in which it left
/// (SO_MAX_PACING_RATE, socket(7)): a new pace has effect with the piece after the next.
class VirtualKernel {
public:
    using Nanoseconds = std::chrono::nanoseconds;
    using Instant = std::chrono::steady_clock::time_point;

    void pace(double bytesPerSecond, std::size_t segment)
    {
        m_pace = bytesPerSecond;
        m_piece = static_cast<double>(segment);
    }

    bool hasRoom()
    {
        const double most = std::clamp(m_pace / 250, 2 * m_piece, 131072.0);
        m_isFull = m_unsent >= (m_isFull ? most / 2 : most);
        return !m_isFull;
    }
    void take(double bytes) { m_unsent += bytes; }
    double unsent() const { return m_unsent; }

    /// Bytes, within one step, and no more than TCP lets be under way.
    double send(Instant now, Nanoseconds step, double atMost)
    {
        double sent = 0;
        while (m_unsent > 0 && m_next < now + step && sent < atMost) {
            const double piece = std::min({m_unsent, m_piece, atMost - sent});
            const auto takes = std::chrono::duration_cast<Nanoseconds>(std::chrono::duration<double>(piece / m_pace));
            m_next = std::max(m_next, now - takes / 2) + takes; // who is late gets half a piece back at most
            m_unsent -= piece;
            sent += piece;
        }
        return sent;
    }

private:
    double m_pace = 0;
    double m_piece = 0;
    double m_unsent = 0;
    bool m_isFull = false;
    Instant m_next{};
};

} // namespace liena::test
