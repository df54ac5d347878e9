// Where a running device shows itself to `liena monitor`.
#pragma once

#include "liena/device_id.hpp"

#include <filesystem>

namespace liena {

/// `$XDG_RUNTIME_DIR/liena`, or `/tmp/liena-<user id>` where there is none. For Settings::status; a device makes it with mode 0700.
std::filesystem::path statusFolder();

/// `<folder>/40018208.sock`. Who connects gets one JSON object per line: one at once, and one each second.
std::filesystem::path statusSocket(const std::filesystem::path& folder, DeviceId device);

} // namespace liena
