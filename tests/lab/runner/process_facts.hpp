// What /proc says about a process of the lab, and what the lab does to its disk and its limits.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

namespace liena::lab {

std::size_t countDescriptors(pid_t process);
std::size_t countThreads(pid_t process);
std::size_t countTimers(pid_t process);    ///< timer descriptors and POSIX timers; the library's own lie in its memory
std::uint64_t residentKiB(pid_t process);  ///< all of it
std::uint64_t anonymousKiB(pid_t process); ///< what it has allocated and touched: its heap and stacks
double processorSeconds(pid_t process);    ///< user and system, since its start

/// So that no descriptor above the present count may be opened.
void limitDescriptors(pid_t process, std::size_t count);

/// A folder as that process sees it: its mounts may differ from ours.
std::filesystem::path diskOf(pid_t process, const std::filesystem::path& folder);
void fillDisk(const std::filesystem::path& folder);
void emptyDisk(const std::filesystem::path& folder);

/// Names of files there that are neither the lab's filling, nor pins, nor a set whose content is that of its name. Empty: none.
std::string incompleteFiles(const std::filesystem::path& folder);

} // namespace liena::lab
