// The VOI LUT functions of DICOM PS3.3 C.11.2: from stored values to values for presentation.
#pragma once

#include "model/display_settings.hpp"

namespace console {

/// 0 … `largest`, not rounded. LINEAR: C.11.2.1.2; SIGMOID: C.11.2.1.3.1; LINEAR_EXACT: C.11.2.1.3.2. The window must be known.
double voiValue(double stored, GreyWindow window, VoiFunction function, double largest);

} // namespace console
