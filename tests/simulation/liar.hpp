// Rubbish on the wire: what a compromised device sends, and what a black channel may do to commands.
#pragma once

#include "scenario.hpp"
#include "seeded_random.hpp"

#include "liena/device_id.hpp"
#include "protocol/datagram.hpp"

#include <cstddef>
#include <deque>
#include <vector>

namespace liena::simulation {

/// Of one direction of one link: remembers commands that left, and can send them again, or break them.
class BlackChannel {
public:
    /// Keeps what may be sent again later.
    void remember(const std::vector<std::byte>& bytes, std::size_t begin);

    /// Puts `count` remembered commands behind what leaves now.
    void replay(std::vector<std::byte>& bytes, SeededRandom& random, std::size_t count) const;

    /// Flips one bit of the command at `begin`, not of its header.
    static void corrupt(std::vector<std::byte>& bytes, std::size_t begin, SeededRandom& random);

    static bool isCommand(const std::vector<std::byte>& bytes, std::size_t begin);

private:
    static constexpr std::size_t most = 64;
    std::deque<std::vector<std::byte>> m_commands;
};

/// Changes the datagram at `begin`, or puts invented ones behind it.
class Liar {
public:
    explicit Liar(std::vector<DeviceId> devices) : m_devices(std::move(devices)) {}
    void speak(std::vector<std::byte>& bytes, std::size_t begin, SeededRandom& random, LieKind lies) const;

private:
    void mutate(std::vector<std::byte>& bytes, std::size_t begin, SeededRandom& random) const;
    void invent(std::vector<std::byte>& bytes, const protocol::DatagramHeader& like, SeededRandom& random) const;
    void endless(std::vector<std::byte>& bytes, const protocol::DatagramHeader& like, SeededRandom& random) const;
    DeviceId someone(SeededRandom& random) const { return m_devices[random.below(m_devices.size())]; }

    std::vector<DeviceId> m_devices;
};

} // namespace liena::simulation
