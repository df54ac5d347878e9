// Why a connection could not be made or ended, in the words of a probe and of a person.
#pragma once

#include "liena/session_state.hpp"

#include <boost/asio/error.hpp>
#include <boost/asio/ip/address.hpp>

#include <optional>
#include <string>

namespace liena::transport {

struct ConnectionFailure {
    ProbeResult probe = ProbeResult::NotProbed;
    std::string detail;
};

/// What a TCP connect that ended with `error` says about the way to the peer. Where nobody answered at `target`, this computer's own
/// interfaces are looked at.
ConnectionFailure explainConnect(const boost::system::error_code& error, const std::string& place,
                                 const std::optional<boost::asio::ip::address>& target = std::nullopt);

/// The same of one that was not answered in time.
ConnectionFailure explainSilence(const std::string& place, const std::optional<boost::asio::ip::address>& target);

} // namespace liena::transport
