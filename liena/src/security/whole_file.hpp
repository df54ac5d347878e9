// Files that appear whole or not at all.
#pragma once

#include "liena/error.hpp"

#include <filesystem>
#include <string>
#include <string_view>

#include <sys/types.h>

namespace liena::security {

/// A new content of a file, written and synced beside it under a temporary name until publish(); removed again if that never comes.
class StagedFile {
public:
    /// The temporary file has `mode` before the first byte is in it.
    static Result<StagedFile> write(const std::filesystem::path& target, std::string_view content, mode_t mode);

    StagedFile(StagedFile&& other) noexcept;
    StagedFile& operator=(StagedFile&&) = delete;
    ~StagedFile();

    /// Takes the target's name. Without `replace` a target that exists is left alone and is an error.
    Result<void> publish(bool replace);

private:
    StagedFile(std::filesystem::path target, std::filesystem::path temporary);

    std::filesystem::path m_target;
    std::filesystem::path m_temporary; ///< empty once published
};

/// Refuses a secret file that its group or others may use, or that belongs to another user than `user`; names it and the cure.
Result<void> requireSecret(const std::filesystem::path& file, mode_t mode, uid_t owner, uid_t user);

/// A regular file of at most 1 MiB. A secret one has to pass requireSecret() for the user of this process.
enum class Secrecy : bool { Open, Secret };
Result<std::string> readFile(const std::filesystem::path& file, Secrecy secrecy = Secrecy::Open);

} // namespace liena::security
