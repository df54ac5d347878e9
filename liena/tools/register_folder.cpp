// The project's folder goes before the installed one: whoever works there means its files.
#include "register_folder.hpp"

#include <system_error>

namespace liena::tools {

namespace {

constexpr auto inProject = "resources/devices";

} // namespace

std::filesystem::path registerFolder(const std::filesystem::path& working, const std::filesystem::path& program)
{
    const auto project = working / inProject;
    const auto installed = (program.parent_path() / LIENA_DATA_FROM_PROGRAM / "devices").lexically_normal();
    std::error_code none;
    const bool elsewhere = !std::filesystem::is_directory(project, none) && std::filesystem::is_directory(installed, none);
    return elsewhere && !program.empty() ? installed : project;
}

std::filesystem::path registerFolder()
{
    std::error_code none; // without /proc there is no program's place, and so no installed folder
    return registerFolder({}, std::filesystem::read_symlink("/proc/self/exe", none));
}

} // namespace liena::tools
