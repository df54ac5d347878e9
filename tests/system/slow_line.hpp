// A line that is as slow as a test says, between devices that know nothing of it.
#pragma once

#include <QHostAddress>
#include <QThread>

#include <atomic>
#include <chrono>

namespace liena::test {

/// Stands at `shown` in the place of a device that listens at `hidden`, both addresses of loopback, and hands on to it what it hears, by
/// TCP and by UDP. What goes there is that long on its way, in its order; what comes back on the same connections does not wait. A thread
/// of its own; the methods are for any other.
class SlowLine {
public:
    SlowLine(const QHostAddress& shown, const QHostAddress& hidden);
    ~SlowLine(); ///< cuts every connection
    Q_DISABLE_COPY_MOVE(SlowLine)

    /// Once; false when the port is taken at `shown`.
    bool open(quint16 port);

    /// Of an open line. Who is connected stays so; the port at `shown` is free for another one.
    void stopListening();

    /// Of what leaves from now on; no delay before the first call.
    void setDelay(std::chrono::milliseconds delay) { m_delay = delay; }

private:
    class Carrier;
    enum class Listening { Goes, Ends, Ended };

    std::atomic<std::chrono::milliseconds> m_delay{std::chrono::milliseconds(0)};
    std::atomic<Listening> m_listening{Listening::Goes};
    std::atomic<bool> m_ended{false}; ///< all of the carrier
    QThread m_thread;
    Carrier* m_carrier; ///< lives on the thread from open() on, and ends with it
};

} // namespace liena::test
