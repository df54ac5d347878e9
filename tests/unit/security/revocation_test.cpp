// Revoked certificates: refused at both ends, from the moment the list is there, and whatever happens to the list afterwards.
#include "memory_connection.hpp"
#include "security/pem.hpp"
#include "security/revocation_list.hpp"
#include "security/revoking.hpp"
#include "security/tls_identity.hpp"
#include "support/forged_certificate.hpp"
#include "support/test_authority.hpp"

#include <QTest>

#include <fstream>
#include <optional>

#include <sys/stat.h>

using namespace liena;
using namespace liena::security;
using namespace liena::test;
using namespace std::chrono_literals;

namespace {

constexpr DeviceId cockpit(0x40018208U);
constexpr DeviceId robot(0x00008208U);
constexpr DeviceId arm(0x60008208U);

std::string contentOf(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

void write(const std::filesystem::path& file, const std::string& content)
{
    std::filesystem::remove(file); // another file, as copying tools make it
    std::ofstream(file, std::ios::binary) << content;
}

bool says(const Result<void>& result, const std::string& words) { return !result && result.error().what.find(words) != std::string::npos; }

/// A list of the authority with a critical extension that says that it is only a part.
std::string partialList(const std::filesystem::path& folder)
{
    const auto authority = loadAuthority(folder);
    auto list = makeRevocationList(authority.value(), nullptr, {}, RevocationReason::Unspecified, 24h);
    X509V3_CTX context;
    X509V3_set_ctx(&context, authority.value().certificate.get(), nullptr, nullptr, list.value().get(), 0);
    const ExtensionPtr part(X509V3_EXT_nconf_nid(nullptr, &context, NID_issuing_distribution_point, "critical,onlyuser:TRUE"));
    X509_CRL_add_ext(list.value().get(), part.get(), -1);
    X509_CRL_sign(list.value().get(), authority.value().key.get(), EVP_sha256());
    return toPem(list.value().get()).value();
}

/// Numbered high, so that it is not an older one, and made in an hour.
std::string futureList(const std::filesystem::path& folder)
{
    const auto authority = loadAuthority(folder);
    const auto current = readLists(contentOf(folder / "ca.crl"), folder / "ca.crl");
    auto list = makeRevocationList(authority.value(), current.value().front().get(), {}, RevocationReason::Unspecified, 24h);
    ASN1_TIME* const later = X509_gmtime_adj(nullptr, 3600);
    X509_CRL_set1_lastUpdate(list.value().get(), later);
    ASN1_TIME_free(later);
    X509_CRL_sign(list.value().get(), authority.value().key.get(), EVP_sha256());
    return toPem(list.value().get()).value();
}

} // namespace

class RevocationTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void init();
    void opensWhenNobodyIsRevoked();
    void refusesARevokedPeerAtBothEnds();
    void tellsTheRevokedOne();
    void readsTheListAgainWhenItsFileChanges();
    void aListThatVanishedLetsNobodyInAgain();
    void anOlderListLetsNobodyInAgain();
    void refusesToStartWithABadList_data();
    void refusesToStartWithABadList();
    void aBadListStopsNewSessionsAndNothingElse_data() { refusesToStartWithABadList_data(); }
    void aBadListStopsNewSessionsAndNothingElse();
    void tellsEachFaultOnce();
    void refusesToStartWhenRevokedItself();
    void aNamedListMustBeThere();
    void keepsWhatWasRevokedWhenTheListIsRenewed();
    void doesNotBeginADamagedListAnew();
    void revokesOnlyWhatItIssued();
    void refusesWhatIsNoSerial();
    void followsRfc5280();

private:
    TlsIdentity::Site siteOf()
    {
        TlsIdentity::Site site;
        site.clock = [this] { return m_now; };
        site.log = [this](LogLevel level, std::string_view text) {
            m_log.push_back(std::string(toString(level)) + " " + std::string(text));
        };
        return site;
    }
    Result<std::shared_ptr<TlsIdentity>> tryLoad(DeviceId device, const std::string& name)
    {
        const auto files = m_site->identityOf(device, name);
        return TlsIdentity::load(files.certificate, files.key, files.authority, device, siteOf());
    }
    void revoke(const std::string& name, std::chrono::hours validity = 100h)
    {
        const auto serial = m_site->authority().issuedSerial(m_site->folder() / (name + ".crt"));
        QVERIFY2(m_site->authority().revoke({serial.value()}, RevocationReason::KeyCompromise, validity), "cannot revoke");
    }
    std::filesystem::path list() const { return m_site->folder() / "ca.crl"; }
    /// What the two ends say to each other's certificates; empty when both let the other in.
    std::string meeting(TlsIdentity& server, TlsIdentity& client)
    {
        MemoryConnection connection(server.serverContext(), client.clientContext());
        connection.handshake();
        return connection.serverFailure() + "|" + connection.clientFailure();
    }
    void makeBad(const std::string& how);

    std::optional<TestAuthority> m_site;
    std::chrono::system_clock::time_point m_now;
    std::vector<std::string> m_log;
};

void RevocationTest::init()
{
    m_site.emplace();
    m_now = std::chrono::system_clock::now();
    m_log.clear();
}

void RevocationTest::opensWhenNobodyIsRevoked()
{
    auto ours = tryLoad(cockpit, "cockpit").value();
    auto theirs = tryLoad(robot, "robot").value();
    QCOMPARE(meeting(*ours, *theirs), std::string("|"));
    QVERIFY(m_site->authority().revoke({}, RevocationReason::Unspecified, 100h)); // an empty list is no reason either
    QCOMPARE(meeting(*ours, *theirs), std::string("|"));
    QCOMPARE(meeting(*theirs, *ours), std::string("|"));
}

void RevocationTest::refusesARevokedPeerAtBothEnds()
{
    auto ours = tryLoad(cockpit, "cockpit").value();
    auto theirs = tryLoad(robot, "robot").value();
    auto third = tryLoad(arm, "arm").value();
    revoke("robot");
    QVERIFY(meeting(*ours, *theirs).find("the certificate was revoked") < meeting(*ours, *theirs).find('|'));
    QVERIFY(meeting(*theirs, *ours).find("|the peer's certificate was refused: the certificate was revoked") != std::string::npos);
    QCOMPARE(meeting(*ours, *third), std::string("|"));
    QCOMPARE(meeting(*third, *ours), std::string("|"));
}

void RevocationTest::tellsTheRevokedOne()
{
    // The robot has not got the list itself: it hears from the alert what is wrong.
    const auto files = m_site->identityOf(robot, "robot");
    auto site = siteOf();
    write(m_site->folder() / "own.crt", contentOf(files.authority));
    auto theirs = TlsIdentity::load(files.certificate, files.key, m_site->folder() / "own.crt", robot, site).value();
    auto ours = tryLoad(cockpit, "cockpit").value();
    revoke("robot");
    const auto said = meeting(*ours, *theirs);
    QVERIFY2(said.find("|the peer's revocation list names our certificate") != std::string::npos, said.c_str());
}

void RevocationTest::readsTheListAgainWhenItsFileChanges()
{
    auto ours = tryLoad(cockpit, "cockpit").value();
    auto theirs = tryLoad(robot, "robot").value();
    auto third = tryLoad(arm, "arm").value();
    QCOMPARE(meeting(*ours, *third), std::string("|"));
    revoke("robot");
    QVERIFY(meeting(*ours, *theirs) != "|");
    QCOMPARE(meeting(*ours, *third), std::string("|"));
    revoke("arm");
    QVERIFY(meeting(*ours, *theirs) != "|");
    QVERIFY(meeting(*ours, *third) != "|");
    const auto told = [&](const char* words) {
        return std::count_if(m_log.begin(), m_log.end(), [&](const std::string& line) { return line.find(words) != std::string::npos; });
    };
    QVERIFY(told("number 01, 1 revoked") >= 1);
    QVERIFY(told("number 02, 2 revoked") >= 1);
}

void RevocationTest::aListThatVanishedLetsNobodyInAgain()
{
    auto ours = tryLoad(cockpit, "cockpit").value();
    auto theirs = tryLoad(robot, "robot").value();
    revoke("robot");
    QVERIFY(meeting(*ours, *theirs) != "|");
    std::filesystem::remove(list());
    QVERIFY(meeting(*ours, *theirs) != "|");
    QVERIFY(ours->trust().admitSession());
    QVERIFY(m_log.back().find("stays revoked") != std::string::npos);
}

void RevocationTest::anOlderListLetsNobodyInAgain()
{
    QVERIFY(m_site->authority().revoke({}, RevocationReason::Unspecified, 100h));
    const auto older = contentOf(list());
    auto ours = tryLoad(cockpit, "cockpit").value();
    auto theirs = tryLoad(robot, "robot").value();
    revoke("robot");
    QVERIFY(meeting(*ours, *theirs) != "|");
    write(list(), older);
    QVERIFY(meeting(*ours, *theirs) != "|");
    QVERIFY(says(ours->trust().admitSession(), "older than the one in force"));
}

void RevocationTest::makeBad(const std::string& how)
{
    revoke("arm");
    const auto good = contentOf(list());
    if (how == "cut off")
        write(list(), good.substr(0, good.size() / 2));
    else if (how == "empty")
        write(list(), "");
    else if (how == "text")
        write(list(), "nobody is revoked\n");
    else if (how == "changed") {
        auto changed = good;
        changed[changed.size() / 2] = changed[changed.size() / 2] == 'A' ? 'B' : 'A';
        write(list(), changed);
    } else if (how == "of another site") {
        const TestAuthority other;
        QVERIFY(other.authority().revoke({}, RevocationReason::Unspecified, 100h));
        write(list(), contentOf(other.folder() / "ca.crl"));
    } else if (how == "signed by a device") {
        const auto files = m_site->identityOf(robot, "robot");
        AuthorityFiles forger{std::move(readCertificates(files.certificate).value().front()), std::move(readKey(files.key).value())};
        auto forged = makeRevocationList(forger, nullptr, {}, RevocationReason::Unspecified, 100h);
        write(list(), toPem(forged.value().get()).value());
    } else if (how == "twice the same authority") {
        write(list(), good + good);
    } else if (how == "a part of a list") {
        write(list(), partialList(m_site->folder()));
    } else if (how == "a folder") {
        std::filesystem::remove(list());
        std::filesystem::create_directory(list());
    } else if (how == "a pipe") {
        std::filesystem::remove(list());
        QCOMPARE(::mkfifo(list().c_str(), 0600), 0);
    } else if (how == "too long") {
        write(list(), std::string(2U << 20U, '\n') + good);
    } else if (how == "over") {
        revoke("arm", 24h);
        m_now += 25h;
    } else if (how == "to come") {
        write(list(), futureList(m_site->folder()));
    }
}

void RevocationTest::refusesToStartWithABadList_data()
{
    QTest::addColumn<std::string>("how");
    QTest::addColumn<std::string>("words");
    const auto row = [](const char* how, const char* words) { QTest::newRow(how) << std::string(how) << std::string(words); };
    row("cut off", "is damaged");
    row("empty", "holds no list");
    row("text", "holds no list");
    row("changed", "ca.crl");
    row("of another site", "not signed by the site's authority");
    row("signed by a device", "not signed by the site's authority");
    row("twice the same authority", "two lists of the same authority");
    row("a part of a list", "only a part");
    row("a folder", "not a regular file");
    row("a pipe", "not a regular file");
    row("too long", "longer than 1 MiB");
    row("over", "run `liena pki revoke --dir PKI --renew`");
    row("to come", "set the clock");
}

void RevocationTest::refusesToStartWithABadList()
{
    QFETCH(std::string, how);
    QFETCH(std::string, words);
    m_site->identityOf(arm, "arm");
    makeBad(how);
    const auto refused = tryLoad(cockpit, "cockpit");
    QVERIFY(!refused);
    QVERIFY2(refused.error().what.find(words) != std::string::npos, refused.error().what.c_str());
    QVERIFY2(refused.error().what.find("ca.crl") != std::string::npos, refused.error().what.c_str());
}

/// A session that runs must be able to heal: handshakes go on, and only who was revoked before stays out.
void RevocationTest::aBadListStopsNewSessionsAndNothingElse()
{
    QFETCH(std::string, how);
    QFETCH(std::string, words);
    auto ours = tryLoad(cockpit, "cockpit").value();
    auto theirs = tryLoad(robot, "robot").value();
    auto third = tryLoad(arm, "arm").value();
    revoke("arm");
    QVERIFY(meeting(*ours, *third) != "|");
    QVERIFY(ours->trust().admitSession());
    makeBad(how);
    const auto admitted = ours->trust().admitSession();
    QVERIFY2(says(admitted, words), admitted ? "admitted" : admitted.error().what.c_str());
    QCOMPARE(meeting(*ours, *theirs), std::string("|"));
    QVERIFY(meeting(*ours, *third) != "|");
}

void RevocationTest::tellsEachFaultOnce()
{
    auto ours = tryLoad(cockpit, "cockpit").value();
    auto theirs = tryLoad(robot, "robot").value();
    write(list(), "damaged\n");
    m_log.clear();
    for (int i = 0; i < 20; ++i)
        meeting(*ours, *theirs);
    QCOMPARE(m_log.size(), std::size_t(2)); // one of each device
}

void RevocationTest::refusesToStartWhenRevokedItself()
{
    m_site->identityOf(robot, "robot");
    revoke("robot");
    const auto refused = tryLoad(robot, "robot");
    QVERIFY(!refused);
    QVERIFY(refused.error().what.find("robot.crt was revoked") != std::string::npos);
    QVERIFY(tryLoad(cockpit, "cockpit"));
    const auto files = m_site->identityOf(robot, "robot");
    QVERIFY(says(checkIdentity(files.certificate, files.key, files.authority, robot), "was revoked"));
}

void RevocationTest::aNamedListMustBeThere()
{
    const auto files = m_site->identityOf(robot, "robot");
    auto site = siteOf();
    site.revocations = m_site->folder() / "elsewhere.crl";
    const auto refused = TlsIdentity::load(files.certificate, files.key, files.authority, robot, site);
    QVERIFY(!refused);
    QVERIFY(refused.error().what.find("elsewhere.crl") != std::string::npos);
}

void RevocationTest::keepsWhatWasRevokedWhenTheListIsRenewed()
{
    m_site->identityOf(robot, "robot");
    m_site->identityOf(arm, "arm");
    revoke("robot");
    revoke("arm");
    revoke("arm"); // twice is once
    const auto renewed = m_site->authority().revoke({}, RevocationReason::Unspecified, 48h).value();
    QCOMPARE(renewed.revoked.size(), std::size_t(2));
    QCOMPARE(renewed.number, std::string("04"));
    for (const auto& one : renewed.revoked)
        QVERIFY(one.reason == RevocationReason::KeyCompromise);
}

void RevocationTest::doesNotBeginADamagedListAnew()
{
    m_site->identityOf(robot, "robot");
    revoke("robot");
    const auto damaged = contentOf(list()).substr(0, 100);
    write(list(), damaged);
    const auto refused = m_site->authority().revoke({}, RevocationReason::Unspecified, 48h);
    QVERIFY(!refused);
    QVERIFY(refused.error().what.find("damaged") != std::string::npos);
    QCOMPARE(contentOf(list()), damaged);
}

void RevocationTest::revokesOnlyWhatItIssued()
{
    TestAuthority other;
    const auto strange = other.identityOf(robot, "robot");
    QVERIFY(!m_site->authority().issuedSerial(strange.certificate));
    QVERIFY(!m_site->authority().issuedSerial(m_site->certificate()));
    QVERIFY(!m_site->authority().issuedSerial(m_site->key()));
    QVERIFY(m_site->authority().issuedSerial(m_site->identityOf(robot, "robot").certificate));
}

void RevocationTest::refusesWhatIsNoSerial()
{
    for (const auto* text : {"", "xyz", "-1", "0x12", "12 34", "12\n", "00112233445566778899aabbccddeeff0011223344"})
        QVERIFY2(!m_site->authority().revoke({text}, RevocationReason::Unspecified, 48h), text);
    QVERIFY(!std::filesystem::exists(list()));
    QVERIFY(m_site->authority().revoke({"0aBc"}, RevocationReason::Unspecified, 48h));
}

void RevocationTest::followsRfc5280()
{
    m_site->identityOf(robot, "robot");
    revoke("robot");
    const auto lists = readLists(contentOf(list()), list()).value();
    auto* const made = lists.front().get();
    QCOMPARE(X509_CRL_get_version(made), static_cast<long>(X509_CRL_VERSION_2));
    for (const int extension : {NID_crl_number, NID_authority_key_identifier})
        QVERIFY(X509_CRL_get_ext_by_NID(made, extension, -1) >= 0);
    QVERIFY(X509_CRL_get_ext_by_critical(made, 1, -1) < 0);
    QVERIFY(X509_CRL_get0_nextUpdate(made) != nullptr);
}

QTEST_GUILESS_MAIN(RevocationTest)
#include "revocation_test.moc"
