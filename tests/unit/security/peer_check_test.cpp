// Who gets through the handshake: a table of certificates and connections, of which one row opens.
#include "memory_connection.hpp"

#include "security/tls_identity.hpp"
#include "support/certificate_matrix.hpp"
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

using Row = CertificateRow;

std::vector<Row> allRows() { return certificateMatrix(robot, arm); }

} // namespace

Q_DECLARE_METATYPE(Row)

class PeerCheckTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
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
    Forged madeFor(const Row& row) const { return m_signers->made(row); }
    Stranger strangerFor(const Row& row, const Forged& forged) const;
    std::string serverAnswer(const Row& row) const;
    std::string clientAnswer(const Row& row) const;

    std::optional<TestAuthority> m_site;
    std::shared_ptr<TlsIdentity> m_cockpit;
    std::shared_ptr<TlsIdentity> m_robot;
    std::optional<MatrixSigners> m_signers;
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
    m_signers.emplace(m_site->certificate(), m_site->key());
}

void PeerCheckTest::addRows()
{
    QTest::addColumn<Row>("row");
    for (const auto& row : allRows())
        QTest::newRow(row.name) << row;
}

Stranger PeerCheckTest::strangerFor(const Row& row, const Forged& forged) const
{
    Stranger stranger{.alpn = row.alpn, .groups = row.groups, .highestVersion = row.highestVersion};
    if (row.showsCertificate) {
        stranger.certificate = forged.certificate.get();
        stranger.key = forged.key.get();
    }
    if (row.signer == Signer::OneBelow)
        stranger.intermediate = m_signers->between().certificate.get();
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
    QVERIFY(allRows().size() >= 40);
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
    const Row row{.name = "", .recipe = changed(robot, [](Recipe& r) { r.key = KeyKind::Rsa2048; })};
    QCOMPARE(serverAnswer(row), std::string());
    QCOMPARE(clientAnswer(row), std::string());
}

void PeerCheckTest::acceptsOneAuthorityBetween()
{
    const Row row{.name = "", .recipe = goodRecipe(robot), .signer = Signer::OneBelow};
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
    const auto forged = forge(goodRecipe(robot), &m_signers->site());
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
    const auto forged = forge(goodRecipe(robot));
    const Row row{.name = "", .recipe = goodRecipe(robot), .signer = Signer::Itself};
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
