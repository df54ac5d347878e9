// Sockets without waiting, below TLS and without it.
#include "transport/stream_end.hpp"

#include "security/tls_identity.hpp"

#include <openssl/bio.h>
#include <openssl/err.h>
#include <openssl/sslerr.h>

#include <sys/socket.h>
#include <sys/uio.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <limits>
#include <memory>
#include <system_error>
#include <utility>

namespace liena::transport {

namespace {

constexpr auto closedByPeer = "the peer closed the connection";

bool isPatience(int error) { return error == EAGAIN || error == EWOULDBLOCK || error == EINTR; }

StreamEnd::Step failed(int error)
{
    return {0, StreamEnd::Need::Nothing, StreamEnd::Failure{std::generic_category().message(error), false}};
}

int flagsFor(std::size_t burst) { return MSG_NOSIGNAL | MSG_DONTWAIT | (burst != 0 ? MSG_EOR : 0); }

StreamEnd::Wire& wireOf(BIO* bio) { return *static_cast<StreamEnd::Wire*>(BIO_get_data(bio)); }

int readWire(BIO* bio, char* buffer, std::size_t size, std::size_t* count)
{
    auto& wire = wireOf(bio);
    BIO_clear_retry_flags(bio);
    const auto got = ::recv(wire.descriptor, buffer, size, MSG_DONTWAIT);
    wire.drained = got < static_cast<ssize_t>(size);
    if (got > 0) {
        *count = static_cast<std::size_t>(got);
        return 1;
    }
    wire.error = got < 0 ? errno : 0;
    if (got < 0 && isPatience(wire.error))
        BIO_set_retry_read(bio);
    return 0;
}

int writeWire(BIO* bio, const char* bytes, std::size_t size, std::size_t* count)
{
    auto& wire = wireOf(bio);
    BIO_clear_retry_flags(bio);
    const auto sent = ::send(wire.descriptor, bytes, wire.burst != 0 ? std::min(size, wire.burst) : size, flagsFor(wire.burst));
    if (sent >= 0) {
        *count = static_cast<std::size_t>(sent);
        return 1;
    }
    wire.error = errno;
    if (isPatience(wire.error))
        BIO_set_retry_write(bio);
    return 0;
}

long controlWire(BIO* /*bio*/, int command, long /*number*/, void* /*pointer*/) { return command == BIO_CTRL_FLUSH ? 1 : 0; }

/// One for the process, as OpenSSL wants it.
const BIO_METHOD* wireMethod()
{
    using MethodPtr = std::unique_ptr<BIO_METHOD, security::Released<BIO_meth_free>>;
    static const MethodPtr method = [] {
        MethodPtr made(BIO_meth_new(BIO_get_new_index() | BIO_TYPE_SOURCE_SINK, "LiENa"));
        BIO_meth_set_read_ex(made.get(), readWire);
        BIO_meth_set_write_ex(made.get(), writeWire);
        BIO_meth_set_ctrl(made.get(), controlWire);
        return made;
    }();
    return method.get();
}

} // namespace

bool StreamEnd::secure(SSL_CTX* context, bool asServer)
{
    security::BioPtr bio(BIO_new(wireMethod()));
    m_tls.reset(SSL_new(context));
    if (!bio || !m_tls)
        return false;
    BIO_set_data(bio.get(), &m_wire);
    BIO_set_init(bio.get(), 1);
    SSL_set_bio(m_tls.get(), bio.get(), bio.get());
    (void)bio.release(); // the connection's from now on
    SSL_set_mode(m_tls.get(), SSL_MODE_ENABLE_PARTIAL_WRITE | SSL_MODE_ACCEPT_MOVING_WRITE_BUFFER | SSL_MODE_RELEASE_BUFFERS);
    SSL_clear_mode(m_tls.get(), SSL_MODE_AUTO_RETRY); // a record without a byte for us ends the call, else a peer could keep us in it
    SSL_set_read_ahead(m_tls.get(), 1);
    if (asServer)
        SSL_set_accept_state(m_tls.get());
    else
        SSL_set_connect_state(m_tls.get());
    return true;
}

void StreamEnd::keepBuffers()
{
    if (m_tls)
        SSL_clear_mode(m_tls.get(), SSL_MODE_RELEASE_BUFFERS);
}

StreamEnd::Step StreamEnd::shakeHands()
{
    ERR_clear_error();
    return explain(SSL_do_handshake(m_tls.get()), {});
}

StreamEnd::Step StreamEnd::read(Room room, std::size_t most)
{
    if (m_tls == nullptr)
        return readClear(room);
    if (m_ended)
        return {0, Need::Nothing, m_ended};
    Step step;
    const auto limit = std::min(most, room.size());
    while (step.bytes < limit) {
        std::size_t count = 0;
        ERR_clear_error();
        const auto place = room.behind(step.bytes);
        const int result = SSL_read_ex(m_tls.get(), place.data(), place.size(), &count);
        step.bytes += count;
        if (result != 1 && step.bytes == 0)
            return explain(result, step);
        if (result != 1) {
            m_ended = explain(result, {}).failure; // OpenSSL says it once
            return step;
        }
        if (!mayHaveMore())
            break;
    }
    return step;
}

StreamEnd::Step StreamEnd::write(Parts parts, std::size_t done, std::size_t most)
{
    if (m_tls == nullptr)
        return writeClear(parts, done);
    Step step;
    for (const auto part : parts) {
        if (done >= part.size()) {
            done -= part.size();
            continue;
        }
        auto rest = part.subspan(std::exchange(done, 0));
        while (!rest.empty()) {
            std::size_t count = 0;
            ERR_clear_error();
            const int result = SSL_write_ex(m_tls.get(), rest.data(), rest.size(), &count);
            if (result != 1) {
                step = explain(result, step);
                if (step.failure && !step.failure->tls)
                    if (auto said = lastWords())
                        step.failure = std::move(said);
                return step;
            }
            step.bytes += count;
            rest = rest.subspan(count);
            if (step.bytes >= most)
                return step;
        }
    }
    return step;
}

/// A peer that refuses us says why and then resets the connection: whoever writes may meet the reset first, with the reason still unread.
std::optional<StreamEnd::Failure> StreamEnd::lastWords()
{
    constexpr int mostRecords = 8; // before them
    std::array<std::byte, 1024> unread;
    for (int i = 0; i < mostRecords && !m_ended; ++i) {
        std::size_t count = 0;
        ERR_clear_error();
        const int result = SSL_read_ex(m_tls.get(), unread.data(), unread.size(), &count);
        if (result == 1)
            continue;
        m_ended = explain(result, {}).failure; // for whoever reads, too
        break;
    }
    return m_ended && m_ended->tls ? m_ended : std::nullopt;
}

StreamEnd::Step StreamEnd::readClear(Room room)
{
    std::array<iovec, 2> list{{{room.first.data(), room.first.size()}, {room.second.data(), room.second.size()}}};
    msghdr message{};
    message.msg_iov = list.data();
    message.msg_iovlen = list.size();
    const auto got = room.first.empty() ? ::recv(m_wire.descriptor, room.second.data(), room.second.size(), MSG_DONTWAIT)
                                        : ::recvmsg(m_wire.descriptor, &message, MSG_DONTWAIT);
    const int error = errno;
    m_wire.drained = got < static_cast<ssize_t>(room.size());
    if (got > 0)
        return {static_cast<std::size_t>(got), Need::Nothing, std::nullopt};
    if (got == 0)
        return {0, Need::Nothing, Failure{closedByPeer, false}};
    return isPatience(error) ? Step{0, Need::Readable, std::nullopt} : failed(error);
}

StreamEnd::Step StreamEnd::writeClear(Parts parts, std::size_t done)
{
    std::array<iovec, 32> list;
    std::size_t count = 0;
    auto room = m_wire.burst != 0 ? m_wire.burst : std::numeric_limits<std::size_t>::max();
    for (const auto part : parts) {
        const auto skipped = std::min(done, part.size());
        done -= skipped;
        const auto size = std::min(part.size() - skipped, room);
        if (size == 0)
            continue;
        list[count++] = {const_cast<std::byte*>(part.data() + skipped), size}; // sendmsg only reads
        room -= size;
        if (count == list.size())
            break;
    }
    msghdr message{};
    message.msg_iov = list.data();
    message.msg_iovlen = count;
    const auto sent = ::sendmsg(m_wire.descriptor, &message, flagsFor(m_wire.burst));
    if (sent >= 0)
        return {static_cast<std::size_t>(sent), Need::Nothing, std::nullopt};
    return isPatience(errno) ? Step{0, Need::Writable, std::nullopt} : failed(errno);
}

/// Of a call that did nothing.
StreamEnd::Step StreamEnd::explain(int result, Step step)
{
    switch (SSL_get_error(m_tls.get(), result)) {
    case SSL_ERROR_NONE:
        return step;
    case SSL_ERROR_WANT_READ:
        step.need = Need::Readable;
        return step;
    case SSL_ERROR_WANT_WRITE:
        step.need = Need::Writable;
        return step;
    case SSL_ERROR_ZERO_RETURN:
        step.failure = Failure{closedByPeer, false};
        return step;
    case SSL_ERROR_SYSCALL:
        step.failure = Failure{m_wire.error != 0 ? std::generic_category().message(m_wire.error) : closedByPeer, false};
        return step;
    default:
        break;
    }
    const auto error = ERR_get_error();
    ERR_clear_error();
    if (ERR_GET_LIB(error) == ERR_LIB_SSL && ERR_GET_REASON(error) == SSL_R_UNEXPECTED_EOF_WHILE_READING)
        step.failure = Failure{closedByPeer, false};
    else
        step.failure = Failure{
            security::explainTlsFailure(error, SSL_is_init_finished(m_tls.get()) ? X509_V_OK : SSL_get_verify_result(m_tls.get())), true};
    return step;
}

bool StreamEnd::mayHaveMore() const { return !m_wire.drained || (m_tls != nullptr && SSL_has_pending(m_tls.get()) == 1); }

void StreamEnd::limitBursts(std::size_t bytes)
{
    constexpr std::size_t recordOverhead = 64; // of TLS, above what it needs
    if (bytes == m_burst)
        return;
    m_burst = bytes;
    if (m_tls != nullptr && bytes != 0) {
        const auto record = static_cast<long>(std::min<std::size_t>(bytes, SSL3_RT_MAX_PLAIN_LENGTH));
        SSL_set_max_send_fragment(m_tls.get(), record);
        SSL_set_split_send_fragment(m_tls.get(), record); // the former lowers this one, and does not raise it again
    }
    m_wire.burst = m_tls != nullptr && bytes != 0 ? bytes + recordOverhead : bytes;
}

void StreamEnd::keepApart(bool apart)
{
    if (m_burst == 0)
        m_wire.burst = apart ? std::numeric_limits<std::size_t>::max() : 0;
}

} // namespace liena::transport
