// What stands between this computer and a device, step by step, in plain words.
#pragma once

#include "liena/device_id.hpp"
#include "liena/system_topology.hpp"

#include <chrono>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace liena {

struct ProbeStep {
    enum class Result : std::uint8_t { Ok, Failed, Skipped };

    std::string name; ///< own-files, name, route, port, tls, identity, certificate, revocation, acceptance
    Result result = Result::Ok;
    std::string text;   ///< what was found
    std::string remedy; ///< what to do; empty unless it failed
    std::chrono::nanoseconds took{};
};

std::string_view toString(ProbeStep::Result result);

/// Who asks, and for whom. The files are those of a device of this computer; they are not needed in mode `none`.
struct ProbeRequest {
    TopologyDevice target;
    SecurityMode security = SecurityMode::Tls;
    DeviceId self;
    std::filesystem::path certificate;
    std::filesystem::path key;
    std::filesystem::path authority;
    std::filesystem::path revocations;     ///< empty: beside the authority
    std::chrono::milliseconds limit{2000}; ///< of each step
};

/// Goes as far as it gets: what depends on a step that failed is skipped. It ends before a session could begin, so a device in the middle
/// of its sessions is not disturbed: nothing is said on the connection after the TLS handshake. Blocks; any thread.
std::vector<ProbeStep> probeDevice(const ProbeRequest& request);

} // namespace liena
