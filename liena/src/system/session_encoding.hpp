// A session message of this device in wire form, stamped now.
#pragma once

#include "protocol/datagram_encoder.hpp"
#include "protocol/session_messages.hpp"
#include "system/module_host.hpp"

namespace liena::system {

inline protocol::EncodedMessage encodeSession(ModuleHost& host, const protocol::SessionMessage& message, DeviceId target)
{
    const auto body = protocol::encodeSessionMessage(message);
    protocol::EncodedMessage encoded;
    encoded.header.message = {host.ownDevice().id, protocol::numberOf(message)};
    encoded.header.target = target;
    encoded.header.timestamp = host.stamp();
    encoded.part.assign(body.data(), body.data() + body.size());
    return encoded;
}

} // namespace liena::system
