// What /proc says about a process of the lab: implementation.
#include "runner/process_facts.hpp"

#include "liena/hash.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <sstream>
#include <system_error>

namespace liena::lab {

namespace {

namespace fs = std::filesystem;

constexpr auto filling = "filling";

fs::path procOf(pid_t process) { return fs::path("/proc") / std::to_string(process); }

std::size_t countEntries(const fs::path& folder)
{
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

std::uint64_t statusField(pid_t process, const std::string& name)
{
    std::ifstream file(procOf(process) / "status");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with(name + ":"))
            return std::stoull(line.substr(name.size() + 1));
    return 0;
}

} // namespace

std::size_t countDescriptors(pid_t process) { return countEntries(procOf(process) / "fd"); }

std::size_t countThreads(pid_t process) { return countEntries(procOf(process) / "task"); }

std::size_t countTimers(pid_t process)
{
    std::size_t count = 0;
    for (const auto& entry : fs::directory_iterator(procOf(process) / "fd")) {
        std::error_code gone;
        count += fs::read_symlink(entry.path(), gone).string().find("timerfd") != std::string::npos;
    }
    std::ifstream timers(procOf(process) / "timers");
    for (std::string line; std::getline(timers, line);)
        count += line.starts_with("ID:");
    return count;
}

std::uint64_t residentKiB(pid_t process) { return statusField(process, "VmRSS"); }

std::uint64_t anonymousKiB(pid_t process) { return statusField(process, "RssAnon"); }

double processorSeconds(pid_t process)
{
    std::ifstream file(procOf(process) / "stat");
    std::string text((std::istreambuf_iterator<char>(file)), {});
    std::istringstream fields(text.substr(text.rfind(')') + 1));
    std::string skipped;
    for (int field = 3; field < 14; ++field)
        fields >> skipped;
    double user = 0;
    double system = 0;
    fields >> user >> system;
    return (user + system) / static_cast<double>(::sysconf(_SC_CLK_TCK));
}

void limitDescriptors(pid_t process, std::size_t count)
{
    rlimit limit{};
    if (::prlimit(process, RLIMIT_NOFILE, nullptr, &limit) == 0) {
        limit.rlim_cur = count;
        if (::prlimit(process, RLIMIT_NOFILE, &limit, nullptr) == 0)
            return;
    }
    throw std::system_error(errno, std::generic_category(), "cannot limit a process's descriptors");
}

fs::path diskOf(pid_t process, const fs::path& folder) { return procOf(process) / "root" / folder.relative_path(); }

void fillDisk(const fs::path& folder)
{
    std::ofstream file(folder / filling, std::ios::app);
    const std::string block(512, 'x');
    while (file.write(block.data(), static_cast<std::streamsize>(block.size())).flush()) {
    }
}

void emptyDisk(const fs::path& folder) { fs::remove(folder / filling); }

std::string incompleteFiles(const fs::path& folder)
{
    std::string names;
    for (const auto& entry : fs::directory_iterator(folder)) {
        const auto name = entry.path().filename().string();
        if (name == filling || name == "pins")
            continue;
        std::ifstream file(entry.path());
        const std::string content((std::istreambuf_iterator<char>(file)), {});
        if (Sha256::of(content).toHex() + ".xml" != name)
            names += name + " ";
    }
    return names;
}

} // namespace liena::lab
