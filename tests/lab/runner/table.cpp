// What the lab prints: implementation.
#include "runner/table.hpp"

#include <cstdio>

namespace liena::lab {

namespace {

std::string pairOf(const Sample& sample)
{
    char text[32];
    if (sample.empty())
        return "-";
    std::snprintf(text, sizeof text, "%.0f / %.0f", sample.at(0.5), sample.at(0.99));
    return text;
}

/// Of the detections that the machine did not disturb.
std::string calmOf(const Row& row)
{
    char text[96];
    if (row.calmDetects.empty())
        return {};
    std::snprintf(text, sizeof text, "; %zu of %zu calm: p99.9 %.1f, longest %.1f", row.calmDetects.size(), row.detects.size(),
                  row.calmDetects.at(0.999), row.calmDetects.at(1));
    return text;
}

std::string words(const std::map<std::string, int>& counted)
{
    std::string text;
    for (const auto& [word, count] : counted)
        text += (text.empty() ? "" : ", ") + word + (count > 1 ? " x" + std::to_string(count) : "");
    return text;
}

std::string quoted(const std::string& text)
{
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\')
            result += '\\';
        result += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
    return result + "\"";
}

std::string jsonOf(const Sample& sample)
{
    char text[128];
    if (sample.empty())
        return "null";
    std::snprintf(text, sizeof text, R"({"n": %zu, "p50": %.2f, "p99": %.2f, "p99.9": %.2f, "max": %.2f})", sample.size(), sample.at(0.5),
                  sample.at(0.99), sample.at(0.999), sample.at(1));
    return text;
}

std::string jsonOf(const std::map<std::string, int>& counted)
{
    std::string text = "{";
    for (const auto& [word, count] : counted)
        text += (text.size() > 1 ? ", " : "") + quoted(word) + ": " + std::to_string(count);
    return text + "}";
}

std::string jsonOf(const Row& row)
{
    std::string broken;
    for (const auto& line : row.broken)
        broken += (broken.empty() ? "" : ", ") + quoted(line);
    const auto& tally = row.tally;
    char counts[256];
    std::snprintf(counts, sizeof counts,
                  R"("applied": %llu, "stale": %llu, "repeated": %llu, "not_open": %llu, "unknown": %llu, "unbidden": %llu, "torn": %llu, )"
                  R"("oldest_ms": %.2f, "stall_ms": %.2f)",
                  static_cast<unsigned long long>(tally.applied), static_cast<unsigned long long>(tally.stale),
                  static_cast<unsigned long long>(tally.repeated), static_cast<unsigned long long>(tally.notOpen),
                  static_cast<unsigned long long>(tally.unknown), static_cast<unsigned long long>(tally.unbidden),
                  static_cast<unsigned long long>(tally.torn), tally.oldest, row.stall);
    return "  {\"fault\": " + quoted(row.fault) + ", \"row\": " + quoted(row.row) + ", \"what\": " + quoted(row.sentence) +
           ", \"repetitions\": " + std::to_string(row.repetitions) + ", \"cockpit_detects_ms\": " + jsonOf(row.cockpitDetects) +
           ", \"robot_detects_ms\": " + jsonOf(row.robotDetects) + ", \"calm_detects_ms\": " + jsonOf(row.calmDetects) +
           ", \"drives_stop_ms\": " + jsonOf(row.stops) + ", \"reopen_ms\": " + jsonOf(row.reopens) + ", \"seen\": " + jsonOf(row.seen) +
           ", \"notes\": " + jsonOf(row.notes) + ", " + counts + ", \"broken\": [" + broken + "]}";
}

} // namespace

void printHead()
{
    std::printf("%-15s %-4s %4s  %-13s %-13s %8s %6s %7s %7s %6s  %s\n", "fault", "row", "reps", "detection", "drive stop", "applied",
                "stale", "oldest", "re-open", "stall", "seen");
    std::printf("%-15s %-4s %4s  %-13s %-13s %8s %6s %7s %7s %6s\n", "", "", "", "p50/p99 ms", "p50/p99 ms", "", "etc.", "ms", "p99 ms",
                "ms");
}

void printRow(const Row& row)
{
    char reopens[16] = "-";
    if (!row.reopens.empty())
        std::snprintf(reopens, sizeof reopens, "%.0f", row.reopens.at(0.99));
    const auto notes = words(row.notes);
    const auto calm = calmOf(row);
    std::printf("%-15s %-4s %4d  %-13s %-13s %8llu %6llu %7.1f %7s %6.1f  %s%s%s%s\n", row.fault.c_str(), row.row.c_str(), row.repetitions,
                pairOf(row.detects).c_str(), pairOf(row.stops).c_str(), static_cast<unsigned long long>(row.tally.applied),
                static_cast<unsigned long long>(row.tally.broken()), row.tally.oldest, reopens, row.stall, words(row.seen).c_str(),
                notes.empty() ? "" : "; ", notes.c_str(), calm.c_str());
    for (const auto& line : row.broken)
        std::printf("    BROKEN: %s\n", line.c_str());
    std::fflush(stdout);
}

std::string toJson(const std::vector<Row>& rows)
{
    std::string text = "[\n";
    for (std::size_t i = 0; i < rows.size(); ++i)
        text += jsonOf(rows[i]) + (i + 1 < rows.size() ? ",\n" : "\n");
    return text + "]\n";
}

} // namespace liena::lab
