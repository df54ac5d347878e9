// The shares of our network interfaces.
#pragma once

#include "tasks/fair_share.hpp"

#include <boost/asio/ip/address.hpp>

#include <map>
#include <memory>

namespace liena::tasks {

/// Network thread. By the address of our end of a connection.
class InterfaceShares {
public:
    std::shared_ptr<FairShare> of(const boost::asio::ip::address& local)
    {
        auto& share = m_shares[local];
        if (!share)
            share = std::make_shared<FairShare>();
        return share;
    }

private:
    std::map<boost::asio::ip::address, std::shared_ptr<FairShare>> m_shares;
};

} // namespace liena::tasks
