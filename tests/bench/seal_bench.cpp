// Measures what sealing costs: packets of the datagram path, and records of a TLS connection as our channels hold one, beside the bare
// cipher that both use.
#include "protocol/packet.hpp"
#include "security/datagram_seal.hpp"
#include "security/tls_identity.hpp"
#include "support/test_authority.hpp"
#include "unit/security/memory_connection.hpp"

#include <benchmark/benchmark.h>

#include <array>
#include <cstring>
#include <stdexcept>
#include <vector>

using namespace liena;
using security::DatagramSeal;

namespace {

void seal(benchmark::State& state)
{
    DatagramSeal seal{security::DatagramKey()};
    const std::vector<std::byte> clear(protocol::packetPrefixSize);
    const std::vector<std::byte> plain(static_cast<std::size_t>(state.range(0)));
    std::vector<std::byte> sealed(plain.size() + DatagramSeal::tagSize);
    std::uint64_t number = 0;
    for (auto _ : state)
        if (!seal.seal(++number, clear, plain, sealed))
            state.SkipWithError("not sealed");
    state.SetBytesProcessed(state.iterations() * state.range(0));
}
BENCHMARK(seal)->Arg(64)->Arg(1200);

void open(benchmark::State& state)
{
    DatagramSeal seal{security::DatagramKey()};
    const std::vector<std::byte> clear(protocol::packetPrefixSize);
    std::vector<std::byte> plain(static_cast<std::size_t>(state.range(0)));
    std::vector<std::byte> sealed(plain.size() + DatagramSeal::tagSize);
    if (!seal.seal(1, clear, plain, sealed))
        state.SkipWithError("not sealed");
    for (auto _ : state)
        if (!seal.open(1, clear, sealed, plain))
            state.SkipWithError("not opened");
    state.SetBytesProcessed(state.iterations() * state.range(0));
}
BENCHMARK(open)->Arg(64)->Arg(1200);

constexpr std::size_t recordOverhead = 22; // header, content type, tag

/// Two devices' contexts, and a connection of theirs over a pair of memory BIOs: what Asio's TLS stream puts below OpenSSL.
class TlsPair {
public:
    TlsPair() : m_near(identityOf("near", 0)), m_far(identityOf("far", 1)), m_ends(m_far->serverContext(), m_near->clientContext())
    {
        m_ends.handshake();
        if (!security::peerDevice(m_ends.client()) || !security::peerDevice(m_ends.server()))
            throw std::runtime_error("no TLS: " + m_ends.clientFailure() + m_ends.serverFailure());
    }

    const char* cipher() const { return SSL_get_cipher_name(m_ends.client()); }

    /// The record's length; 0 when it was not sealed.
    std::size_t seal(std::span<const std::byte> plain, std::span<std::byte> record)
    {
        if (SSL_write(m_ends.client(), plain.data(), static_cast<int>(plain.size())) != static_cast<int>(plain.size()))
            return 0;
        const int length = BIO_read(SSL_get_rbio(m_ends.server()), record.data(), static_cast<int>(record.size()));
        return length > 0 ? static_cast<std::size_t>(length) : 0;
    }

    bool open(std::span<const std::byte> record, std::span<std::byte> plain)
    {
        return BIO_write(SSL_get_wbio(m_ends.client()), record.data(), static_cast<int>(record.size())) ==
                   static_cast<int>(record.size()) &&
               SSL_read(m_ends.server(), plain.data(), static_cast<int>(plain.size())) == static_cast<int>(plain.size());
    }

private:
    std::shared_ptr<security::TlsIdentity> identityOf(const std::string& name, std::uint32_t index)
    {
        const auto id = DeviceId::compose(DeviceClass::Special, 1, 62, 0, index);
        const auto files = m_authority.identityOf(id, name);
        return security::TlsIdentity::load(files.certificate, files.key, files.authority, id).value();
    }

    test::TestAuthority m_authority;
    std::shared_ptr<security::TlsIdentity> m_near;
    std::shared_ptr<security::TlsIdentity> m_far;
    test::MemoryConnection m_ends;
};

void tlsSeal(benchmark::State& state)
{
    TlsPair pair;
    const std::vector<std::byte> plain(static_cast<std::size_t>(state.range(0)));
    std::vector<std::byte> record(plain.size() + recordOverhead);
    for (auto _ : state)
        if (pair.seal(plain, record) != record.size())
            state.SkipWithError("not sealed as one record");
    state.SetBytesProcessed(state.iterations() * state.range(0));
    state.SetLabel(pair.cipher());
}
BENCHMARK(tlsSeal)->RangeMultiplier(4)->Range(64, 16384);

void tlsOpen(benchmark::State& state)
{
    constexpr std::size_t batch = 256; // a record opens once only, and in its order
    TlsPair pair;
    std::vector<std::byte> plain(static_cast<std::size_t>(state.range(0)));
    std::vector<std::vector<std::byte>> records(batch, std::vector<std::byte>(plain.size() + recordOverhead));
    std::size_t next = batch;
    for (auto _ : state) {
        if (next == batch) {
            state.PauseTiming();
            for (auto& record : records)
                if (pair.seal(plain, record) != record.size())
                    state.SkipWithError("not sealed as one record");
            next = 0;
            state.ResumeTiming();
        }
        if (!pair.open(records[next++], plain))
            state.SkipWithError("not opened");
    }
    state.SetBytesProcessed(state.iterations() * state.range(0));
    state.SetLabel(pair.cipher());
}
BENCHMARK(tlsOpen)->RangeMultiplier(4)->Range(64, 16384);

/// The bare cipher of those records: key once; nonce, five bytes in the clear, plain text with its type, and tag each time.
void bareCipherSeal(benchmark::State& state)
{
    using CipherPtr = std::unique_ptr<EVP_CIPHER_CTX, security::Released<EVP_CIPHER_CTX_free>>;
    const CipherPtr cipher(EVP_CIPHER_CTX_new());
    const std::array<unsigned char, 32> key{};
    std::array<unsigned char, 12> nonce{};
    const std::array<unsigned char, 5> clear{};
    std::array<unsigned char, 16> tag{};
    const std::vector<unsigned char> plain(static_cast<std::size_t>(state.range(0)) + 1);
    std::vector<unsigned char> sealed(plain.size());
    int length = 0;
    bool sealedAll = EVP_EncryptInit_ex(cipher.get(), EVP_aes_256_gcm(), nullptr, key.data(), nonce.data()) == 1;
    std::uint64_t number = 0;
    for (auto _ : state) {
        std::memcpy(nonce.data() + 4, &++number, sizeof number);
        sealedAll = sealedAll && EVP_EncryptInit_ex(cipher.get(), nullptr, nullptr, nullptr, nonce.data()) == 1 &&
                    EVP_EncryptUpdate(cipher.get(), nullptr, &length, clear.data(), static_cast<int>(clear.size())) == 1 &&
                    EVP_EncryptUpdate(cipher.get(), sealed.data(), &length, plain.data(), static_cast<int>(plain.size())) == 1 &&
                    EVP_EncryptFinal_ex(cipher.get(), sealed.data() + length, &length) == 1 &&
                    EVP_CIPHER_CTX_ctrl(cipher.get(), EVP_CTRL_AEAD_GET_TAG, static_cast<int>(tag.size()), tag.data()) == 1;
    }
    if (!sealedAll)
        state.SkipWithError("not sealed");
    state.SetBytesProcessed(state.iterations() * state.range(0));
}
BENCHMARK(bareCipherSeal)->RangeMultiplier(4)->Range(64, 16384);

} // namespace

BENCHMARK_MAIN();
