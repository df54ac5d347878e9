// Following the revocation list's file.
#include "security/revocations.hpp"

#include "security/certificate_fields.hpp"
#include "security/whole_file.hpp"

#include <fmt/format.h>

#include <cerrno>

#include <sys/stat.h>

namespace liena::security {

namespace {

std::int64_t nanoseconds(const timespec& time) { return static_cast<std::int64_t>(time.tv_sec) * 1'000'000'000 + time.tv_nsec; }

} // namespace

Revocations::Revocations(std::filesystem::path file, const std::vector<CertificatePtr>& authorities, LogSink log)
    : m_file(std::move(file)), m_log(std::move(log))
{
    for (const auto& authority : authorities)
        m_authorities.push_back(sharedCertificate(authority));
}

Result<Revocations> Revocations::load(std::filesystem::path file, const std::vector<CertificatePtr>& authorities, Time now, LogSink log)
{
    Revocations revocations(std::move(file), authorities, std::move(log));
    revocations.refresh();
    if (auto reliable = revocations.requireReliable(now); !reliable)
        return reliable.as_failure();
    return revocations;
}

std::optional<Revocations::Mark> Revocations::mark() const
{
    struct stat status {};
    if (::stat(m_file.c_str(), &status) != 0)
        return errno == ENOENT || errno == ENOTDIR ? std::nullopt : std::optional(Mark());
    return Mark{status.st_dev, status.st_ino, status.st_size, nanoseconds(status.st_mtim), nanoseconds(status.st_ctim)};
}

void Revocations::refresh()
{
    const auto seen = mark();
    if (m_looked && seen == m_mark)
        return;
    m_looked = true;
    m_mark = seen;
    if (!seen)
        return vanished();
    read();
}

void Revocations::vanished()
{
    m_fault.reset();
    if (m_list)
        m_log(LogLevel::Warning,
              fmt::format("the revocation list {} is gone; whom it revoked stays revoked until this program ends", m_file.string()));
}

void Revocations::read()
{
    const auto text = readFile(m_file);
    if (!text)
        return fault(text.error());
    auto list = RevocationList::parse(text.value(), m_file, m_authorities);
    if (!list)
        return fault(list.error());
    if (m_list && m_list->isNewerThan(list.value()))
        return fault({Errc::CertificateInvalid, fmt::format("the revocation list {} is older than the one in force; copy the newest ca.crl "
                                                            "from where certificates are issued",
                                                            m_file.string())});
    take(std::move(list.value()));
}

void Revocations::take(RevocationList list)
{
    m_list = std::move(list);
    m_fault.reset();
    const auto said = m_list->info();
    m_log(LogLevel::Info, fmt::format("revocation list {}: number {}, {} revoked, good until {}", m_file.string(), said.number,
                                      said.revoked.size(), dateText(said.ends)));
}

void Revocations::fault(Error error)
{
    m_log(LogLevel::Error, error.what + "; until then no new session opens");
    m_fault = std::move(error);
}

Result<void> Revocations::requireReliable(Time now) const
{
    if (m_fault)
        return boost::outcome_v2::failure(*m_fault);
    return m_list ? m_list->requireCurrent(now) : ok();
}

} // namespace liena::security
