// The audit file on the disk: opened for one process, continued after a crash, appended to line by line.
#pragma once

#include "audit/audit_chain.hpp"
#include "liena/error.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <sys/types.h>

namespace liena::audit {

/// Everything here may wait for the disk. One thread at a time.
class AuditFile {
public:
    /// Takes the file for this process, or makes it (mode 0600). What a crash left unfinished at its end stays there, closed by an entry
    /// `recovered`, also when that was interrupted itself; entries that `.head` knows and the file has not are told by an entry `missing`.
    static Result<AuditFile> open(const std::filesystem::path& file, std::string device);

    AuditFile(AuditFile&& other) noexcept;
    AuditFile& operator=(AuditFile&&) = delete;
    ~AuditFile();

    /// The whole line or nothing of it.
    Result<void> append(const Entry& entry);

    /// Makes what was appended last, and writes `.head`.
    Result<void> sync();

    /// What open() found that a person should know.
    const std::vector<std::string>& remarks() const { return m_remarks; }

    const AuditChain& chain() const { return m_chain; }
    const std::filesystem::path& path() const { return m_file; }

private:
    AuditFile(std::filesystem::path file, std::string device, int descriptor);

    Result<void> readEnd();
    Result<void> continueAfter(std::string_view unfinished);
    Result<void> recoverAgain(std::string_view tail, std::size_t lastEnd);
    Result<void> mark(std::string_view unfinished, std::string_view end);
    Result<void> compareWithHead();
    Result<void> requireInPlace() const;
    Result<void> writeWhole(std::string_view bytes);
    Result<void> unwritable(int reason) const;

    std::filesystem::path m_file;
    std::string m_device;
    int m_descriptor;
    off_t m_size = 0;    ///< where the next line begins
    bool m_torn = false; ///< bytes behind m_size could not be taken back
    AuditChain m_chain;
    std::vector<std::string> m_remarks;
};

/// `audit.jsonl.head` for `audit.jsonl`: `<entries> <hash>`.
struct Head {
    std::uint64_t entries = 0;
    Sha256 hash;
};
std::filesystem::path headFileOf(const std::filesystem::path& file);
std::optional<Head> readHead(const std::filesystem::path& file);

} // namespace liena::audit
