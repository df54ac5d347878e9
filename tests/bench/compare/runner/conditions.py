"""What is measured: the links, the workloads, and how many bytes a frame has on each link."""
from dataclasses import dataclass, replace

MIB = 1 << 20
SEGMENT_BYTES = (2854, 8562)  # of LiENa, least and most: what a command waits for at worst when it came while a frame leaves
SEGMENT_S = 0.00025  # of the path, in whole steps of the least: PathRate::segment()
QUEUE_BYTES = 512 * 1024  # before the bottleneck, as in a small switch
COMMAND_RATE = 500  # per second, beside frames
FRAME_RATES = (0, 15, 30)
LOSSY_FRAME_BYTES = 8 * 1024


@dataclass(frozen=True)
class Link:
    name: str
    megabits: int = 0  # 0: loopback
    delay_ms: int = 0  # each way
    frame_bytes: int = 2 * MIB
    frame_rates: tuple = FRAME_RATES
    loss: float = 0.0  # the part of the packets that is lost, each way

    def carries(self, frame_rate):
        return frame_rate * self.frame_bytes * 8 <= self.megabits * 1_000_000

    def segment_bytes(self):
        least, most = SEGMENT_BYTES
        return min(max(int(self.megabits * 125000 * SEGMENT_S) // least * least, least), most)

    def segment_us(self):
        return self.segment_bytes() * 8 / self.megabits if self.megabits else 0.0


@dataclass(frozen=True)
class Measurement:
    """One row group of the table; `arguments` is the common command line of both ends."""
    key: str
    title: str
    link: Link
    workload: str
    mode: str = "tls"
    arguments: tuple = ()
    beside: tuple = ()  # the command line of a second pair of ends, which runs meanwhile on the same link
    streams_apart: bool = False  # for transports that give each stream of frames a way of its own


LOOPBACK = Link("loopback")
# Frames of a quarter (15 /s) and of half (30 /s) of what each link carries; where packets are lost, of what one TCP connection carries there.
GIGABIT = Link("1 Gbit/s", 1000)
LINKS = {
    "1g": GIGABIT,
    "400m": Link("400 Mbit/s", 400, 0, 2 * MIB * 400 // 1000),
    "100m": Link("100 Mbit/s", 100, 0, 2 * MIB * 100 // 1000),
    "1g-20ms": Link("1 Gbit/s, 20 ms", 1000, 20),
    "400m-20ms": Link("400 Mbit/s, 20 ms", 400, 20, 2 * MIB * 400 // 1000),
    "100m-20ms": Link("100 Mbit/s, 20 ms", 100, 20, 2 * MIB * 100 // 1000),
    "400m-overload": Link("400 Mbit/s, less than the frames need", 400, 0, 2 * MIB, (0, 30)),
    "100m-20ms-loss": Link("100 Mbit/s, 20 ms, 1 % lost", 100, 20, LOSSY_FRAME_BYTES, loss=0.01),
}


STATUS_BYTES = 16 * 1024
STATUS_SHARES = (0.25, 0.5, 1.25)  # of what a link carries


def status_link(link, shares=STATUS_SHARES):
    """The same with status messages in place of the frames."""
    return replace(link, frame_bytes=STATUS_BYTES, frame_rates=(0, *(round(link.megabits * 1e6 / 8 * share / STATUS_BYTES) for share in shares)))


# Where commands are measured beside status messages; more than 1 Gbit/s carries takes the processors
# that are to be measured.
STATUS_LINKS = {"1g": status_link(GIGABIT, STATUS_SHARES[:2]), **{name: status_link(LINKS[name]) for name in ("400m", "100m", "100m-20ms")}}

# Where commands of one pair of ends are measured beside the frames of another.
NEIGHBOUR_LINKS = {name: LINKS[name] for name in ("1g", "100m")}
NEIGHBOUR_COMMAND_RATE = 10  # per second, of those beside the frames
STREAM_RATES = (15, 14.3)  # of two streams of one device, per second: they drift through all overlaps in 1.4 s


def sending(link, frame_rate, command_rate=COMMAND_RATE):
    return ("--frame-rate", str(frame_rate), "--frame-bytes", str(link.frame_bytes), "--command-rate", str(command_rate))


def conditions_of(names, links=LINKS, what="frames"):
    """`(name, link, frames per second, title)` of each."""
    return [(name, links[name], rate, f"{links[name].name}, " + (f"{rate} {what}/s" if rate else f"no {what}"))
            for name in names for rate in links[name].frame_rates]


def load_measurements(link_names):
    return [Measurement(f"load/{name}/{rate}", title, link, "load", "tls", sending(link, rate))
            for name, link, rate, title in conditions_of(link_names)]


def neighbour_measurements():
    return [Measurement(f"neighbour/{name}/{rate}", title, link, "load", "tls", sending(link, 0),
                        beside=sending(link, rate, NEIGHBOUR_COMMAND_RATE))
            for name, link, rate, title in conditions_of(NEIGHBOUR_LINKS)]


def status_measurements(link_names):
    """On those of the links where it is measured."""
    names = [name for name in link_names if name in STATUS_LINKS]
    return [Measurement(f"status/{name}/{rate}", title, link, "load", "tls", (*sending(link, rate), "--status"))
            for name, link, rate, title in conditions_of(names, STATUS_LINKS, "status messages")]


def stream_links(names):
    """Those that carry both streams and lose nothing."""
    return [name for name in names if not LINKS[name].loss and LINKS[name].carries(sum(STREAM_RATES))]


def streams_measurements(link_names):
    """Of each link without frames and with two streams of them; the last word of the key says how many streams."""
    first, second = STREAM_RATES
    both = f"frames of {first} and {second}/s"
    return [Measurement(f"two-streams/{name}/{streams}", f"{LINKS[name].name}, {title}", LINKS[name], "load", "tls",
                        (*sending(LINKS[name], rate), *more), streams_apart=True)
            for name in stream_links(link_names)
            for streams, title, rate, more in ((0, "no frames", 0, ()), (2, both, first, ("--second-rate", str(second))))]


@dataclass(frozen=True)
class Collapse:
    """A link that is `link`, then a tenth of it, then `link` again."""
    key: str
    link: Link
    seconds: tuple = (5, 10, 10)  # of each

    @property
    def narrow(self):
        return Link(f"{self.link.megabits // 10} Mbit/s", self.link.megabits // 10)

    def measurement(self):
        arguments = (*sending(self.link, 15), "--timeline")
        return Measurement(f"collapse/{self.key}", f"{self.link.name} to {self.narrow.name}", self.link, "load", "tls", arguments)


COLLAPSES = [Collapse("1g", GIGABIT), Collapse("100m", LINKS["100m"])]


def loopback_measurements(workloads):
    every = {
        "roundtrip": [Measurement("roundtrip", "64 bytes, back to back", LOOPBACK, "roundtrip")],
        "paced": [Measurement("paced", "64 bytes, 1 kHz", LOOPBACK, "paced", "tls", ("--command-rate", "1000"))],
        "throughput": [
            Measurement("frames", "1 MiB frames", LOOPBACK, "frames", "tls", ("--frame-bytes", str(MIB))),
            Measurement("messages", "64-byte messages", LOOPBACK, "messages"),
        ],
    }
    return [m for workload in workloads for m in every.get(workload, [])]
