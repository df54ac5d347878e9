// From error codes of connect(2) to what a probe reports.
#include "transport/connection_failure.hpp"

#include "transport/own_interfaces.hpp"

namespace liena::transport {

namespace {

/// Without a carrier the kernel knows no way, or waits for an answer as if there were one.
ConnectionFailure unlessHere(ConnectionFailure found, const std::string& place, const std::optional<boost::asio::ip::address>& target)
{
    if (!target || target->is_loopback())
        return found;
    boost::system::error_code noWay;
    const auto missing = missingNetwork(ownInterfaces(), addressTowards(*target, noWay));
    return missing ? ConnectionFailure{ProbeResult::InterfaceDown, place + ": " + *missing} : found;
}

} // namespace

ConnectionFailure explainConnect(const boost::system::error_code& error, const std::string& place,
                                 const std::optional<boost::asio::ip::address>& target)
{
    namespace errors = boost::asio::error;
    const auto detail = place + ": " + error.message();
    if (error == errors::connection_refused || error == errors::connection_reset)
        return {ProbeResult::ConnectionRefused, detail};
    if (error == errors::network_down || error.value() == ENETDOWN)
        return {ProbeResult::InterfaceDown, detail};
    if (error == errors::network_unreachable)
        return unlessHere({ProbeResult::NoRoute, detail}, place, target);
    if (error == errors::host_not_found || error == errors::host_not_found_try_again)
        return {ProbeResult::NoRoute, place + ": the host's name cannot be resolved"};
    return unlessHere({ProbeResult::HostUnreachable, detail}, place, target);
}

ConnectionFailure explainSilence(const std::string& place, const std::optional<boost::asio::ip::address>& target)
{
    return unlessHere({ProbeResult::HostUnreachable, place + ": no answer"}, place, target);
}

} // namespace liena::transport
