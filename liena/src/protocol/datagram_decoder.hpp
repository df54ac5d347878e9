// Cuts the byte stream of one lane into datagrams, asking about each header before its body is awaited.
#pragma once

#include "protocol/datagram.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>

namespace liena::protocol {

enum class HeaderVerdict : std::uint8_t {
    Take,
    Skip,         ///< pass over the body
    Refuse,       ///< the stream ends here
    TakeInPieces, ///< the body is handed on as it comes, and need not wait here until it is whole
};

/// A fixed buffer that one datagram always fits. What is handed on is valid until the next call of writable() or room().
///
/// The rest of a body that is taken in pieces may land where it is wanted at once, past the buffer: see landIn().
class DatagramDecoder {
public:
    DatagramDecoder() : m_buffer(std::make_unique_for_overwrite<std::byte[]>(bufferSize)) {}

    /// Where the next bytes of the stream go.
    std::span<std::byte> writable();

    /// The same in two places, the first of them first; it is empty where nothing is to land elsewhere.
    struct Room {
        std::span<std::byte> landing;
        std::span<std::byte> buffer;
    };

    /// What is read together with a body that lands elsewhere.
    enum class ReadAhead : std::uint8_t {
        Header, ///< the next one, so that its body can land, too
        All,    ///< as much as the buffer takes, to be copied from there: where reading often costs more than that
    };
    Room room(ReadAhead ahead = ReadAhead::Header);
    void commit(std::size_t bytes);

    /// How much of a body that is taken in pieces has not come yet, when nothing of what follows it has.
    std::size_t awaited() const { return m_judged && m_verdict == HeaderVerdict::TakeInPieces && buffered() == 0 ? m_missing : 0; }

    /// The next bytes of that body go to `place`, of at most awaited() bytes, which `keeper` keeps for as long as a read may be in flight.
    void landIn(std::span<std::byte> place, std::shared_ptr<const void> keeper)
    {
        m_landing = place;
        m_keeper = std::move(keeper);
    }

    /// Calls `judge(const DatagramHeader&) -> HeaderVerdict` once per header, `take(const DatagramHeader&, span body) -> bool` for each
    /// datagram that is whole, and `piece(const DatagramHeader&, span bytes, bool last) -> bool` for each part of a body that is taken in
    /// pieces. Ends when bytes are missing (true), or at once when one of them refuses (false).
    template <typename Judge, typename Take, typename Piece>
    bool process(Judge&& judge, Take&& take, Piece&& piece)
    {
        for (;;) {
            if (!m_judged) {
                if (buffered() < headerSize)
                    return true;
                m_header = decodeHeader(std::span<const std::byte, headerSize>(m_buffer.get() + m_begin, headerSize));
                m_verdict = judge(m_header);
                if (m_verdict == HeaderVerdict::Refuse)
                    return false;
                m_judged = true;
                m_missing = m_header.length;
                m_begin += headerSize;
            }
            if (!m_landed.empty() && !handOnLanded(piece))
                return false;
            if (!m_judged)
                continue;
            const bool inPieces = m_verdict == HeaderVerdict::TakeInPieces || m_verdict == HeaderVerdict::Skip;
            if (inPieces ? m_missing > 0 && buffered() == 0 : buffered() < m_missing)
                return true;
            const auto bytes = std::span<const std::byte>(m_buffer.get() + m_begin, std::min(m_missing, buffered()));
            m_begin += bytes.size();
            m_missing -= bytes.size();
            m_judged = m_missing > 0;
            if (m_verdict == HeaderVerdict::Take && !take(m_header, bytes))
                return false;
            if (m_verdict == HeaderVerdict::TakeInPieces && !piece(m_header, bytes, !m_judged))
                return false;
        }
    }

    /// Where no body is taken in pieces.
    template <typename Judge, typename Take>
    bool process(Judge&& judge, Take&& take)
    {
        return process(std::forward<Judge>(judge), std::forward<Take>(take),
                       [](const DatagramHeader&, std::span<const std::byte>, bool) { return true; });
    }

    std::size_t buffered() const { return m_end - m_begin; }

private:
    static constexpr std::size_t bufferSize = 2 * (headerSize + maximumBody);

    template <typename Piece>
    bool handOnLanded(Piece&& piece)
    {
        const auto bytes = std::exchange(m_landed, {});
        const auto keeper = std::exchange(m_keeper, nullptr);
        m_missing -= bytes.size();
        m_judged = m_missing > 0;
        return piece(m_header, std::span<const std::byte>(bytes), !m_judged);
    }

    std::unique_ptr<std::byte[]> m_buffer; ///< not filled beforehand: what is never used of it takes no memory
    std::size_t m_begin = 0;
    std::size_t m_end = 0;
    DatagramHeader m_header;
    HeaderVerdict m_verdict = HeaderVerdict::Take;
    bool m_judged = false;
    std::size_t m_missing = 0; ///< of the body, once its header is judged
    std::span<std::byte> m_landing;
    std::span<std::byte> m_landed;
    std::shared_ptr<const void> m_keeper; ///< of both
};

} // namespace liena::protocol
