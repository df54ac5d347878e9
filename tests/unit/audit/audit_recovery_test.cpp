// What a crash left in the audit file is marked by the next start, also when that one is interrupted in turn.
#include "audit/audit_file.hpp"
#include "file_content.hpp"
#include "liena/audit.hpp"

#include <QTemporaryDir>
#include <QTest>

#include <csignal>
#include <fstream>
#include <iterator>
#include <string>

#include <sys/resource.h>

using namespace liena;
using namespace liena::audit;
using liena::test::contentOf;
using liena::test::write;

namespace {

/// No file of this process grows beyond `bytes`, as on a disk that is full.
class FullDisk {
public:
    explicit FullDisk(std::uintmax_t bytes) : m_signal(std::signal(SIGXFSZ, SIG_IGN))
    {
        ::getrlimit(RLIMIT_FSIZE, &m_before);
        const rlimit limit{static_cast<rlim_t>(bytes), m_before.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FullDisk()
    {
        ::setrlimit(RLIMIT_FSIZE, &m_before);
        std::signal(SIGXFSZ, m_signal);
    }
    FullDisk(const FullDisk&) = delete;
    FullDisk& operator=(const FullDisk&) = delete;

private:
    rlimit m_before{};
    void (*m_signal)(int);
};

} // namespace

class AuditRecoveryTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void init();
    void aFullDiskLeavesTheFileAsItWas();
    void goesOnAfterAnInterruptedRecovery_data();
    void goesOnAfterAnInterruptedRecovery();
    void refusesWhatNoRecoveryLeaves_data();
    void refusesWhatNoRecoveryLeaves();

private:
    void append(int count)
    {
        auto file = AuditFile::open(m_file, "robot");
        QVERIFY2(file, file ? "" : file.error().what.c_str());
        for (int i = 0; i < count; ++i) {
            Entry entry;
            entry.event = "session-opened";
            entry.when = std::chrono::system_clock::now();
            QVERIFY(file.value().append(entry));
        }
        QVERIFY(file.value().sync());
    }

    QTemporaryDir m_folder;
    std::filesystem::path m_file;
    std::string m_good;
};

void AuditRecoveryTest::init()
{
    m_file = std::filesystem::path(m_folder.path().toStdString()) / "audit.jsonl";
    std::filesystem::remove(m_file);
    std::filesystem::remove(headFileOf(m_file));
    append(3);
    m_good = contentOf(m_file);
}

void AuditRecoveryTest::aFullDiskLeavesTheFileAsItWas()
{
    const auto torn = m_good + "{\"n\":4,\"ti";
    write(m_file, torn);
    {
        const FullDisk disk(torn.size() + 1);
        QVERIFY(!AuditFile::open(m_file, "robot"));
        QCOMPARE(contentOf(m_file), torn);
    }
    append(1);
    const auto found = verifyAudit(m_file).value();
    QVERIFY2(found.sound(), found.fault.c_str());
    QCOMPARE(found.entries, std::uint64_t{5}); // three, the mark and one
    QCOMPARE(found.remarks.size(), std::size_t{1});
}

void AuditRecoveryTest::goesOnAfterAnInterruptedRecovery_data()
{
    QTest::addColumn<int>("bytes"); // of the mark that were written
    for (const int bytes : {0, 1, 5, 20, 200})
        QTest::addRow("%d bytes of the mark", bytes) << bytes;
    QTest::newRow("all but its end") << -1;
}

void AuditRecoveryTest::goesOnAfterAnInterruptedRecovery()
{
    QFETCH(const int, bytes);
    const std::string torn = m_good + "half a li";
    write(m_file, torn);
    append(0);
    const auto recovered = contentOf(m_file);
    const auto begin = torn.size() + 1;
    QVERIFY(recovered.size() > begin + 200 && recovered.starts_with(torn + "\n"));
    const auto length = bytes < 0 ? recovered.size() - 1 : begin + static_cast<std::size_t>(bytes);
    write(m_file, recovered.substr(0, length));
    std::filesystem::remove(headFileOf(m_file)); // it is written behind the mark, so it knows of none
    append(2);
    QVERIFY(contentOf(m_file).starts_with(torn + "\n{\"n\":4,"));
    const auto found = verifyAudit(m_file).value();
    QVERIFY2(found.sound(), found.fault.c_str());
    QCOMPARE(found.entries, std::uint64_t{6});
    QCOMPARE(found.remarks.size(), std::size_t{1});
}

void AuditRecoveryTest::refusesWhatNoRecoveryLeaves_data()
{
    QTest::addColumn<QByteArray>("left");
    QTest::newRow("two lines") << QByteArray("half a li\nanother\n");
    QTest::newRow("another line behind it") << QByteArray("half a li\nand more");
    QTest::newRow("the mark of another place") << QByteArray("half a li\n{\"n\":5,");
}

void AuditRecoveryTest::refusesWhatNoRecoveryLeaves()
{
    QFETCH(const QByteArray, left);
    const auto content = m_good + left.toStdString();
    write(m_file, content);
    const auto opened = AuditFile::open(m_file, "robot");
    QVERIFY(!opened);
    QVERIFY2(opened.error().what.find("is no audit entry") != std::string::npos, opened.error().what.c_str());
    QCOMPARE(contentOf(m_file), content);
}

QTEST_APPLESS_MAIN(AuditRecoveryTest)
#include "audit_recovery_test.moc"
