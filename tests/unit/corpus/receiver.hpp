// The receiver of the refused frames, as tests/corpus/README.md describes it: every judgement is the library's own.
#pragma once

#include "liena/message_set.hpp"
#include "protocol/header_judge.hpp"
#include "protocol/reassembler.hpp"
#include "security/datagram_seal.hpp"
#include "session/packet_window.hpp"
#include "unit/session/session_side.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace liena::test {

/// What became of the bytes. `verdict` is accepted, violation, dropped, malformed or closed.
struct Verdict {
    std::string verdict;
    std::string where;
    std::string why;

    bool isRefusal() const { return verdict != "accepted"; }
};

/// The robot; its peer is the cockpit. One object takes one file.
class Receiver {
public:
    /// `state`: a word of the corpus, `Open` when empty.
    Receiver(std::uint8_t lane, const std::string& state);

    /// The first refusal, or the acceptance of the last message.
    Verdict onLane(std::span<const std::byte> bytes);
    Verdict asAttach(std::span<const std::byte> bytes) const;
    Verdict asHandshake(std::span<const std::byte> bytes) const;
    Verdict asPacket(std::span<const std::byte> bytes);

private:
    Verdict take(const protocol::DatagramHeader& header, std::span<const std::byte> body, std::size_t maximum);
    Verdict takeMessage(const protocol::DatagramHeader& header, std::span<const std::byte> part);
    Verdict takeSession(const protocol::DatagramHeader& header, std::span<const std::byte> part);
    Verdict takeApplication(const protocol::DatagramHeader& header, std::span<const std::byte> part);
    session::SessionInput inputOf(const protocol::SessionMessage& message) const;
    void enter(const std::string& state);

    std::shared_ptr<const MessageSet> m_robot;
    std::shared_ptr<const MessageSet> m_cockpit;
    protocol::Ends m_ends;
    std::uint8_t m_lane;
    Side m_side;
    session::ControlGuard m_guard;
    session::PacketWindow m_window;
    security::DatagramSeal m_seal;
    protocol::PartialBudget m_budget;
    protocol::Reassembler m_reassembler;
};

} // namespace liena::test
