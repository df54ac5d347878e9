// What a procedure asks of a line: limits for the figures of a measurement, read from a file that a site may write itself.
#pragma once

#include <liena/error.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace liena::tools {

/// Milliseconds, percent, or megabytes per second, each judged by itself.
enum class Figure : std::uint8_t {
    RoundTrip,             ///< 99th percentile of a command and its echo, on the idle line
    RoundTripBesideImages, ///< the same while images flow
    TailBesideImages,      ///< the 99.9th percentile of that: how late the rare late ones are
    Jitter,                ///< of packets: 99.9th percentile of the round trip less the least, on the idle line
    JitterBesideImages,    ///< the same while images flow
    Loss,                  ///< of packets, both ways together
    CommandsCarried,       ///< whose echo came back, of those that were due; of both rhythms the lesser
    ImageRate,             ///< that the line carries
    ImagesCarried,         ///< of those that were due
    ImageDelivery,         ///< 99th percentile, from due to heard whole
};

struct FigureKind {
    Figure figure;
    std::string_view name;  ///< in profiles, as round-trip-p99
    std::string_view words; ///< for people
    std::string_view unit;
    bool leastWanted; ///< a greater figure is better
};

inline constexpr std::array figureKinds{
    FigureKind{Figure::RoundTrip, "round-trip-p99", "round trip of commands, idle, 99 %", "ms", false},
    FigureKind{Figure::RoundTripBesideImages, "round-trip-beside-images-p99", "round trip of commands beside images, 99 %", "ms", false},
    FigureKind{Figure::TailBesideImages, "round-trip-beside-images-p99.9", "round trip of commands beside images, 99.9 %", "ms", false},
    FigureKind{Figure::Jitter, "jitter", "jitter of packets, idle, 99.9 %", "ms", false},
    FigureKind{Figure::JitterBesideImages, "jitter-beside-images", "jitter of packets beside images, 99.9 %", "ms", false},
    FigureKind{Figure::Loss, "loss", "loss of packets, both ways", "%", false},
    FigureKind{Figure::CommandsCarried, "commands-carried", "commands that came back, of those due", "%", true},
    FigureKind{Figure::ImageRate, "image-rate", "rate that images are carried at", "MB/s", true},
    FigureKind{Figure::ImagesCarried, "images-carried", "images that arrived", "%", true},
    FigureKind{Figure::ImageDelivery, "image-delivery-p99", "delivery of an image, 99 %", "ms", false},
};

/// The kind with that place in the table.
const FigureKind& kindOf(Figure figure);

/// A figure up to `go` is good, one up to `caution` needs a person's judgement; the other way round where more is better.
struct FigureLimits {
    double go = 0;
    double caution = 0;
};

struct LineProfile {
    std::string name; ///< of its file, without the ending
    std::string title;
    double commandsPerSecond = 500;
    double framesPerSecond = 15;
    std::uint32_t imageBytes = 1U << 20U;
    std::map<Figure, FigureLimits> limits;

    /// `file` is named in errors, with the line and what to write instead.
    static Result<LineProfile> parse(std::string_view text, const std::string& file);

    /// A file, or the name of one of those that come with LiENa.
    static Result<LineProfile> load(const std::string& nameOrFile);
};

/// `512 KiB`, `1.5 MiB` or `2000000`; nothing for what is no size up to 8 MiB.
std::optional<std::uint32_t> imageBytesFrom(std::string_view text);

} // namespace liena::tools
