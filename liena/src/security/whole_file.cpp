// Staging, publishing and reading of files.
#include "security/whole_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace liena::security {

namespace {

constexpr std::size_t longestFile = 1024UL * 1024UL;

class Descriptor {
public:
    explicit Descriptor(int number) : m_number(number) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor()
    {
        if (m_number >= 0)
            ::close(m_number);
    }
    int number() const { return m_number; }

private:
    int m_number;
};

auto unwritable(const std::filesystem::path& file, int reason)
{
    return fail(Errc::FileUnwritable, fmt::format("{} cannot be written: {}; choose a folder you may write to, with space left",
                                                  file.string(), std::strerror(reason)));
}

auto unreadable(const std::filesystem::path& file, std::string_view reason)
{
    return fail(Errc::FileUnreadable, fmt::format("{} cannot be read: {}", file.string(), reason));
}

bool writeAll(int descriptor, std::string_view content)
{
    while (!content.empty()) {
        const auto written = ::write(descriptor, content.data(), content.size());
        if (written < 0 && errno != EINTR)
            return false;
        if (written > 0)
            content.remove_prefix(static_cast<std::size_t>(written));
    }
    return true;
}

std::filesystem::path folderOf(const std::filesystem::path& file)
{
    return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

} // namespace

StagedFile::StagedFile(std::filesystem::path target, std::filesystem::path temporary)
    : m_target(std::move(target)), m_temporary(std::move(temporary))
{}

StagedFile::StagedFile(StagedFile&& other) noexcept : m_target(std::move(other.m_target)), m_temporary(std::exchange(other.m_temporary, {}))
{}

StagedFile::~StagedFile()
{
    if (!m_temporary.empty())
        ::unlink(m_temporary.c_str());
}

Result<StagedFile> StagedFile::write(const std::filesystem::path& target, std::string_view content, mode_t mode)
{
    auto name = (folderOf(target) / fmt::format(".{}.XXXXXX", target.filename().string())).string();
    const Descriptor descriptor(::mkostemp(name.data(), O_CLOEXEC)); // created with mode 0600
    if (descriptor.number() < 0)
        return unwritable(target, errno);
    StagedFile staged(target, name);
    if (::fchmod(descriptor.number(), mode) != 0 || !writeAll(descriptor.number(), content) || ::fsync(descriptor.number()) != 0)
        return unwritable(target, errno);
    return staged;
}

Result<void> StagedFile::publish(bool replace)
{
    // link() refuses an existing name, where rename() would take it.
    const int outcome = replace ? ::rename(m_temporary.c_str(), m_target.c_str()) : ::link(m_temporary.c_str(), m_target.c_str());
    if (outcome != 0 && errno == EEXIST)
        return fail(Errc::FileUnwritable,
                    fmt::format("{} exists already and is left as it is; ask to replace it if that is meant", m_target.string()));
    if (outcome != 0)
        return unwritable(m_target, errno);
    if (!replace)
        ::unlink(m_temporary.c_str());
    m_temporary.clear();
    const Descriptor folder(::open(folderOf(m_target).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (folder.number() < 0 || ::fsync(folder.number()) != 0)
        return unwritable(m_target, errno);
    return ok();
}

Result<void> requireSecret(const std::filesystem::path& file, mode_t mode, uid_t owner, uid_t user)
{
    if ((mode & 077U) != 0)
        return fail(Errc::FileUnreadable, fmt::format("{} is open to other users (mode {:04o}) and is not used; run: chmod 600 {}",
                                                      file.string(), mode & 07777U, file.string()));
    if (owner != user)
        return fail(Errc::FileUnreadable,
                    fmt::format("{} belongs to user {} and this program runs as user {}, so it is not used; run it as "
                                "that user, or as root: chown {} {} && chmod 600 {}",
                                file.string(), owner, user, user, file.string(), file.string()));
    return ok();
}

Result<std::string> readFile(const std::filesystem::path& file, Secrecy secrecy)
{
    // O_NONBLOCK: a pipe of that name must not hold us up.
    const Descriptor descriptor(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    struct stat status {};
    if (descriptor.number() < 0 || ::fstat(descriptor.number(), &status) != 0)
        return unreadable(file, std::strerror(errno));
    if (!S_ISREG(status.st_mode))
        return unreadable(file, "it is not a regular file");
    if (secrecy == Secrecy::Secret)
        if (auto secret = requireSecret(file, status.st_mode, status.st_uid, ::geteuid()); !secret)
            return secret.as_failure();
    if (static_cast<std::size_t>(status.st_size) > longestFile)
        return unreadable(file, "it is longer than 1 MiB");
    std::string content(static_cast<std::size_t>(status.st_size), '\0');
    std::size_t filled = 0;
    while (filled < content.size()) {
        const auto got = ::read(descriptor.number(), content.data() + filled, content.size() - filled);
        if (got < 0 && errno != EINTR)
            return unreadable(file, std::strerror(errno));
        if (got == 0)
            break;
        filled += got > 0 ? static_cast<std::size_t>(got) : 0;
    }
    content.resize(filled);
    return content;
}

} // namespace liena::security
