// The queue and the thread of the audit log.
#include "audit/audit_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <utility>

namespace liena::audit {

using namespace std::chrono_literals;

namespace {

constexpr auto retryPause = 1s;
/// A disk that takes longer than this for a few lines does not answer.
constexpr auto longestWrite = 2s;

} // namespace

AuditLog::AuditLog(AuditFile file, LogSink log)
    : m_path(file.path()),
      m_log(std::move(log)),
      m_file(std::move(file)),
      m_entries(m_file.chain().entries()),
      m_head(m_file.chain().head())
{
    m_thread = std::thread([this] { run(); });
}

Result<std::unique_ptr<AuditLog>> AuditLog::open(const std::filesystem::path& file, std::string device, LogSink log)
{
    auto opened = AuditFile::open(file, std::move(device));
    if (!opened)
        return opened.as_failure();
    for (const auto& remark : opened.value().remarks())
        log({LogLevel::Warning, remark, "audit"});
    try {
        return std::unique_ptr<AuditLog>(new AuditLog(std::move(opened.value()), std::move(log)));
    } catch (const std::system_error& none) {
        return fail(Errc::Forbidden, fmt::format("{} is not written, since no thread can be had ({}): allow more with `nproc` in "
                                                 "/etc/security/limits.d, or with TasksMax= in the systemd unit",
                                                 file.string(), none.code().message()));
    }
}

AuditLog::~AuditLog() { close(); }

void AuditLog::put(Entry entry)
{
    entry.when = std::chrono::system_clock::now();
    {
        const std::lock_guard lock(m_mutex);
        if (m_ending || !mayWrite(entry, std::chrono::steady_clock::now()))
            return;
        if (m_waiting.size() >= mostWaiting)
            ++m_dropped;
        else
            m_waiting.push_back(std::move(entry));
    }
    m_wake.notify_one();
}

/// Under the lock.
bool AuditLog::mayWrite(Entry& entry, Instant now)
{
    if (entry.often) {
        const auto count = m_often.count(entry.event + "|" + entry.peer + "|" + entry.who + "|" + entry.text, 0, now);
        if (!count)
            return false;
        entry.text += base::timesText(*count);
    }
    const auto seconds = std::chrono::duration<double>(now - std::exchange(m_allowedAt, now)).count();
    m_allowance = std::min(mostAtOnce, m_allowance + seconds * mostPerSecond);
    if (m_allowance < 1) {
        ++m_leftOut;
        return false;
    }
    m_allowance -= 1;
    return true;
}

AuditLog::Status AuditLog::status(Instant now)
{
    const std::lock_guard lock(m_mutex);
    Status status{!m_fault.empty() || m_dropped > 0, m_fault, m_entries, m_head};
    if (m_fault.empty() && m_dropped > 0)
        status.detail = fmt::format("entries of the audit file {} were lost: more came than its disk could take", m_path.string());
    if (m_begun && now - *m_begun > longestWrite) {
        status.lost = true;
        status.detail = fmt::format("the disk of the audit file {} does not answer", m_path.string());
    }
    return status;
}

void AuditLog::run()
{
    std::unique_lock lock(m_mutex);
    while (!m_ending || !m_waiting.empty() || m_leftOut > 0) {
        const auto due = [&] { return m_ending || !m_waiting.empty() || m_dropped > 0; };
        if (m_fault.empty())
            m_wake.wait(lock, due);
        else if (!m_ending)
            m_wake.wait_for(lock, retryPause, [&] { return m_ending; });
        if (m_waiting.empty() && m_dropped == 0 && m_fault.empty() && !(m_ending && m_leftOut > 0))
            continue;
        const bool last = m_ending;
        writeSome(lock);
        if (last && !m_fault.empty())
            break; // there is nobody to wait for better times
    }
}

void AuditLog::writeSome(std::unique_lock<std::mutex>& lock)
{
    auto batch = std::exchange(m_waiting, {});
    const auto tell = [&](std::string event, std::uint64_t count, std::string_view what) {
        if (count == 0)
            return;
        Entry entry;
        entry.event = std::move(event);
        entry.text = fmt::format("{} {}", count, what);
        entry.when = std::chrono::system_clock::now();
        batch.push_back(std::move(entry));
    };
    tell("entries-lost", std::exchange(m_dropped, 0), "entries found no room while the file could not be written");
    tell("entries-left-out", std::exchange(m_leftOut, 0), "entries were left out, because more came than are written");
    m_begun = std::chrono::steady_clock::now();
    lock.unlock();
    std::size_t written = 0;
    const auto outcome = write(batch, written);
    lock.lock();
    m_begun.reset();
    m_entries = m_file.chain().entries();
    m_head = m_file.chain().head();
    m_fault = outcome ? std::string() : outcome.error().what;
    batch.erase(batch.begin(), batch.begin() + static_cast<std::ptrdiff_t>(written));
    batch.insert(batch.end(), std::make_move_iterator(m_waiting.begin()), std::make_move_iterator(m_waiting.end()));
    m_waiting = std::move(batch);
}

Result<void> AuditLog::write(const std::deque<Entry>& entries, std::size_t& written)
{
    for (const auto& entry : entries) {
        if (auto appended = m_file.append(entry); !appended)
            return appended;
        ++written;
    }
    return m_file.sync();
}

void AuditLog::close()
{
    {
        const std::lock_guard lock(m_mutex);
        m_ending = true;
    }
    m_wake.notify_one();
    if (!m_thread.joinable())
        return;
    m_thread.join();
    if (!m_waiting.empty())
        m_log({LogLevel::Error, fmt::format("{} entries of the audit file are lost: {}", m_waiting.size(), m_fault), "audit"});
    m_log({LogLevel::Info,
           fmt::format("audit file {}: {} entries, head {}", m_path.string(), m_file.chain().entries(), m_file.chain().head().toHex()),
           "audit-head"});
}

} // namespace liena::audit
