// The exporter and AES-256-GCM by OpenSSL.
#include "security/datagram_seal.hpp"

#include <cstring>
#include <stdexcept>
#include <string_view>

namespace liena::security {

namespace {

constexpr std::string_view label = "EXPORTER-liena-datagram";

const unsigned char* in(const std::byte* bytes) { return reinterpret_cast<const unsigned char*>(bytes); }
unsigned char* out(std::byte* bytes) { return reinterpret_cast<unsigned char*>(bytes); }

} // namespace

Result<DatagramKey> exportDatagramKey(SSL* connection, std::uint64_t token)
{
    std::array<unsigned char, sizeof token> context{}; // as on the wire: little-endian
    for (std::size_t i = 0; i < context.size(); ++i)
        context[i] = static_cast<unsigned char>(token >> (8 * i));
    std::array<std::byte, sizeof(DatagramKey::key) + sizeof(DatagramKey::iv)> material{};
    if (SSL_export_keying_material(connection, out(material.data()), material.size(), label.data(), label.size(), context.data(),
                                   context.size(), 1) != 1)
        return fail(Errc::CertificateInvalid, "no key for the datagram path could be derived: " + takeOpensslReason());
    DatagramKey key;
    std::memcpy(key.key.data(), material.data(), key.key.size());
    std::memcpy(key.iv.data(), material.data() + key.key.size(), key.iv.size());
    OPENSSL_cleanse(material.data(), material.size());
    return key;
}

DatagramSeal::DatagramSeal(const DatagramKey& key) : m_sealing(EVP_CIPHER_CTX_new()), m_opening(EVP_CIPHER_CTX_new()), m_iv(key.iv)
{
    if (!m_sealing || !m_opening || EVP_EncryptInit_ex(m_sealing.get(), EVP_aes_256_gcm(), nullptr, in(key.key.data()), nullptr) != 1 ||
        EVP_DecryptInit_ex(m_opening.get(), EVP_aes_256_gcm(), nullptr, in(key.key.data()), nullptr) != 1)
        throw std::runtime_error("OpenSSL offers no AES-256-GCM: " + takeOpensslReason());
}

std::array<unsigned char, 12> DatagramSeal::nonce(std::uint64_t number) const
{
    std::array<unsigned char, 12> nonce{};
    std::memcpy(nonce.data(), m_iv.data(), nonce.size());
    for (std::size_t i = 0; i < sizeof number; ++i)
        nonce[nonce.size() - 1 - i] ^= static_cast<unsigned char>(number >> (8 * i));
    return nonce;
}

bool DatagramSeal::seal(std::uint64_t number, std::span<const std::byte> clear, std::span<const std::byte> plain,
                        std::span<std::byte> sealed)
{
    if (sealed.size() != plain.size() + tagSize)
        return false;
    auto* cipher = m_sealing.get();
    int length = 0;
    return EVP_EncryptInit_ex(cipher, nullptr, nullptr, nullptr, nonce(number).data()) == 1 &&
           EVP_EncryptUpdate(cipher, nullptr, &length, in(clear.data()), static_cast<int>(clear.size())) == 1 &&
           EVP_EncryptUpdate(cipher, out(sealed.data()), &length, in(plain.data()), static_cast<int>(plain.size())) == 1 &&
           EVP_EncryptFinal_ex(cipher, out(sealed.data()) + length, &length) == 1 &&
           EVP_CIPHER_CTX_ctrl(cipher, EVP_CTRL_GCM_GET_TAG, tagSize, sealed.data() + plain.size()) == 1;
}

bool DatagramSeal::open(std::uint64_t number, std::span<const std::byte> clear, std::span<const std::byte> sealed,
                        std::span<std::byte> plain)
{
    if (sealed.size() != plain.size() + tagSize)
        return false;
    std::array<std::byte, tagSize> tag{};
    std::memcpy(tag.data(), sealed.data() + plain.size(), tag.size());
    auto* cipher = m_opening.get();
    int length = 0;
    return EVP_DecryptInit_ex(cipher, nullptr, nullptr, nullptr, nonce(number).data()) == 1 &&
           EVP_DecryptUpdate(cipher, nullptr, &length, in(clear.data()), static_cast<int>(clear.size())) == 1 &&
           EVP_DecryptUpdate(cipher, out(plain.data()), &length, in(sealed.data()), static_cast<int>(plain.size())) == 1 &&
           EVP_CIPHER_CTX_ctrl(cipher, EVP_CTRL_GCM_SET_TAG, tagSize, tag.data()) == 1 &&
           EVP_DecryptFinal_ex(cipher, out(plain.data()) + plain.size(), &length) == 1;
}

} // namespace liena::security
