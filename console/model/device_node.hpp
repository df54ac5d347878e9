// One device of the topology, as the console names and draws it.
#pragma once

#include <QString>

#include <cstdint>

namespace console {

/// From the id's class bits.
enum class DeviceKind : std::uint8_t { Hand, Eye, Brain, Arm, Special };

/// `hand`, `eye`, `brain`, `arm`, `special`: the topology's own words, not for translation.
QString word(DeviceKind kind);

/// The kind that the three class bits of an id name; Special for a reserved number.
DeviceKind kindOf(quint32 id);

struct DeviceNode {
    quint32 id = 0;
    QString name;  ///< unique in the topology
    QString title; ///< for people; the name when the topology gives none
    QString site;  ///< where the device stands, free text; may be empty
    DeviceKind kind = DeviceKind::Special;
    QString messageSet;          ///< the set's name
    QString address;             ///< `host:port`
    bool onThisComputer = false; ///< at a loopback address: no other computer reaches it
    bool self = false;           ///< this console

    /// `0x40018208`.
    QString idText() const;
};

} // namespace console
