// Why a connection could not be made or ended, in the words of a probe and of a person.
#pragma once

#include "liena/session_state.hpp"

#include <boost/asio/error.hpp>

#include <string>

namespace liena::transport {

struct ConnectionFailure {
    ProbeResult probe = ProbeResult::NotProbed;
    std::string detail;
};

/// What a TCP connect that ended with `error` says about the way to the peer.
ConnectionFailure explainConnect(const boost::system::error_code& error, const std::string& place);

} // namespace liena::transport
