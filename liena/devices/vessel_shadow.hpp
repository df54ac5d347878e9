// Where vessels and instruments fall on the detector, and how thick they are there.
#pragma once

#include "c_arm_projection.hpp"
#include "image_source.hpp"
#include "vessel_tree.hpp"

#include <cstdint>
#include <vector>

namespace liena::devices {

/// One pixel's way through one piece of vessel.
struct VesselCrossing {
    std::uint32_t pixel = 0; ///< row × size + column
    std::uint32_t point = 0; ///< of the tree: the piece between it and its parent
    float thickness = 0;     ///< mm along the ray
};

/// All crossings of one geometry, in the order of the tree.
std::vector<VesselCrossing> vesselShadow(const CArmProjection& projection, const VesselTree& tree);

/// Adds the attenuation of guidewire and catheter to `lines`.
void addInstruments(const CArmProjection& projection, const VesselWay& way, const InstrumentView& view, std::vector<float>& lines);

} // namespace liena::devices
