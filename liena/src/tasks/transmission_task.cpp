// The write loop of one lane.
#include "tasks/transmission_task.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace liena::tasks {

namespace {

constexpr std::size_t worthHandingOver = 128 * 1024; // bytes, about, of a write that another thread makes

} // namespace

TransmissionTask::TransmissionTask(std::shared_ptr<transport::TcpChannel> channel, OutputQueue& queue, Settings settings, PathRate* rate,
                                   Lost lost)
    : m_channel(std::move(channel)),
      m_buffers(std::make_shared<Buffers>(settings.batch + settings.segment + protocol::headerSize, !m_channel->isSecured())),
      m_queue(&queue),
      m_settings(settings),
      m_rate(rate),
      m_look(m_channel->io()),
      m_patience(m_channel->io()),
      m_lost(std::move(lost))
{
    m_channel->tune(m_settings.traffic, m_settings.dscp);
    if (m_rate != nullptr)
        m_rate->restart();
    if (m_settings.workers != nullptr)
        m_channel->shareWork(*m_settings.workers);
    m_channel->setListener(this);
    m_channel->read(m_buffers->unexpected, m_buffers);
}

TransmissionTask::~TransmissionTask() { close(); }

void TransmissionTask::close()
{
    m_look.cancel();
    m_patience.cancel();
    m_channel->setListener(nullptr);
    m_channel->close();
}

void TransmissionTask::sendFirst(const protocol::EncodedMessage& message)
{
    m_buffers->batch.append(protocol::DatagramEncoder().next(message.header, message.bytes(), m_settings.segment), nullptr);
    wake();
}

void TransmissionTask::wake()
{
    if (m_writing || m_channel->isClosed())
        return;
    const bool isPassable = mayBePassed();
    const bool isUrgent = m_queue->hasUrgent() || !m_buffers->batch.empty();
    const bool isPatient = isPassable && !isUrgent;
    const bool isOverdue = isPatient && std::exchange(m_isOverdue, false);
    const auto now = std::chrono::steady_clock::now();
    if (isPatient && !isOverdue && !m_channel->askForRoom())
        return watchPatience(now);
    fill(now, isPassable, isPassable && isUrgent);
    if (m_buffers->batch.empty()) {
        m_channel->nothingWaits();
        if (m_rate != nullptr)
            m_rate->pause(now, unsent());
        return;
    }
    if (m_rate != nullptr) {
        keepPace(now);
        if (!m_looking)
            watchPace(now);
    }
    if (isPatient)
        m_lastPatient = now;
    m_writing = true;
    m_bytesSent += m_buffers->batch.size();
    using transport::Urgency;
    m_channel->write(m_buffers->batch.parts(), m_buffers, isPatient && !isOverdue ? Urgency::Patient : Urgency::Urgent);
}

/// On the way to another computer a command waits for what was written, and may pass what was not. What is short is soon over, and not
/// worth a request to the kernel.
bool TransmissionTask::mayBePassed() const
{
    constexpr std::size_t onePacket = 1400; // bytes, about
    return m_settings.traffic == transport::TcpChannel::Traffic::Prompt && m_queue->bytes() > onePacket;
}

/// Many commands under way, or a queue that others build, may leave no room for long: what waits for it goes on all the same, slowly.
void TransmissionTask::watchPatience(std::chrono::steady_clock::time_point now)
{
    if (std::exchange(m_watchesPatience, true))
        return;
    constexpr std::chrono::milliseconds least{20};
    const auto facts = m_channel->facts();
    const auto longest = least + (facts ? 2 * facts->roundTrip : std::chrono::nanoseconds{});
    m_patience.at(now + longest, [this, longest] {
        m_watchesPatience = false;
        if (!mayBePassed())
            return;
        const auto later = std::chrono::steady_clock::now();
        if (later - m_lastPatient < longest)
            return watchPatience(later);
        m_isOverdue = true;
        wake();
    });
}

/// A paced write is no more than a millisecond's: the rate is judged between two of them. `urgentOnly`: what is urgent takes nothing along
/// that has to wait for room.
void TransmissionTask::fill(std::chrono::steady_clock::time_point now, bool isPassable, bool urgentOnly)
{
    auto segment = m_settings.segment;
    auto batch = m_channel->hasWorkers() ? worthHandingOver : m_settings.batch;
    if (isPassable)
        segment = batch = std::min(segment, m_channel->patientWrite());
    if (m_rate != nullptr) {
        segment = std::min(segment, m_rate->segment());
        batch = std::clamp(static_cast<std::size_t>(m_rate->rate() / 1000), segment, batch);
    }
    while (m_buffers->batch.size() < batch && (!urgentOnly || m_queue->hasUrgent()) &&
           m_queue->appendNext(segment, now, m_buffers->batch)) {
    }
}

void TransmissionTask::keepPace(std::chrono::steady_clock::time_point now)
{
    constexpr double worthTelling = 0.005;
    if (const auto facts = m_channel->facts())
        m_rate->observe(*facts, now, !m_queue->empty());
    m_rate->endsBurst(m_queue->empty());
    if (std::abs(m_rate->rate() - m_paced) <= m_paced * worthTelling)
        return;
    m_paced = m_rate->rate();
    m_channel->pace(m_paced, m_rate->segment() + protocol::headerSize);
}

/// A path that becomes narrow makes a write of a millisecond last for fifty: the queue is seen before that is over, and what the kernel has
/// of it slowed down.
void TransmissionTask::watchPace(std::chrono::steady_clock::time_point now)
{
    constexpr std::chrono::milliseconds between{5};
    m_looking = true;
    m_look.at(now + between, [this] {
        m_looking = false;
        if (!m_writing)
            return;
        const auto later = std::chrono::steady_clock::now();
        if (const auto facts = m_channel->facts()) {
            m_rate->observe(*facts, later, !m_queue->empty());
            m_channel->slow(m_rate->rate());
            m_paced = 0; // the next write tells the kernel all of it
        }
        watchPace(later);
    });
}

/// What the kernel has leaves at the new one, too.
void TransmissionTask::rateChanged()
{
    m_channel->slow(m_rate->rate());
    m_paced = 0; // the next write tells the kernel all of it
}

/// In the kernel, not yet on its way.
std::uint32_t TransmissionTask::unsent() const
{
    const auto facts = m_channel->facts();
    return facts ? facts->bytesUnsent : 0;
}

void TransmissionTask::bytesWritten()
{
    m_writing = false;
    m_buffers->batch.clear();
    wake();
}

void TransmissionTask::roomMade() { wake(); }

void TransmissionTask::bytesRead(std::size_t /*count*/)
{
    m_channel->close();
    m_lost("the peer sent bytes on a connection that only brings ours", false);
}

void TransmissionTask::channelLost(const std::string& detail, bool identity) { m_lost(detail, identity); }

} // namespace liena::tasks
