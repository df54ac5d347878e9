// The register of message sets, loaded from folders.
#include "marked_text.hpp"

#include "topology/registry.hpp"

#include <QTemporaryDir>

using namespace liena;
using namespace liena::test;

namespace {

QByteArray setOf(const char* name, int type)
{
    return QByteArray("<message-set xmlns=\"urn:liena:message-set:1\" name=\"") + name +
           "\" version=\"1\" class=\"hand\" manufacturer=\"1\" type=\"" + QByteArray::number(type) + "\" device-version=\"3\"/>";
}

std::string write(const QTemporaryDir& folder, const char* name, const QByteArray& bytes)
{
    QFile file(folder.filePath(QLatin1String(name)));
    if (!file.open(QIODevice::WriteOnly) || file.write(bytes) != bytes.size())
        qFatal("the test's file cannot be written");
    return file.fileName().toStdString();
}

std::filesystem::path pathOf(const QTemporaryDir& folder) { return folder.path().toStdString(); }

} // namespace

class RegistryTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void loadsTheReferenceSets();
    void refusesTwoSetsOfOneTypeAndNamesBoth();
    void refusesACopyInTheSameFolder();
    void acceptsTheSameBytesInAnotherFolder();
    void reportsEveryInvalidSet();
    void reportsMissingFolder();
    void isEmptyWithoutFolders();
};

void RegistryTest::loadsTheReferenceSets()
{
    Findings findings;
    const auto registry = Registry::load({sourceFile("resources/devices")}, &findings);
    QVERIFY2(registry && findings.empty(), listed(findings).c_str());
    QVERIFY(registry.value().size() >= 4);
    const auto robot = registry.value().find(DeviceId(0x00008208));
    QCOMPARE(robot->name(), std::string("vascular-robot"));
    QVERIFY(registry.value().find(DeviceId(0x0000820E)) == robot);
    QVERIFY(registry.value().find(robot->hash()) == robot);
    QVERIFY(!registry.value().find(DeviceId(0x00008210)));
    QVERIFY(!registry.value().find(Sha256{}));
}

void RegistryTest::refusesTwoSetsOfOneTypeAndNamesBoth()
{
    const QTemporaryDir folder;
    const auto first = write(folder, "a.xml", setOf("one", 1));
    const auto second = write(folder, "b.xml", setOf("two", 1));
    Findings findings;
    const auto registry = Registry::load({pathOf(folder)}, &findings);
    QVERIFY(!registry);
    QVERIFY(registry.error().code == Errc::MessageSetInvalid);
    QCOMPARE(findings.size(), 1U);
    QCOMPARE(findings[0].file, second);
    QVERIFY(findings[0].text.find(first) != std::string::npos);
}

void RegistryTest::refusesACopyInTheSameFolder()
{
    const QTemporaryDir folder;
    write(folder, "a.xml", setOf("one", 1));
    write(folder, "b.xml", setOf("one", 1));
    QVERIFY(!Registry::load({pathOf(folder)}));
}

void RegistryTest::acceptsTheSameBytesInAnotherFolder()
{
    const QTemporaryDir one;
    const QTemporaryDir two;
    write(one, "a.xml", setOf("one", 1));
    write(two, "a.xml", setOf("one", 1));
    write(two, "b.xml", setOf("two", 2));
    write(two, "notes.txt", "nothing");
    const auto registry = Registry::load({pathOf(one), pathOf(two)});
    QVERIFY(registry);
    QCOMPARE(registry.value().size(), 2U);
    write(two, "a.xml", setOf("changed", 1));
    QVERIFY(!Registry::load({pathOf(one), pathOf(two)}));
}

void RegistryTest::reportsEveryInvalidSet()
{
    const QTemporaryDir folder;
    write(folder, "a.xml", "<message-set");
    write(folder, "b.xml", setOf("good", 1));
    write(folder, "c.xml", setOf("bad", 99));
    Findings findings;
    QVERIFY(!Registry::load({pathOf(folder)}, &findings));
    QCOMPARE(findings.size(), 2U);
    QVERIFY(findings[0].file.ends_with("a.xml"));
    QVERIFY(findings[1].file.ends_with("c.xml"));
}

void RegistryTest::reportsMissingFolder()
{
    const auto registry = Registry::load({"/nonexistent/devices"});
    QVERIFY(!registry);
    QVERIFY(registry.error().what.find("/nonexistent/devices") != std::string::npos);
}

void RegistryTest::isEmptyWithoutFolders()
{
    const auto registry = Registry::load({});
    QVERIFY(registry);
    QCOMPARE(registry.value().size(), 0U);
}

QTEST_APPLESS_MAIN(RegistryTest)
#include "registry_test.moc"
