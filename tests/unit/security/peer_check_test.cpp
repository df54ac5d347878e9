// Who gets through the handshake: a table of certificates and connections, of which one row opens.
#include "memory_connection.hpp"

#include "security/device_uri.hpp"
#include "security/tls_identity.hpp"
#include "support/forged_certificate.hpp"
#include "support/test_authority.hpp"

#include <QTest>

#include <optional>

using namespace liena;
using namespace liena::security;
using namespace liena::test;

namespace {

constexpr DeviceId cockpit(0x40018208U);
constexpr DeviceId robot(0x00008208U);
constexpr DeviceId arm(0x60008208U);

enum class Signer { Site, OtherSite, Itself, OneBelow, TwoBelow };

struct Row {
    const char* name;
    Recipe recipe;
    Signer signer = Signer::Site;
    bool showsCertificate = true;
    std::string alpn = "liena/1";
    int highestVersion = TLS1_3_VERSION;
    std::string groups = "X25519:P-256:P-384:P-521";
    const char* serverSays = ""; ///< part of what our server says to a client like this; empty: it lets it in
    const char* clientSays = ""; ///< part of what our client says to a server like this
};

Recipe good() { return {.uris = {deviceUri(robot)}, .commonName = "robot"}; }

Recipe naming(std::vector<std::string> uris)
{
    auto recipe = good();
    recipe.uris = std::move(uris);
    return recipe;
}

Recipe with(auto change)
{
    auto recipe = good();
    change(recipe);
    return recipe;
}

std::vector<Row> certificateRows()
{
    const auto uri = deviceUri(robot);
    const auto none = "names no device";
    const auto impossible = "names a device that cannot be";
    const auto unknown = "unknown authority";
    const auto both = "both client and server";
    const auto weak = "too weak";
    return {
        {.name = "self-signed", .recipe = good(), .signer = Signer::Itself, .serverSays = unknown, .clientSays = unknown},
        {.name = "another authority", .recipe = good(), .signer = Signer::OtherSite, .serverSays = unknown, .clientSays = unknown},
        {.name = "two authorities between", .recipe = good(), .signer = Signer::TwoBelow, .serverSays = unknown, .clientSays = unknown},
        {.name = "another device's id", .recipe = naming({deviceUri(arm)}), .serverSays = "was meant", .clientSays = "was meant"},
        {.name = "two devices", .recipe = naming({uri, deviceUri(arm)}), .serverSays = "more than one", .clientSays = "more than one"},
        {.name = "the same device twice", .recipe = naming({uri, uri}), .serverSays = "more than one", .clientSays = "more than one"},
        {.name = "NUL after the id", .recipe = naming({uri + '\0'}), .serverSays = impossible, .clientSays = impossible},
        {.name = "NUL and more after the id",
         .recipe = naming({uri + std::string("\0.example", 9)}),
         .serverSays = impossible,
         .clientSays = impossible},
        {.name = "NUL before the id", .recipe = naming({std::string("\0", 1) + uri}), .serverSays = none, .clientSays = none},
        {.name = "wildcard", .recipe = naming({"urn:liena:device:*"}), .serverSays = impossible, .clientSays = impossible},
        {.name = "wildcard digit", .recipe = naming({"urn:liena:device:0000820?"}), .serverSays = impossible, .clientSays = impossible},
        {.name = "upper case digits", .recipe = naming({"urn:liena:device:0000820A"}), .serverSays = impossible, .clientSays = impossible},
        {.name = "upper case prefix", .recipe = naming({"URN:LIENA:DEVICE:00008208"}), .serverSays = impossible, .clientSays = impossible},
        {.name = "0x before the digits",
         .recipe = naming({"urn:liena:device:0x00008208"}),
         .serverSays = impossible,
         .clientSays = impossible},
        {.name = "seven digits", .recipe = naming({"urn:liena:device:0008208"}), .serverSays = impossible, .clientSays = impossible},
        {.name = "the broadcast id", .recipe = naming({"urn:liena:device:ffffffff"}), .serverSays = impossible, .clientSays = impossible},
        {.name = "good id beside a bad one",
         .recipe = naming({uri, "urn:liena:device:*"}),
         .serverSays = "more than one",
         .clientSays = "more than one"},
        {.name = "id in the common name only",
         .recipe = with([&](Recipe& r) { r.uris.clear(), r.commonName = uri; }),
         .serverSays = none,
         .clientSays = none},
        {.name = "id in a DNS name only",
         .recipe = with([&](Recipe& r) { r.uris.clear(), r.dnsNames = {uri}; }),
         .serverSays = none,
         .clientSays = none},
        {.name = "no names at all",
         .recipe = with([](Recipe& r) { r.uris.clear(), r.commonName.clear(); }),
         .serverSays = none,
         .clientSays = none},
        {.name = "expired",
         .recipe = with([](Recipe& r) { r.startHours = -2, r.endHours = -1; }),
         .serverSays = "expired",
         .clientSays = "expired"},
        {.name = "not yet valid",
         .recipe = with([](Recipe& r) { r.startHours = 1; }),
         .serverSays = "not valid yet",
         .clientSays = "not valid yet"},
        {.name = "usage server only", .recipe = with([](Recipe& r) { r.usage = "serverAuth"; }), .serverSays = both, .clientSays = both},
        {.name = "usage client only", .recipe = with([](Recipe& r) { r.usage = "clientAuth"; }), .serverSays = both, .clientSays = both},
        {.name = "usage code signing", .recipe = with([](Recipe& r) { r.usage = "codeSigning"; }), .serverSays = both, .clientSays = both},
        {.name = "no usage", .recipe = with([](Recipe& r) { r.usage.clear(); }), .serverSays = both, .clientSays = both},
        {.name = "an authority of its own",
         .recipe = with([](Recipe& r) { r.authority = true; }),
         .serverSays = "an authority's",
         .clientSays = "an authority's"},
        {.name = "RSA of 1024 bits", .recipe = with([](Recipe& r) { r.key = KeyKind::Rsa1024; }), .serverSays = weak, .clientSays = weak},
        {.name = "elliptic curve of 224 bits",
         .recipe = with([](Recipe& r) { r.key = KeyKind::P224; }),
         .serverSays = "no",
         .clientSays = "in common"},
        {.name = "signed with SHA-1", .recipe = with([](Recipe& r) { r.sha1 = true; }), .serverSays = weak, .clientSays = weak},
    };
}

std::vector<Row> connectionRows()
{
    const auto version = "no TLS version in common";
    const auto protocol = "application protocol";
    return {
        {.name = "TLS 1.2", .recipe = good(), .highestVersion = TLS1_2_VERSION, .serverSays = version, .clientSays = version},
        {.name = "no ALPN", .recipe = good(), .alpn = "", .serverSays = protocol, .clientSays = protocol},
        {.name = "another ALPN", .recipe = good(), .alpn = "h2", .serverSays = protocol, .clientSays = protocol},
        {.name = "a later version in ALPN", .recipe = good(), .alpn = "liena/12", .serverSays = protocol, .clientSays = protocol},
        {.name = "costly key exchange only", .recipe = good(), .groups = "ffdhe8192", .serverSays = "in common", .clientSays = "in common"},
        {.name = "certificate of 20 KiB",
         .recipe = with([](Recipe& r) { r.dnsNames.assign(100, std::string(200, 'x')); }),
         .serverSays = "too long",
         .clientSays = "too long"},
        {.name = "no certificate",
         .recipe = good(),
         .showsCertificate = false,
         .serverSays = "showed no certificate",
         .clientSays = ""}, // a TLS 1.3 server cannot do without one; see refusesServerWithoutCertificate
    };
}

std::vector<Row> allRows()
{
    auto rows = certificateRows();
    for (auto& row : connectionRows())
        rows.push_back(std::move(row));
    rows.push_back({.name = "as it should be", .recipe = good()});
    return rows;
}

} // namespace

Q_DECLARE_METATYPE(Row)

class PeerCheckTest : public QObject {
    Q_OBJECT

private slots:
    void initTestCase();
    void serverLetsInOnlyTheRightClient_data() { addRows(); }
    void serverLetsInOnlyTheRightClient();
    void clientStaysOnlyWithTheRightServer_data() { addRows(); }
    void clientStaysOnlyWithTheRightServer();
    void opensExactlyOneRow();
    void opensBetweenTwoDevices();
    void acceptsRsaOf2048Bits();
    void acceptsOneAuthorityBetween();
    void refusesServerWithoutCertificate();
    void givesNoTicketAndKeepsNoSession();
    void asksNothingBeforeTheHandshakeIsComplete();
    void refusesContextThatVerifiesNobody();

private:
    static void addRows();
    Forged madeFor(const Row& row) const;
    Stranger strangerFor(const Row& row, const Forged& forged) const;
    std::string serverAnswer(const Row& row) const;
    std::string clientAnswer(const Row& row) const;

    std::optional<TestAuthority> m_site;
    std::shared_ptr<TlsIdentity> m_cockpit;
    std::shared_ptr<TlsIdentity> m_robot;
    Forged m_signer;
    Forged m_otherSigner;
    Forged m_between;
    Forged m_belowBetween;
};

void PeerCheckTest::initTestCase()
{
    m_site.emplace();
    const auto load = [&](DeviceId device, const char* name) {
        const auto files = m_site->identityOf(device, name);
        return TlsIdentity::load(files.certificate, files.key, files.authority, device);
    };
    auto ours = load(cockpit, "cockpit");
    auto theirs = load(robot, "robot");
    QVERIFY2(ours, ours ? "" : ours.error().what.c_str());
    QVERIFY2(theirs, theirs ? "" : theirs.error().what.c_str());
    m_cockpit = ours.value();
    m_robot = theirs.value();
    m_signer = loadForged(m_site->certificate(), m_site->key());
    const Recipe authority{.commonName = "LiENa certificate authority", .usage = "", .authority = true};
    m_otherSigner = forge(authority);
    m_between = forge({.commonName = "between", .usage = "", .authority = true}, &m_signer);
    m_belowBetween = forge({.commonName = "below", .usage = "", .authority = true}, &m_between);
}

void PeerCheckTest::addRows()
{
    QTest::addColumn<Row>("row");
    for (const auto& row : allRows())
        QTest::newRow(row.name) << row;
}

Forged PeerCheckTest::madeFor(const Row& row) const
{
    switch (row.signer) {
    case Signer::Itself:
        return forge(row.recipe);
    case Signer::OtherSite:
        return forge(row.recipe, &m_otherSigner);
    case Signer::OneBelow:
        return forge(row.recipe, &m_between);
    case Signer::TwoBelow:
        return forge(row.recipe, &m_belowBetween);
    case Signer::Site:
        break;
    }
    return forge(row.recipe, &m_signer);
}

Stranger PeerCheckTest::strangerFor(const Row& row, const Forged& forged) const
{
    Stranger stranger{.alpn = row.alpn, .groups = row.groups, .highestVersion = row.highestVersion};
    if (row.showsCertificate) {
        stranger.certificate = forged.certificate.get();
        stranger.key = forged.key.get();
    }
    if (row.signer == Signer::OneBelow)
        stranger.intermediate = m_between.certificate.get();
    return stranger;
}

/// What our server says to such a client; empty when it lets it in.
std::string PeerCheckTest::serverAnswer(const Row& row) const
{
    const auto forged = madeFor(row);
    const auto stranger = strangerFor(row, forged);
    const auto context = strangerClient(stranger);
    MemoryConnection connection(m_cockpit->serverContext(), context.get());
    connection.handshake();
    if (!connection.serverFailure().empty())
        return connection.serverFailure();
    const auto right = requirePeer(connection.server(), robot);
    return right ? "" : right.error().what;
}

std::string PeerCheckTest::clientAnswer(const Row& row) const
{
    const auto forged = madeFor(row);
    const auto stranger = strangerFor(row, forged);
    const auto context = strangerServer(stranger);
    MemoryConnection connection(context.get(), m_cockpit->clientContext());
    connection.handshake();
    if (!connection.clientFailure().empty())
        return connection.clientFailure();
    const auto right = requirePeer(connection.client(), robot);
    return right ? "" : right.error().what;
}

void PeerCheckTest::serverLetsInOnlyTheRightClient()
{
    QFETCH(Row, row);
    const auto answer = serverAnswer(row);
    QCOMPARE(answer.empty(), *row.serverSays == '\0');
    QVERIFY2(answer.find(row.serverSays) != std::string::npos, answer.c_str());
}

void PeerCheckTest::clientStaysOnlyWithTheRightServer()
{
    QFETCH(Row, row);
    if (!row.showsCertificate)
        return;
    const auto answer = clientAnswer(row);
    QCOMPARE(answer.empty(), *row.clientSays == '\0');
    QVERIFY2(answer.find(row.clientSays) != std::string::npos, answer.c_str());
}

void PeerCheckTest::opensExactlyOneRow()
{
    // The right peer comes last: all the refusals before it have not worn the contexts out.
    std::vector<std::string> opened;
    for (const auto& row : allRows()) {
        if (serverAnswer(row).empty())
            opened.push_back(std::string("server: ") + row.name);
        if (row.showsCertificate && clientAnswer(row).empty())
            opened.push_back(std::string("client: ") + row.name);
    }
    QCOMPARE(opened, (std::vector<std::string>{"server: as it should be", "client: as it should be"}));
}

void PeerCheckTest::opensBetweenTwoDevices()
{
    MemoryConnection connection(m_robot->serverContext(), m_cockpit->clientContext());
    connection.handshake();
    QCOMPARE(connection.serverFailure(), std::string());
    QCOMPARE(connection.clientFailure(), std::string());
    QCOMPARE(peerDevice(connection.server()).value(), cockpit);
    QCOMPARE(peerDevice(connection.client()).value(), robot);
    QVERIFY(requirePeer(connection.client(), robot));
    QVERIFY(!requirePeer(connection.client(), arm));
}

void PeerCheckTest::acceptsRsaOf2048Bits()
{
    const Row row{.name = "", .recipe = with([](Recipe& r) { r.key = KeyKind::Rsa2048; })};
    QCOMPARE(serverAnswer(row), std::string());
    QCOMPARE(clientAnswer(row), std::string());
}

void PeerCheckTest::acceptsOneAuthorityBetween()
{
    const Row row{.name = "", .recipe = good(), .signer = Signer::OneBelow};
    QCOMPARE(serverAnswer(row), std::string());
    QCOMPARE(clientAnswer(row), std::string());
}

void PeerCheckTest::refusesServerWithoutCertificate()
{
    const Stranger stranger;
    const auto context = strangerServer(stranger);
    MemoryConnection connection(context.get(), m_cockpit->clientContext());
    connection.handshake();
    QVERIFY(!connection.clientFailure().empty());
    QVERIFY(!peerDevice(connection.client()));
}

void PeerCheckTest::givesNoTicketAndKeepsNoSession()
{
    int sessions = 0;
    const auto client = strangerClient({.alpn = "liena/1"});
    const auto forged = forge(good(), &m_signer);
    SSL_CTX_use_certificate(client.get(), forged.certificate.get());
    SSL_CTX_use_PrivateKey(client.get(), forged.key.get());
    SSL_CTX_set_session_cache_mode(client.get(), SSL_SESS_CACHE_CLIENT);
    SSL_CTX_set_app_data(client.get(), &sessions);
    SSL_CTX_sess_set_new_cb(client.get(), [](SSL* ssl, SSL_SESSION*) {
        ++*static_cast<int*>(SSL_CTX_get_app_data(SSL_get_SSL_CTX(ssl)));
        return 0;
    });
    MemoryConnection connection(m_cockpit->serverContext(), client.get());
    connection.handshake();
    QVERIFY(peerDevice(connection.server()));
    QCOMPARE(sessions, 0);
    QCOMPARE(SSL_CTX_sess_number(m_cockpit->serverContext()), 0L);
    QCOMPARE(SSL_SESSION_is_resumable(SSL_get0_session(connection.client())), 0);
}

void PeerCheckTest::asksNothingBeforeTheHandshakeIsComplete()
{
    MemoryConnection connection(m_robot->serverContext(), m_cockpit->clientContext());
    const auto device = peerDevice(connection.client());
    QVERIFY(!device);
    QVERIFY(device.error().what.find("not completed") != std::string::npos);
}

void PeerCheckTest::refusesContextThatVerifiesNobody()
{
    const auto forged = forge(good());
    const Row row{.name = "", .recipe = good(), .signer = Signer::Itself};
    const auto stranger = strangerFor(row, forged);
    const auto server = strangerServer(stranger);
    const auto client = strangerClient(stranger);
    MemoryConnection connection(server.get(), client.get());
    connection.handshake();
    const auto device = peerDevice(connection.client());
    QVERIFY(!device);
    QVERIFY(device.error().what.find("not verified") != std::string::npos);
}

QTEST_GUILESS_MAIN(PeerCheckTest)
#include "peer_check_test.moc"
