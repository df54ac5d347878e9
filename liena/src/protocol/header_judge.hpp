// What a datagram's header means before its body is awaited (protocol sections 2 and 6; rulings A3, A12, B2, B4, B7 to B10).
#pragma once

#include "liena/message_set.hpp"
#include "protocol/datagram.hpp"
#include "protocol/datagram_decoder.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace liena::protocol {

/// Who speaks to whom, and the sets that define what they say; only looked at.
struct Ends {
    DeviceId peer; ///< authenticated
    DeviceId self;
    const MessageSet* ownSet = nullptr;  ///< defines the commands
    const MessageSet* peerSet = nullptr; ///< defines the reports; null while it is not known

    /// Null for a number that is reserved, of session management, or not defined.
    const MessageDefinition* definitionOf(std::uint16_t number) const;
};

/// Skip: counted, and the rest of the stream goes on. Refuse: a violation.
struct HeaderJudgement {
    HeaderVerdict verdict = HeaderVerdict::Take;
    std::size_t maximum = 0; ///< of the whole message in bytes, when it is taken
    std::string why;         ///< when it is not
    /// Of an application's message that is taken: inside the sets that were asked.
    const MessageDefinition* definition = nullptr;
};

/// On a lane of a session.
HeaderJudgement judgeOnLane(const Ends& ends, std::uint8_t lane, const DatagramHeader& header);

/// In a UDP packet; `partSize` is what stands behind the header there.
HeaderJudgement judgeInPacket(const Ends& ends, const DatagramHeader& header, std::size_t partSize);

/// Whether it is the Attach that a connection to `self` begins with. `authenticated` is absent in mode `none`.
bool isAttachHeader(DeviceId self, std::optional<DeviceId> authenticated, const DatagramHeader& header);

/// Whether it is the one handshake that follows an Attach with a fresh token.
bool isHandshakeHeader(DeviceId self, DeviceId peer, const DatagramHeader& header);

} // namespace liena::protocol
