// The vessel tree's file format.
#include "vessel_tree.hpp"

#include <charconv>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <unordered_map>

namespace liena::devices {

namespace {

constexpr std::size_t mostPoints = 200'000;
constexpr double farthest = 5'000; // mm; a human body

struct Line {
    long id = 0;
    Vector position;
    double radius = 0;
    long parent = 0;
};

bool readNumber(std::string_view& text, double& value)
{
    const auto start = text.find_first_not_of(" \t\r");
    if (start == std::string_view::npos)
        return false;
    text.remove_prefix(start);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{})
        return false;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return text.empty() || text.front() == ' ' || text.front() == '\t' || text.front() == '\r';
}

// The first complaint about a line, or nothing.
std::string_view readLine(std::string_view text, Line& line)
{
    double values[7] = {};
    for (double& value : values)
        if (!readNumber(text, value))
            return "has not seven numbers: id type x y z radius parent";
    if (text.find_first_not_of(" \t\r") != std::string_view::npos)
        return "has more than seven numbers";
    if (!(std::abs(values[0]) < 1e9 && std::abs(values[6]) < 1e9))
        return "has an id that is no small whole number";
    line.id = static_cast<long>(values[0]);
    line.position = {values[2], values[3], values[4]};
    line.radius = values[5];
    line.parent = static_cast<long>(values[6]);
    if (static_cast<double>(line.id) != values[0] || static_cast<double>(line.parent) != values[6])
        return "has an id that is no whole number";
    if (!(length(line.position) < farthest))
        return "lies farther than 5 m from the origin; positions are in mm";
    if (!(line.radius > 0 && line.radius < 50))
        return "has a radius outside 0 to 50 mm";
    return {};
}

class SwcReader {
public:
    std::string_view add(std::string_view text)
    {
        Line line;
        if (const auto complaint = readLine(text, line); !complaint.empty())
            return complaint;
        if (m_tree.points.size() == mostPoints)
            return "is beyond the 200000 points that a tree may have";
        VesselPoint point{line.position, line.radius, std::nullopt};
        if (line.parent == -1 && !m_tree.points.empty())
            return "begins a second tree; keep one, or join them";
        if (line.parent != -1) {
            const auto parent = m_indices.find(line.parent);
            if (parent == m_indices.end())
                return "names a parent that does not stand above it";
            point.parent = parent->second;
        }
        if (!m_indices.try_emplace(line.id, m_tree.points.size()).second)
            return "repeats the id of another point";
        m_tree.points.push_back(point);
        return {};
    }

    VesselTree take() { return std::move(m_tree); }

private:
    VesselTree m_tree;
    std::unordered_map<long, std::size_t> m_indices;
};

} // namespace

Result<VesselTree> VesselTree::parse(std::string_view text, const std::string& name)
{
    SwcReader reader;
    int number = 0;
    while (!text.empty()) {
        ++number;
        const auto line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(line.size() + 1, text.size()));
        const auto start = line.find_first_not_of(" \t\r");
        if (start == std::string_view::npos || line[start] == '#')
            continue;
        if (const auto complaint = reader.add(line); !complaint.empty())
            return fail(Errc::InvalidArgument, name + ":" + std::to_string(number) + ": this point " + std::string(complaint));
    }
    VesselTree tree = reader.take();
    if (tree.points.size() < 2)
        return fail(Errc::InvalidArgument, name + ": no vessel in it; an SWC file has one point per line: id type x y z radius parent");
    if (VesselWay(tree).length() < 20)
        return fail(Errc::InvalidArgument, name + ": its longest vessel is shorter than 20 mm; positions are in mm");
    return tree;
}

Result<VesselTree> VesselTree::load(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    if (!stream || !(text << stream.rdbuf()))
        return fail(Errc::FileUnreadable, file.string() + ": cannot be read; --vessels wants an SWC file");
    return parse(text.str(), file.string());
}

std::string VesselTree::toSwc() const
{
    std::string text = "# A cerebral arterial tree. id type x y z radius parent; mm; x right, y posterior, z up\n";
    for (std::size_t index = 0; index < points.size(); ++index) {
        const auto& point = points[index];
        const long parent = point.parent ? static_cast<long>(*point.parent) + 1 : -1;
        char line[160];
        std::snprintf(line, sizeof line, "%zu 3 %.3f %.3f %.3f %.3f %ld\n", index + 1, point.position.x, point.position.y, point.position.z,
                      point.radius, parent);
        text += line;
    }
    return text;
}

} // namespace liena::devices
