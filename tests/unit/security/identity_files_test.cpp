// The three files of a device: what is refused before the first connection, and with which words.
#include "liena/certificates.hpp"
#include "security/device_uri.hpp"
#include "security/random_token.hpp"
#include "security/tls_identity.hpp"
#include "security/whole_file.hpp"
#include "support/forged_certificate.hpp"
#include "support/test_authority.hpp"

#include <QTemporaryDir>
#include <QTest>

#include <fstream>
#include <set>

#include <sys/stat.h>

using namespace liena;
using namespace liena::security;
using namespace liena::test;

namespace {

constexpr DeviceId robot(0x00008208U);
constexpr DeviceId arm(0x60008208U);

bool says(const Result<void>& result, const std::string& words) { return !result && result.error().what.find(words) != std::string::npos; }

Result<void> check(const IdentityFiles& files, DeviceId device = robot)
{
    return checkIdentity(files.certificate, files.key, files.authority, device);
}

} // namespace

class IdentityFilesTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void refusesMissingFile_data();
    void refusesMissingFile();
    void refusesKeyThatOthersMayUse_data();
    void refusesKeyThatOthersMayUse();
    void refusesAnotherDevicesFiles();
    void refusesKeyOfAnotherCertificate();
    void refusesAuthorityOfAnotherSite();
    void refusesCertificateAsAuthority();
    void refusesForgedCertificate_data();
    void refusesForgedCertificate();
    void refusesTextThatIsNoCertificate();
    void refusesDamagedCertificate();
    void refusesPipeWithoutWaiting();
    void loadsContextsOnlyForSoundFiles();
    void readsOnlyExactUris_data();
    void readsOnlyExactUris();
    void explainsUnknownErrorsToo();
    void givesTokensThatDiffer();
    void publishesWholeFilesOnly();
    void refusesWritingWhereNothingCanBe();
};

void IdentityFilesTest::refusesMissingFile_data()
{
    QTest::addColumn<int>("which");
    QTest::newRow("certificate") << 0;
    QTest::newRow("key") << 1;
    QTest::newRow("authority") << 2;
}

void IdentityFilesTest::refusesMissingFile()
{
    QFETCH(int, which);
    TestAuthority site;
    auto files = site.identityOf(robot, "robot");
    auto& missing = which == 0 ? files.certificate : which == 1 ? files.key : files.authority;
    missing = site.folder() / "missing.pem";
    const auto checked = check(files);
    QVERIFY(says(checked, "missing.pem cannot be read: No such file"));
    QVERIFY(checked.error().code == Errc::FileUnreadable);
}

void IdentityFilesTest::refusesKeyThatOthersMayUse_data()
{
    QTest::addColumn<int>("mode");
    for (const int mode : {0640, 0620, 0610, 0604, 0602, 0601, 0644, 0666})
        QTest::addRow("%o", static_cast<unsigned>(mode)) << mode;
}

void IdentityFilesTest::refusesKeyThatOthersMayUse()
{
    QFETCH(int, mode);
    TestAuthority site;
    const auto files = site.identityOf(robot, "robot");
    QVERIFY(check(files));
    QCOMPARE(::chmod(files.key.c_str(), static_cast<mode_t>(mode)), 0);
    QVERIFY(says(check(files), "run: chmod 600 " + files.key.string()));
    QCOMPARE(::chmod(files.key.c_str(), 0400), 0);
    QVERIFY(check(files));
}

void IdentityFilesTest::refusesAnotherDevicesFiles()
{
    TestAuthority site;
    QVERIFY(says(check(site.identityOf(robot, "robot"), arm), "is for device 0x00008208, not for 0x60008208"));
}

void IdentityFilesTest::refusesKeyOfAnotherCertificate()
{
    TestAuthority site;
    auto files = site.identityOf(robot, "robot");
    files.key = site.identityOf(arm, "arm").key;
    QVERIFY(says(check(files), "arm.key is not the key of"));
}

void IdentityFilesTest::refusesAuthorityOfAnotherSite()
{
    TestAuthority site;
    const TestAuthority other;
    auto files = site.identityOf(robot, "robot");
    files.authority = other.certificate();
    QVERIFY(says(check(files), "unknown authority"));
}

void IdentityFilesTest::refusesCertificateAsAuthority()
{
    TestAuthority site;
    auto files = site.identityOf(robot, "robot");
    files.authority = files.certificate;
    QVERIFY(says(check(files), "is not an authority"));
}

void IdentityFilesTest::refusesForgedCertificate_data()
{
    QTest::addColumn<Recipe>("recipe");
    QTest::addColumn<std::string>("words");
    const std::vector<std::string> uris{deviceUri(robot)};
    QTest::newRow("expired") << Recipe{.uris = uris, .startHours = -2, .endHours = -1} << std::string("expired");
    QTest::newRow("not yet valid") << Recipe{.uris = uris, .startHours = 1} << std::string("not valid yet");
    QTest::newRow("server only") << Recipe{.uris = uris, .usage = "serverAuth"} << std::string("both client and server");
    QTest::newRow("weak key") << Recipe{.uris = uris, .key = KeyKind::Rsa1024} << std::string("too weak");
    QTest::newRow("no device") << Recipe{} << std::string("names no device");
    QTest::newRow("an authority") << Recipe{.uris = uris, .authority = true} << std::string("an authority's");
}

void IdentityFilesTest::refusesForgedCertificate()
{
    QFETCH(Recipe, recipe);
    QFETCH(std::string, words);
    const TestAuthority site;
    const IdentityFiles files{site.folder() / "forged.crt", site.folder() / "forged.key", site.certificate()};
    const auto signer = loadForged(site.certificate(), site.key());
    forge(recipe, &signer).writeTo(files.certificate, files.key);
    const auto checked = check(files);
    QVERIFY2(says(checked, words), checked ? "accepted" : checked.error().what.c_str());
    QVERIFY(says(checked, "forged.crt"));
}

void IdentityFilesTest::refusesTextThatIsNoCertificate()
{
    TestAuthority site;
    auto files = site.identityOf(robot, "robot");
    std::ofstream(files.certificate) << "not a certificate\n";
    QVERIFY(says(check(files), "holds no certificate"));
    QVERIFY(!describeCertificate(files.certificate));
    QVERIFY(!describeCertificate(files.key));
}

void IdentityFilesTest::refusesDamagedCertificate()
{
    TestAuthority site;
    auto files = site.identityOf(robot, "robot");
    std::fstream stream(files.certificate, std::ios::in | std::ios::out);
    stream.seekp(60);
    stream << "????";
    stream.close();
    QVERIFY(says(check(files), "damaged certificate"));
}

void IdentityFilesTest::refusesPipeWithoutWaiting()
{
    TestAuthority site;
    auto files = site.identityOf(robot, "robot");
    files.certificate = site.folder() / "pipe";
    QCOMPARE(::mkfifo(files.certificate.c_str(), 0600), 0);
    QVERIFY(says(check(files), "not a regular file"));
}

void IdentityFilesTest::loadsContextsOnlyForSoundFiles()
{
    TestAuthority site;
    const auto files = site.identityOf(robot, "robot");
    const auto loaded = TlsIdentity::load(files.certificate, files.key, files.authority, robot);
    QVERIFY2(loaded, loaded ? "" : loaded.error().what.c_str());
    QCOMPARE(loaded.value()->self(), robot);
    QVERIFY(loaded.value()->serverContext() != loaded.value()->clientContext());
    QVERIFY(!TlsIdentity::load(files.certificate, files.key, files.authority, arm));
}

void IdentityFilesTest::readsOnlyExactUris_data()
{
    QTest::addColumn<std::string>("uri");
    QTest::addColumn<bool>("exact");
    QTest::newRow("exact") << std::string("urn:liena:device:40018208") << true;
    QTest::newRow("letters") << std::string("urn:liena:device:6000820a") << true;
    QTest::newRow("empty") << std::string() << false;
    QTest::newRow("prefix only") << std::string("urn:liena:device:") << false;
    QTest::newRow("upper case") << std::string("urn:liena:device:6000820A") << false;
    QTest::newRow("sign") << std::string("urn:liena:device:-0018208") << false;
    QTest::newRow("nine digits") << std::string("urn:liena:device:400182080") << false;
    QTest::newRow("another kind") << std::string("urn:liena:person:40018208") << false;
    QTest::newRow("space") << std::string("urn:liena:device: 4001820") << false;
}

void IdentityFilesTest::readsOnlyExactUris()
{
    QFETCH(std::string, uri);
    QFETCH(bool, exact);
    const auto device = deviceFromUri(uri);
    QCOMPARE(device.has_value(), exact);
    if (device)
        QCOMPARE(deviceUri(*device), uri);
}

void IdentityFilesTest::explainsUnknownErrorsToo()
{
    QVERIFY(explainTlsFailure(0, X509_V_OK).find("no reason given") != std::string::npos);
    QVERIFY(explainTlsFailure(0, X509_V_ERR_CERT_HAS_EXPIRED).find("expired") != std::string::npos);
    QVERIFY(explainTlsFailure(0, X509_V_ERR_OUT_OF_MEM).find("out of memory") != std::string::npos);
}

void IdentityFilesTest::givesTokensThatDiffer()
{
    std::set<std::uint64_t> tokens;
    for (int i = 0; i < 1000; ++i)
        tokens.insert(randomToken());
    QCOMPARE(tokens.size(), std::size_t(1000));
    QVERIFY(!tokens.contains(0));
}

void IdentityFilesTest::publishesWholeFilesOnly()
{
    const QTemporaryDir folder;
    const auto target = std::filesystem::path(folder.path().toStdString()) / "file";
    {
        const auto staged = StagedFile::write(target, "first", 0600);
        QVERIFY(staged);
        QVERIFY(!std::filesystem::exists(target));
    }
    QVERIFY(std::filesystem::is_empty(target.parent_path()));
    QVERIFY(StagedFile::write(target, "first", 0600).value().publish(false));
    QVERIFY(!StagedFile::write(target, "second", 0600).value().publish(false));
    QCOMPARE(readFile(target).value(), std::string("first"));
    QVERIFY(StagedFile::write(target, "second", 0600).value().publish(true));
    QCOMPARE(readFile(target, Secrecy::Secret).value(), std::string("second"));
    QCOMPARE(std::distance(std::filesystem::directory_iterator(target.parent_path()), {}), 1);
}

void IdentityFilesTest::refusesWritingWhereNothingCanBe()
{
    const QTemporaryDir folder;
    const auto nowhere = std::filesystem::path(folder.path().toStdString()) / "missing" / "file";
    const auto staged = StagedFile::write(nowhere, "text", 0600);
    QVERIFY(!staged);
    QVERIFY(staged.error().code == Errc::FileUnwritable);
    QVERIFY(staged.error().what.find(nowhere.string()) != std::string::npos);
}

QTEST_GUILESS_MAIN(IdentityFilesTest)
#include "identity_files_test.moc"
