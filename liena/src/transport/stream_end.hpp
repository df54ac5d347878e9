// One end of a TCP connection, in the clear or under TLS: what can be read or written at once.
#pragma once

#include "security/openssl_types.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include <openssl/ssl.h>

namespace liena::transport {

/// Never waits. One thread at a time, whichever; the descriptor is its owner's and outlives it.
class StreamEnd {
public:
    enum class Need : std::uint8_t { Nothing, Readable, Writable };

    struct Failure {
        std::string detail;
        bool tls = false; ///< TLS ended it, over a certificate or a forged byte
    };

    /// What was done, and what has to come first before anything more can be done.
    struct Step {
        std::size_t bytes = 0;
        Need need = Need::Nothing;
        std::optional<Failure> failure;
    };

    using Parts = std::span<const std::span<const std::byte>>;

    /// Where bytes go that are read: to the first place until it is full, then to the second.
    struct Room {
        std::span<std::byte> first;
        std::span<std::byte> second;

        std::size_t size() const { return first.size() + second.size(); }

        /// What is left in one piece behind `done` bytes.
        std::span<std::byte> behind(std::size_t done) const
        {
            return done < first.size() ? first.subspan(done) : second.subspan(done - first.size());
        }
    };

    explicit StreamEnd(int descriptor) : m_wire{descriptor} {}
    StreamEnd(const StreamEnd&) = delete;
    StreamEnd& operator=(const StreamEnd&) = delete;

    /// False when there is no memory for it.
    bool secure(SSL_CTX* context, bool asServer);
    SSL* tls() const { return m_tls.get(); }

    /// Nothing is needed any more when it is done.
    Step shakeHands();

    /// At least one byte, or what is needed for it; no more than fit, and no more than about `most`. A peer that only renews its keys takes
    /// no longer than a buffer of such records does.
    Step read(Room room, std::size_t most);

    /// The bytes of `parts` behind the first `done` of them; about `most` at once.
    Step write(Parts parts, std::size_t done, std::size_t most);

    /// Whether read() may find something without waiting.
    bool mayHaveMore() const;

    /// The kernel joins what is written to packets of up to 64 KiB and sends each in one burst, behind which a control message of another
    /// connection waits: from now on it is given no more than this at a time, and told to keep two writes apart. 0: as it likes. Longer
    /// only between two writes: TLS keeps the buffer of a record for the rest of its write, and a longer one does not go into it.
    void limitBursts(std::size_t bytes);

    /// Without that limit: the kernel does not join what follows with what is written now. It would take it into a packet that waits,
    /// however full its buffer is.
    void keepApart(bool apart);

    /// TLS keeps its buffers, 17 KiB for each direction in use, while they are empty. Else it asks the heap for them with each record,
    /// which suits a connection that is used now and then.
    void keepBuffers();

    /// What TLS calls to reach the socket.
    struct Wire {
        int descriptor;
        std::size_t burst = 0; ///< bytes at a time, each kept apart; 0: as they come
        int error = 0;         ///< of the last call that failed
        bool drained = false;  ///< the last read found no more
    };

private:
    Step readClear(Room room);
    Step writeClear(Parts parts, std::size_t done);
    Step explain(int result, Step step);
    std::optional<Failure> lastWords();

    Wire m_wire;
    std::size_t m_burst = 0;
    security::SslPtr m_tls;
    std::optional<Failure> m_ended; ///< met behind bytes that were read, or by a write
};

} // namespace liena::transport
