// openat2 with RESOLVE_BENEATH where the kernel has it, else openat with O_NOFOLLOW, which is enough for names without a slash.
#include "topology/directory.hpp"

#include "topology/file_bytes.hpp"

#include <fmt/format.h>

#include <dirent.h>
#include <fcntl.h>
#include <linux/openat2.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <memory>
#include <system_error>

namespace liena {

namespace {

constexpr mode_t privateFile = 0600;
constexpr mode_t privateFolder = 0700;
constexpr const char* temporaryName = "incoming.tmp";

bool writeAll(int descriptor, std::string_view bytes)
{
    while (!bytes.empty()) {
        const auto count = write(descriptor, bytes.data(), bytes.size());
        if (count < 0 && errno == EINTR)
            continue;
        if (count < 0)
            return false;
        bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return fsync(descriptor) == 0;
}

auto unwritable(const std::filesystem::path& folder, const std::string& name, int code)
{
    return fail(Errc::FileUnwritable, fmt::format("{} in {} cannot be written: {}", name, folder.string(), systemText(code)));
}

} // namespace

std::string systemText(int code) { return std::generic_category().message(code); }

FileDescriptor::~FileDescriptor()
{
    if (m_descriptor >= 0)
        close(m_descriptor);
}

Result<Directory> Directory::open(const std::filesystem::path& folder)
{
    if (mkdir(folder.c_str(), privateFolder) != 0 && errno != EEXIST)
        return fail(Errc::FileUnwritable, fmt::format("the folder {} cannot be made: {}", folder.string(), systemText(errno)));
    Directory directory;
    directory.m_path = folder;
    directory.m_descriptor = FileDescriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (!directory.m_descriptor)
        return fail(Errc::FileUnreadable, fmt::format("the folder {} cannot be opened: {}", folder.string(), systemText(errno)));
    return directory;
}

FileDescriptor Directory::openFile(const std::string& name, int flags) const
{
    if (name.empty() || name.front() == '.' || name.find('/') != std::string::npos) {
        errno = EINVAL;
        return {};
    }
    const int all = flags | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK;
    const mode_t mode = (flags & O_CREAT) != 0 ? privateFile : 0;
    open_how how{};
    how.flags = static_cast<std::uint64_t>(all);
    how.mode = mode;
    how.resolve = RESOLVE_BENEATH | RESOLVE_NO_SYMLINKS | RESOLVE_NO_MAGICLINKS;
    const auto opened = syscall(SYS_openat2, m_descriptor.get(), name.c_str(), &how, sizeof how);
    if (opened >= 0 || (errno != ENOSYS && errno != EPERM))
        return FileDescriptor(static_cast<int>(opened));
    return FileDescriptor(openat(m_descriptor.get(), name.c_str(), all, mode));
}

bool Directory::exists(const std::string& name) const
{
    struct stat status {};
    return fstatat(m_descriptor.get(), name.c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0;
}

Result<std::string> Directory::read(const std::string& name, std::size_t limit) const
{
    const auto file = openFile(name, O_RDONLY);
    if (!file)
        return fail(Errc::FileUnreadable, fmt::format("{} in {} cannot be opened: {}", name, m_path.string(), systemText(errno)));
    return readDescriptor(file.get(), (m_path / name).string(), limit);
}

Result<void> Directory::write(const std::string& name, std::string_view bytes) const
{
    // A leftover of a writer that died; the lock says that nobody writes it now.
    unlinkat(m_descriptor.get(), temporaryName, 0);
    {
        const auto file = openFile(temporaryName, O_WRONLY | O_CREAT | O_EXCL);
        if (!file)
            return unwritable(m_path, name, errno);
        if (fchmod(file.get(), privateFile) != 0 || !writeAll(file.get(), bytes)) {
            const int code = errno;
            unlinkat(m_descriptor.get(), temporaryName, 0);
            return unwritable(m_path, name, code);
        }
    }
    if (renameat(m_descriptor.get(), temporaryName, m_descriptor.get(), name.c_str()) != 0) {
        const int code = errno;
        unlinkat(m_descriptor.get(), temporaryName, 0);
        return unwritable(m_path, name, code);
    }
    if (fsync(m_descriptor.get()) != 0)
        return unwritable(m_path, name, errno);
    return ok();
}

Result<std::vector<std::string>> Directory::names() const
{
    // A fresh descriptor, because a directory stream moves the position of the one it is given.
    const int again = openat(m_descriptor.get(), ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const auto closeStream = [](DIR* open) { closedir(open); };
    const std::unique_ptr<DIR, decltype(closeStream)> stream(again >= 0 ? fdopendir(again) : nullptr);
    if (!stream)
        return fail(Errc::FileUnreadable, fmt::format("the folder {} cannot be listed: {}", m_path.string(), systemText(errno)));
    std::vector<std::string> result;
    while (const auto* entry = readdir(stream.get()))
        result.emplace_back(entry->d_name);
    return result;
}

Result<FileDescriptor> Directory::lock() const
{
    // Of its own, so that two stores of one process exclude each other too.
    FileDescriptor own(openat(m_descriptor.get(), ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    while (own) {
        if (flock(own.get(), LOCK_EX) == 0)
            return own;
        if (errno != EINTR)
            break;
    }
    return fail(Errc::FileUnwritable, fmt::format("the folder {} cannot be locked: {}", m_path.string(), systemText(errno)));
}

} // namespace liena
