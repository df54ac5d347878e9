// Whether a line is good enough: the figures of a measurement against what a procedure asks.
#pragma once

#include "line_profile.hpp"

#include <liena/measurement.hpp>

#include <optional>
#include <string>
#include <vector>

namespace liena::tools {

/// The phases of a bench run, by name.
namespace phases {
inline constexpr auto paced = "paced";                ///< commands in their rhythm, and packets
inline constexpr auto backToBack = "back-to-back";    ///< one command at a time, the next on its echo
inline constexpr auto messages = "messages";          ///< as many commands as go
inline constexpr auto besideImages = "beside-images"; ///< as paced, while images flow in theirs
inline constexpr auto images = "images";              ///< as many images as go
} // namespace phases

enum class Verdict : std::uint8_t { Go, Caution, NoGo };

/// `GO`, `CAUTION`, `NO-GO`.
std::string_view wordOf(Verdict verdict);

struct JudgedFigure {
    Figure figure = Figure::RoundTrip;
    std::optional<double> value;        ///< in the figure's unit; nothing when it could not be measured
    std::optional<FigureLimits> limits; ///< nothing when the profile has none
    Verdict verdict = Verdict::Go;
    std::string reason; ///< for a person; empty when all is well
};

struct LineVerdict {
    Verdict verdict = Verdict::Go;     ///< the worst of the figures'
    std::vector<JudgedFigure> figures; ///< in the order of the table of figures
};

/// Three digits, or as many as it takes to write it without an exponent and to tell it from `limit`: 99.88 is not "99.9", which 99.9 would
/// be as well.
std::string numberText(double value, std::optional<double> limit = std::nullopt);

/// Of fewer, one alone is more than the share that may be worse: that there is none tells nothing. 100 for 99 %; for 100 %, which no number
/// tells, as for 99.9.
double neededFor(double percent);

/// Packets of which none is lost, that no more than so many percent of them may be. Rule of three (Hanley and Lippman-Hand, JAMA 249 (1983)
/// 1743-1745): where none of n is lost, up to 3 in n may be, with 95 % confidence.
double neededForLoss(double percent);

/// What of a measurement is a figure; nothing when it was not measured, `why` says the reason then.
std::optional<double> valueOf(Figure figure, const Measurement& measurement, std::string& why);

LineVerdict judge(const Measurement& measurement, const LineProfile& profile);

/// The phase of that name; null when it was not measured.
const PhaseFigures* phaseOf(const Measurement& measurement, std::string_view name);

} // namespace liena::tools
