// peer_fastdds: Fast DDS without security over UDP, reliable topics for commands, for what comes back and for frames.
#include "peers/fastdds_types.hpp"
#include "peers/threaded_link.hpp"
#include "workloads/peer.hpp"

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>

#include <mutex>
#include <stdexcept>
#include <thread>

namespace liena::compare {

namespace {

namespace dds = eprosima::fastdds::dds;

dds::DomainParticipant* makeParticipant(dds::DomainId_t domain)
{
    constexpr std::uint32_t sendBuffer = 256U << 10U; // more would be lost in the 512 KiB before a token bucket, and no frame come whole
    constexpr std::uint32_t receiveBuffer = 4U << 20U;
    dds::DomainParticipantQos qos;
    qos.transport().use_builtin_transports = false; // no shared memory: the link is what is compared
    auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
    udp->sendBufferSize = sendBuffer;
    udp->receiveBufferSize = receiveBuffer;
    qos.transport().user_transports.push_back(udp);
    auto* participant = dds::DomainParticipantFactory::get_instance()->create_participant(domain, qos);
    if (participant == nullptr)
        throw std::runtime_error("no participant");
    return participant;
}

/// Hands on whatever a reader has.
template <typename Sample, typename Hand>
class Taker final : public dds::DataReaderListener {
public:
    explicit Taker(Hand hand) : m_hand(std::move(hand)) {}

    void on_data_available(dds::DataReader* reader) override
    {
        dds::SampleInfo info;
        while (reader->take_next_sample(&m_sample, &info) == ReturnCode_t::RETCODE_OK)
            if (info.valid_data)
                m_hand(m_sample);
    }

private:
    Hand m_hand;
    Sample m_sample;
};

class FastLink final : public ThreadedLink {
public:
    explicit FastLink(const Options& options)
        : ThreadedLink(options),
          m_participant(makeParticipant(options.pair)),
          m_commandType(new CommandType),
          m_frameType(new FrameType(options.frameBytes))
    {
        m_frame.pixels.resize(options.frameBytes);
    }

    ~FastLink() override
    {
        m_participant->delete_contained_entities();
        dds::DomainParticipantFactory::get_instance()->delete_participant(m_participant);
    }

    void sendCommand(const Command& command) override
    {
        auto copy = command;
        m_commandWriter->write(&copy);
    }

    void sendFrame(const Stamp& stamp) override
    {
        const std::lock_guard lock(m_framing);
        m_frame.stamp = stamp;
        m_frameWriter->write(&m_frame);
    }

protected:
    void connect() override
    {
        m_commandType.register_type(m_participant);
        m_frameType.register_type(m_participant);
        auto* move = topic("Move", m_commandType);
        auto* moved = topic("Moved", m_commandType);
        auto* frame = topic("Frame", m_frameType);
        auto* publisher = m_participant->create_publisher(dds::PUBLISHER_QOS_DEFAULT);
        m_commandWriter = publisher->create_datawriter(isClient() ? move : moved, writerQos(dds::KEEP_ALL_HISTORY_QOS));
        if (isClient())
            m_frameWriter = publisher->create_datawriter(frame, writerQos(historyOfFrames()));
        auto* subscriber = m_participant->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT);
        subscriber->create_datareader(isClient() ? moved : move, readerQos(dds::KEEP_ALL_HISTORY_QOS), &m_commands);
        if (!isClient())
            subscriber->create_datareader(frame, readerQos(historyOfFrames()), &m_frames);
        while (!isMatched() && !isStopped())
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }

private:
    /// Until they are acknowledged, so that what was lost of them can be repeated.
    static constexpr int framesKept = 4;

    /// A frame replaces an older one, except in a throughput run.
    dds::HistoryQosPolicyKind historyOfFrames() const
    {
        return options().workload == WorkloadKind::Load ? dds::KEEP_LAST_HISTORY_QOS : dds::KEEP_ALL_HISTORY_QOS;
    }

    template <typename Qos>
    static Qos qosOf(Qos qos, dds::HistoryQosPolicyKind history)
    {
        qos.reliability().kind = dds::RELIABLE_RELIABILITY_QOS;
        qos.durability().kind = dds::VOLATILE_DURABILITY_QOS;
        qos.history().kind = history;
        qos.history().depth = framesKept;
        qos.endpoint().history_memory_policy = eprosima::fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
        return qos;
    }
    static dds::DataWriterQos writerQos(dds::HistoryQosPolicyKind history)
    {
        auto qos = qosOf(dds::DATAWRITER_QOS_DEFAULT, history);
        qos.reliability().max_blocking_time = {10, 0};
        constexpr std::uint32_t fiveMilliseconds = 5'000'000;
        qos.reliable_writer_qos().times.heartbeatPeriod =
            eprosima::fastrtps::Duration_t(0, fiveMilliseconds); // by default acknowledgements come every 3 s
        qos.publish_mode().kind = history == dds::KEEP_LAST_HISTORY_QOS ? dds::ASYNCHRONOUS_PUBLISH_MODE : dds::SYNCHRONOUS_PUBLISH_MODE;
        return qos;
    }
    static dds::DataReaderQos readerQos(dds::HistoryQosPolicyKind history) { return qosOf(dds::DATAREADER_QOS_DEFAULT, history); }

    dds::Topic* topic(const char* name, const dds::TypeSupport& type)
    {
        return m_participant->create_topic(name, type.get_type_name(), dds::TOPIC_QOS_DEFAULT);
    }

    bool isMatched() const
    {
        dds::PublicationMatchedStatus commands;
        dds::PublicationMatchedStatus frames;
        m_commandWriter->get_publication_matched_status(commands);
        if (m_frameWriter == nullptr)
            return commands.current_count > 0;
        m_frameWriter->get_publication_matched_status(frames);
        return commands.current_count > 0 && frames.current_count > 0;
    }

    struct HandCommand {
        FastLink* link;
        void operator()(const Command& command) const { link->received(command); }
    };
    struct HandFrame {
        FastLink* link;
        void operator()(const FrameSample& frame) const { link->received(frame.stamp, frame.pixels.size()); }
    };

    dds::DomainParticipant* m_participant;
    dds::TypeSupport m_commandType;
    dds::TypeSupport m_frameType;
    Taker<Command, HandCommand> m_commands{HandCommand{this}};
    Taker<FrameSample, HandFrame> m_frames{HandFrame{this}};
    dds::DataWriter* m_commandWriter = nullptr;
    dds::DataWriter* m_frameWriter = nullptr;
    std::mutex m_framing;
    FrameSample m_frame;
};

} // namespace

} // namespace liena::compare

int main(int argc, char** argv)
{
    using namespace liena::compare;
    runPeer(argc, argv, "Fast DDS", [](const Options& options) { return std::make_unique<FastLink>(options); });
}
