// Bounded reading of regular files; never waits on a pipe or a device that stands in a file's place.
#include "topology/file_bytes.hpp"

#include "topology/directory.hpp"

#include <fmt/format.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

namespace liena {

Result<std::string> readDescriptor(int descriptor, const std::string& name, std::size_t limit)
{
    struct stat status {};
    if (fstat(descriptor, &status) != 0)
        return fail(Errc::FileUnreadable, fmt::format("{} cannot be read: {}", name, systemText(errno)));
    if (!S_ISREG(status.st_mode))
        return fail(Errc::FileUnreadable, name + " is not a regular file");
    std::string bytes(limit + 1, '\0');
    std::size_t filled = 0;
    while (filled < bytes.size()) {
        const auto count = read(descriptor, bytes.data() + filled, bytes.size() - filled);
        if (count < 0 && errno == EINTR)
            continue;
        if (count < 0)
            return fail(Errc::FileUnreadable, fmt::format("{} cannot be read: {}", name, systemText(errno)));
        if (count == 0)
            break;
        filled += static_cast<std::size_t>(count);
    }
    if (filled > limit)
        return fail(Errc::FileUnreadable, fmt::format("{} has more than {} bytes, the most that is allowed", name, limit));
    bytes.resize(filled);
    return bytes;
}

Result<std::string> readFile(const std::filesystem::path& file, std::size_t limit)
{
    const FileDescriptor descriptor(open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    if (!descriptor)
        return fail(Errc::FileUnreadable, fmt::format("{} cannot be opened: {}", file.string(), systemText(errno)));
    return readDescriptor(descriptor.get(), file.string(), limit);
}

} // namespace liena
