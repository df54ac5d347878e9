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

private slots:
    void init();
    void issuesForEveryDeviceOfATopology();
    void issuesForOneDevice();
    void leavesEverythingAloneUnlessToldToReplace();
    void refusesDeviceCalledAsTheAuthority();
    void showsWhatCertificatesSay();
    void tellsByItsStatusThatAFileIsNoCertificate();
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
