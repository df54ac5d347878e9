// From error codes of connect(2) to what a probe reports.
#include "transport/connection_failure.hpp"

namespace liena::transport {

ConnectionFailure explainConnect(const boost::system::error_code& error, const std::string& place)
{
    namespace errors = boost::asio::error;
    const auto detail = place + ": " + error.message();
    if (error == errors::connection_refused || error == errors::connection_reset)
        return {ProbeResult::ConnectionRefused, detail};
    if (error == errors::network_down || error.value() == ENETDOWN)
        return {ProbeResult::InterfaceDown, detail};
    if (error == errors::network_unreachable)
        return {ProbeResult::NoRoute, detail};
    if (error == errors::host_not_found || error == errors::host_not_found_try_again)
        return {ProbeResult::NoRoute, place + ": the host's name cannot be resolved"};
    return {ProbeResult::HostUnreachable, detail};
}

} // namespace liena::transport
