// UDP packets: the window held against the set of all numbers; what was sealed is opened, and nothing else is.
#include "corpus_ends.hpp"
#include "fuzz_input.hpp"
#include "protocol/packet.hpp"
#include "security/datagram_seal.hpp"
#include "session/packet_window.hpp"

#include <set>
#include <vector>

using namespace liena;
using namespace liena::protocol;
using namespace liena::fuzz;

namespace {

using Bytes = std::vector<std::byte>;

void checkWindow(FuzzInput& input)
{
    session::PacketWindow window;
    std::set<std::uint64_t> seen;
    std::uint64_t newest = input.flag() ? 0 : input.number<std::uint64_t>();
    if (newest != 0) {
        window.note(newest);
        seen.insert(newest);
    }
    while (!input.isUsedUp()) {
        const auto step = input.number<std::uint16_t>();
        const std::uint64_t number = (step & 1U) != 0 ? newest + (step >> 1U) % 3000 : newest - (step >> 1U) % 3000;
        const bool isOld = number < newest && newest - number > session::PacketWindow::reach;
        const bool expected = number != 0 && !isOld && !seen.contains(number);
        expect(window.isNew(number) == expected, "a packet number is taken once, and not when it is far behind");
        if (!expected || input.below(4) == 0)
            continue; // a forged number is never noted
        window.note(number);
        seen.insert(number);
        newest = std::max(newest, number);
        expect(window.newest() == newest && !window.isNew(number), "a noted number is not new");
    }
}

security::DatagramKey keyFrom(FuzzInput& input)
{
    security::DatagramKey key;
    const auto bytes = input.take(4);
    std::copy(bytes.begin(), bytes.end(), key.key.begin());
    return key;
}

void checkSeal(FuzzInput& input)
{
    const PacketPrefix prefix{input.number<std::uint64_t>(), input.number<std::uint64_t>()};
    const auto prefixBytes = encodePacketPrefix(prefix);
    expect(decodePacketPrefix(prefixBytes) == prefix, "a prefix is read as it was written");
    security::DatagramSeal seal(keyFrom(input));
    const auto damage = input.number<std::uint16_t>();
    const auto plain = input.take(maximumPacketDatagram);
    Bytes sealed(plain.size() + packetTagSize);
    expect(seal.seal(prefix.number, prefixBytes, plain, sealed), "a datagram is sealed");
    Bytes opened(plain.size());
    expect(seal.open(prefix.number, prefixBytes, sealed, opened) && std::equal(opened.begin(), opened.end(), plain.begin()),
           "what was sealed is opened");
    expect(!seal.open(prefix.number + 1, prefixBytes, sealed, opened), "under another number it is not");
    auto otherPrefix = prefixBytes;
    otherPrefix[damage % otherPrefix.size()] ^= static_cast<std::byte>(1U << (damage >> 13U));
    expect(!seal.open(prefix.number, otherPrefix, sealed, opened), "behind another prefix it is not");
    sealed[damage % sealed.size()] ^= static_cast<std::byte>(1U << (damage >> 13U));
    expect(!seal.open(prefix.number, prefixBytes, sealed, opened), "when one bit is another it is not");
}

/// What the peer sealed may still be anything.
void checkContent(FuzzInput& input)
{
    const auto datagram = input.take(maximumPacketDatagram);
    const auto prefix = decodePacketPrefix(datagram);
    expect(prefix.has_value() == (datagram.size() >= packetPrefixSize), "a prefix has 16 bytes");
    if (datagram.size() < headerSize)
        return;
    const auto header = decodeHeader(datagram.first<headerSize>());
    const auto judgement = judgeInPacket(corpusEnds(), header, datagram.size() - headerSize);
    if (judgement.verdict == HeaderVerdict::Take)
        expect(datagram.size() - headerSize <= judgement.maximum && header.message.origin == cockpitId, "what is taken is the peer's");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    FuzzInput input(data, size);
    const auto kind = input.below(3);
    if (kind == 0)
        checkWindow(input);
    else if (kind == 1)
        checkSeal(input);
    else
        checkContent(input);
    return 0;
}
