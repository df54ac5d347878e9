// Sockets for whose packets the kernel asks the network card before a thread sleeps (SO_BUSY_POLL, socket(7)).
#pragma once

#include "liena/error.hpp"

#include <chrono>
#include <optional>

namespace liena::system {

/// What the kernel said and has been told.
struct CardSearchFacts {
    int error = 0;               ///< of the trial on a socket; 0: it is permitted
    std::optional<int> busyRead; ///< net.core.busy_read: more than this needs CAP_NET_ADMIN
    std::optional<int> busyPoll; ///< net.core.busy_poll: 0 lets whoever waits for many sockets sleep at once
};

CardSearchFacts readCardSearchFacts(std::chrono::microseconds wanted);

/// The error names what is not permitted, or would have no effect, and how to change it.
Result<void> judgeCardSearch(std::chrono::microseconds wanted, const CardSearchFacts& facts);

/// Tries it on a socket of its own; nothing is asked of the kernel when `wanted` is 0.
Result<void> checkCardSearch(std::chrono::microseconds wanted);

/// For this socket, and for those that a listening one accepts from now on. It was permitted when it was tried.
void searchCard(int socket, std::chrono::microseconds wanted);

} // namespace liena::system
