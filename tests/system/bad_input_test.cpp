// Wrong input on the command line of the real programs: one clear sentence, the right status, and nothing left running.
#include "child_process.hpp"
#include "test_system.hpp"

#include <QFile>
#include <QTest>

using namespace liena::test;

namespace {

QString write(const TestSystem& system, const QString& name, const QByteArray& bytes)
{
    const auto path = QString::fromStdString(system.folder().string()) + QLatin1Char('/') + name;
    QFile file(path);
    if (!file.open(QIODevice::WriteOnly) || file.write(bytes) != bytes.size())
        throw std::runtime_error("cannot write " + path.toStdString());
    return path;
}

QByteArray contents(const std::filesystem::path& path)
{
    QFile file(QString::fromStdString(path.string()));
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

void replace(QStringList& arguments, const char* option, const QString& value)
{
    arguments[arguments.indexOf(QLatin1String(option)) + 1] = value;
}

/// Changes a good command line into a bad one.
using Spoil = void (*)(TestSystem&, QStringList&);

struct Row {
    const char* name;
    Spoil spoil;
    QStringList expected;
};

const std::vector<Row>& rows()
{
    static const std::vector<Row> all{
        {"topology missing",
         [](TestSystem&, QStringList& a) { replace(a, "--topology", QStringLiteral("/no/such/topology.xml")); },
         {QStringLiteral("/no/such/topology.xml")}},
        {"topology cut off",
         [](TestSystem& s, QStringList& a) {
             replace(a, "--topology", write(s, QStringLiteral("cut.xml"), contents(s.topology()).left(300)));
         },
         {QStringLiteral("cut.xml:")}},
        {"topology with a document type",
         [](TestSystem& s, QStringList& a) {
             replace(a, "--topology", write(s, QStringLiteral("dtd.xml"), "<!DOCTYPE topology>\n" + contents(s.topology())));
         },
         {QStringLiteral("dtd.xml:1:1")}},
        {"topology with an unknown attribute",
         [](TestSystem& s, QStringList& a) {
             replace(a, "--topology",
                     write(s, QStringLiteral("odd.xml"), contents(s.topology()).replace("name=\"test\"", "name=\"test\" colour=\"red\"")));
         },
         {QStringLiteral("odd.xml:1:"), QStringLiteral("colour")}},
        {"device not in the topology",
         [](TestSystem&, QStringList& a) { replace(a, "--device", QStringLiteral("scalpel")); },
         {QStringLiteral("scalpel")}},
        {"register missing",
         [](TestSystem&, QStringList& a) { replace(a, "--registry", QStringLiteral("/no/such/register")); },
         {QStringLiteral("/no/such/register")}},
        {"certificate missing",
         [](TestSystem&, QStringList& a) { replace(a, "--certificate", QStringLiteral("/no/such/robot.crt")); },
         {QStringLiteral("/no/such/robot.crt")}},
        {"certificate of another device",
         [](TestSystem& s, QStringList& a) {
             const auto other = s.identityOf("arm");
             replace(a, "--certificate", QString::fromStdString(other.certificate.string()));
             replace(a, "--key", QString::fromStdString(other.key.string()));
         },
         {QStringLiteral("0x60008208")}},
        {"key that others can read",
         [](TestSystem& s, QStringList& a) {
             const auto key = write(s, QStringLiteral("open.key"), contents(a[a.indexOf(QStringLiteral("--key")) + 1].toStdString()));
             QFile::setPermissions(key, QFile::ReadOwner | QFile::WriteOwner | QFile::ReadGroup | QFile::ReadOther);
             replace(a, "--key", key);
         },
         {QStringLiteral("open.key"), QStringLiteral("chmod 600")}},
    };
    return all;
}

} // namespace

class BadInputTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void aProgramSaysWhatIsWrongAndEnds_data()
    {
        QTest::addColumn<int>("row");
        QTest::addColumn<QString>("program");
        for (std::size_t i = 0; i < rows().size(); ++i) {
            QTest::addRow("liena-device: %s", rows()[i].name) << static_cast<int>(i) << QStringLiteral("liena-device");
            QTest::addRow("liena-console: %s", rows()[i].name) << static_cast<int>(i) << QStringLiteral("liena-console");
        }
    }
    void aProgramSaysWhatIsWrongAndEnds()
    {
        QFETCH(int, row);
        QFETCH(QString, program);
        TestSystem system({reference::cockpit, reference::robot, reference::arm}, {"cockpit robot", "cockpit arm"});
        const bool console = program == QLatin1String("liena-console");
        auto arguments = system.argumentsOf(console ? "cockpit" : "robot");
        rows()[static_cast<std::size_t>(row)].spoil(system, arguments);
        if (!console)
            arguments.prepend(QStringLiteral("robot"));
        expectRefusal(program, arguments, rows()[static_cast<std::size_t>(row)].expected);
    }

    void aPortInUseIsNamed()
    {
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"});
        TestDevice first(system.settingsOf("robot"));
        expectRefusal(QStringLiteral("liena-device"), QStringList{QStringLiteral("robot")} + system.argumentsOf("robot"),
                      {QStringLiteral("127.0.0.1:%1").arg(system.portOf("robot")), QStringLiteral("another program")});
    }

    void aDamagedDicomFileIsRefused_data()
    {
        QTest::addColumn<QByteArray>("bytes");
        QTest::newRow("empty") << QByteArray();
        QTest::newRow("text") << QByteArray("this is no DICOM file");
        QTest::newRow("header only") << QByteArray(128, '\0') + "DICM";
        QFile cine(qEnvironmentVariable("LIENA_SHARED_DATA", QStringLiteral(LIENA_SOURCE_DIR "/../shared/data")) +
                   QStringLiteral("/dicom-xa/wg04_XA1_UNC.dcm"));
        if (cine.open(QIODevice::ReadOnly))
            QTest::newRow("cut off in its pixels") << cine.read(500000);
    }
    void aDamagedDicomFileIsRefused()
    {
        QFETCH(QByteArray, bytes);
        TestSystem system({reference::cockpit, reference::xray}, {"cockpit xray"});
        const auto file = write(system, QStringLiteral("damaged.dcm"), bytes);
        expectRefusal(QStringLiteral("liena-device"),
                      QStringList{QStringLiteral("xray")} + system.argumentsOf("xray") + QStringList{QStringLiteral("--dicom"), file},
                      {QStringLiteral("damaged.dcm")});
    }

private:
    static void expectRefusal(const QString& program, const QStringList& arguments, const QStringList& expected)
    {
        ChildProcess process(program, arguments);
        QCOMPARE(process.waitForEnd(), 1);
        const auto output = process.output();
        for (const auto& part : expected)
            QVERIFY2(output.contains(part), qPrintable(output));
        QVERIFY2(!output.contains(QStringLiteral("terminate called")), qPrintable(output));
        QVERIFY(!process.isRunning());
    }
};

QTEST_GUILESS_MAIN(BadInputTest)
#include "bad_input_test.moc"
