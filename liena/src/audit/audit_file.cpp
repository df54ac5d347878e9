// Opening, continuing and appending.
#include "audit/audit_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace liena::audit {

namespace {

constexpr std::size_t tailSize = 64UL * 1024UL;

auto unusable(const std::filesystem::path& file, std::string_view reason)
{
    return fail(Errc::FileUnwritable, fmt::format("the audit file {} cannot be used: {}", file.string(), reason));
}

Entry entryOf(std::string event, std::string text)
{
    Entry entry;
    entry.event = std::move(event);
    entry.text = std::move(text);
    entry.when = std::chrono::system_clock::now();
    return entry;
}

/// The line that has its end there, without it.
std::string_view lineBefore(std::string_view text, std::size_t end)
{
    const auto before = end == 0 ? std::string_view::npos : text.rfind('\n', end - 1);
    return text.substr(before + 1, end - before - 1); // npos + 1 is 0
}

std::string readAt(int descriptor, off_t from, std::size_t size)
{
    std::string bytes(size, '\0');
    std::size_t filled = 0;
    while (filled < size) {
        const auto got = ::pread(descriptor, bytes.data() + filled, size - filled, from + static_cast<off_t>(filled));
        if (got <= 0)
            break;
        filled += static_cast<std::size_t>(got);
    }
    bytes.resize(filled);
    return bytes;
}

} // namespace

std::filesystem::path headFileOf(const std::filesystem::path& file) { return file.string() + ".head"; }

std::optional<Head> readHead(const std::filesystem::path& file)
{
    std::ifstream stream(headFileOf(file));
    Head head;
    std::string hash;
    if (!(stream >> head.entries >> hash))
        return std::nullopt;
    const auto read = Sha256::fromHex(hash);
    if (!read)
        return std::nullopt;
    head.hash = *read;
    return head;
}

AuditFile::AuditFile(std::filesystem::path file, std::string device, int descriptor)
    : m_file(std::move(file)), m_device(std::move(device)), m_descriptor(descriptor)
{}

AuditFile::AuditFile(AuditFile&& other) noexcept
    : m_file(std::move(other.m_file)),
      m_device(std::move(other.m_device)),
      m_descriptor(std::exchange(other.m_descriptor, -1)),
      m_size(other.m_size),
      m_torn(other.m_torn),
      m_chain(other.m_chain),
      m_remarks(std::move(other.m_remarks))
{}

AuditFile::~AuditFile()
{
    if (m_descriptor >= 0)
        ::close(m_descriptor);
}

Result<AuditFile> AuditFile::open(const std::filesystem::path& file, std::string device)
{
    // O_NONBLOCK: a pipe of that name must not hold us up.
    AuditFile opened(file, std::move(device),
                     ::open(file.c_str(), O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0600));
    struct stat status {};
    if (opened.m_descriptor < 0 || ::fstat(opened.m_descriptor, &status) != 0)
        return unusable(file,
                        fmt::format("{}; choose a folder that exists and that this program's user may write to", std::strerror(errno)));
    if (!S_ISREG(status.st_mode))
        return unusable(file, "it is not a regular file; choose another name");
    if (::flock(opened.m_descriptor, LOCK_EX | LOCK_NB) != 0)
        return unusable(file, "another program writes it; give every device a file of its own");
    opened.m_size = status.st_size;
    if (auto read = opened.readEnd(); !read)
        return read.as_failure();
    if (auto compared = opened.compareWithHead(); !compared)
        return compared.as_failure();
    if (auto synced = opened.sync(); !synced)
        return synced.as_failure();
    return opened;
}

Result<void> AuditFile::readEnd()
{
    const auto size = std::min(static_cast<std::size_t>(m_size), tailSize);
    const auto tail = readAt(m_descriptor, m_size - static_cast<off_t>(size), size);
    const auto lastEnd = tail.rfind('\n');
    const bool whole = lastEnd != std::string::npos;
    if (!whole && static_cast<std::size_t>(m_size) > tailSize)
        return unusable(m_file, "its end is no audit entry; keep it for whoever looks into that, and choose another name");
    if (whole) {
        const auto last = parseLine(lineBefore(tail, lastEnd));
        if (!last)
            return recoverAgain(tail, lastEnd);
        m_chain = AuditChain(last->number, last->hash);
    }
    const auto unfinished = std::string_view(tail).substr(whole ? lastEnd + 1 : 0);
    return unfinished.empty() ? ok() : continueAfter(unfinished);
}

Result<void> AuditFile::continueAfter(std::string_view unfinished)
{
    // Only its end is missing.
    if (const auto parsed = parseLine(unfinished);
        parsed && parsed->number == m_chain.entries() + 1 && parsed->hash == AuditChain::hashOf(m_chain.head(), parsed->body)) {
        if (auto ended = writeWhole("\n"); !ended)
            return ended;
        m_chain.accept(unfinished);
        return ok();
    }
    return mark(unfinished, "\n");
}

/// The last whole line is no entry. After a good one it is what a crash left, and the start that gave it its end was interrupted before it
/// had marked it. What there is of the mark is written anew.
Result<void> AuditFile::recoverAgain(std::string_view tail, std::size_t lastEnd)
{
    const auto unfinished = lineBefore(tail, lastEnd);
    const auto begin = lastEnd - unfinished.size();
    const auto good = begin > 0 ? parseLine(lineBefore(tail, begin - 1)) : std::nullopt;
    const auto started = tail.substr(lastEnd + 1);
    const auto due = fmt::format("{{\"n\":{},", good ? good->number + 1 : 0);
    if (!good || started.substr(0, due.size()) != std::string_view(due).substr(0, started.size()))
        return unusable(m_file, "its last line is no audit entry; keep it for whoever looks into that, and choose another name");
    m_chain = AuditChain(good->number, good->hash);
    const auto size = m_size - static_cast<off_t>(started.size());
    if (!started.empty() && ::ftruncate(m_descriptor, size) != 0)
        return unwritable(errno);
    m_size = size;
    return mark(unfinished, "");
}

/// In one write, which a full disk takes back: the line and its mark belong together.
Result<void> AuditFile::mark(std::string_view unfinished, std::string_view end)
{
    auto entry = entryOf("recovered", "the line before was left unfinished, as a crash does");
    entry.bytes = unfinished.size();
    entry.damaged = Sha256::of(unfinished).toHex();
    m_remarks.push_back(fmt::format("{}: the last line was left unfinished by a crash ({} bytes); it stays, and is marked", m_file.string(),
                                    unfinished.size()));
    const auto line = m_chain.line(entry, m_device);
    if (auto written = writeWhole(fmt::format("{}{}\n", end, line)); !written)
        return written;
    m_chain.accept(line);
    return ok();
}

Result<void> AuditFile::compareWithHead()
{
    const auto head = readHead(m_file);
    if (!head || head->entries < m_chain.entries() || (head->entries == m_chain.entries() && head->hash == m_chain.head()))
        return ok();
    const auto text = fmt::format("{} entries had been written, the newest with hash {}; {} were there", head->entries, head->hash.toHex(),
                                  m_chain.entries());
    m_remarks.push_back(fmt::format("{}: {}. Entries were cut off or the file was replaced; this is marked in it", m_file.string(), text));
    return append(entryOf("missing", text));
}

/// Who moves or removes the file while it is written would lose what comes without noticing.
Result<void> AuditFile::requireInPlace() const
{
    struct stat named {};
    struct stat open {};
    const bool same = ::stat(m_file.c_str(), &named) == 0 && ::fstat(m_descriptor, &open) == 0 && named.st_ino == open.st_ino &&
                      named.st_dev == open.st_dev;
    if (same)
        return ok();
    return unusable(m_file,
                    "it was moved or removed while it was in use; put it back, or restart the program when its sessions are closed");
}

Result<void> AuditFile::unwritable(int reason) const
{
    return fail(Errc::FileUnwritable, fmt::format("the audit file {} cannot be written: {}; make room there, or mend the disk",
                                                  m_file.string(), std::strerror(reason)));
}

Result<void> AuditFile::writeWhole(std::string_view bytes)
{
    if (std::exchange(m_torn, false) && ::ftruncate(m_descriptor, m_size) != 0) {
        m_torn = true;
        return unwritable(errno);
    }
    std::size_t done = 0;
    while (done < bytes.size()) {
        const auto written = ::write(m_descriptor, bytes.data() + done, bytes.size() - done);
        if (written < 0 && errno == EINTR)
            continue;
        if (written <= 0) {
            const int reason = written < 0 ? errno : ENOSPC;
            m_torn = done > 0 && ::ftruncate(m_descriptor, m_size) != 0;
            return unwritable(reason);
        }
        done += static_cast<std::size_t>(written);
    }
    m_size += static_cast<off_t>(bytes.size());
    return ok();
}

Result<void> AuditFile::append(const Entry& entry)
{
    if (auto there = requireInPlace(); !there)
        return there;
    const auto line = m_chain.line(entry, m_device);
    if (auto written = writeWhole(line + '\n'); !written)
        return written;
    m_chain.accept(line);
    return ok();
}

Result<void> AuditFile::sync()
{
    if (::fdatasync(m_descriptor) != 0)
        return unwritable(errno);
    const auto target = headFileOf(m_file);
    const auto fresh = target.string() + ".new";
    const int descriptor = ::open(fresh.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0600);
    if (descriptor < 0)
        return unwritable(errno);
    const auto text = fmt::format("{} {}\n", m_chain.entries(), m_chain.head().toHex());
    const auto written = ::write(descriptor, text.data(), text.size());
    const int reason = written < 0 ? errno : ENOSPC;
    ::close(descriptor);
    if (written != static_cast<ssize_t>(text.size()))
        return unwritable(reason);
    return ::rename(fresh.c_str(), target.c_str()) == 0 ? ok() : unwritable(errno);
}

} // namespace liena::audit
