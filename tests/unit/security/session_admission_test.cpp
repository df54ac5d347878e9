// No session begins near a certificate's end: the boundary to the second at both ends, and what the rule leaves alone.
#include "memory_connection.hpp"
#include "security/tls_identity.hpp"
#include "security/whole_file.hpp"
#include "support/test_authority.hpp"

#include <QTest>

#include <fstream>
#include <optional>

#include <sys/resource.h>

using namespace liena;
using namespace liena::security;
using namespace liena::test;
using namespace std::chrono_literals;

namespace {

constexpr DeviceId cockpit(0x40018208U);
constexpr DeviceId robot(0x00008208U);

std::string wordsOf(const Result<void>& result) { return result ? "" : result.error().what; }

} // namespace

class SessionAdmissionTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase();
    void judgesItsOwnCertificateToTheSecond_data() { addMoments(); }
    void judgesItsOwnCertificateToTheSecond();
    void judgesThePeersCertificateToTheSecond_data() { addMoments(); }
    void judgesThePeersCertificateToTheSecond();
    void countsTheAuthoritysEndToo();
    void letsARunningSessionHealUntilTheVeryEnd();
    void refusesWhatIsOver();
    void aClockSetBackBringsNothingBack();
    void checksFilesByTheSameRule();
    void refusesKeysThatAreNotItsUsersAlone_data();
    void refusesKeysThatAreNotItsUsersAlone();
    void leavesNoKeysInCoreDumps();

private:
    static void addMoments();
    std::shared_ptr<TlsIdentity> load(DeviceId device, const std::string& name)
    {
        TlsIdentity::Site site;
        site.clock = [this] { return m_now; };
        auto loaded = TlsIdentity::load(m_site->folder() / (name + ".crt"), m_site->folder() / (name + ".key"), m_site->certificate(),
                                        device, std::move(site));
        if (!loaded)
            throw std::runtime_error(loaded.error().what);
        return loaded.value();
    }
    std::chrono::system_clock::time_point endOf(const std::string& name) const
    {
        return describeCertificate(m_site->folder() / (name + ".crt")).value().notAfter;
    }

    std::optional<TestAuthority> m_site; ///< its own certificate ends after 72 h
    std::chrono::system_clock::time_point m_now;
};

void SessionAdmissionTest::initTestCase()
{
    m_site.emplace();
    QVERIFY(m_site->authority().issue(cockpit, "cockpit", 60h));
    QVERIFY(m_site->authority().issue(robot, "robot", 48h));
}

void SessionAdmissionTest::addMoments()
{
    QTest::addColumn<int>("secondsBeforeTheEnd");
    QTest::addColumn<bool>("admitted");
    QTest::newRow("a day and a second") << 24 * 3600 + 1 << true;
    QTest::newRow("a day") << 24 * 3600 << false;
    QTest::newRow("a day but a second") << 24 * 3600 - 1 << false;
    QTest::newRow("a second") << 1 << false;
}

void SessionAdmissionTest::judgesItsOwnCertificateToTheSecond()
{
    QFETCH(int, secondsBeforeTheEnd);
    QFETCH(bool, admitted);
    m_now = std::chrono::system_clock::now();
    const auto identity = load(robot, "robot");
    m_now = endOf("robot") - std::chrono::seconds(secondsBeforeTheEnd);
    const auto words = wordsOf(identity->trust().admitSession());
    QCOMPARE(words.empty(), admitted);
    if (!admitted)
        for (const auto* part : {"robot.crt ends on ", "24 hours", "liena pki issue"})
            QVERIFY2(words.find(part) != std::string::npos, words.c_str());
}

void SessionAdmissionTest::judgesThePeersCertificateToTheSecond()
{
    QFETCH(int, secondsBeforeTheEnd);
    QFETCH(bool, admitted);
    m_now = std::chrono::system_clock::now();
    const auto ours = load(cockpit, "cockpit");
    const auto theirs = load(robot, "robot");
    m_now = endOf("robot") - std::chrono::seconds(secondsBeforeTheEnd);
    const bool ownIsGood = ours->trust().admitSession().has_value(); // it ends 12 h after the robot's
    QCOMPARE(ownIsGood, secondsBeforeTheEnd > 12 * 3600);
    for (const bool connecting : {true, false}) {
        MemoryConnection connection(connecting ? theirs->serverContext() : ours->serverContext(),
                                    connecting ? ours->clientContext() : theirs->clientContext());
        connection.handshake();
        QCOMPARE(connection.clientFailure() + connection.serverFailure(), std::string());
        const auto words = wordsOf(ours->trust().admitSession(connecting ? connection.client() : connection.server()));
        QCOMPARE(words.empty(), admitted);
        QVERIFY2(admitted || words.find("0x00008208 ends on ") != std::string::npos || !ownIsGood, words.c_str());
    }
}

void SessionAdmissionTest::countsTheAuthoritysEndToo()
{
    TestAuthority site;
    QVERIFY(site.authority().issue(robot, "robot", 70h));
    m_now = std::chrono::system_clock::now();
    TlsIdentity::Site seam;
    seam.clock = [this] { return m_now; };
    const auto loaded =
        TlsIdentity::load(site.folder() / "robot.crt", site.folder() / "robot.key", site.certificate(), robot, seam).value();
    QVERIFY(loaded->trust().admitSession());
    m_now += 45h;
    QVERIFY(loaded->trust().admitSession());
    m_now += 2h; // the device's certificate ends in 23 h, its authority in 25
    QVERIFY(!loaded->trust().admitSession());
}

/// Interrupted sessions connect anew with the certificates they began with; the rule is about beginning.
void SessionAdmissionTest::letsARunningSessionHealUntilTheVeryEnd()
{
    m_now = std::chrono::system_clock::now();
    const auto ours = load(cockpit, "cockpit");
    const auto theirs = load(robot, "robot");
    m_now = endOf("robot") - 1s;
    MemoryConnection connection(theirs->serverContext(), ours->clientContext());
    connection.handshake();
    QCOMPARE(connection.clientFailure() + connection.serverFailure(), std::string());
    QVERIFY(requirePeer(connection.client(), robot));
    QVERIFY(!ours->trust().admitSession(connection.client()));
}

void SessionAdmissionTest::refusesWhatIsOver()
{
    m_now = std::chrono::system_clock::now();
    const auto ours = load(cockpit, "cockpit");
    const auto theirs = load(robot, "robot");
    m_now = endOf("robot") + 1s;
    MemoryConnection connection(theirs->serverContext(), ours->clientContext());
    connection.handshake();
    QVERIFY(connection.clientFailure().find("has expired") != std::string::npos);
    QVERIFY(!peerDevice(connection.client()));
}

void SessionAdmissionTest::aClockSetBackBringsNothingBack()
{
    m_now = std::chrono::system_clock::now();
    const auto ours = load(cockpit, "cockpit");
    const auto theirs = load(robot, "robot");
    m_now -= std::chrono::hours(24) * 365 * 50;
    MemoryConnection connection(theirs->serverContext(), ours->clientContext());
    connection.handshake();
    QVERIFY(connection.clientFailure().find("not valid yet") != std::string::npos);
}

void SessionAdmissionTest::checksFilesByTheSameRule()
{
    TestAuthority site;
    QVERIFY(site.authority().issue(robot, "short", 23h));
    QVERIFY(site.authority().issue(robot, "long", 25h));
    const auto check = [&](const std::string& name) {
        return checkIdentity(site.folder() / (name + ".crt"), site.folder() / (name + ".key"), site.certificate(), robot);
    };
    QVERIFY(wordsOf(check("short")).find("short.crt ends on") != std::string::npos);
    QCOMPARE(wordsOf(check("long")), std::string());
}

void SessionAdmissionTest::refusesKeysThatAreNotItsUsersAlone_data()
{
    QTest::addColumn<int>("mode");
    QTest::addColumn<int>("owner");
    QTest::addColumn<QString>("words");
    QTest::newRow("as it should be") << 0600 << 1000 << QString();
    QTest::newRow("read only") << 0400 << 1000 << QString();
    QTest::newRow("group") << 0640 << 1000 << QStringLiteral("run: chmod 600 /pki/robot.key");
    QTest::newRow("world") << 0644 << 1000 << QStringLiteral("run: chmod 600 /pki/robot.key");
    QTest::newRow("another user's") << 0600 << 1001 << QStringLiteral("chown 1000 /pki/robot.key && chmod 600 /pki/robot.key");
    QTest::newRow("root's") << 0600 << 0 << QStringLiteral("belongs to user 0");
}

void SessionAdmissionTest::refusesKeysThatAreNotItsUsersAlone()
{
    QFETCH(int, mode);
    QFETCH(int, owner);
    QFETCH(QString, words);
    const auto judged = requireSecret("/pki/robot.key", static_cast<mode_t>(mode), static_cast<uid_t>(owner), 1000);
    QCOMPARE(judged.has_value(), words.isEmpty());
    if (!judged)
        QVERIFY2(QString::fromStdString(judged.error().what).contains(words), judged.error().what.c_str());
}

void SessionAdmissionTest::leavesNoKeysInCoreDumps()
{
    keepKeysOutOfCoreDumps();
    rlimit limit{};
    QCOMPARE(::getrlimit(RLIMIT_CORE, &limit), 0);
    QVERIFY(limit.rlim_cur == 0 && limit.rlim_max == 0);
    std::ifstream filter("/proc/self/coredump_filter");
    std::string mask;
    QVERIFY(filter >> mask);
    QCOMPARE(mask, std::string("00000000"));
}

QTEST_GUILESS_MAIN(SessionAdmissionTest)
#include "session_admission_test.moc"
