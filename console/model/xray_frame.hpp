// One X-ray picture on its way from the link to the screen: what is said about it, and its encoded pixels, shared.
#pragma once

#include "model/instant.hpp"
#include "model/xray_state.hpp"

#include <QString>
#include <QtGlobal>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

namespace console {

enum class Photometric : std::uint8_t {
    Monochrome1 = 1, ///< the lowest value is white
    Monochrome2 = 2, ///< the lowest value is black
};

enum class PixelEncoding : std::uint8_t {
    Raw,    ///< row by row from the top left; above 8 bits two bytes a pixel, low byte first
    JpegLs, ///< ISO 14495-1
    Jpeg,   ///< ISO 10918-1 baseline, 8 bits
};

enum class IntensityRelationship : std::uint8_t {
    Linear = 1,
    Logarithmic = 2,
    Display = 3, ///< made for display; no quantitative use
};

enum class PictureSource : std::uint8_t { Live = 1, Simulated = 2, Recorded = 3 };

/// LIVE, SIMULATED, RECORDED: the mark that is painted with the picture.
QString word(PictureSource source);

/// Immutable once made; any thread.
struct XrayFrame {
    quint32 frame = 0;
    quint32 acquisition = 0;
    PictureSource source = PictureSource::Recorded;
    int rows = 0;
    int columns = 0;
    int bitsStored = 0;
    Photometric photometric = Photometric::Monochrome2;
    PixelEncoding encoding = PixelEncoding::Raw;
    int quality = 0;
    IntensityRelationship intensity = IntensityRelationship::Linear;
    double imagerPixelSpacing = 0; ///< mm at the detector; 0 = unknown
    double windowCentre = 0;
    double windowWidth = 0; ///< 0 = unknown
    XrayGeometry geometry;  ///< without the table
    bool mask = false;

    // What the way to the viewers made of it; reductionOf() puts it together.
    int rung = 0;         ///< step of the X-ray system's declared ladder; 0: as asked for
    double rate = 0;      ///< per second; 0 = not said
    double askedRate = 0; ///< per second; 0 = not said
    PixelEncoding askedEncoding = PixelEncoding::Raw;
    std::size_t encodedBytes = 0; ///< that came of it; stays when `pixels` are let go; 0 = unknown

    quint64 captureNs = 0; ///< Unix time of the X-ray system
    Instant arrival;       ///< here, last byte

    bool isLossy() const { return encoding == PixelEncoding::Jpeg || (encoding == PixelEncoding::JpegLs && quality > 0); }

    /// From the pulse's end to `arrival`, both clocks compared; nothing while the clock offset is unknown.
    std::optional<Duration> ageAtArrival;
    Duration ageUncertainty{}; ///< meaningful only with ageAtArrival, as is the next one
    Duration beforeSending{};  ///< the part of it that passed at the X-ray system, until the frame was sent: one clock told it

    /// When the pulse ended on our monotonic clock; nothing while the offset is unknown.
    std::optional<Instant> captured() const { return ageAtArrival ? std::optional<Instant>(arrival - *ageAtArrival) : std::nullopt; }

    /// When it can have been taken at the earliest, never later than `arrival`. Where the clocks do not tell, it can be as old as the X-ray
    /// system's reports may be.
    Instant earliestCapture() const
    {
        const auto at = captured();
        return at ? std::min(*at - ageUncertainty, arrival) : arrival - XraySystemState::statusLimit;
    }

    std::shared_ptr<const void> owner; ///< keeps `pixels` alive: the picture travels without a copy
    std::span<const std::byte> pixels;
};

} // namespace console
