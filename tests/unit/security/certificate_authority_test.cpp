// The authority's folder: what is written, how, and what is refused.
#include "liena/certificates.hpp"
#include "support/forged_certificate.hpp"
#include "support/test_authority.hpp"

#include <QFile>
#include <QTemporaryDir>
#include <QTest>

#include <algorithm>
#include <fstream>

#include <sys/stat.h>

using namespace liena;
using namespace liena::test;

namespace {

constexpr DeviceId robot(0x00008208U);
constexpr auto oneDay = std::chrono::hours(24);

std::string content(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

unsigned modeOf(const std::filesystem::path& file)
{
    struct stat status {};
    return ::stat(file.c_str(), &status) == 0 ? status.st_mode & 07777U : 0U;
}

std::vector<std::string> filesIn(const std::filesystem::path& folder)
{
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

} // namespace

class CertificateAuthorityTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void writesAuthorityThatSignsAndNothingElse();
    void writesDeviceThatIsClientAndServer();
    void keepsKeysToTheirOwner();
    void leavesNoTemporaryFiles();
    void givesEverySerialOnce();
    void refusesFolderThatHoldsAnAuthority();
    void refusesSecondIssueUnlessReplaced();
    void leavesBothFilesWhenOneIsInTheWay();
    void refusesName_data();
    void refusesName();
    void refusesImpossibleDevice_data();
    void refusesImpossibleDevice();
    void refusesSite_data();
    void refusesSite();
    void makesNoFolderForBadSite();
    void refusesValidityBeyondTheAuthority();
    void refusesValidity_data();
    void refusesValidity();
    void refusesToOpenKeyThatOthersCanRead();
    void refusesToOpenEmptyFolder();
    void refusesToOpenMixedFiles();
    void refusesToOpenWithDeviceCertificate();
};

void CertificateAuthorityTest::writesAuthorityThatSignsAndNothingElse()
{
    const TestAuthority site;
    const auto info = describeCertificate(site.certificate());
    QVERIFY2(info, info ? "" : info.error().what.c_str());
    QVERIFY(info.value().isAuthority);
    QVERIFY(info.value().devices.empty());
    QVERIFY(info.value().subject.find("Test site") != std::string::npos);
    QCOMPARE(info.value().subject, info.value().issuer);
    const auto forged = loadForged(site.certificate(), site.key());
    QCOMPARE(X509_get_key_usage(forged.certificate.get()), static_cast<std::uint32_t>(KU_KEY_CERT_SIGN | KU_CRL_SIGN));
    QVERIFY(X509_get0_subject_key_id(forged.certificate.get()) != nullptr);
    QVERIFY(X509_get0_authority_key_id(forged.certificate.get()) != nullptr);
    QCOMPARE(X509_get_ext_by_NID(forged.certificate.get(), NID_ext_key_usage, -1), -1);
}

void CertificateAuthorityTest::writesDeviceThatIsClientAndServer()
{
    TestAuthority site;
    const auto files = site.identityOf(robot, "robot");
    const auto info = describeCertificate(files.certificate);
    QVERIFY2(info, info ? "" : info.error().what.c_str());
    QVERIFY(!info.value().isAuthority);
    QCOMPARE(info.value().uris, std::vector<std::string>{"urn:liena:device:00008208"});
    QCOMPARE(info.value().devices, std::vector<DeviceId>{robot});
    QCOMPARE(info.value().subject, std::string("CN = robot"));
    QCOMPARE(info.value().fingerprint.size(), std::size_t(64));
    const auto now = std::chrono::system_clock::now();
    QVERIFY(info.value().notBefore < now - std::chrono::minutes(4) && info.value().notBefore > now - std::chrono::minutes(10));
    QVERIFY(info.value().notAfter > now + std::chrono::hours(47) && info.value().notAfter <= now + 2 * oneDay);
    const auto forged = loadForged(files.certificate, files.key);
    QCOMPARE(X509_get_key_usage(forged.certificate.get()), static_cast<std::uint32_t>(KU_DIGITAL_SIGNATURE));
    QCOMPARE(X509_get_extended_key_usage(forged.certificate.get()), static_cast<std::uint32_t>(XKU_SSL_SERVER | XKU_SSL_CLIENT));
    QCOMPARE(EVP_PKEY_get_bits(forged.key.get()), 256);
    const auto usable = checkIdentity(files.certificate, files.key, files.authority, robot);
    QVERIFY2(usable, usable ? "" : usable.error().what.c_str());
}

void CertificateAuthorityTest::keepsKeysToTheirOwner()
{
    const auto before = ::umask(0);
    TestAuthority site;
    const auto files = site.identityOf(robot, "robot");
    ::umask(before);
    QCOMPARE(modeOf(site.key()), 0600U);
    QCOMPARE(modeOf(files.key), 0600U);
    QCOMPARE(modeOf(files.certificate), 0644U);
    QVERIFY(content(files.certificate).find("PRIVATE") == std::string::npos);
}

void CertificateAuthorityTest::leavesNoTemporaryFiles()
{
    TestAuthority site;
    site.identityOf(robot, "robot");
    QVERIFY(CertificateAuthority::open(site.folder()).value().issue(robot, "robot", 2 * oneDay, true));
    QCOMPARE(filesIn(site.folder()), (std::vector<std::string>{"ca.crt", "ca.key", "robot.crt", "robot.key"}));
}

void CertificateAuthorityTest::givesEverySerialOnce()
{
    TestAuthority site;
    const auto one = describeCertificate(site.identityOf(robot, "one").certificate).value();
    const auto other = describeCertificate(site.identityOf(robot, "other").certificate).value();
    QVERIFY(one.serial != other.serial);
    QVERIFY(one.serial.size() >= 24); // 128 random bits have more than 32 leading zeros once in four thousand million
    QVERIFY(one.serial.front() != '-');
}

void CertificateAuthorityTest::refusesFolderThatHoldsAnAuthority()
{
    const TestAuthority site;
    const auto before = content(site.certificate()) + content(site.key());
    const auto second = CertificateAuthority::create(site.folder(), "Other", oneDay);
    QVERIFY(!second);
    QVERIFY(second.error().code == Errc::FileUnwritable);
    QVERIFY(second.error().what.find("ca.crt exists already") != std::string::npos);
    QCOMPARE(content(site.certificate()) + content(site.key()), before);
}

void CertificateAuthorityTest::refusesSecondIssueUnlessReplaced()
{
    TestAuthority site;
    const auto files = site.identityOf(robot, "robot");
    const auto before = content(files.certificate);
    const auto authority = CertificateAuthority::open(site.folder()).value();
    const auto again = authority.issue(robot, "robot", oneDay);
    QVERIFY(!again);
    QVERIFY(again.error().what.find("robot.crt exists already") != std::string::npos);
    QCOMPARE(content(files.certificate), before);
    QVERIFY(authority.issue(robot, "robot", 2 * oneDay, true));
    QVERIFY(content(files.certificate) != before);
    QVERIFY(checkIdentity(files.certificate, files.key, files.authority, robot));
}

void CertificateAuthorityTest::leavesBothFilesWhenOneIsInTheWay()
{
    const TestAuthority site;
    std::ofstream(site.folder() / "robot.crt") << "something else";
    QVERIFY(!CertificateAuthority::open(site.folder()).value().issue(robot, "robot", oneDay));
    QCOMPARE(content(site.folder() / "robot.crt"), std::string("something else"));
    QVERIFY(!std::filesystem::exists(site.folder() / "robot.key"));
}

void CertificateAuthorityTest::refusesName_data()
{
    QTest::addColumn<std::string>("name");
    QTest::newRow("empty") << std::string();
    QTest::newRow("parent") << std::string("../robot");
    QTest::newRow("path") << std::string("a/b");
    QTest::newRow("absolute") << std::string("/tmp/robot");
    QTest::newRow("dot") << std::string("a.b");
    QTest::newRow("hidden") << std::string(".robot");
    QTest::newRow("digit first") << std::string("1robot");
    QTest::newRow("option") << std::string("-robot");
    QTest::newRow("space") << std::string("a b");
    QTest::newRow("NUL") << std::string("robot\0x", 7);
    QTest::newRow("umlaut") << std::string("r\xc3\xb6ntgen");
    QTest::newRow("65 characters") << std::string(65, 'a');
    QTest::newRow("the authority's") << std::string("ca");
    QTest::newRow("the authority's in capitals") << std::string("CA");
}

void CertificateAuthorityTest::refusesName()
{
    QFETCH(std::string, name);
    const TestAuthority site;
    const auto issued = CertificateAuthority::open(site.folder()).value().issue(robot, name, oneDay, true);
    QVERIFY(!issued);
    QVERIFY(issued.error().code == Errc::InvalidArgument);
    QCOMPARE(filesIn(site.folder()), (std::vector<std::string>{"ca.crt", "ca.key"}));
    QVERIFY(CertificateAuthority::open(site.folder()));
}

void CertificateAuthorityTest::refusesImpossibleDevice_data()
{
    QTest::addColumn<std::uint32_t>("id");
    QTest::newRow("broadcast") << 0xFFFFFFFFU;
    QTest::newRow("index 7") << 0x0000820FU;
    QTest::newRow("reserved class") << 0x80008208U;
}

void CertificateAuthorityTest::refusesImpossibleDevice()
{
    QFETCH(std::uint32_t, id);
    const TestAuthority site;
    const auto issued = CertificateAuthority::open(site.folder()).value().issue(DeviceId(id), "robot", oneDay);
    QVERIFY(!issued);
    QVERIFY(issued.error().code == Errc::InvalidArgument);
    QCOMPARE(filesIn(site.folder()).size(), std::size_t(2));
}

void CertificateAuthorityTest::refusesSite_data()
{
    QTest::addColumn<std::string>("site");
    QTest::newRow("empty") << std::string();
    QTest::newRow("too long") << std::string(65, 's');
    QTest::newRow("line break") << std::string("a\nb");
    QTest::newRow("invalid UTF-8") << std::string("a\xff");
}

void CertificateAuthorityTest::refusesSite()
{
    QFETCH(std::string, site);
    const QTemporaryDir folder;
    const auto made = CertificateAuthority::create(folder.path().toStdString(), site, oneDay);
    QVERIFY(!made);
    QVERIFY(made.error().code == Errc::InvalidArgument);
}

void CertificateAuthorityTest::makesNoFolderForBadSite()
{
    const QTemporaryDir folder;
    const auto inside = std::filesystem::path(folder.path().toStdString()) / "pki";
    QVERIFY(!CertificateAuthority::create(inside, "", oneDay));
    QVERIFY(!std::filesystem::exists(inside));
    QVERIFY(CertificateAuthority::create(inside, "Site", oneDay));
    QCOMPARE(modeOf(inside), 0700U);
}

void CertificateAuthorityTest::refusesValidityBeyondTheAuthority()
{
    const TestAuthority site;
    const auto issued = CertificateAuthority::open(site.folder()).value().issue(robot, "robot", 3 * oneDay);
    QVERIFY(!issued);
    QVERIFY(issued.error().what.find("outlive its authority") != std::string::npos);
}

void CertificateAuthorityTest::refusesValidity_data()
{
    QTest::addColumn<int>("hours");
    QTest::newRow("none") << 0;
    QTest::newRow("negative") << -24;
    QTest::newRow("beyond a hundred years") << 24 * 36501;
}

void CertificateAuthorityTest::refusesValidity()
{
    QFETCH(int, hours);
    const QTemporaryDir folder;
    QVERIFY(!CertificateAuthority::create(folder.path().toStdString(), "Site", std::chrono::hours(hours)));
    QVERIFY(filesIn(folder.path().toStdString()).empty());
}

void CertificateAuthorityTest::refusesToOpenKeyThatOthersCanRead()
{
    const TestAuthority site;
    std::filesystem::permissions(site.key(), std::filesystem::perms::group_read, std::filesystem::perm_options::add);
    const auto opened = CertificateAuthority::open(site.folder());
    QVERIFY(!opened);
    QVERIFY(opened.error().code == Errc::FileUnreadable);
    QVERIFY(opened.error().what.find("chmod 600 " + site.key().string()) != std::string::npos);
}

void CertificateAuthorityTest::refusesToOpenEmptyFolder()
{
    const QTemporaryDir folder;
    const auto opened = CertificateAuthority::open(folder.path().toStdString());
    QVERIFY(!opened);
    QVERIFY(opened.error().what.find("ca.crt") != std::string::npos);
}

void CertificateAuthorityTest::refusesToOpenMixedFiles()
{
    const TestAuthority site;
    const TestAuthority other;
    std::filesystem::copy_file(other.certificate(), site.certificate(), std::filesystem::copy_options::overwrite_existing);
    const auto opened = CertificateAuthority::open(site.folder());
    QVERIFY(!opened);
    QVERIFY(opened.error().what.find("is not the key of") != std::string::npos);
}

void CertificateAuthorityTest::refusesToOpenWithDeviceCertificate()
{
    TestAuthority site;
    const auto device = site.identityOf(robot, "robot");
    std::filesystem::rename(device.certificate, site.certificate());
    std::filesystem::rename(device.key, site.key());
    const auto opened = CertificateAuthority::open(site.folder());
    QVERIFY(!opened);
    QVERIFY(opened.error().what.find("not an authority") != std::string::npos);
}

QTEST_GUILESS_MAIN(CertificateAuthorityTest)
#include "certificate_authority_test.moc"
