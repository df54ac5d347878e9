// Keys that both ends derive alike, and packets that open only as they were sealed.
#include "security/datagram_seal.hpp"

#include "memory_connection.hpp"
#include "security/tls_identity.hpp"
#include "support/hex.hpp"
#include "support/test_authority.hpp"

#include <QTest>

#include <vector>

using namespace liena;
using namespace liena::security;
using namespace liena::test;

namespace {

using Bytes = std::vector<std::byte>;

constexpr DeviceId cockpit(0x40018208U);
constexpr DeviceId robot(0x00008208U);

DatagramKey countingKey()
{
    DatagramKey key;
    for (std::size_t i = 0; i < key.key.size(); ++i)
        key.key[i] = static_cast<std::byte>(i);
    for (std::size_t i = 0; i < key.iv.size(); ++i)
        key.iv[i] = static_cast<std::byte>(0xA0 + i);
    return key;
}

const Bytes& prefix()
{
    static const auto bytes = bytesOf("88 77 66 55 44 33 22 11 03 00 00 00 00 00 00 00");
    return bytes;
}

/// A Heartbeat of the robot to the cockpit.
const Bytes& plain()
{
    static const auto bytes = bytesOf("10 00 08 82 00 00 08 82 01 40 80 f0 f4 f0 51 72 86 18 28 00 "
                                      "03 00 00 00 80 f0 f4 f0 51 72 86 18 02 00 00 00 40 9c 6b f0 51 72 86 18 "
                                      "80 a9 6e f0 51 72 86 18 08 02 00 00 01 00 00 00");
    return bytes;
}

Bytes sealed(DatagramSeal& seal)
{
    Bytes bytes(plain().size() + DatagramSeal::tagSize);
    return seal.seal(3, prefix(), plain(), bytes) ? bytes : Bytes();
}

bool opens(DatagramSeal& seal, std::uint64_t number, const Bytes& clear, const Bytes& bytes)
{
    Bytes opened(bytes.size() - DatagramSeal::tagSize);
    return seal.open(number, clear, bytes, opened) && opened == plain();
}

DatagramKey keyOf(SSL* end, std::uint64_t token) { return exportDatagramKey(end, token).value(); }

bool same(const DatagramKey& a, const DatagramKey& b) { return a.key == b.key && a.iv == b.iv; }

} // namespace

class DatagramSealTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    /// Computed with another library than ours.
    void sealsToTheBytesOfTheProtocolPage()
    {
        DatagramSeal seal(countingKey());
        QCOMPARE(hexOf(sealed(seal)),
                 hexOf(bytesOf("49 24 ee b5 9d 50 b8 87 7c 1e ea ce b5 6d dc 52 1f 43 1c c3 38 ca 75 2f 83 1d 55 fb cb "
                               "b1 29 d5 59 18 05 2e 29 18 a1 89 f6 c0 30 ba a8 ed d5 6b 15 78 c2 92 04 f1 65 ea c7 0e "
                               "13 8a 0e f8 d6 b1 67 d1 5d 88 92 2b 91 8c e0 c0 44 f4")));
    }
    void opensWhatItSealed()
    {
        DatagramSeal sender(countingKey());
        DatagramSeal receiver(countingKey());
        QVERIFY(opens(receiver, 3, prefix(), sealed(sender)));
    }
    void sealsInPlace()
    {
        DatagramSeal seal(countingKey());
        Bytes bytes = plain();
        bytes.resize(plain().size() + DatagramSeal::tagSize);
        QVERIFY(seal.seal(3, prefix(), std::span(bytes).first(plain().size()), bytes));
        QVERIFY(bytes == sealed(seal));
    }
    void refusesEveryChangedByte()
    {
        DatagramSeal seal(countingKey());
        const auto genuine = sealed(seal);
        for (std::size_t i = 0; i < genuine.size(); ++i) {
            auto forged = genuine;
            forged[i] ^= std::byte{1};
            QVERIFY2(!opens(seal, 3, prefix(), forged), qPrintable(QString::number(i)));
        }
        for (std::size_t i = 0; i < prefix().size(); ++i) {
            auto other = prefix();
            other[i] ^= std::byte{0x80};
            QVERIFY2(!opens(seal, 3, other, genuine), qPrintable(QString::number(i)));
        }
        QVERIFY(!opens(seal, 4, prefix(), genuine));
        QVERIFY(opens(seal, 3, prefix(), genuine)); // and the true one still opens after all of them
    }
    void refusesWhatHasNoRoomForItsTag()
    {
        DatagramSeal seal(countingKey());
        Bytes small(plain().size());
        QVERIFY(!seal.seal(3, prefix(), plain(), small));
        QVERIFY(!seal.open(3, prefix(), Bytes(8), small));
    }
    void bothEndsDeriveTheSameKey()
    {
        TestAuthority authority;
        const auto load = [&](DeviceId device, const char* name) {
            const auto files = authority.identityOf(device, name);
            return TlsIdentity::load(files.certificate, files.key, files.authority, device).value();
        };
        const auto server = load(robot, "robot");
        const auto client = load(cockpit, "cockpit");
        MemoryConnection one(server->serverContext(), client->clientContext());
        one.handshake();
        QVERIFY2(one.clientFailure().empty() && one.serverFailure().empty(), (one.clientFailure() + one.serverFailure()).c_str());
        QVERIFY(same(keyOf(one.server(), 7), keyOf(one.client(), 7)));
        QVERIFY(!same(keyOf(one.client(), 7), keyOf(one.client(), 8))); // of another session
        QVERIFY(!same(keyOf(one.client(), 7), DatagramKey()));
        MemoryConnection other(server->serverContext(), client->clientContext());
        other.handshake();
        QVERIFY(!same(keyOf(one.client(), 7), keyOf(other.client(), 7)));
    }
    void derivesNothingBeforeTheHandshake()
    {
        TestAuthority authority;
        const auto files = authority.identityOf(robot, "robot");
        const auto identity = TlsIdentity::load(files.certificate, files.key, files.authority, robot).value();
        const SslPtr connection(SSL_new(identity->clientContext()));
        QVERIFY(!exportDatagramKey(connection.get(), 7));
    }
};

QTEST_APPLESS_MAIN(DatagramSealTest)
#include "datagram_seal_test.moc"
