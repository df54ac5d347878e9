// Any 20 bytes as a header, on any lane and in a packet: what is taken is what the page allows.
#include "corpus_ends.hpp"
#include "fuzz_input.hpp"
#include "protocol/session_messages.hpp"

using namespace liena;
using namespace liena::protocol;
using namespace liena::fuzz;

namespace {

void checkVerdict(const HeaderJudgement& judgement, const DatagramHeader& header)
{
    const bool taken = judgement.verdict == HeaderVerdict::Take;
    expect(taken == judgement.why.empty(), "a refusal says why, and nothing else does");
    if (header.message.origin != cockpitId)
        expect(judgement.verdict == HeaderVerdict::Refuse, "another origin is a violation");
    if (!taken)
        return;
    expect(header.target == robotId || header.target.isBroadcast(), "what is taken is for this device");
    expect(header.length <= judgement.maximum, "what is taken is within its maximum");
    expect(judgement.maximum <= std::size_t{32} << 20U, "no maximum is above 32 MiB");
    expect(header.message.number != 0 && header.message.number < 0x1000, "what is taken has no reserved number");
}

void checkTakenApplication(const DatagramHeader& header, std::uint8_t lane)
{
    const auto* definition = corpusEnds().definitionOf(header.message.number);
    expect(definition != nullptr, "what is taken is defined");
    expect((definition->priority == Priority::Bulk) == (lane > 0), "bulk and nothing else is on a bulk lane");
    if (definition->priority == Priority::Control)
        expect(!header.moreSegments && !header.target.isBroadcast(), "control is whole and for one device");
    if (definition->role == Role::Command)
        expect(!header.target.isBroadcast(), "a command is for one device");
}

void checkOnLane(const DatagramHeader& header, std::uint8_t lane)
{
    const auto judgement = judgeOnLane(corpusEnds(), lane, header);
    checkVerdict(judgement, header);
    if (judgement.verdict != HeaderVerdict::Take)
        return;
    if (header.message.isSessionManagement())
        expect(lane == 0 || header.message.number == Abandon::number || header.message.number == Probe::number,
               "session management is on lane 0");
    else
        checkTakenApplication(header, lane);
}

void checkInPacket(const DatagramHeader& header, std::size_t partSize)
{
    const auto judgement = judgeInPacket(corpusEnds(), header, partSize);
    checkVerdict(judgement, header);
    if (judgement.verdict != HeaderVerdict::Take)
        return;
    expect(!header.moreSegments && header.length == partSize, "a packet is filled by one whole message");
    if (header.message.isSessionManagement())
        expect((header.message.number == Heartbeat::number || header.message.number == Probe::number ||
                header.message.number == ProbeEcho::number) &&
                   !header.target.isBroadcast(),
               "of session management only a Heartbeat and what measures");
    else
        expect(corpusEnds().definitionOf(header.message.number)->path == Path::Datagram, "only what is declared for it");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    FuzzInput input(data, size);
    const auto lane = input.number<std::uint8_t>();
    const auto partSize = input.number<std::uint16_t>();
    const auto bytes = input.take(headerSize);
    if (bytes.size() < headerSize)
        return 0;
    const auto header = decodeHeader(bytes.first<headerSize>());
    const auto again = encodeHeader(header);
    expect(std::equal(again.begin(), again.end(), bytes.begin()), "a header is written again as it was read");
    checkOnLane(header, lane);
    checkInPacket(header, partSize);
    checkInPacket(header, header.length);
    if (isAttachHeader(robotId, cockpitId, header))
        expect(judgeOnLane(corpusEnds(), 0, header).verdict == HeaderVerdict::Take && header.length == 11, "an Attach is what it is");
    if (isHandshakeHeader(robotId, cockpitId, header))
        expect(judgeOnLane(corpusEnds(), 0, header).verdict == HeaderVerdict::Take, "a handshake is what it is");
    return 0;
}
