// The library's own door into a Message: its meta-data and its encoded fields.
#pragma once

#include "liena/message.hpp"

#include <span>
#include <utility>

namespace liena {

class MessageAccess {
public:
    static void setMeta(Message& message, DeviceId origin, DeviceId target, Timestamp timestamp)
    {
        message.m_origin = origin;
        message.m_target = target;
        message.m_timestamp = timestamp;
    }

    static void setArrival(Message& message, std::chrono::steady_clock::time_point arrival, std::optional<std::chrono::nanoseconds> latency)
    {
        message.m_arrival = arrival;
        message.m_latency = latency;
    }

    /// `fields` must have passed protocol::checkFields.
    static Message fromFields(std::shared_ptr<const MessageSet> set, const MessageDefinition& definition, FieldBytes&& fields)
    {
        return {std::move(set), definition, std::move(fields)};
    }

    /// The same of bytes that stay where they are.
    static Message copyOf(std::shared_ptr<const MessageSet> set, const MessageDefinition& definition, std::span<const std::byte> fields)
    {
        Message message(std::move(set), definition, FieldBytes());
        message.m_fields.assign(fields.data(), fields.data() + fields.size());
        return message;
    }

    /// What the definition, and every name in it, lives in.
    static const std::shared_ptr<const MessageSet>& setIn(const Message& message) { return message.m_set; }
    static std::shared_ptr<const MessageSet> takeSet(Message& message) { return std::move(message.m_set); }
    static FieldBytes takeFields(Message& message) { return std::move(message.m_fields); }
    static std::shared_ptr<const LentBytes> takeLent(Message& message) { return std::move(message.m_lent); }
};

} // namespace liena
