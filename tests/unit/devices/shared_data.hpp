// Real data for trying, when they lie beside the project.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

/// The file or folder of that name below the shared data; nothing when it is not there.
inline std::optional<std::filesystem::path> sharedData(const std::string& name)
{
    const char* named = std::getenv("LIENA_SHARED_DATA");
    const auto root = named ? std::filesystem::path(named) : std::filesystem::path(LIENA_SOURCE_DIR) / ".." / "shared" / "data";
    const auto path = root / name;
    return std::filesystem::exists(path) ? std::optional(path) : std::nullopt;
}
