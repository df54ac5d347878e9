// Where the X-ray system's pictures come from: a generator, a DICOM cine or a folder.
#pragma once

#include "xray_machine.hpp"

#include "liena/error.hpp"

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace liena::devices {

// The numbers are those of the enums in the X-ray system's message set.
enum class Photometric : std::uint8_t { Monochrome1 = 1, Monochrome2 = 2 };
enum class IntensityRelationship : std::uint8_t { Linear = 1, Logarithmic = 2, Display = 3 };
enum class PictureSource : std::uint8_t { Live = 1, Simulated = 2, Recorded = 3 };

/// What a picture's pixels mean.
struct PictureFormat {
    std::uint16_t rows = 0;
    std::uint16_t columns = 0;
    std::uint8_t bitsStored = 8;
    Photometric photometric = Photometric::Monochrome2;
    IntensityRelationship relationship = IntensityRelationship::Display;
    PictureSource source = PictureSource::Simulated;
    double imagerPixelSpacing = 0; ///< mm at the detector; 0 = unknown
    double windowCentre = 0;
    double windowWidth = 0; ///< 0 = unknown
    double primaryAngle = 0;
    double secondaryAngle = 0;
    double sourceDetectorDistance = 0; ///< 0 = unknown
    double sourceObjectDistance = 0;   ///< 0 = unknown
    bool mask = false;
};

struct Picture {
    PictureFormat format;
    std::vector<std::uint16_t> pixels; ///< row by row from the top left
};

/// What the robot reported last, as the picture shows it.
struct InstrumentView {
    bool present = false;
    double guidewire = 0; ///< mm along the way
    double guidewireAngle = 0;
    double catheter = 0;
    double contrastFlow = 0; ///< ml/s out of the catheter now
};

/// One pulse.
struct Exposure {
    std::chrono::nanoseconds time{}; ///< monotonic, of the pulse
    AcquisitionMode mode = AcquisitionMode::Fluoroscopy;
    std::uint32_t acquisition = 0;
    CArmGeometry geometry;
    InstrumentView instruments;
    unsigned pulses = 1; ///< of the asked rate from this picture to the next: a recording goes on by so many
};

/// Used by one thread, the picture thread; may take a good part of a pulse period.
class ImageSource {
public:
    virtual ~ImageSource() = default;

    /// A sentence for the log.
    virtual std::string describe() const = 0;

    /// Pictures per second at which it wants to be played; 0: as the cockpit asks.
    virtual double ownRate() const { return 0; }

    /// The next picture into `picture`, whose memory is used again.
    virtual Result<void> next(const Exposure& exposure, Picture& picture) = 0;
};

} // namespace liena::devices
