// A stream of bytes in any chunks gives the same datagrams as the stream in one piece.
#include "fuzz_input.hpp"
#include "fuzz_target.hpp"
#include "protocol/datagram_decoder.hpp"

#include <array>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

using namespace liena::protocol;
using namespace liena::fuzz;

namespace {

struct Datagram {
    DatagramHeader header;
    std::vector<std::byte> body;
    friend bool operator==(const Datagram&, const Datagram&) = default;
};

struct Reading {
    std::vector<Datagram> datagrams;
    std::size_t judged = 0;
    bool refused = false;
    friend bool operator==(const Reading&, const Reading&) = default;
};

HeaderVerdict verdictOf(const DatagramHeader& header)
{
    if (header.message.number == 0)
        return HeaderVerdict::Skip;
    if (header.message.number >= 0x1000)
        return HeaderVerdict::Refuse;
    return header.message.number % 2 == 0 ? HeaderVerdict::Take : HeaderVerdict::TakeInPieces;
}

bool isWelcome(const DatagramHeader& header) { return header.message.number != 0x0666; }

/// What the page says, without a buffer.
Reading expectedOf(std::span<const std::byte> stream)
{
    Reading reading;
    while (stream.size() >= headerSize && !reading.refused) {
        const auto header = decodeHeader(stream.first<headerSize>());
        ++reading.judged;
        const auto verdict = verdictOf(header);
        reading.refused = verdict == HeaderVerdict::Refuse;
        if (reading.refused || stream.size() < headerSize + header.length)
            break;
        const auto body = stream.subspan(headerSize, header.length);
        if (verdict != HeaderVerdict::Skip) {
            reading.datagrams.push_back({header, {body.begin(), body.end()}});
            reading.refused = !isWelcome(header);
        }
        stream = stream.subspan(headerSize + header.length);
    }
    return reading;
}

/// A connection hands its decoder on behind the first datagram: there the decoder is stopped once and goes on. `lands`: what is awaited of
/// a body goes past the decoder's buffer, with so much of what follows; nothing: into the buffer.
class Reader {
public:
    using Lands = std::optional<DatagramDecoder::ReadAhead>;

    Reader(bool handsOn, Lands lands) : m_handsOn(handsOn), m_lands(lands) {}

    bool read(std::span<const std::byte> chunk)
    {
        while (!chunk.empty()) {
            if (m_lands && m_decoder.awaited() > 0) {
                const auto place = std::make_shared<std::vector<std::byte>>(m_decoder.awaited());
                m_decoder.landIn(*place, place);
            }
            const auto room = m_decoder.room(m_lands.value_or(DatagramDecoder::ReadAhead::Header));
            expect(!room.buffer.empty(), "there is always room for more bytes");
            const auto part = chunk.first(std::min(chunk.size(), room.landing.size() + room.buffer.size()));
            const auto landing = part.first(std::min(part.size(), room.landing.size()));
            std::copy(landing.begin(), landing.end(), room.landing.begin());
            const auto rest = part.subspan(landing.size());
            std::copy(rest.begin(), rest.end(), room.buffer.begin());
            m_decoder.commit(part.size());
            chunk = chunk.subspan(part.size());
            if (!process())
                return false;
        }
        return true;
    }

    const Reading& reading() const { return m_reading; }

private:
    bool process()
    {
        for (;;) {
            bool stopped = false;
            const auto judge = [&](const DatagramHeader& header) {
                if (m_handsOn && !m_reading.datagrams.empty()) {
                    m_handsOn = false;
                    stopped = true;
                    return HeaderVerdict::Refuse;
                }
                ++m_reading.judged;
                return verdictOf(header);
            };
            const auto take = [&](const DatagramHeader& header, std::span<const std::byte> body) {
                m_reading.datagrams.push_back({header, {body.begin(), body.end()}});
                return isWelcome(header);
            };
            const auto piece = [&](const DatagramHeader& header, std::span<const std::byte> bytes, bool last) {
                m_pieces.insert(m_pieces.end(), bytes.begin(), bytes.end());
                return !last || take(header, std::exchange(m_pieces, {}));
            };
            const bool processed = m_decoder.process(judge, take, piece);
            if (stopped)
                continue;
            m_reading.refused = !processed;
            return processed;
        }
    }

    DatagramDecoder m_decoder;
    std::vector<std::byte> m_pieces;
    bool m_handsOn;
    Lands m_lands;
    Reading m_reading;
};

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    FuzzInput input(data, size);
    const bool handsOn = input.flag();
    std::array<std::size_t, 4> chunks{};
    for (auto& chunk : chunks)
        chunk = input.number<std::uint8_t>();
    const auto stream = input.rest();

    using ReadAhead = DatagramDecoder::ReadAhead;
    for (const Reader::Lands lands : {Reader::Lands(), Reader::Lands(ReadAhead::Header), Reader::Lands(ReadAhead::All)}) {
        Reader reader(handsOn, lands);
        auto left = stream;
        for (std::size_t i = 0; !left.empty(); ++i) {
            const auto wanted = chunks[i % chunks.size()];
            const auto chunk = left.first(std::min(left.size(), wanted == 0 ? std::size_t{40000} : wanted));
            left = left.subspan(chunk.size());
            if (!reader.read(chunk))
                break;
        }
        expect(reader.reading() == expectedOf(stream), "chunks and landing places change nothing");
    }
    return 0;
}
