// The session-management set: numbers, fields and their byte layout (protocol section 7).
#pragma once

#include "liena/device_id.hpp"
#include "liena/hash.hpp"
#include "liena/session_state.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace liena::protocol {

inline constexpr std::uint16_t protocolVersion = 1;
inline constexpr std::size_t maximumSetBytes = 262144;
inline constexpr std::size_t maximumProbePadding = std::size_t{8} << 20U; ///< on a bulk lane
inline constexpr std::size_t maximumPromptPadding = 1024;                 ///< on lane 0 and by UDP

/// Text with the most bytes that the wire allows for it.
template <std::size_t Maximum>
struct Text {
    std::string value;
    friend bool operator==(const Text&, const Text&) = default;
};

/// Bytes of any value, at most so many.
template <std::size_t Maximum>
struct Bytes {
    std::vector<std::byte> value;
    friend bool operator==(const Bytes&, const Bytes&) = default;
};

struct Attach {
    static constexpr std::uint16_t number = 0x0001;
    std::uint16_t protocol = protocolVersion;
    std::uint64_t token = 0;
    std::uint8_t lane = 0;
    void visit(auto&& v) { v(protocol), v(token), v(lane); }
    friend bool operator==(const Attach&, const Attach&) = default;
};

struct Handshake {
    static constexpr std::uint16_t number = 0x0002;
    std::uint64_t token = 0;
    Sha256 topology;
    Sha256 set;
    Text<64> software;
    void visit(auto&& v) { v(token), v(topology), v(set), v(software); }
    friend bool operator==(const Handshake&, const Handshake&) = default;
};

struct HandshakeCommit {
    static constexpr std::uint16_t number = 0x0003;
    std::uint64_t token = 0;
    Sha256 set;
    bool wantSet = false;
    Text<64> software;
    void visit(auto&& v) { v(token), v(set), v(wantSet), v(software); }
    friend bool operator==(const HandshakeCommit&, const HandshakeCommit&) = default;
};

struct MessageSetRequest {
    static constexpr std::uint16_t number = 0x0004;
    Sha256 set;
    void visit(auto&& v) { v(set); }
    friend bool operator==(const MessageSetRequest&, const MessageSetRequest&) = default;
};

struct MessageSetAnswer {
    static constexpr std::uint16_t number = 0x0005;
    Sha256 set;
    std::vector<std::byte> xml; ///< at most maximumSetBytes
    void visit(auto&& v) { v(set), v(xml); }
    friend bool operator==(const MessageSetAnswer&, const MessageSetAnswer&) = default;
};

struct ChannelOpened {
    static constexpr std::uint16_t number = 0x0006;
    std::uint64_t token = 0;
    void visit(auto&& v) { v(token); }
    friend bool operator==(const ChannelOpened&, const ChannelOpened&) = default;
};

struct Rejected {
    static constexpr std::uint16_t number = 0x0007;
    std::uint64_t token = 0;
    RejectReason reason = RejectReason::None;
    Text<512> detail;
    void visit(auto&& v) { v(token), v(reason), v(detail); }
    friend bool operator==(const Rejected&, const Rejected&) = default;
};

struct Heartbeat {
    static constexpr std::uint16_t number = 0x0010;
    std::uint32_t sequence = 0;
    std::uint64_t sentNs = 0;
    std::uint32_t echoSequence = 0;
    std::uint64_t echoSentNs = 0;
    std::uint64_t echoReceivedNs = 0;
    std::uint8_t datagramsHeard = 0;
    SessionState state = SessionState::Closed;
    std::uint16_t incidents = 0;
    std::uint32_t epoch = 0;
    void visit(auto&& v)
    {
        v(sequence), v(sentNs), v(echoSequence), v(echoSentNs), v(echoReceivedNs), v(datagramsHeard), v(state), v(incidents), v(epoch);
    }
    friend bool operator==(const Heartbeat&, const Heartbeat&) = default;
};

struct Disengagement {
    static constexpr std::uint16_t number = 0x0020;
    std::uint64_t token = 0;
    Text<256> reason;
    void visit(auto&& v) { v(token), v(reason); }
    friend bool operator==(const Disengagement&, const Disengagement&) = default;
};

struct DisengagementCommit {
    static constexpr std::uint16_t number = 0x0021;
    std::uint64_t token = 0;
    void visit(auto&& v) { v(token); }
    friend bool operator==(const DisengagementCommit&, const DisengagementCommit&) = default;
};

struct ChannelClosed {
    static constexpr std::uint16_t number = 0x0022;
    std::uint64_t token = 0;
    void visit(auto&& v) { v(token); }
    friend bool operator==(const ChannelClosed&, const ChannelClosed&) = default;
};

struct DiagnosisHandshake {
    static constexpr std::uint16_t number = 0x0030;
    Handshake handshake;
    std::uint64_t previous = 0;
    void visit(auto&& v) { handshake.visit(v), v(previous); }
    friend bool operator==(const DiagnosisHandshake&, const DiagnosisHandshake&) = default;
};

struct DiagnosisHandshakeCommit {
    static constexpr std::uint16_t number = 0x0031;
    HandshakeCommit commit;
    std::uint64_t previous = 0; ///< the responder's own incident of this pair, 0 when it has none (ruling A8)
    void visit(auto&& v) { commit.visit(v), v(previous); }
    friend bool operator==(const DiagnosisHandshakeCommit&, const DiagnosisHandshakeCommit&) = default;
};

struct ChannelReOpened {
    static constexpr std::uint16_t number = 0x0032;
    std::uint64_t token = 0;
    std::uint64_t incident = 0;
    DeviceId peerA;
    DeviceId peerB;
    void visit(auto&& v) { v(token), v(incident), v(peerA), v(peerB); }
    friend bool operator==(const ChannelReOpened&, const ChannelReOpened&) = default;
};

struct StandBy {
    static constexpr std::uint16_t number = 0x0040;
    std::uint64_t incident = 0;
    DeviceId peerA;
    DeviceId peerB;
    LossCause cause = LossCause::None;
    std::uint64_t sinceNs = 0;
    DeviceId device; ///< the end of the pair that says so: `cause` is as it saw it (ruling B20)
    void visit(auto&& v) { v(incident), v(peerA), v(peerB), v(cause), v(sinceNs), v(device); }
    friend bool operator==(const StandBy&, const StandBy&) = default;
};

struct StandByReport {
    static constexpr std::uint16_t number = 0x0041;
    std::uint64_t incident = 0;
    DeviceId device;
    bool holding = false;
    std::uint64_t confirmedNs = 0;
    void visit(auto&& v) { v(incident), v(device), v(holding), v(confirmedNs); }
    friend bool operator==(const StandByReport&, const StandByReport&) = default;
};

struct IncidentDismissed {
    static constexpr std::uint16_t number = 0x0042;
    std::uint64_t incident = 0;
    DeviceId device;
    Text<256> reason;
    void visit(auto&& v) { v(incident), v(device), v(reason); }
    friend bool operator==(const IncidentDismissed&, const IncidentDismissed&) = default;
};

struct LinkReport {
    static constexpr std::uint16_t number = 0x0050;
    std::uint32_t windowUs = 0;
    std::uint64_t receivedBytes = 0;
    std::uint64_t receivedMessages = 0;
    std::uint64_t deliveredMessages = 0;
    std::uint64_t lateMessages = 0;
    std::uint64_t droppedMessages = 0;
    std::uint64_t oneWayNs = 0;
    std::uint32_t backlogBytes = 0;
    void visit(auto&& v)
    {
        v(windowUs), v(receivedBytes), v(receivedMessages), v(deliveredMessages), v(lateMessages), v(droppedMessages), v(oneWayNs),
            v(backlogBytes);
    }
    friend bool operator==(const LinkReport&, const LinkReport&) = default;
};

struct Abandon {
    static constexpr std::uint16_t number = 0x0051;
    std::uint16_t message = 0;
    std::uint64_t timestamp = 0;
    void visit(auto&& v) { v(message), v(timestamp); }
    friend bool operator==(const Abandon&, const Abandon&) = default;
};

/// Asks to measure the line for a while, or with no duration ends that. A limit of 0 is none.
struct MeasureRequest {
    static constexpr std::uint16_t number = 0x0060;
    std::uint32_t run = 0;
    std::uint32_t durationMs = 0;
    std::uint32_t probesPerSecond = 0;
    std::uint64_t bulkBytesPerSecond = 0;
    void visit(auto&& v) { v(run), v(durationMs), v(probesPerSecond), v(bulkBytesPerSecond); }
    friend bool operator==(const MeasureRequest&, const MeasureRequest&) = default;
};

enum class MeasureVerdict : std::uint8_t { Granted = 1, NotAllowed = 2, Busy = 3, Ended = 4 };

struct MeasureAnswer {
    static constexpr std::uint16_t number = 0x0061;
    std::uint32_t run = 0;
    MeasureVerdict verdict = MeasureVerdict::NotAllowed;
    bool inUse = false; ///< commands or images flow at the device that answers
    std::uint32_t durationMs = 0;
    std::uint32_t probesPerSecond = 0;
    std::uint64_t bulkBytesPerSecond = 0;
    Text<256> detail;
    void visit(auto&& v) { v(run), v(verdict), v(inUse), v(durationMs), v(probesPerSecond), v(bulkBytesPerSecond), v(detail); }
    friend bool operator==(const MeasureAnswer&, const MeasureAnswer&) = default;
};

/// On lane 0, in a packet, or as an image on a bulk lane.
enum class ProbeWay : std::uint8_t { Prompt = 1, Packet = 2, Image = 3 };

struct Probe {
    static constexpr std::uint16_t number = 0x0062;
    std::uint32_t run = 0;
    ProbeWay way = ProbeWay::Prompt;
    std::uint32_t sequence = 0;
    std::uint64_t sentNs = 0; ///< on a clock of the sender's choice
    Bytes<maximumProbePadding> padding;
    void visit(auto&& v) { v(run), v(way), v(sequence), v(sentNs), v(padding); }
    friend bool operator==(const Probe&, const Probe&) = default;
};

struct ProbeEcho {
    static constexpr std::uint16_t number = 0x0063;
    std::uint32_t run = 0;
    ProbeWay way = ProbeWay::Prompt;
    std::uint32_t sequence = 0;
    std::uint64_t sentNs = 0;
    std::uint32_t heard = 0; ///< probes of this way in this run, with this one
    void visit(auto&& v) { v(run), v(way), v(sequence), v(sentNs), v(heard); }
    friend bool operator==(const ProbeEcho&, const ProbeEcho&) = default;
};

using SessionMessage =
    std::variant<Attach, Handshake, HandshakeCommit, MessageSetRequest, MessageSetAnswer, ChannelOpened, Rejected, Heartbeat, Disengagement,
                 DisengagementCommit, ChannelClosed, DiagnosisHandshake, DiagnosisHandshakeCommit, ChannelReOpened, StandBy, StandByReport,
                 IncidentDismissed, LinkReport, Abandon, MeasureRequest, MeasureAnswer, Probe, ProbeEcho>;

std::uint16_t numberOf(const SessionMessage& message);
std::string_view nameOf(const SessionMessage& message);

/// Largest body in bytes of the session message with that number; nothing for a number that is none.
std::optional<std::size_t> maximumSessionBody(std::uint16_t number);

/// The information part. Text longer than the wire allows is cut at a character's start; a set longer than allowed is a mistake in the
/// program.
std::vector<std::byte> encodeSessionMessage(const SessionMessage& message);

/// Nothing when the body is not exactly a message of that number: size, UTF-8, booleans and enums.
std::optional<SessionMessage> decodeSessionMessage(std::uint16_t number, std::span<const std::byte> body);

} // namespace liena::protocol
