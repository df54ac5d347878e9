// X-ray frames made for tests: a known picture in every depth and encoding.
#pragma once

#include "model/xray_frame.hpp"

#include <QSize>

#include <cstdint>
#include <memory>
#include <vector>

namespace console::samples {

/// A picture in which every row and column differs and the whole range of `bits` occurs.
std::vector<std::uint16_t> storedValues(QSize size, int bits);

std::vector<std::byte> encode(const std::vector<std::uint16_t>& values, QSize size, int bits, PixelEncoding encoding, int quality);

/// jpeg-ls: quality is the largest error; jpeg: its quality, and 8 bits only. The window covers all values; source simulated, age 20 ms.
/// Number 1 has storedValues(); in the next seven another last pixel tells one from the other.
std::shared_ptr<XrayFrame> frame(quint32 number, QSize size, int bits, PixelEncoding encoding, int quality = 0);

/// The same with these encoded bytes in place of its own.
std::shared_ptr<XrayFrame> withBytes(const XrayFrame& frame, std::vector<std::byte> bytes);

/// DICOM PS3.3 C.11.2.1.2 for whole numbers, in integers: independent of the code under test.
int linearGrey(int stored, int centre, int width);

} // namespace console::samples
