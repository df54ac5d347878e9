// The write loop of one lane.
#include "tasks/transmission_task.hpp"

namespace liena::tasks {

TransmissionTask::TransmissionTask(std::shared_ptr<transport::TcpChannel> channel, OutputQueue& queue, Settings settings, Lost lost)
    : m_channel(std::move(channel)), m_queue(&queue), m_settings(settings), m_lost(std::move(lost))
{
    m_buffer.reserve(m_settings.batch + m_settings.segment + protocol::headerSize);
    m_channel->setListener(this);
    m_channel->read(m_unexpected);
}

TransmissionTask::~TransmissionTask() { close(); }

void TransmissionTask::close()
{
    m_channel->setListener(nullptr);
    m_channel->close();
}

void TransmissionTask::sendFirst(const protocol::EncodedMessage& message)
{
    protocol::DatagramEncoder().appendSegment(message, m_settings.segment, m_buffer);
    wake();
}

void TransmissionTask::wake()
{
    if (m_writing || m_channel->isClosed())
        return;
    const auto now = std::chrono::steady_clock::now();
    while (m_buffer.size() < m_settings.batch && m_queue->appendNext(m_settings.segment, now, m_buffer)) {
    }
    if (m_buffer.empty())
        return;
    m_writing = true;
    m_bytesSent += m_buffer.size();
    m_channel->write(m_buffer);
}

void TransmissionTask::bytesWritten()
{
    m_writing = false;
    m_buffer.clear();
    wake();
}

void TransmissionTask::bytesRead(std::size_t /*count*/)
{
    m_channel->close();
    m_lost("the peer sent bytes on a connection that only brings ours", false);
}

void TransmissionTask::channelLost(const std::string& detail, bool identity) { m_lost(detail, identity); }

} // namespace liena::tasks
