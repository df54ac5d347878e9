"""The programs under comparison, and which of them need certificates."""
from dataclasses import dataclass

from .conditions import GIGABIT, LOOPBACK


@dataclass(frozen=True)
class Transport:
    key: str
    title: str
    program: str
    mode: str  # of the topology that LiENa reads
    arguments: tuple = ()  # of the program, besides those of the measurement
    round_trips_only: bool = False
    frames_only: bool = False  # and where many bytes of them pass
    also_with_losses: bool = False  # beside frames as well, where packets are lost
    streams_apart: bool = False  # two streams of frames do not wait for each other

    def suits(self, measurement):
        """Mode none is for comparison on loopback only, and whoever never sleeps takes a processor from what is measured beside it."""
        if measurement.streams_apart and not self.streams_apart:
            return False
        if self.frames_only:
            return measurement.workload == "frames" or measurement.key in (f"load/1g/{rate}" for rate in GIGABIT.frame_rates)
        if self.round_trips_only:
            return measurement.workload in ("roundtrip", "paced") or (self.also_with_losses and measurement.link.loss > 0)
        return measurement.link == LOOPBACK or self.key not in ("liena-none", "asio")


TRANSPORTS = [
    Transport("liena", "LiENa, TLS, awake in dialogues", "peer_liena", "tls", streams_apart=True),
    Transport("asio-tls", "Asio TLS", "peer_asio_tls", "tls"),
    Transport("raw", "raw TCP", "peer_raw_tcp", "none", streams_apart=True),
    Transport("liena-asleep", "LiENa, TLS, asleep between messages", "peer_liena", "tls", ("--asleep",), True),
    Transport("liena-udp", "LiENa, sealed UDP packets", "peer_liena", "tls", ("--packets",), True, also_with_losses=True),
    Transport("liena-spin", "LiENa, TLS, never asleep", "peer_liena", "tls", ("--spin",), True),
    Transport("raw-spin", "raw TCP, never asleep", "peer_raw_tcp", "none", ("--spin",), True),
    Transport("liena-worker", "LiENa, TLS, with a worker thread", "peer_liena", "tls", ("--workers", "1"), frames_only=True),
    Transport("liena-none", "LiENa, mode none", "peer_liena", "none"),
    Transport("asio", "Asio", "peer_asio", "none"),
    Transport("zeromq", "ZeroMQ", "peer_zeromq", "none"),
    Transport("igtl", "OpenIGTLink", "peer_openigtlink", "none"),
    Transport("cyclone", "Cyclone DDS", "peer_cyclonedds", "none"),
    Transport("fastdds", "Fast DDS", "peer_fastdds", "none"),
]
OWN = tuple(t.key for t in TRANSPORTS if t.program == "peer_liena")


def built(bin_dir):
    return [t for t in TRANSPORTS if (bin_dir / t.program).exists()]
