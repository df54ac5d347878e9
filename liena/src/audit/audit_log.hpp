// The audit file for those who must not wait: entries are queued, and a thread of its own writes them.
#pragma once

#include "audit/audit_file.hpp"
#include "base/cause_books.hpp"
#include "liena/log.hpp"

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

namespace liena::audit {

class AuditLog {
public:
    using Instant = std::chrono::steady_clock::time_point;

    static constexpr std::size_t mostWaiting = 1024;
    /// What is written at most, so that no peer can fill the disk; what is left out is counted in an entry.
    static constexpr double mostPerSecond = 10;
    static constexpr double mostAtOnce = 2000;

    static Result<std::unique_ptr<AuditLog>> open(const std::filesystem::path& file, std::string device, LogSink log);

    ~AuditLog(); ///< closes
    AuditLog(const AuditLog&) = delete;
    AuditLog& operator=(const AuditLog&) = delete;

    /// Any thread; never waits for the disk. The time of the entry is now.
    void put(Entry entry);

    struct Status {
        bool lost = false;  ///< entries are not written, or were lost for good since this was asked last
        std::string detail; ///< why
        std::uint64_t entries = 0;
        Sha256 head;
    };
    Status status(Instant now);

    /// Writes what waits, as far as it can be, and ends the thread. Harmless when repeated.
    void close();

    const std::filesystem::path& path() const { return m_path; }

private:
    AuditLog(AuditFile file, LogSink log);

    void run();
    bool mayWrite(Entry& entry, Instant now);
    void writeSome(std::unique_lock<std::mutex>& lock);
    Result<void> write(const std::deque<Entry>& entries, std::size_t& written);

    std::filesystem::path m_path;
    LogSink m_log;
    AuditFile m_file; ///< the thread's

    std::mutex m_mutex;
    std::condition_variable m_wake;
    std::deque<Entry> m_waiting;
    std::uint64_t m_dropped = 0; ///< entries that found no room, not yet told in the file
    base::CauseBooks m_often{64, std::chrono::seconds(60)};
    double m_allowance = mostAtOnce;
    Instant m_allowedAt = std::chrono::steady_clock::now();
    std::uint64_t m_leftOut = 0;    ///< for want of allowance, not yet told in the file
    std::string m_fault;            ///< of the last attempt; empty when it was good
    std::optional<Instant> m_begun; ///< an attempt is in hand since then
    std::uint64_t m_entries = 0;
    Sha256 m_head;
    bool m_ending = false;
    std::thread m_thread;
};

} // namespace liena::audit
