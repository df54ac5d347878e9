// Pictures whose every byte follows from their number, so that the receiver can tell a whole one from a torn one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace liena::lab {

std::vector<std::byte> pictureOf(std::uint32_t frame, std::size_t size);
bool isPictureOf(std::uint32_t frame, std::span<const std::byte> bytes);

} // namespace liena::lab
