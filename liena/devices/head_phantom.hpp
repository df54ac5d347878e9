// A head, neck and chest made of ellipsoids, and what they take from the X-rays.
#pragma once

#include "c_arm_projection.hpp"

#include <vector>

namespace liena::devices {

/// For each pixel, row by row, the line integral of the attenuation coefficient (no unit): what Beer and Lambert's law has in its exponent.
/// `origin` is where the phantom's centre, the middle of the brain, lies in the patient's frame.
std::vector<float> headAttenuation(const CArmProjection& projection, Vector origin);

} // namespace liena::devices
