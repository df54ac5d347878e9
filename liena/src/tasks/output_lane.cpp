// Connecting, replacing and ending an output lane.
#include "tasks/output_lane.hpp"

#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>

namespace liena::tasks {

namespace asio = boost::asio;

namespace {

/// There no way is shared: who waits, waits for a processor. A segment costs its reader a turn, so that images leave in the longest there
/// are; sealed they leave in a record each.
TransmissionTask::Settings onThisComputer(TransmissionTask::Settings settings, bool isSecured)
{
    using Traffic = transport::TcpChannel::Traffic;
    if (settings.traffic == Traffic::Prompt)
        settings.traffic = Traffic::Here;
    else if (!isSecured)
        settings.segment = protocol::maximumBody;
    return settings;
}

} // namespace

OutputLane::OutputLane(asio::io_context& io, TopologyDevice peer, std::shared_ptr<security::TlsIdentity> identity,
                       TransmissionTask::Settings settings, Handlers handlers)
    : m_io(io),
      m_peer(std::move(peer)),
      m_identity(std::move(identity)),
      m_settings(settings),
      m_handlers(std::move(handlers)),
      m_queue(makeQueue())
{}

OutputLane::~OutputLane() = default;

std::unique_ptr<OutputQueue> OutputLane::makeQueue() const
{
    return std::make_unique<OutputQueue>(m_handlers.dropped, m_handlers.abandoning);
}

/// For an empty one.
std::unique_ptr<OutputQueue> OutputLane::exchangeQueue()
{
    m_leftBefore += m_queue->left().bytes;
    return std::exchange(m_queue, makeQueue());
}

void OutputLane::connect(protocol::EncodedMessage attach, std::chrono::nanoseconds limit, const std::vector<asio::ip::address>& known)
{
    m_attach = std::move(attach);
    cancelAttempt();
    const auto ended = [this, inSession = !known.empty()](transport::TcpClient::Outcome outcome) {
        auto addresses = m_client->addresses();
        bury(std::move(m_client));
        auto* channel = std::get_if<std::shared_ptr<transport::TcpChannel>>(&outcome);
        if (channel == nullptr) {
            if (inSession && !addresses.empty())
                m_addresses = std::move(addresses);
            return m_handlers.failed(std::get<transport::ConnectionFailure>(outcome));
        }
        if (const auto admitted = m_handlers.admit ? m_handlers.admit(**channel) : ok(); !admitted) {
            (*channel)->close();
            return m_handlers.failed({ProbeResult::TlsFailure, admitted.error().what});
        }
        m_addresses = std::move(addresses);
        established(std::move(*channel));
    };
    m_client = std::make_unique<transport::TcpClient>(m_io, m_peer, m_identity, limit, ended, known);
}

void OutputLane::cancelAttempt()
{
    if (m_client)
        m_client->cancel();
    bury(std::move(m_client));
}

void OutputLane::established(std::shared_ptr<transport::TcpChannel> channel)
{
    if (m_task) {
        m_bytesSent += m_task->bytesSent();
        m_task->close();
        bury(std::move(m_task));
    }
    m_queue->restart();
    m_way = {channel->localAddress().to_string(), channel->remote().address().to_string()};
    m_paced = m_settings.traffic == transport::TcpChannel::Traffic::Bulk && !channel->isLocal();
    m_rate.shareWith(m_paced && m_settings.interfaces != nullptr ? m_settings.interfaces->of(channel->localAddress()) : nullptr, m_peer.id);
    const auto settings = channel->isLocal() ? onThisComputer(m_settings, channel->isSecured()) : m_settings;
    m_task = std::make_unique<TransmissionTask>(std::move(channel), *m_queue, settings, m_paced ? &m_rate : nullptr,
                                                [this](const std::string& detail, bool identity) { lost(detail, identity); });
    m_rate.serve(*m_task);
    m_task->sendFirst(m_attach);
    m_handlers.up();
}

void OutputLane::lost(const std::string& detail, bool identity)
{
    m_bytesSent += m_task->bytesSent();
    m_rate.shareWith(nullptr); // who no longer sends has no share
    bury(std::move(m_task));
    m_handlers.lost(detail, identity);
}

std::optional<KnownRate> OutputLane::knownRate() const
{
    const auto known = m_task && m_paced ? m_rate.known() : std::nullopt;
    return known ? std::optional(KnownRate{*known, m_rate.shown()}) : std::nullopt;
}

bool OutputLane::push(OutputQueue::Entry&& entry)
{
    if (!m_queue->push(std::move(entry)))
        return false;
    if (m_task && !m_gathers)
        m_task->wake();
    return true;
}

void OutputLane::discardApplication()
{
    m_queue->discardApplication();
    if (m_task)
        m_task->wake();
}

void OutputLane::gather(bool begins)
{
    m_gathers = begins;
    if (m_task && !begins && !m_queue->empty())
        m_task->wake();
}

bool OutputLane::isDelivered() const
{
    return m_queue->empty() && (!m_task || (m_task->isIdle() && m_task->channel().unacknowledged() == 0));
}

void OutputLane::close(std::chrono::nanoseconds grace)
{
    cancelAttempt();
    m_queue->discardApplication();
    if (!m_task) {
        exchangeQueue();
        return;
    }
    m_bytesSent += m_task->bytesSent();
    m_rate.shareWith(nullptr);
    struct Remains {
        std::unique_ptr<OutputQueue> queue;
        std::unique_ptr<TransmissionTask> task;
    };
    auto remains = std::make_shared<Remains>();
    remains->queue = exchangeQueue();
    remains->task = std::move(m_task);
    if (grace <= std::chrono::nanoseconds::zero()) {
        remains->task->close();
        return bury(std::move(remains));
    }
    remains->task->orphan();
    auto timer = std::make_shared<asio::steady_timer>(m_io, grace);
    timer->async_wait([timer, remains](const boost::system::error_code&) {});
}

/// What ended may be further up the call stack: it dies in a later turn.
void OutputLane::bury(std::shared_ptr<void> ended)
{
    if (ended)
        asio::post(m_io, [ended = std::move(ended)] {});
}

} // namespace liena::tasks
