// peer_cyclonedds: Cyclone DDS without security, reliable topics for commands, for what comes back and for frames.
#include "peers/threaded_link.hpp"
#include "workloads/peer.hpp"

#include "comparison.h"

#include <dds/dds.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <string>
#include <thread>

namespace liena::compare {

namespace {

dds_entity_t checked(dds_entity_t entity, const char* what)
{
    if (entity < 0)
        throw std::runtime_error(std::string(what) + ": " + dds_strretcode(-entity));
    return entity;
}

class CycloneLink final : public ThreadedLink {
public:
    explicit CycloneLink(const Options& options)
        : ThreadedLink(options),
          m_pixels(options.frameBytes),
          m_participant(checked(dds_create_participant(options.pair, nullptr, nullptr), "participant"))
    {}

    ~CycloneLink() override { dds_delete(m_participant); }

    void sendCommand(const Command& command) override
    {
        comparison_Move move{};
        move.number = command.stamp.number;
        move.sent = command.stamp.sentNs;
        std::copy(command.values.begin(), command.values.end(), move.values);
        dds_write(m_commandWriter, &move);
    }

    void sendFrame(const Stamp& stamp) override
    {
        comparison_Frame frame{};
        frame.number = stamp.number;
        frame.sent = stamp.sentNs;
        frame.pixels._buffer = reinterpret_cast<std::uint8_t*>(m_pixels.data());
        frame.pixels._length = frame.pixels._maximum = static_cast<std::uint32_t>(m_pixels.size());
        dds_write(m_frameWriter, &frame);
    }

protected:
    void connect() override
    {
        // A frame replaces an older one, except in a throughput run.
        auto* all = qosOf(DDS_HISTORY_KEEP_ALL);
        auto* newest = qosOf(options().workload == WorkloadKind::Load ? DDS_HISTORY_KEEP_LAST : DDS_HISTORY_KEEP_ALL);
        const auto move = topic(&comparison_Move_desc, "Move");
        const auto moved = topic(&comparison_Move_desc, "Moved");
        const auto frame = topic(&comparison_Frame_desc, "Frame");
        m_commandWriter = checked(dds_create_writer(m_participant, isClient() ? move : moved, all, nullptr), "writer");
        if (isClient())
            m_frameWriter = checked(dds_create_writer(m_participant, frame, newest, nullptr), "writer of frames");
        listen(isClient() ? moved : move, all, &CycloneLink::takeCommands);
        if (!isClient())
            listen(frame, newest, &CycloneLink::takeFrames);
        dds_delete_qos(all);
        dds_delete_qos(newest);
        while (!isMatched() && !isStopped())
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }

private:
    /// Until they are acknowledged, so that what was lost of them can be repeated.
    static constexpr int framesKept = 4;

    static dds_qos_t* qosOf(dds_history_kind_t history)
    {
        auto* qos = dds_create_qos();
        dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(10));
        dds_qset_history(qos, history, framesKept);
        return qos;
    }

    dds_entity_t topic(const dds_topic_descriptor_t* type, const char* name) const
    {
        return checked(dds_create_topic(m_participant, type, name, nullptr, nullptr), name);
    }

    void listen(dds_entity_t topic, const dds_qos_t* qos, dds_on_data_available_fn take)
    {
        auto* listener = dds_create_listener(this);
        dds_lset_data_available(listener, take);
        checked(dds_create_reader(m_participant, topic, qos, listener), "reader");
        dds_delete_listener(listener);
    }

    bool isMatched() const
    {
        dds_publication_matched_status_t commands{};
        dds_publication_matched_status_t frames{};
        dds_get_publication_matched_status(m_commandWriter, &commands);
        if (!isClient())
            return commands.current_count > 0;
        dds_get_publication_matched_status(m_frameWriter, &frames);
        return commands.current_count > 0 && frames.current_count > 0;
    }

    template <typename Sample, typename Hand>
    static void takeEach(dds_entity_t reader, const Hand& hand)
    {
        constexpr std::size_t most = 64;
        void* samples[most] = {};
        dds_sample_info_t infos[most];
        for (;;) {
            const auto count = dds_take(reader, samples, infos, most, most);
            if (count <= 0)
                return;
            for (int i = 0; i < count; ++i)
                if (infos[i].valid_data)
                    hand(*static_cast<const Sample*>(samples[i]));
            dds_return_loan(reader, samples, count);
            samples[0] = nullptr;
        }
    }

    static void takeCommands(dds_entity_t reader, void* self)
    {
        takeEach<comparison_Move>(reader, [self](const comparison_Move& move) {
            Command command;
            command.stamp = {move.number, move.sent};
            std::copy(std::begin(move.values), std::end(move.values), command.values.begin());
            static_cast<CycloneLink*>(self)->received(command);
        });
    }

    static void takeFrames(dds_entity_t reader, void* self)
    {
        takeEach<comparison_Frame>(reader, [self](const comparison_Frame& frame) {
            static_cast<CycloneLink*>(self)->received({frame.number, frame.sent}, frame.pixels._length);
        });
    }

    std::vector<std::byte> m_pixels;
    dds_entity_t m_participant;
    dds_entity_t m_commandWriter = 0;
    dds_entity_t m_frameWriter = 0;
};

} // namespace

} // namespace liena::compare

int main(int argc, char** argv)
{
    using namespace liena::compare;
    runPeer(argc, argv, "Cyclone DDS", [](const Options& options) { return std::make_unique<CycloneLink>(options); });
}
