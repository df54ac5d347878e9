// Connecting, writing, replacing and ending a simulated output lane.
#include "simulated_lane.hpp"

#include <utility>

namespace liena::simulation {

using namespace std::chrono_literals;

/// One connection's write loop, one write at a time.
class SimulatedLane::Writer : public Connection::Listener {
public:
    Writer(SimulatedLane& lane, tasks::OutputQueue& queue, ConnectionNumber connection)
        : m_program(lane.m_program),
          m_settings(lane.m_settings),
          m_leaving(lane.m_handlers.leaving),
          m_lane(&lane),
          m_queue(&queue),
          m_connection(connection)
    {
        if (auto* stands = m_program.network().find(m_connection))
            stands->setListener(m_program.host(), this);
    }
    ~Writer() override { close(); }
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;

    void close()
    {
        if (m_connection == 0)
            return; // and the program may be gone
        if (auto* stands = m_program.network().find(std::exchange(m_connection, 0)))
            stands->close(m_program.host());
    }

    void sendFirst(const protocol::EncodedMessage& message)
    {
        protocol::DatagramEncoder().appendSegment(message, m_settings.segment, m_buffer);
        wake();
    }

    void wake()
    {
        auto* stands = m_program.network().find(m_connection);
        if (m_writing || stands == nullptr)
            return;
        const auto now = m_program.now().mono;
        do {
            std::size_t begin = m_buffer.size();
            while (m_buffer.size() < m_settings.batch && m_queue->appendNext(m_settings.segment, now, m_buffer)) {
                m_leaving(m_buffer, begin);
                begin = m_buffer.size();
            }
            if (m_buffer.empty())
                return;
            m_writing = !stands->write(m_buffer);
            m_buffer.clear();
        } while (!m_writing);
    }

    /// Nobody is told any more how it ends; the lane may be gone.
    void orphan() { m_lane = nullptr; }

    void bytesRead(std::size_t /*count*/) override {}
    void bytesWritten() override
    {
        m_writing = false;
        wake();
    }
    void connectionLost(const char* detail) override
    {
        m_connection = 0;
        if (m_lane != nullptr)
            m_lane->lost(detail);
    }

private:
    Program& m_program;
    Settings m_settings;
    std::function<void(std::vector<std::byte>&, std::size_t)> m_leaving;
    SimulatedLane* m_lane;
    tasks::OutputQueue* m_queue;
    ConnectionNumber m_connection;
    std::vector<std::byte> m_buffer;
    bool m_writing = false;
};

SimulatedLane::SimulatedLane(Program& program, HostIndex peer, Settings settings, Handlers handlers)
    : m_program(program), m_peer(peer), m_settings(settings), m_handlers(std::move(handlers)), m_queue(makeQueue())
{}

SimulatedLane::~SimulatedLane() { cancelAttempt(); }

std::unique_ptr<tasks::OutputQueue> SimulatedLane::makeQueue() const
{
    return std::make_unique<tasks::OutputQueue>(m_handlers.dropped, m_handlers.abandoning);
}

void SimulatedLane::connect(const protocol::EncodedMessage& attach, Nanoseconds limit)
{
    m_attach = attach;
    cancelAttempt();
    m_attempt = m_program.network().connect(m_program.host(), m_peer, limit, [this](ConnectionNumber connection, ConnectFailure failure) {
        m_attempt = 0;
        if (connection != 0)
            established(connection);
        else
            m_handlers.failed(failure);
    });
}

void SimulatedLane::cancelAttempt()
{
    if (m_attempt != 0)
        m_program.network().cancel(std::exchange(m_attempt, 0));
}

void SimulatedLane::established(ConnectionNumber connection)
{
    if (m_writer) {
        m_writer->close();
        m_program.bury(std::move(m_writer));
    }
    m_queue->restart();
    m_writer = std::make_shared<Writer>(*this, *m_queue, connection);
    m_connection = connection;
    m_writer->sendFirst(m_attach);
    m_handlers.up();
}

void SimulatedLane::lost(const std::string& detail)
{
    m_program.bury(std::move(m_writer));
    m_handlers.lost(detail);
}

bool SimulatedLane::push(tasks::OutputQueue::Entry entry)
{
    if (!m_queue->push(std::move(entry)))
        return false;
    if (m_writer)
        m_writer->wake();
    return true;
}

void SimulatedLane::close(Nanoseconds grace)
{
    cancelAttempt();
    m_queue->discardApplication();
    if (!m_writer) {
        m_queue = makeQueue();
        return;
    }
    if (grace <= 0ns) {
        m_writer->close();
        m_program.bury(std::exchange(m_writer, nullptr));
        m_queue = makeQueue();
        return;
    }
    m_writer->orphan();
    m_remains.push_back(
        {std::exchange(m_queue, makeQueue()), std::exchange(m_writer, nullptr), std::make_unique<Program::Timer>(m_program)});
    m_remains.back().timer->after(grace, [this] { m_remains.pop_front(); }); // all wait equally long, or no time at all
}

} // namespace liena::simulation
