// Writing, and saying why it failed.
#include "report_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace liena::tools {

namespace {

auto notWritten(const std::string& what, int error)
{
    const auto* remedy = error == ENOSPC || error == EDQUOT ? "; make room on the disk" : "";
    return fail(Errc::FileUnwritable, fmt::format("{} was not written: {}{}", what, std::strerror(error), remedy));
}

/// 0, or why it failed.
int writeAll(int descriptor, std::string_view content)
{
    while (!content.empty()) {
        const auto count = ::write(descriptor, content.data(), content.size());
        if (count < 0 && errno != EINTR)
            return errno;
        if (count > 0)
            content.remove_prefix(static_cast<std::size_t>(count));
    }
    return 0;
}

int writeAndClose(int descriptor, std::string_view content, bool synced)
{
    if (descriptor < 0)
        return errno;
    int error = writeAll(descriptor, content);
    if (error == 0 && synced && ::fsync(descriptor) != 0)
        error = errno;
    if (::close(descriptor) != 0 && error == 0)
        error = errno;
    return error;
}

/// A terminal, a pipe, and a folder, too.
bool isNoFile(const std::filesystem::path& file)
{
    struct stat status {};
    return ::stat(file.c_str(), &status) == 0 && !S_ISREG(status.st_mode);
}

std::string besideOf(const std::filesystem::path& file) { return file.string() + ".XXXXXX"; }

} // namespace

Result<void> tryReport(const std::filesystem::path& file)
{
    if (isNoFile(file)) {
        const int opened = ::open(file.c_str(), O_WRONLY | O_CLOEXEC | O_NONBLOCK);
        if (opened < 0 && errno != ENXIO) // a pipe that nobody reads yet
            return notWritten(file.string(), errno);
        if (opened >= 0)
            ::close(opened);
        return ok();
    }
    auto temporary = besideOf(file);
    const int descriptor = ::mkostemp(temporary.data(), O_CLOEXEC);
    if (descriptor < 0)
        return notWritten(file.string(), errno);
    ::close(descriptor);
    ::unlink(temporary.c_str());
    return ok();
}

Result<void> writeReport(const std::filesystem::path& file, std::string_view content)
{
    if (isNoFile(file)) {
        const int error = writeAndClose(::open(file.c_str(), O_WRONLY | O_CLOEXEC), content, false);
        return error == 0 ? Result<void>(ok()) : notWritten(file.string(), error);
    }
    auto temporary = besideOf(file);
    const int descriptor = ::mkostemp(temporary.data(), O_CLOEXEC);
    if (descriptor < 0)
        return notWritten(file.string(), errno);
    constexpr mode_t readable = 0644;
    (void)::fchmod(descriptor, readable);
    int error = writeAndClose(descriptor, content, true);
    if (error == 0 && ::rename(temporary.c_str(), file.c_str()) != 0)
        error = errno;
    if (error == 0)
        return ok();
    ::unlink(temporary.c_str());
    return notWritten(file.string(), error);
}

Result<void> printReport(std::string_view content)
{
    std::fflush(stdout);
    const int error = writeAll(STDOUT_FILENO, content);
    return error == 0 ? Result<void>(ok()) : notWritten("the report", error);
}

Result<void> flushOutput()
{
    const int error = std::fflush(stdout) != 0 ? errno : std::ferror(stdout) != 0 ? EIO : 0; // why an earlier part failed is not kept
    std::clearerr(stdout);
    return error == 0 ? Result<void>(ok()) : notWritten("the output", error);
}

} // namespace liena::tools
