// How datagrams are broken, repeated and invented.
#include "liar.hpp"

#include "protocol/session_messages.hpp"

#include <algorithm>

namespace liena::simulation {

namespace {

using protocol::DatagramHeader;
using protocol::headerSize;

DatagramHeader headerAt(const std::vector<std::byte>& bytes, std::size_t begin)
{
    return protocol::decodeHeader(std::span<const std::byte, headerSize>(bytes.data() + begin, headerSize));
}

void put(std::vector<std::byte>& bytes, std::size_t at, const DatagramHeader& header)
{
    const auto encoded = protocol::encodeHeader(header);
    std::copy(encoded.begin(), encoded.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at));
}

void append(std::vector<std::byte>& bytes, DatagramHeader header, const std::vector<std::byte>& body)
{
    header.length = static_cast<std::uint16_t>(body.size());
    const auto encoded = protocol::encodeHeader(header);
    bytes.insert(bytes.end(), encoded.begin(), encoded.end());
    bytes.insert(bytes.end(), body.begin(), body.end());
}

protocol::SessionMessage drawMessage(SeededRandom& random, DeviceId a, DeviceId b)
{
    const auto token = random.next();
    switch (random.below(9)) {
    case 0:
        return protocol::StandBy{token, std::min(a, b), std::max(a, b), LossCause::HeartbeatLost, token >> 2U, a};
    case 1:
        return protocol::StandByReport{token, a, true, token};
    case 2:
        return protocol::ChannelOpened{token};
    case 3:
        return protocol::ChannelReOpened{token, random.next(), std::min(a, b), std::max(a, b)};
    case 4:
        return protocol::Disengagement{token, {"no"}};
    case 5:
        return protocol::Rejected{token, RejectReason::Busy, {"no"}};
    case 6:
        return protocol::Handshake{token, {}, {}, {"a liar"}};
    case 7:
        return protocol::Heartbeat{static_cast<std::uint32_t>(token), 0, 0, 0, 0, 0, SessionState::Open, 0,
                                   static_cast<std::uint32_t>(token)};
    default:
        return protocol::Attach{1, token, 0};
    }
}

} // namespace

bool BlackChannel::isCommand(const std::vector<std::byte>& bytes, std::size_t begin)
{
    const auto header = headerAt(bytes, begin);
    return header.message.isCommand() && header.message.number != 0x0104 && !header.moreSegments;
}

void BlackChannel::remember(const std::vector<std::byte>& bytes, std::size_t begin)
{
    m_commands.emplace_back(bytes.begin() + static_cast<std::ptrdiff_t>(begin), bytes.end());
    if (m_commands.size() > most)
        m_commands.pop_front();
}

void BlackChannel::replay(std::vector<std::byte>& bytes, SeededRandom& random, std::size_t count) const
{
    for (std::size_t i = 0; i < count && !m_commands.empty(); ++i) {
        const auto& again = m_commands[random.below(m_commands.size())];
        bytes.insert(bytes.end(), again.begin(), again.end());
    }
}

void BlackChannel::corrupt(std::vector<std::byte>& bytes, std::size_t begin, SeededRandom& random)
{
    const auto body = bytes.size() - begin - headerSize;
    if (body != 0)
        bytes[begin + headerSize + random.below(body)] ^= static_cast<std::byte>(1U << random.below(8));
}

void Liar::speak(std::vector<std::byte>& bytes, std::size_t begin, SeededRandom& random, LieKind lies) const
{
    auto header = headerAt(bytes, begin);
    if (header.moreSegments)
        return; // broken in the middle is broken all the same
    if (lies != LieKind::Every && !header.message.isReport())
        return;
    if (lies == LieKind::EndlessMessages)
        return endless(bytes, header, random);
    if (lies == LieKind::Origins) {
        header.message.origin = someone(random);
        return put(bytes, begin, header);
    }
    switch (random.below(6)) {
    case 0:
    case 1:
        return mutate(bytes, begin, random);
    case 2: {
        const std::vector<std::byte> again(bytes.begin() + static_cast<std::ptrdiff_t>(begin), bytes.end());
        bytes.insert(bytes.end(), again.begin(), again.end());
        return;
    }
    case 3:
        return endless(bytes, header, random);
    default:
        return invent(bytes, header, random);
    }
}

void Liar::mutate(std::vector<std::byte>& bytes, std::size_t begin, SeededRandom& random) const
{
    auto header = headerAt(bytes, begin);
    switch (random.below(7)) {
    case 0:
        header.message.origin = someone(random);
        return put(bytes, begin, header);
    case 1:
        header.target = random.below(2) == 0 ? DeviceId::broadcast() : someone(random);
        return put(bytes, begin, header);
    case 2:
        header.message.number = static_cast<std::uint16_t>(random.below(3) == 0 ? random.below(0x1100) : random.below(0x60));
        return put(bytes, begin, header);
    case 3:
        header.length = static_cast<std::uint16_t>(random.below(protocol::maximumBody + 1));
        return put(bytes, begin, header);
    case 4:
        header.timestamp.ns = random.next() >> random.below(64);
        return put(bytes, begin, header);
    case 5:
        header.moreSegments = !header.moreSegments;
        return put(bytes, begin, header);
    default:
        for (auto flips = random.between(1, 8); flips > 0; --flips)
            bytes[begin + random.below(bytes.size() - begin)] ^= static_cast<std::byte>(1U << random.below(8));
    }
}

void Liar::invent(std::vector<std::byte>& bytes, const DatagramHeader& like, SeededRandom& random) const
{
    const auto a = someone(random);
    const auto b = someone(random);
    const auto message = drawMessage(random, a, b);
    auto header = like;
    header.message.number = protocol::numberOf(message);
    header.target = header.message.number >= 0x0032 && header.message.number <= 0x0042 ? DeviceId::broadcast() : like.target;
    ++header.timestamp.ns;
    append(bytes, header, protocol::encodeSessionMessage(message));
}

/// Segments that never come to an end, of whatever number just left.
void Liar::endless(std::vector<std::byte>& bytes, const DatagramHeader& like, SeededRandom& random) const
{
    auto header = like;
    header.moreSegments = true;
    ++header.timestamp.ns;
    const std::vector<std::byte> body(random.between(1, 4000));
    for (auto count = random.between(1, 20); count > 0; --count)
        append(bytes, header, body);
}

} // namespace liena::simulation
