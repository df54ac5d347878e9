// The local store under hostile content, planted links, a full quota and several writers.
#include "marked_text.hpp"

#include "topology/local_store.hpp"

#include <QDir>
#include <QTemporaryDir>

#include <sys/stat.h>
#include <unistd.h>

#include <thread>

using namespace liena;
using namespace liena::test;

namespace {

std::shared_ptr<const MessageSet> makeSet(int version)
{
    const auto xml = "<message-set xmlns=\"urn:liena:message-set:1\" name=\"probe\" version=\"" + std::to_string(version) +
                     "\" class=\"hand\" manufacturer=\"1\" type=\"2\" device-version=\"3\"/>";
    return MessageSet::parse(xml, "made").value();
}

const DeviceId robotType(0x00008208);
const DeviceId armType(0x60008208);

} // namespace

class LocalStoreTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void init();
    void returnsWhatItSaved();
    void hasNothingAtFirst();
    void keepsBytesWithModeForOwnerOnly();
    void savesTwiceWithoutHarm();
    void survivesAnotherOpening();
    void refusesFileWithOtherContent();
    void repairsFileWithOtherContentWhenSavedAgain();
    void refusesPlantedLink_data();
    void refusesPlantedLink();
    void refusesPipeWithoutWaiting();
    void refusesDirectoryInAFilesPlace();
    void writesThroughNoPlantedTemporary();
    void removesLeftoverOfADeadWriter();
    void keepsAtMost64Sets();
    void leavesNoPartWhenItCannotWrite();
    void reportsFolderThatCannotBe();
    void pinsFirstSetMet();
    void replacesPinForAPerson();
    void refusesToGuessAtDamagedPins_data();
    void refusesToGuessAtDamagedPins();
    void losesNoPinToAnotherWriter();

private:
    LocalStore open() const { return LocalStore::open(m_folder->path().toStdString()).value(); }
    std::string inFolder(const std::string& name) const { return m_folder->path().toStdString() + "/" + name; }
    static std::string nameOf(const MessageSet& set) { return set.hash().toHex() + ".xml"; }
    static void write(const std::string& path, const QByteArray& bytes);

    std::unique_ptr<QTemporaryDir> m_folder;
};

void LocalStoreTest::init()
{
    m_folder = std::make_unique<QTemporaryDir>();
    QVERIFY(m_folder->isValid());
}

void LocalStoreTest::write(const std::string& path, const QByteArray& bytes)
{
    QFile file(QString::fromStdString(path));
    if (!file.open(QIODevice::WriteOnly) || file.write(bytes) != bytes.size())
        qFatal("the test's file cannot be written");
}

void LocalStoreTest::returnsWhatItSaved()
{
    auto store = open();
    const auto set = makeSet(1);
    QVERIFY(store.save(*set));
    const auto found = store.find(set->hash());
    QVERIFY(found);
    QCOMPARE(found.value()->xml(), set->xml());
    QVERIFY(found.value()->hash() == set->hash());
}

void LocalStoreTest::hasNothingAtFirst()
{
    const auto store = open();
    const auto found = store.find(makeSet(1)->hash());
    QVERIFY(found);
    QVERIFY(!found.value());
    const auto pin = store.pinFor(robotType);
    QVERIFY(pin);
    QVERIFY(!pin.value());
}

void LocalStoreTest::keepsBytesWithModeForOwnerOnly()
{
    const auto set = makeSet(1);
    const auto before = umask(0);
    const auto saved = open().save(*set);
    const auto made = LocalStore::open(inFolder("new"));
    umask(before);
    QVERIFY(saved && made);
    struct stat status {};
    QCOMPARE(stat(inFolder(nameOf(*set)).c_str(), &status), 0);
    QCOMPARE(status.st_mode & 07777U, 0600U);
    QCOMPARE(stat(inFolder("new").c_str(), &status), 0);
    QCOMPARE(status.st_mode & 07777U, 0700U);
    QCOMPARE(bytesOf(inFolder(nameOf(*set))).toStdString(), set->xml());
}

void LocalStoreTest::savesTwiceWithoutHarm()
{
    auto store = open();
    QVERIFY(store.save(*makeSet(1)));
    QVERIFY(store.save(*makeSet(1)));
    QCOMPARE(QDir(m_folder->path()).entryList(QDir::Files).size(), 1);
}

void LocalStoreTest::survivesAnotherOpening()
{
    QVERIFY(open().save(*makeSet(1)));
    QVERIFY(open().accept(robotType, makeSet(1)->hash()));
    QVERIFY(open().find(makeSet(1)->hash()).value());
    QVERIFY(open().pinFor(robotType).value()->hash == makeSet(1)->hash());
}

void LocalStoreTest::refusesFileWithOtherContent()
{
    const auto set = makeSet(1);
    write(inFolder(nameOf(*set)), QByteArray::fromStdString(makeSet(2)->xml()));
    const auto found = open().find(set->hash());
    QVERIFY(!found);
    QVERIFY(found.error().code == Errc::MessageSetInvalid);
    QVERIFY(found.error().what.find(nameOf(*set)) != std::string::npos);
}

void LocalStoreTest::repairsFileWithOtherContentWhenSavedAgain()
{
    const auto set = makeSet(1);
    write(inFolder(nameOf(*set)), "half a fi");
    QVERIFY(open().save(*set));
    QVERIFY(open().find(set->hash()).value());
}

void LocalStoreTest::refusesPlantedLink_data()
{
    QTest::addColumn<QByteArray>("target");
    QTest::newRow("out of the folder") << QByteArray("../outside.xml");
    QTest::newRow("absolute") << QByteArray("/etc/passwd");
    QTest::newRow("inside the folder") << QByteArray("innocent.xml");
    QTest::newRow("to nothing") << QByteArray("nowhere");
}

void LocalStoreTest::refusesPlantedLink()
{
    QFETCH(QByteArray, target);
    QTemporaryDir outer;
    const auto folder = outer.path().toStdString() + "/store";
    auto store = LocalStore::open(folder).value();
    const auto set = makeSet(1);
    const auto outside = outer.path().toStdString() + "/outside.xml";
    write(outside, QByteArray::fromStdString(set->xml()));
    write(folder + "/innocent.xml", QByteArray::fromStdString(set->xml()));
    QCOMPARE(symlink(target.constData(), (folder + "/" + nameOf(*set)).c_str()), 0);
    QVERIFY(!store.find(set->hash()));
    // Saving replaces the link and leaves what it led to alone.
    const auto before = bytesOf(outside);
    QVERIFY(store.save(*set));
    QVERIFY(store.find(set->hash()).value());
    QVERIFY(!QFileInfo(QString::fromStdString(folder + "/" + nameOf(*set))).isSymLink());
    QCOMPARE(bytesOf(outside), before);
    QVERIFY(!QFileInfo::exists(QString::fromStdString(folder + "/nowhere")));
}

void LocalStoreTest::refusesPipeWithoutWaiting()
{
    const auto set = makeSet(1);
    QCOMPARE(mkfifo(inFolder(nameOf(*set)).c_str(), 0600), 0);
    QCOMPARE(mkfifo(inFolder("pins").c_str(), 0600), 0);
    QVERIFY(!open().find(set->hash()));
    QVERIFY(!open().pinFor(robotType));
    QVERIFY(open().save(*set));
    QVERIFY(open().find(set->hash()).value());
}

void LocalStoreTest::refusesDirectoryInAFilesPlace()
{
    const auto set = makeSet(1);
    QVERIFY(QDir(m_folder->path()).mkdir(QString::fromStdString(nameOf(*set))));
    QVERIFY(!open().find(set->hash()));
    const auto saved = open().save(*set);
    QVERIFY(!saved);
    QVERIFY(saved.error().code == Errc::FileUnwritable);
    QVERIFY(!QFileInfo::exists(QString::fromStdString(inFolder("incoming.tmp"))));
}

void LocalStoreTest::writesThroughNoPlantedTemporary()
{
    QTemporaryDir outer;
    const auto victim = outer.path().toStdString() + "/victim";
    write(victim, "precious");
    QCOMPARE(symlink(victim.c_str(), inFolder("incoming.tmp").c_str()), 0);
    QVERIFY(open().save(*makeSet(1)));
    QCOMPARE(bytesOf(victim), QByteArray("precious"));
    QVERIFY(open().find(makeSet(1)->hash()).value());
}

void LocalStoreTest::removesLeftoverOfADeadWriter()
{
    write(inFolder("incoming.tmp"), "half");
    QVERIFY(open().save(*makeSet(1)));
    QVERIFY(!QFileInfo::exists(QString::fromStdString(inFolder("incoming.tmp"))));
}

void LocalStoreTest::keepsAtMost64Sets()
{
    auto store = open();
    write(inFolder("notes.xml"), "not a set");
    for (int version = 0; version < 64; ++version)
        QVERIFY(store.save(*makeSet(version)));
    const auto one = store.save(*makeSet(64));
    QVERIFY(!one);
    QVERIFY(one.error().code == Errc::FileUnwritable);
    QVERIFY(one.error().what.find("64 message sets") != std::string::npos);
    QVERIFY(!store.find(makeSet(64)->hash()).value());
    QVERIFY(store.save(*makeSet(63)));
    QVERIFY(store.accept(robotType, makeSet(63)->hash()));
}

void LocalStoreTest::leavesNoPartWhenItCannotWrite()
{
    auto store = open();
    if (geteuid() == 0) {
        // Root may write anywhere: the folder is taken away instead.
        m_folder->remove();
    } else {
        QCOMPARE(chmod(m_folder->path().toStdString().c_str(), 0500), 0);
    }
    const auto saved = store.save(*makeSet(1));
    chmod(m_folder->path().toStdString().c_str(), 0700);
    QVERIFY(!saved);
    QVERIFY(saved.error().code == Errc::FileUnwritable);
    QVERIFY(QDir(m_folder->path()).entryList(QDir::Files).isEmpty());
}

void LocalStoreTest::reportsFolderThatCannotBe()
{
    write(inFolder("file"), "x");
    QVERIFY(LocalStore::open(inFolder("file")).error().code == Errc::FileUnreadable);
    const auto deep = LocalStore::open(inFolder("a/b"));
    QVERIFY(deep.error().code == Errc::FileUnwritable);
    QVERIFY(deep.error().what.find("a/b") != std::string::npos);
}

void LocalStoreTest::pinsFirstSetMet()
{
    auto store = open();
    QVERIFY(store.pinFirst(robotType, makeSet(1)->hash()).value() == makeSet(1)->hash());
    QVERIFY(store.pinFirst(robotType, makeSet(2)->hash()).value() == makeSet(1)->hash());
    QVERIFY(store.pinFor(robotType).value()->hash == makeSet(1)->hash());
    QVERIFY(!store.pinFor(armType).value());
    // A pin is of the device type: every index has it.
    QVERIFY(store.pinFor(DeviceId(robotType.value() + 6)).value()->hash == makeSet(1)->hash());
    QVERIFY(store.pinFirst(DeviceId(robotType.value() + 1), makeSet(3)->hash()).value() == makeSet(1)->hash());
}

void LocalStoreTest::replacesPinForAPerson()
{
    auto store = open();
    QVERIFY(store.accept(robotType, makeSet(1)->hash()));
    QVERIFY(store.accept(armType, makeSet(3)->hash()));
    QVERIFY(store.accept(DeviceId(robotType.value() + 2), makeSet(2)->hash()));
    QVERIFY(store.pinFor(robotType).value()->hash == makeSet(2)->hash());
    QVERIFY(store.pinFor(armType).value()->hash == makeSet(3)->hash());
    QCOMPARE(bytesOf(inFolder("pins")).toStdString(),
             "0x00008208 " + makeSet(2)->hash().toHex() + " accepted\n0x60008208 " + makeSet(3)->hash().toHex() + " accepted\n");
}

void LocalStoreTest::refusesToGuessAtDamagedPins_data()
{
    QTest::addColumn<QByteArray>("bytes");
    const auto line = QByteArray("0x00008208 ") + QByteArray(64, 'a');
    QTest::newRow("cut off") << line.left(40) + "\n";
    QTest::newRow("without its end") << line;
    QTest::newRow("with an index") << QByteArray(line + "\n").replace("8208", "8209");
    QTest::newRow("twice") << line + "\n" + line + "\n";
    QTest::newRow("noise") << QByteArray("\0\0\0\0", 4);
    QTest::newRow("with another word") << line + " trusted\n";
    QTest::newRow("upper case") << QByteArray("0x00008208 ") + QByteArray(64, 'A') + "\n";
}

void LocalStoreTest::refusesToGuessAtDamagedPins()
{
    QFETCH(QByteArray, bytes);
    write(inFolder("pins"), bytes);
    auto store = open();
    QVERIFY(!store.pinFor(robotType));
    QVERIFY(!store.pinFor(armType));
    QVERIFY(!store.pinFirst(armType, makeSet(1)->hash()));
    QVERIFY(!store.accept(armType, makeSet(1)->hash()));
    QCOMPARE(bytesOf(inFolder("pins")), bytes);
}

void LocalStoreTest::losesNoPinToAnotherWriter()
{
    constexpr std::uint32_t each = 20;
    const auto writer = [this](std::uint32_t first) {
        auto store = open();
        for (std::uint32_t i = 0; i < each; ++i)
            if (!store.pinFirst(DeviceId(first + i * 8), Sha256::of("x")))
                qFatal("a pin could not be written");
    };
    std::thread one(writer, 0x1000U);
    std::thread two(writer, 0x2000U);
    one.join();
    two.join();
    QCOMPARE(bytesOf(inFolder("pins")).count('\n'), static_cast<int>(2 * each));
}

QTEST_APPLESS_MAIN(LocalStoreTest)
#include "local_store_test.moc"
