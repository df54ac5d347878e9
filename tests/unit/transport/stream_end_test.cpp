// One end of a TLS connection: what a peer whose certificate is good can do to it, and how long its records are.
#include "support/test_authority.hpp"
#include "support/tls_link.hpp"
#include "transport/stream_end.hpp"

#include "security/tls_identity.hpp"

#include <QTest>

#include <openssl/crypto.h>

#include <netinet/in.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <span>
#include <vector>

using namespace liena;
using namespace liena::test;
using namespace liena::transport;

namespace {

constexpr DeviceId nearId(0x40018208U);
constexpr DeviceId farId(0x20010208U);

std::uint16_t portOf(int descriptor)
{
    sockaddr_in address{};
    socklen_t size = sizeof address;
    ::getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &size);
    return ntohs(address.sin_port);
}

int unread(int descriptor)
{
    int bytes = 0;
    return ::ioctl(descriptor, FIONREAD, &bytes) == 0 ? bytes : -1;
}

std::span<const std::byte> bytesOf(std::string_view text) { return std::as_bytes(std::span(text)); }

std::string textOf(std::span<const std::byte> bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

std::size_t buffers = 0; // that TLS asked the heap for; one thread

/// For each record it asks for some forty bytes as well.
void count(std::size_t size)
{
    constexpr std::size_t smallest = 1024;
    buffers += size >= smallest ? 1 : 0;
}

/// Before TLS asks for anything.
const bool counting = CRYPTO_set_mem_functions(
                          [](std::size_t size, const char*, int) {
                              count(size);
                              return std::malloc(size);
                          },
                          [](void* memory, std::size_t size, const char*, int) {
                              count(size);
                              return std::realloc(memory, size);
                          },
                          [](void* memory, const char*, int) { std::free(memory); }) == 1;

/// Both ends of one connection over loopback, after the handshake.
struct Connection {
    TestAuthority authority;
    Descriptor nearSocket;
    Descriptor farSocket;
    std::optional<StreamEnd> near;
    std::optional<StreamEnd> far;
    std::array<std::byte, 65536> buffer{};

    explicit Connection(bool secured = true)
    {
        const auto listening = listenAt(0);
        nearSocket = tcpTo(portOf(listening.number()));
        if (!waitFor(listening.number(), POLLIN, std::chrono::seconds(10)))
            throw std::runtime_error("no connection over loopback");
        farSocket = Descriptor(::accept4(listening.number(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
        near.emplace(nearSocket.number());
        far.emplace(farSocket.number());
        if (secured && !secure())
            throw std::runtime_error("no memory");
    }

    bool secure()
    {
        return near->secure(identity(nearId, "near")->clientContext(), false) && far->secure(identity(farId, "far")->serverContext(), true);
    }

    std::shared_ptr<security::TlsIdentity> identity(DeviceId device, const std::string& name)
    {
        const auto files = authority.identityOf(device, name);
        return security::TlsIdentity::load(files.certificate, files.key, files.authority, device).value();
    }

    bool shakeHands()
    {
        for (int turn = 0; turn < 100; ++turn) {
            const auto one = near->shakeHands();
            const auto other = far->shakeHands();
            if (one.failure || other.failure)
                return false;
            if (one.need == StreamEnd::Need::Nothing && other.need == StreamEnd::Need::Nothing)
                return true;
            waitFor(farSocket.number(), POLLIN, std::chrono::milliseconds(20));
        }
        return false;
    }

    bool say(std::string_view text)
    {
        const std::array parts{bytesOf(text)};
        return near->write(parts, 0, 65536).bytes == text.size();
    }

    /// Of those that bring so many bytes to the far end, which it does not open: so many bytes in it.
    std::size_t longestRecord(std::size_t bytes)
    {
        constexpr std::size_t header = 5;
        constexpr std::size_t sealing = 17; // of TLS 1.3: the type and the tag
        std::size_t longest = 0;
        for (std::size_t opened = 0; opened < bytes;) {
            std::array<std::uint8_t, header> head{};
            if (!receive(head))
                return 0;
            std::vector<std::uint8_t> body(std::size_t{head[3]} * 256 + head[4]);
            if (!receive(body))
                return 0;
            opened += body.size() - sealing;
            longest = std::max(longest, body.size() - sealing);
        }
        return longest;
    }

    bool receive(std::span<std::uint8_t> whole)
    {
        for (std::size_t got = 0; got < whole.size();) {
            if (!waitFor(farSocket.number(), POLLIN, std::chrono::seconds(10)))
                return false;
            const auto more = ::recv(farSocket.number(), whole.data() + got, whole.size() - got, 0);
            if (more <= 0)
                return false;
            got += static_cast<std::size_t>(more);
        }
        return true;
    }

    StreamEnd::Step read() { return far->read({{}, buffer}, buffer.size()); }
};

} // namespace

class StreamEndTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void peerThatRenewsItsKeysForEverHoldsNobody()
    {
        Connection connection;
        QVERIFY(connection.shakeHands());
        constexpr int updates = 4000;
        constexpr int leastSize = 22; // of one such record: header, message, type, tag
        for (int i = 0; i < updates; ++i) {
            QCOMPARE(SSL_key_update(connection.near->tls(), SSL_KEY_UPDATE_NOT_REQUESTED), 1);
            QCOMPARE(SSL_do_handshake(connection.near->tls()), 1);
        }
        QVERIFY(connection.say("command"));
        QTRY_VERIFY(unread(connection.farSocket.number()) >= updates * leastSize);
        const auto first = connection.read();
        QVERIFY(!first.failure);
        QCOMPARE(first.bytes, std::size_t{0});
        QVERIFY(first.need == StreamEnd::Need::Readable);
        QVERIFY2(unread(connection.farSocket.number()) > updates * leastSize / 2, "one call reads all of them");
        auto step = first;
        for (int turn = 0; turn < updates && step.bytes == 0; ++turn) {
            step = connection.read();
            QVERIFY(!step.failure);
        }
        QCOMPARE(textOf(std::span(connection.buffer).first(step.bytes)), std::string("command"));
    }

    /// Nothing may come after it for a long time.
    void commandBehindNewKeysIsReadWithThem()
    {
        Connection connection;
        QVERIFY(connection.shakeHands());
        QCOMPARE(SSL_key_update(connection.near->tls(), SSL_KEY_UPDATE_NOT_REQUESTED), 1);
        QCOMPARE(SSL_do_handshake(connection.near->tls()), 1);
        constexpr int keysSize = 27;    // of the record: header, message, type, tag
        constexpr int commandSize = 29; // likewise
        QVERIFY(connection.say("command"));
        QTRY_VERIFY(unread(connection.farSocket.number()) >= keysSize + commandSize);
        const auto step = connection.read();
        QVERIFY(!step.failure);
        QCOMPARE(textOf(std::span(connection.buffer).first(step.bytes)), std::string("command"));
    }

    void commandsAskForNoBufferWhereTheyAreKept()
    {
        QVERIFY(counting);
        Connection connection;
        QVERIFY(connection.shakeHands());
        connection.near->keepBuffers();
        connection.far->keepBuffers();
        const auto exchanged = [&] {
            auto step = StreamEnd::Step{};
            for (bool said = connection.say("command"); said && step.bytes == 0 && !step.failure; step = connection.read())
                waitFor(connection.farSocket.number(), POLLIN, std::chrono::seconds(10));
            return textOf(std::span(connection.buffer).first(step.bytes)) == "command";
        };
        QVERIFY(exchanged()); // tickets are read with the first
        const auto before = buffers;
        for (int i = 0; i < 10; ++i)
            QVERIFY(exchanged());
        QCOMPARE(buffers - before, std::size_t{0});
    }

    /// Paths become faster as well as slower.
    void recordIsAsLongAsABurst()
    {
        Connection connection;
        QVERIFY(connection.shakeHands());
        const std::vector<std::byte> image(65536);
        for (const std::size_t burst : {2874, 16384, 5728, 16384}) {
            connection.near->limitBursts(burst);
            const std::array parts{std::span<const std::byte>(image)};
            QCOMPARE(connection.near->write(parts, 0, image.size()).bytes, image.size());
            QCOMPARE(connection.longestRecord(image.size()), burst);
        }
    }

    void whoWritesIntoARefusalHearsItsReason()
    {
        Connection connection;
        QVERIFY(connection.shakeHands());
        std::array<std::uint8_t, 37> forged{23, 3, 3, 0, 32};
        QCOMPARE(::send(connection.nearSocket.number(), forged.data(), forged.size(), MSG_NOSIGNAL), ssize_t{37});
        QTRY_VERIFY(unread(connection.farSocket.number()) >= 37);
        QVERIFY(connection.read().failure); // and the far end says so
        QVERIFY(connection.say("never read"));
        QTRY_VERIFY(unread(connection.farSocket.number()) > 0);
        connection.far.reset();
        connection.farSocket = Descriptor(); // with bytes that nobody read: a reset
        std::optional<StreamEnd::Failure> failure;
        const std::array parts{bytesOf("more")};
        QTRY_VERIFY(failure || (failure = connection.near->write(parts, 0, 65536).failure));
        QVERIFY2(failure->tls, failure->detail.c_str());
        const auto told = connection.near->read({{}, connection.buffer}, connection.buffer.size());
        QVERIFY(told.failure && told.failure->tls); // whoever is asked first
    }

    void fillsTheFirstPlaceThenTheSecond_data()
    {
        QTest::addColumn<bool>("secured");
        QTest::newRow("TLS") << true;
        QTest::newRow("clear") << false;
    }

    void fillsTheFirstPlaceThenTheSecond()
    {
        QFETCH(bool, secured);
        Connection connection(secured);
        QVERIFY(!secured || connection.shakeHands());
        std::string first(20000, '.');
        std::string second(5, '.');
        std::string text(20003, 'a');
        text += "rest";
        QVERIFY(connection.say(text));
        std::size_t got = 0;
        const auto room = [&] {
            const StreamEnd::Room whole{std::as_writable_bytes(std::span(first)), std::as_writable_bytes(std::span(second))};
            return got < 20000 ? StreamEnd::Room{whole.first.subspan(got), whole.second}
                               : StreamEnd::Room{{}, whole.second.subspan(got - 20000)};
        };
        QTRY_VERIFY((got += connection.far->read(room(), 65536).bytes) == 20005);
        QCOMPARE(first, text.substr(0, 20000));
        QCOMPARE(second, std::string("aaare"));
        std::size_t rest = 0;
        QTRY_VERIFY((rest += connection.read().bytes) == 2);
        QCOMPARE(textOf(std::span(connection.buffer).first(2)), std::string("st"));
    }

    void forgedRecordBehindAGoodOneIsNamed()
    {
        Connection connection;
        QVERIFY(connection.shakeHands());
        QVERIFY(connection.say("command"));
        std::array<std::uint8_t, 37> forged{23, 3, 3, 0, 32}; // application data, TLS, 32 bytes that no key has sealed
        QCOMPARE(::send(connection.nearSocket.number(), forged.data(), forged.size(), MSG_NOSIGNAL), ssize_t{37});
        QTRY_VERIFY(unread(connection.farSocket.number()) >= 29 + 37);
        const auto good = connection.read();
        QVERIFY(!good.failure);
        QCOMPARE(textOf(std::span(connection.buffer).first(good.bytes)), std::string("command"));
        for (int i = 0; i < 2; ++i) { // and for good
            const auto bad = connection.read();
            QCOMPARE(bad.bytes, std::size_t{0});
            QVERIFY(bad.failure);
            QVERIFY2(bad.failure->tls, bad.failure->detail.c_str());
        }
    }
};

QTEST_GUILESS_MAIN(StreamEndTest)
#include "stream_end_test.moc"
