// Encoding for Fast DDS.
#include "peers/fastdds_types.hpp"

#include <cstring>

namespace liena::compare {

namespace {

constexpr std::size_t encapsulation = 4;
constexpr std::size_t frameStart = encapsulation + sizeof(Stamp) + sizeof(std::uint32_t);

void begin(eprosima::fastrtps::rtps::SerializedPayload_t& payload, std::size_t size)
{
    constexpr unsigned char littleEndianCdr[encapsulation] = {0, 1, 0, 0};
    std::memcpy(payload.data, littleEndianCdr, encapsulation);
    payload.encapsulation = CDR_LE;
    payload.length = static_cast<std::uint32_t>(size);
}

} // namespace

CommandType::CommandType()
{
    setName("comparison::Move");
    m_typeSize = encapsulation + sizeof(Command);
    m_isGetKeyDefined = false;
}

bool CommandType::serialize(void* data, Payload* payload)
{
    begin(*payload, encapsulation + sizeof(Command));
    std::memcpy(payload->data + encapsulation, data, sizeof(Command));
    return true;
}

bool CommandType::deserialize(Payload* payload, void* data)
{
    if (payload->length < encapsulation + sizeof(Command))
        return false;
    std::memcpy(data, payload->data + encapsulation, sizeof(Command));
    return true;
}

std::function<std::uint32_t()> CommandType::getSerializedSizeProvider(void* /*data*/)
{
    return [] { return static_cast<std::uint32_t>(encapsulation + sizeof(Command)); };
}

FrameType::FrameType(std::size_t largest)
{
    setName("comparison::Frame");
    m_typeSize = static_cast<std::uint32_t>(frameStart + largest);
    m_isGetKeyDefined = false;
}

bool FrameType::serialize(void* data, Payload* payload)
{
    const auto& frame = *static_cast<const FrameSample*>(data);
    begin(*payload, frameStart + frame.pixels.size());
    const auto size = static_cast<std::uint32_t>(frame.pixels.size());
    std::memcpy(payload->data + encapsulation, &frame.stamp, sizeof frame.stamp);
    std::memcpy(payload->data + encapsulation + sizeof frame.stamp, &size, sizeof size);
    std::memcpy(payload->data + frameStart, frame.pixels.data(), frame.pixels.size());
    return true;
}

bool FrameType::deserialize(Payload* payload, void* data)
{
    auto& frame = *static_cast<FrameSample*>(data);
    std::uint32_t size = 0;
    if (payload->length < frameStart)
        return false;
    std::memcpy(&frame.stamp, payload->data + encapsulation, sizeof frame.stamp);
    std::memcpy(&size, payload->data + encapsulation + sizeof frame.stamp, sizeof size);
    if (size > payload->length - frameStart)
        return false;
    frame.pixels.resize(size);
    std::memcpy(frame.pixels.data(), payload->data + frameStart, size);
    return true;
}

std::function<std::uint32_t()> FrameType::getSerializedSizeProvider(void* data)
{
    const auto size = static_cast<const FrameSample*>(data)->pixels.size();
    return [size] { return static_cast<std::uint32_t>(frameStart + size); };
}

} // namespace liena::compare
