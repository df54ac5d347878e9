// Two sockets, two threads.
#include "scale/raw_pair.hpp"

#include "runner/statistics.hpp"

#include <arpa/inet.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <system_error>
#include <thread>

namespace liena::bench {

namespace {

using Clock = std::chrono::steady_clock;
using Packet = std::array<char, 64>;

constexpr auto period = std::chrono::milliseconds(1);

int checked(int result, const char* what)
{
    if (result < 0)
        throw std::system_error(errno, std::generic_category(), what);
    return result;
}

struct Pair {
    Pair()
    {
        const int listener = checked(::socket(AF_INET, SOCK_STREAM, 0), "socket");
        sockaddr_in address{};
        socklen_t size = sizeof address;
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        auto* place = reinterpret_cast<sockaddr*>(&address);
        checked(::bind(listener, place, size), "bind");
        checked(::listen(listener, 1), "listen");
        checked(::getsockname(listener, place, &size), "getsockname");
        near = checked(::socket(AF_INET, SOCK_STREAM, 0), "socket");
        checked(::connect(near, place, size), "connect");
        far = checked(::accept(listener, nullptr, nullptr), "accept");
        ::close(listener);
        const int on = 1;
        for (const int end : {near, far})
            checked(::setsockopt(end, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on), "setsockopt");
    }
    ~Pair()
    {
        ::close(near);
        ::close(far);
    }
    Pair(const Pair&) = delete;
    Pair& operator=(const Pair&) = delete;

    int near = -1;
    int far = -1;
};

double inMilliseconds(Clock::duration span) { return std::chrono::duration<double, std::milli>(span).count(); }

} // namespace

RawPair measureRawPair(std::chrono::milliseconds length)
{
    const Pair pair;
    std::thread echo([&] {
        Packet packet{};
        while (::recv(pair.far, packet.data(), packet.size(), MSG_WAITALL) == static_cast<ssize_t>(packet.size()) &&
               ::send(pair.far, packet.data(), packet.size(), 0) > 0) {
        }
    });
    RawPair result;
    lab::Sample trips;
    auto due = Clock::now();
    for (const auto end = due + length; due < end; due = std::max(due + period, Clock::now())) {
        std::this_thread::sleep_until(due);
        const auto sent = Clock::now();
        result.largestStallMs = std::max(result.largestStallMs, inMilliseconds(sent - due));
        Packet packet{};
        (void)::send(pair.near, packet.data(), packet.size(), 0);
        (void)::recv(pair.near, packet.data(), packet.size(), MSG_WAITALL);
        trips.add(1e3 * inMilliseconds(Clock::now() - sent));
    }
    ::shutdown(pair.near, SHUT_WR);
    echo.join();
    result.p50Us = trips.at(0.5);
    result.p99Us = trips.at(0.99);
    return result;
}

} // namespace liena::bench
