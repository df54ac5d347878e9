// The site's list of revoked certificates as a running device knows it: the file is read again whenever it changed.
#pragma once

#include "liena/error.hpp"
#include "liena/log.hpp"
#include "security/revocation_list.hpp"

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace liena::security {

/// A list that was read once stays in force until a newer one takes its place: neither a file that vanished, nor a damaged or an older one
/// lets a revoked device in again. Not for use by two threads at once.
class Revocations {
public:
    using Time = std::chrono::system_clock::time_point;

    /// No file means that nobody is revoked; a list that cannot be relied on is an error. `log` hears of each new list and of each new
    /// fault, once.
    static Result<Revocations> load(std::filesystem::path file, const std::vector<CertificatePtr>& authorities, Time now, LogSink log);

    /// Looks whether the file changed, and reads it then.
    void refresh();

    /// By the list in force, whether or not it can be relied on any more.
    bool revokes(X509* certificate) const { return m_list && m_list->revokes(certificate); }

    /// Why new sessions cannot rely on the list, with the remedy.
    Result<void> requireReliable(Time now) const;

    const std::filesystem::path& file() const { return m_file; }
    bool hasList() const { return m_list.has_value(); }
    RevocationListInfo info() const { return m_list ? m_list->info() : RevocationListInfo(); }

private:
    Revocations(std::filesystem::path file, const std::vector<CertificatePtr>& authorities, LogSink log);

    /// What tells one content of a file from another without reading it.
    struct Mark {
        std::uint64_t device = 0;
        std::uint64_t node = 0;
        std::int64_t size = 0;
        std::int64_t written = 0; ///< ns
        std::int64_t changed = 0; ///< ns
        bool operator==(const Mark&) const = default;
    };

    std::optional<Mark> mark() const;
    void vanished();
    void read();
    void take(RevocationList list);
    void fault(Error error);

    std::filesystem::path m_file;
    std::vector<CertificatePtr> m_authorities;
    LogSink m_log;
    bool m_looked = false;
    std::optional<Mark> m_mark; ///< of the content that was read last
    std::optional<RevocationList> m_list;
    std::optional<Error> m_fault; ///< of that content
};

} // namespace liena::security
