// The messages of the Fast DDS peer, encoded by hand: Debian's fastddsgen writes code for another release of the library.
#pragma once

#include "measure/stamp.hpp"

#include <fastdds/dds/topic/TopicDataType.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace liena::compare {

struct FrameSample {
    Stamp stamp;
    std::vector<std::byte> pixels;
};

/// CDR in this computer's order: the encapsulation, then the members as they lie in memory.
class CommandType final : public eprosima::fastdds::dds::TopicDataType {
public:
    using Payload = eprosima::fastrtps::rtps::SerializedPayload_t;

    CommandType();
    bool serialize(void* data, Payload* payload) override;
    bool deserialize(Payload* payload, void* data) override;
    std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override;
    void* createData() override { return new Command; }
    void deleteData(void* data) override { delete static_cast<Command*>(data); }
    bool getKey(void*, eprosima::fastrtps::rtps::InstanceHandle_t*, bool) override { return false; }
};

class FrameType final : public eprosima::fastdds::dds::TopicDataType {
public:
    using Payload = eprosima::fastrtps::rtps::SerializedPayload_t;

    explicit FrameType(std::size_t largest);
    bool serialize(void* data, Payload* payload) override;
    bool deserialize(Payload* payload, void* data) override;
    std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override;
    void* createData() override { return new FrameSample; }
    void deleteData(void* data) override { delete static_cast<FrameSample*>(data); }
    bool getKey(void*, eprosima::fastrtps::rtps::InstanceHandle_t*, bool) override { return false; }
};

} // namespace liena::compare
