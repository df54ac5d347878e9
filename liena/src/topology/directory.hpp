// A folder held open as a descriptor: files are named relative to it and never through a link.
#pragma once

#include "liena/error.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace liena {

/// What the system says about an errno.
std::string systemText(int code);

class FileDescriptor {
public:
    FileDescriptor() = default;
    explicit FileDescriptor(int descriptor) : m_descriptor(descriptor) {}
    FileDescriptor(FileDescriptor&& other) noexcept : m_descriptor(std::exchange(other.m_descriptor, -1)) {}
    FileDescriptor& operator=(FileDescriptor&& other) noexcept
    {
        std::swap(m_descriptor, other.m_descriptor);
        return *this;
    }
    ~FileDescriptor();

    explicit operator bool() const { return m_descriptor >= 0; }
    int get() const { return m_descriptor; }

private:
    int m_descriptor = -1;
};

/// Names are plain file names in this folder; a name with a slash is refused by the kernel or here.
class Directory {
public:
    /// Makes the folder (mode 0700) when it is not there; its parent must be.
    static Result<Directory> open(const std::filesystem::path& folder);

    /// A link counts as being there, wherever it leads.
    bool exists(const std::string& name) const;

    Result<std::string> read(const std::string& name, std::size_t limit) const;

    /// Whole or not at all, mode 0600: a temporary file, synchronised, then renamed over `name`.
    Result<void> write(const std::string& name, std::string_view bytes) const;

    Result<std::vector<std::string>> names() const;

    /// Held while the result lives: one writer at a time, over all processes.
    Result<FileDescriptor> lock() const;

    const std::filesystem::path& path() const { return m_path; }

private:
    FileDescriptor openFile(const std::string& name, int flags) const;

    std::filesystem::path m_path; ///< for sentences only
    FileDescriptor m_descriptor;
};

} // namespace liena
