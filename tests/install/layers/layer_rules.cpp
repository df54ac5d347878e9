// The table of the architecture as data, and its application to include lines.
#include "layer_rules.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <optional>
#include <regex>

namespace liena::test {

namespace {

struct Room {
    std::string folder; ///< in the source tree
    std::string name;   ///< as include lines begin
    std::vector<std::string> known;
};

const std::vector<Room>& rooms()
{
    static const std::vector<Room> table{
        {"liena/src/base/", "base", {}},
        {"liena/src/audit/", "audit", {"base"}},
        {"liena/src/protocol/", "protocol", {"base"}},
        {"liena/src/topology/", "topology", {"protocol", "base"}},
        {"liena/src/session/", "session", {"protocol", "base"}},
        {"liena/src/cache/", "cache", {"protocol", "base"}},
        {"liena/src/security/", "security", {"base"}},
        {"liena/src/transport/", "transport", {"security", "protocol", "base"}},
        {"liena/src/tasks/", "tasks", {"transport", "session", "cache", "security", "protocol", "base"}},
        {"liena/src/system/", "system", {"tasks", "topology", "transport", "session", "cache", "security", "audit", "protocol", "base"}},
        {"console/model/", "model", {}},
        {"console/input/", "input", {"model"}},
        {"console/sound/", "sound", {"model"}},
        {"console/watchdog/", "watchdog", {"sound", "model"}},
        {"console/seat/", "seat", {}},
        {"console/imaging/", "imaging", {"model"}},
        {"console/widgets/", "widgets", {"imaging", "model"}},
        {"console/editor/", "editor", {"widgets", "model"}},
        {"console/link/", "link", {"model"}},
        {"console/app/", "app", {"widgets", "editor", "input", "link", "imaging", "sound", "watchdog", "seat", "model"}},
    };
    return table;
}

struct Library {
    std::string name;
    std::string includes; ///< regular expression for the start of the included name
    std::vector<std::string> places;
};

const std::vector<Library>& libraries()
{
    static const std::vector<Library> table{
        {"Asio", "boost/(asio|beast)", {"liena/src/transport/", "liena/src/tasks/", "liena/src/system/"}},
        {"pugixml", "pugi", {"liena/src/topology/"}},
        {"OpenSSL", "openssl/", {"liena/src/security/", "liena/src/transport/", "liena/src/base/hash.cpp"}},
        {"Qt", "(Qt?[A-Z]|qt|qobject)", {"console/"}},
        {"A dialog, for which all else waits,", "(Qt[A-Z]\\w*/)?Q(\\w*Dialog|MessageBox|ErrorMessage|Wizard)\\b", {}},
        {"Qt Multimedia", "(QtMultimedia|QAudio|QMedia|QSound)", {"console/sound/"}},
        {"Qt D-Bus", "(QtDBus|QDBus)", {"console/seat/"}},
        {"SDL", "SDL", {"console/input/"}},
        {"libspnav", "spnav\\.h", {"console/input/"}},
        {"VTK", "vtk", {"console/imaging/"}},
        {"OpenCV", "opencv", {"console/imaging/"}},
        {"OpenGL", "(GL|EGL|KHR)/", {"console/imaging/"}},
        {"DCMTK", "dcmtk/", {"console/imaging/", "liena/devices/"}},
        {"CharLS", "charls/", {"liena/devices/"}},
        {"libjpeg-turbo", "(turbojpeg|jpeglib)", {"console/imaging/", "liena/devices/"}},
        {"CLI11", "CLI/", {"liena/options/", "liena/tools/", "liena/devices/", "console/app/"}},
    };
    return table;
}

/// Public headers that only some rooms of the library may use, since what they declare lies above the others.
struct Summit {
    std::string header;
    std::vector<std::string> places;
};

const std::vector<Summit>& summits()
{
    static const std::vector<Summit> table{
        {"liena/distributed_system.hpp", {"liena/src/system/"}},
        {"liena/message_cache.hpp", {"liena/src/cache/", "liena/src/tasks/", "liena/src/system/"}},
    };
    return table;
}

bool startsWithAny(std::string_view text, const std::vector<std::string>& beginnings)
{
    return std::any_of(beginnings.begin(), beginnings.end(), [&](const std::string& b) { return text.starts_with(b); });
}

std::string listed(const std::vector<std::string>& names)
{
    std::string list;
    for (const auto& name : names)
        list += (list.empty() ? "" : ", ") + name;
    return list.empty() ? "nothing else of the project" : list;
}

const Room* roomAt(std::string_view file)
{
    const auto at = std::find_if(rooms().begin(), rooms().end(), [&](const Room& room) { return file.starts_with(room.folder); });
    return at != rooms().end() ? &*at : nullptr;
}

bool sameTree(std::string_view file, std::string_view folder)
{
    return file.substr(0, file.find('/')) == folder.substr(0, folder.find('/'));
}

/// The room of the same tree that an include line begins with.
const Room* roomMeant(std::string_view file, std::string_view included)
{
    const auto first = included.substr(0, included.find('/'));
    if (first.size() == included.size())
        return nullptr;
    const auto at =
        std::find_if(rooms().begin(), rooms().end(), [&](const Room& room) { return room.name == first && sameTree(file, room.folder); });
    return at != rooms().end() ? &*at : nullptr;
}

std::optional<std::string> againstLibraries(std::string_view file, const std::string& included)
{
    for (const auto& library : libraries()) {
        const std::regex beginning(library.includes);
        if (std::regex_search(included, beginning, std::regex_constants::match_continuous) && !startsWithAny(file, library.places))
            return library.name + " is for " + (library.places.empty() ? "nobody" : listed(library.places) + " only");
    }
    if (file.starts_with("liena/include/") && (included.starts_with("fmt/") || included.starts_with("boost/")) &&
        !included.starts_with("boost/outcome/") && !included.starts_with("boost/container/"))
        return "of libraries, public headers may use Boost.Outcome and Boost.Container only";
    return std::nullopt;
}

std::optional<std::string> againstPublicHeaders(std::string_view file, const std::string& included)
{
    if (!included.starts_with("liena/"))
        return std::nullopt;
    if (file.starts_with("console/") && !file.starts_with("console/link/"))
        return "in the console only link/ includes liena's headers";
    for (const auto& summit : summits())
        if (file.starts_with("liena/src/") && included == summit.header && !startsWithAny(file, summit.places))
            return "this header is for " + listed(summit.places) + " only";
    return std::nullopt;
}

std::optional<std::string> againstRooms(std::string_view file, const std::string& included)
{
    if (included.find("..") != std::string::npos)
        return "an include line does not climb; name the room";
    const Room* const meant = roomMeant(file, included);
    if (meant == nullptr)
        return std::nullopt;
    const Room* const own = roomAt(file);
    if (own == nullptr)
        return "only liena/… and files beside it may be included here";
    if (own == meant || std::find(own->known.begin(), own->known.end(), meant->name) != own->known.end())
        return std::nullopt;
    return own->name + " may know " + listed(own->known);
}

std::optional<std::string> againstQtCore(std::string_view file, const std::string& included, const std::filesystem::path& qtCore)
{
    const bool isQt = included.size() > 1 && included[0] == 'Q' && (std::isupper(included[1]) != 0 || included[1] == 't');
    if (!file.starts_with("console/model/") || !isQt || included.starts_with("QtCore/") || std::filesystem::exists(qtCore / included))
        return std::nullopt;
    return "model is Qt Core only";
}

} // namespace

Violations checkIncludes(const std::string& file, std::string_view text, const std::filesystem::path& qtCore)
{
    static const std::regex includeLine(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
    Violations violations;
    int number = 0;
    while (!text.empty()) {
        const auto end = std::min(text.find('\n'), text.size() - 1);
        const std::string line(text.substr(0, end + 1));
        text.remove_prefix(end + 1);
        ++number;
        std::smatch match;
        if (!std::regex_search(line, match, includeLine))
            continue;
        const auto included = match[1].str();
        for (const auto& reason : {againstLibraries(file, included), againstPublicHeaders(file, included), againstRooms(file, included),
                                   againstQtCore(file, included, qtCore)})
            if (reason)
                violations.push_back(file + ":" + std::to_string(number) + ": includes " + included + ", but " + *reason);
    }
    return violations;
}

std::vector<std::filesystem::path> sourcesOf(const std::filesystem::path& tree)
{
    std::vector<std::filesystem::path> files;
    for (const char* top : {"liena", "console"})
        for (const auto& entry : std::filesystem::recursive_directory_iterator(tree / top)) {
            const auto name = entry.path().filename().string();
            if (entry.is_regular_file() && std::regex_search(name, std::regex(R"(\.(hpp|cpp|h|c|hpp\.in)$)")))
                files.push_back(entry.path());
        }
    std::sort(files.begin(), files.end());
    return files;
}

Violations checkTree(const std::filesystem::path& tree, const std::filesystem::path& qtCore)
{
    Violations violations;
    for (const auto& file : sourcesOf(tree)) {
        std::ifstream stream(file, std::ios::binary);
        const std::string text{std::istreambuf_iterator<char>(stream), {}};
        const auto found = checkIncludes(std::filesystem::relative(file, tree).generic_string(), text, qtCore);
        violations.insert(violations.end(), found.begin(), found.end());
    }
    return violations;
}

} // namespace liena::test
