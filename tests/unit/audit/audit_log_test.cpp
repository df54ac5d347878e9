// The audit log's queue and thread: in order, without waiting, and honest about what a full disk does.
#include "audit/audit_log.hpp"
#include "liena/audit.hpp"
#include "support/no_more_threads.hpp"

#include <QTemporaryDir>
#include <QTest>

#include <atomic>
#include <csignal>
#include <fstream>
#include <memory>
#include <thread>

#include <sys/resource.h>

using namespace liena;
using namespace liena::audit;

namespace {

Entry entry(const std::string& event, const std::string& text = {})
{
    Entry made;
    made.event = event;
    made.text = text;
    return made;
}

/// While it lives, no file of this process grows beyond `bytes`: the kernel refuses as on a full disk, also in the middle of a line.
class FullDisk {
public:
    explicit FullDisk(rlim_t bytes)
    {
        std::signal(SIGXFSZ, SIG_IGN);
        ::getrlimit(RLIMIT_FSIZE, &m_before);
        rlimit limit = m_before;
        limit.rlim_cur = bytes;
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FullDisk() { ::setrlimit(RLIMIT_FSIZE, &m_before); }

private:
    rlimit m_before{};
};

} // namespace

class AuditLogTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void init();
    void writesInOrderAndPrintsItsHeadAtTheEnd();
    void takesEntriesOfManyThreads();
    void tellsThatTheDiskIsFullAndGoesOnAfterwards();
    void neverLeavesATornLine();
    void countsWhatFoundNoRoom();
    void countsWhatComesAgainAndAgain();
    void noFloodFillsTheDisk();
    void endsAlsoWhenNothingCanBeWritten();
    void tellsThatItsFileWasTaken();
    void isNotOpenedWithoutAThread();

private:
    std::unique_ptr<AuditLog> open()
    {
        auto opened = AuditLog::open(m_file, "robot", [this](LogLevel, std::string_view text) { m_log.emplace_back(text); });
        if (!opened)
            throw std::runtime_error(opened.error().what);
        return std::move(opened.value());
    }
    static AuditLog::Status statusOf(AuditLog& log) { return log.status(std::chrono::steady_clock::now()); }

    std::unique_ptr<QTemporaryDir> m_folder;
    std::filesystem::path m_file;
    std::vector<std::string> m_log;
};

void AuditLogTest::init()
{
    m_folder = std::make_unique<QTemporaryDir>();
    m_file = std::filesystem::path(m_folder->path().toStdString()) / "audit.jsonl";
    m_log.clear();
}

void AuditLogTest::writesInOrderAndPrintsItsHeadAtTheEnd()
{
    auto log = open();
    for (int i = 0; i < 200; ++i)
        log->put(entry("e" + std::to_string(i)));
    log->close();
    log->close();
    const auto verdict = verifyAudit(m_file).value();
    QVERIFY2(verdict.sound(), verdict.fault.c_str());
    QCOMPARE(verdict.entries, std::uint64_t(200));
    std::ifstream stream(m_file);
    int number = 0;
    for (std::string line; std::getline(stream, line); ++number)
        QVERIFY(line.find("\"event\":\"e" + std::to_string(number) + "\"") != std::string::npos);
    QVERIFY(m_log.back().find("200 entries, head " + verdict.head.toHex()) != std::string::npos);
    log->put(entry("too late")); // harmless
}

void AuditLogTest::takesEntriesOfManyThreads()
{
    auto log = open();
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([&] {
            for (int i = 0; i < 100; ++i)
                log->put(entry("e"));
        });
    for (auto& thread : threads)
        thread.join();
    log->close();
    QCOMPARE(verifyAudit(m_file).value().entries, std::uint64_t(400));
    QVERIFY(verifyAudit(m_file).value().sound());
}

void AuditLogTest::tellsThatTheDiskIsFullAndGoesOnAfterwards()
{
    auto log = open();
    {
        const FullDisk full(2000);
        for (int i = 0; i < 20; ++i)
            log->put(entry("during", "the disk is full"));
        QTRY_VERIFY(statusOf(*log).lost);
        QVERIFY2(statusOf(*log).detail.find("make room") != std::string::npos, statusOf(*log).detail.c_str());
        const auto verdict = verifyAudit(m_file).value();
        QVERIFY2(verdict.sound(), verdict.fault.c_str());
        QVERIFY(verdict.entries > 0 && verdict.entries < 20);
    }
    QTRY_VERIFY(!statusOf(*log).lost);
    log->put(entry("after"));
    log->close();
    const auto verdict = verifyAudit(m_file).value();
    QVERIFY2(verdict.sound(), verdict.fault.c_str());
    QCOMPARE(verdict.entries, std::uint64_t(21)); // none was lost
}

void AuditLogTest::neverLeavesATornLine()
{
    for (rlim_t size = 900; size < 1100; size += 23) {
        init();
        auto log = open();
        {
            const FullDisk full(size);
            for (int i = 0; i < 10; ++i)
                log->put(entry("e", "text"));
            QTRY_VERIFY(statusOf(*log).lost);
            const auto verdict = verifyAudit(m_file).value();
            QVERIFY2(verdict.sound(), verdict.fault.c_str());
        }
    }
}

void AuditLogTest::countsWhatFoundNoRoom()
{
    auto log = open();
    {
        const FullDisk full(1);
        log->put(entry("first"));
        QTRY_VERIFY(statusOf(*log).lost);
        for (std::size_t i = 0; i < AuditLog::mostWaiting + 100; ++i)
            log->put(entry("more"));
    }
    QTRY_VERIFY(!statusOf(*log).lost);
    log->close();
    const auto verdict = verifyAudit(m_file).value();
    QVERIFY2(verdict.sound(), verdict.fault.c_str());
    std::ifstream stream(m_file);
    const std::string content{std::istreambuf_iterator<char>(stream), {}};
    QVERIFY(content.find("\"event\":\"entries-lost\"") != std::string::npos);
}

void AuditLogTest::countsWhatComesAgainAndAgain()
{
    auto log = open();
    for (int i = 0; i < 500; ++i) {
        auto again = entry("open-failed", "the robot is off");
        again.often = true;
        log->put(again);
    }
    auto other = entry("open-failed", "the arm is off");
    other.often = true;
    log->put(other);
    log->close();
    QCOMPARE(verifyAudit(m_file).value().entries, std::uint64_t(2));
}

void AuditLogTest::noFloodFillsTheDisk()
{
    auto log = open();
    const auto begun = std::chrono::steady_clock::now();
    for (int i = 0; i < 20000; ++i) {
        log->put(entry("hold-reported"));
        if (i % 1000 == 999)
            QTRY_VERIFY(statusOf(*log).entries > 0); // lets the thread write
    }
    log->close();
    const auto seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    const auto verdict = verifyAudit(m_file).value();
    QVERIFY2(verdict.sound(), verdict.fault.c_str());
    QVERIFY(static_cast<double>(verdict.entries) <= AuditLog::mostAtOnce + AuditLog::mostPerSecond * seconds + 10);
    std::ifstream stream(m_file);
    const std::string content{std::istreambuf_iterator<char>(stream), {}};
    QVERIFY(content.find("\"event\":\"entries-left-out\"") != std::string::npos);
}

void AuditLogTest::endsAlsoWhenNothingCanBeWritten()
{
    auto log = open();
    const FullDisk full(1);
    log->put(entry("lost"));
    log->close();
    QVERIFY(m_log.size() >= 2);
    QVERIFY(m_log[m_log.size() - 2].find("1 entries of the audit file are lost") != std::string::npos);
}

void AuditLogTest::tellsThatItsFileWasTaken()
{
    auto log = open();
    log->put(entry("start"));
    QTRY_COMPARE(statusOf(*log).entries, std::uint64_t(1));
    std::filesystem::rename(m_file, m_file.string() + ".away");
    log->put(entry("next"));
    QTRY_VERIFY(statusOf(*log).lost);
    std::filesystem::rename(m_file.string() + ".away", m_file);
    QTRY_VERIFY(!statusOf(*log).lost);
    log->close();
    QCOMPARE(verifyAudit(m_file).value().entries, std::uint64_t(2));
}

void AuditLogTest::isNotOpenedWithoutAThread()
{
    {
        const test::NoMoreThreads none;
        const auto opened = AuditLog::open(m_file, "robot", [](LogLevel, std::string_view) {});
        QVERIFY(!opened);
        QVERIFY2(opened.error().what.find("no thread can be had") != std::string::npos, opened.error().what.c_str());
    }
    QVERIFY(open()); // it holds the file no longer
}

QTEST_GUILESS_MAIN(AuditLogTest)
#include "audit_log_test.moc"
