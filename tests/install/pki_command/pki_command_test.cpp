// `liena pki` as a person uses it.
#include "liena/certificates.hpp"

#include <QDir>
#include <QFile>
#include <QProcess>
#include <QTemporaryDir>
#include <QTest>

using namespace liena;

namespace {

const QString topology = QStringLiteral(LIENA_SOURCE_DIR "/topologies/cerebrovascular.xml");

struct Outcome {
    int status = -1;
    QString output;
    QString errors;
};

Outcome pki(const QStringList& arguments)
{
    QProcess process;
    process.start(QStringLiteral(LIENA_PROGRAM_DIR "/liena"), QStringList{QStringLiteral("pki")} + arguments);
    if (!process.waitForFinished() || process.exitStatus() != QProcess::NormalExit)
        return {};
    return {process.exitCode(), QString::fromUtf8(process.readAllStandardOutput()), QString::fromUtf8(process.readAllStandardError())};
}

QByteArray contentOf(const QString& file)
{
    QFile stream(file);
    return stream.open(QIODevice::ReadOnly) ? stream.readAll() : QByteArray();
}

} // namespace

class PkiCommandTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void init();
    void issuesForEveryDeviceOfATopology();
    void issuesForOneDevice();
    void leavesEverythingAloneUnlessToldToReplace();
    void refusesDeviceCalledAsTheAuthority();
    void showsWhatCertificatesSay();
    void tellsByItsStatusThatAFileIsNoCertificate();
    void revokesByNameAndBySerial();
    void saysHowToRevokeWhatItReplaces();
    void makesAnEmptyListToBeginWith();
    void refusesWrongUse_data();
    void refusesWrongUse();

private:
    QString file(const char* name) const { return m_folder->filePath(QStringLiteral("pki/") + QLatin1String(name)); }
    QStringList issue(const QStringList& more) const
    {
        return QStringList{QStringLiteral("issue"), QStringLiteral("--dir"), m_folder->filePath(QStringLiteral("pki"))} + more;
    }

    std::unique_ptr<QTemporaryDir> m_folder;
};

/// Before each test: a fresh authority.
void PkiCommandTest::init()
{
    m_folder = std::make_unique<QTemporaryDir>();
    const auto made = pki({QStringLiteral("init"), QStringLiteral("--dir"), m_folder->filePath(QStringLiteral("pki"))});
    QCOMPARE(made.errors, QString());
    QCOMPARE(made.status, 0);
}

void PkiCommandTest::issuesForEveryDeviceOfATopology()
{
    const auto issued = pki(issue({QStringLiteral("--topology"), topology}));
    QCOMPARE(issued.errors, QString());
    QCOMPARE(issued.status, 0);
    const std::vector<std::pair<const char*, std::uint32_t>> devices{
        {"cockpit", 0x40018208U}, {"robot", 0x00008208U}, {"arm", 0x60008208U}, {"xray", 0x20010208U}};
    for (const auto& [name, id] : devices) {
        const auto certificate = file(name).toStdString() + ".crt";
        const auto usable = checkIdentity(certificate, file(name).toStdString() + ".key", file("ca.crt").toStdString(), DeviceId(id));
        QVERIFY2(usable, usable ? "" : usable.error().what.c_str());
    }
}

void PkiCommandTest::issuesForOneDevice()
{
    const QStringList probe{QStringLiteral("--device"), QStringLiteral("probe"), QStringLiteral("--id"), QStringLiteral("0x40018209")};
    QCOMPARE(pki(issue(probe)).status, 0);
    QVERIFY(checkIdentity(file("probe.crt").toStdString(), file("probe.key").toStdString(), file("ca.crt").toStdString(),
                          DeviceId(0x40018209U)));
}

void PkiCommandTest::leavesEverythingAloneUnlessToldToReplace()
{
    QFile inTheWay(file("xray.key"));
    QVERIFY(inTheWay.open(QIODevice::WriteOnly));
    inTheWay.close();
    const auto refused = pki(issue({QStringLiteral("--topology"), topology}));
    QCOMPARE(refused.status, 1);
    QVERIFY(refused.errors.contains(QStringLiteral("xray.key exists already; give --replace")));
    QVERIFY(!QFile::exists(file("cockpit.crt")));
    QCOMPARE(pki(issue({QStringLiteral("--topology"), topology, QStringLiteral("--replace")})).status, 0);
    QVERIFY(!contentOf(file("xray.key")).isEmpty());
}

void PkiCommandTest::refusesDeviceCalledAsTheAuthority()
{
    const auto before = contentOf(file("ca.crt")) + contentOf(file("ca.key"));
    const auto refused = pki(issue({QStringLiteral("--device"), QStringLiteral("ca"), QStringLiteral("--id"), QStringLiteral("0x40018208"),
                                    QStringLiteral("--replace")}));
    QCOMPARE(refused.status, 1);
    QVERIFY(refused.errors.contains(QStringLiteral("cannot be called ca")));
    QCOMPARE(contentOf(file("ca.crt")) + contentOf(file("ca.key")), before);
}

void PkiCommandTest::showsWhatCertificatesSay()
{
    QCOMPARE(pki(issue({QStringLiteral("--topology"), topology, QStringLiteral("--days"), QStringLiteral("30")})).status, 0);
    const auto shown = pki({QStringLiteral("show"), file("ca.crt"), file("arm.crt")});
    QCOMPARE(shown.status, 0);
    for (const auto& words : {"certificate authority", "0x60008208", "29 days left", "urn:liena:device:60008208"})
        QVERIFY2(shown.output.contains(QLatin1String(words)), words);
    const auto info = describeCertificate(file("arm.crt").toStdString());
    QVERIFY(shown.output.contains(QString::fromStdString(info.value().fingerprint)));
}

void PkiCommandTest::tellsByItsStatusThatAFileIsNoCertificate()
{
    const auto shown = pki({QStringLiteral("show"), file("ca.key"), file("ca.crt")});
    QCOMPARE(shown.status, 1);
    QVERIFY(shown.errors.contains(QStringLiteral("ca.key: holds no certificate")));
    QVERIFY(shown.output.contains(QStringLiteral("certificate authority")));
    QVERIFY(!shown.output.contains(QStringLiteral("PRIVATE")));
}

void PkiCommandTest::revokesByNameAndBySerial()
{
    QCOMPARE(pki(issue({QStringLiteral("--topology"), topology})).status, 0);
    const QStringList revoke{QStringLiteral("revoke"), QStringLiteral("--dir"), m_folder->filePath(QStringLiteral("pki"))};
    const auto first = pki(revoke + QStringList{QStringLiteral("xray"), QStringLiteral("--reason"), QStringLiteral("key-compromise")});
    QCOMPARE(first.errors, QString());
    QCOMPARE(first.status, 0);
    const auto serial = QString::fromStdString(describeCertificate(file("arm.crt").toStdString()).value().serial);
    QCOMPARE(pki(revoke + QStringList{QStringLiteral("--serial"), serial.toLower()}).status, 0);
    const auto shown = pki({QStringLiteral("show"), file("ca.crl")});
    QCOMPARE(shown.status, 0);
    QVERIFY(shown.output.contains(serial) && shown.output.contains(QStringLiteral("(key-compromise)")));
    const auto usable = [&](const char* name, std::uint32_t id) {
        return checkIdentity(file(name).toStdString() + ".crt", file(name).toStdString() + ".key", file("ca.crt").toStdString(),
                             DeviceId(id));
    };
    QVERIFY(!usable("xray", 0x20010208U) && !usable("arm", 0x60008208U));
    QVERIFY(usable("robot", 0x00008208U) && usable("cockpit", 0x40018208U));
    const auto unknown = pki(revoke + QStringList{QStringLiteral("robot"), QStringLiteral("scalpel")});
    QCOMPARE(unknown.status, 1);
    QVERIFY(unknown.errors.contains(QStringLiteral("scalpel.crt")));
    QVERIFY(usable("robot", 0x00008208U)); // all or none
}

void PkiCommandTest::saysHowToRevokeWhatItReplaces()
{
    QCOMPARE(pki(issue({QStringLiteral("--topology"), topology})).status, 0);
    const auto serial = QString::fromStdString(describeCertificate(file("xray.crt").toStdString()).value().serial);
    const auto replaced = pki(issue({QStringLiteral("--device"), QStringLiteral("xray"), QStringLiteral("--id"),
                                     QStringLiteral("0x20010208"), QStringLiteral("--replace")}));
    QCOMPARE(replaced.status, 0);
    QVERIFY2(replaced.output.contains(QStringLiteral("--serial ") + serial), qPrintable(replaced.output));
}

void PkiCommandTest::makesAnEmptyListToBeginWith()
{
    const QStringList renew{QStringLiteral("revoke"), QStringLiteral("--dir"), m_folder->filePath(QStringLiteral("pki")),
                            QStringLiteral("--renew")};
    QCOMPARE(pki(renew).status, 0);
    const auto again = pki(renew);
    QVERIFY2(again.output.contains(QStringLiteral("number 02, 0 revoked")), qPrintable(again.output));
}

void PkiCommandTest::refusesWrongUse_data()
{
    QTest::addColumn<QStringList>("arguments");
    const auto row = [](const char* line) { QTest::newRow(line) << QString::fromLatin1(line).split(QLatin1Char(' ')); };
    row("issue --dir x");
    row("issue --dir x --device robot");
    row("issue --dir x --id 0x40018208");
    row("issue --dir x --topology t.xml --device robot --id 0x40018208");
    row("init --dir x --days 0");
    row("init");
    row("show");
    row("sign");
    row("issue --dir x --topology t.xml --days 1");
    row("revoke --dir x");
    row("revoke xray");
    row("revoke --dir x xray --reason boredom");
    row("revoke --dir x xray --days 1");
}

void PkiCommandTest::refusesWrongUse()
{
    QFETCH(QStringList, arguments);
    const auto refused = pki(arguments);
    QCOMPARE(refused.status, 2);
    QVERIFY(!refused.errors.isEmpty());
}

QTEST_GUILESS_MAIN(PkiCommandTest)
#include "pki_command_test.moc"
