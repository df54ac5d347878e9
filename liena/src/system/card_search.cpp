// Asking the kernel for SO_BUSY_POLL, and explaining its refusals.
#include "system/card_search.hpp"

#include <fmt/format.h>

#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

namespace liena::system {

namespace {

using namespace std::chrono_literals;

constexpr auto longestSearch = 1s;

std::optional<int> kernelValue(const char* file)
{
    int value = 0;
    if (std::ifstream(file) >> value)
        return value;
    return std::nullopt;
}

int trySearch(int socket, std::chrono::microseconds wanted)
{
    const int value = static_cast<int>(wanted.count());
    return ::setsockopt(socket, SOL_SOCKET, SO_BUSY_POLL, &value, sizeof value) == 0 ? 0 : errno;
}

} // namespace

CardSearchFacts readCardSearchFacts(std::chrono::microseconds wanted)
{
    CardSearchFacts facts;
    const int socket = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    facts.error = socket >= 0 ? trySearch(socket, wanted) : errno;
    if (socket >= 0)
        ::close(socket);
    facts.busyRead = kernelValue("/proc/sys/net/core/busy_read");
    facts.busyPoll = kernelValue("/proc/sys/net/core/busy_poll");
    return facts;
}

Result<void> judgeCardSearch(std::chrono::microseconds wanted, const CardSearchFacts& facts)
{
    const auto us = wanted.count();
    if (wanted < 0us || wanted > longestSearch)
        return fail(Errc::InvalidArgument, fmt::format("a search of {} us at the network card is not 0 to {} us", us,
                                                       std::chrono::microseconds(longestSearch).count()));
    if (facts.error == ENOPROTOOPT || !facts.busyPoll)
        return fail(Errc::Forbidden, "this kernel has no busy polling of network cards (CONFIG_NET_RX_BUSY_POLL)");
    if (facts.error == EPERM)
        return fail(
            Errc::Forbidden,
            fmt::format("a search of {} us at the network card is not permitted: the kernel allows {} us without CAP_NET_ADMIN; raise "
                        "it with `sysctl net.core.busy_read={}`, or give the program the right with `setcap cap_net_admin+ep` or "
                        "AmbientCapabilities=CAP_NET_ADMIN in the systemd unit",
                        us, facts.busyRead.value_or(0), us));
    if (facts.error != 0)
        return fail(Errc::Forbidden, fmt::format("a search of {} us at the network card is refused: {}", us, std::strerror(facts.error)));
    if (*facts.busyPoll == 0)
        return fail(Errc::Forbidden,
                    fmt::format("a search of {} us at the network card would have no effect: the kernel lets a thread that "
                                "waits for many sockets sleep at once; set `sysctl net.core.busy_poll={}`",
                                us, us));
    return ok();
}

Result<void> checkCardSearch(std::chrono::microseconds wanted)
{
    return wanted == 0us ? ok() : judgeCardSearch(wanted, wanted > 0us ? readCardSearchFacts(wanted) : CardSearchFacts());
}

void searchCard(int socket, std::chrono::microseconds wanted)
{
    if (wanted > 0us)
        (void)trySearch(socket, wanted);
}

} // namespace liena::system
