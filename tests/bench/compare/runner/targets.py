"""What the figures of LiENa are held against."""
from dataclasses import dataclass

from .load_table import FRAME_RATIO, limit_of, verdict
from .conditions import FRAME_RATES, LINKS

BELOW = "<"
AT_MOST = "≤"
AT_LEAST = "≥"


@dataclass(frozen=True)
class Target:
    title: str
    measurement: str
    figure: str
    transport: str
    base: str  # transport; empty: the figure itself in millions
    relation: str
    bound: float

    def value(self, medians):
        value = medians.of(self.measurement, self.transport, self.figure)
        if not self.base:
            return None if value is None else value / 1e6
        reference = medians.of(self.measurement, self.base, self.figure)
        return value / reference if value is not None and reference else None

    def is_met(self, value):
        return {BELOW: value < self.bound, AT_MOST: value <= self.bound, AT_LEAST: value >= self.bound}[self.relation]


OTHERS = (("zeromq", "ZeroMQ"), ("cyclone", "Cyclone DDS"), ("fastdds", "Fast DDS"))
ROUND_TRIPS = (("roundtrip", "back to back"), ("paced", "at 1 kHz"))
TARGETS = [
    *(Target(f"Round trip {how} ÷ Asio TLS", key, "round_trip_p50", "liena", "asio-tls", AT_MOST, 1.15) for key, how in ROUND_TRIPS),
    *(Target(f"Round trip {how} ÷ {title}, which has no TLS", key, "round_trip_p50", "liena", other, BELOW, 1)
      for key, how in ROUND_TRIPS for other, title in OTHERS),
    *(Target(f"Round trip {how} as sealed UDP packets ÷ {title}, which seals nothing", key, "round_trip_p50", "liena-udp", other, BELOW, 1)
      for key, how in ROUND_TRIPS for other, title in OTHERS if other != "zeromq"),
    Target("Round trip, never asleep ÷ raw TCP, never asleep", "roundtrip", "round_trip_p50", "liena-spin", "raw-spin", AT_MOST, 2.5),
    Target("1 MiB frames ÷ Asio TLS", "frames", "megabytes_per_second", "liena", "asio-tls", AT_LEAST, 0.9),
    Target("1 MiB frames in mode none ÷ Asio", "frames", "megabytes_per_second", "liena-none", "asio", AT_LEAST, 0.85),
    Target("64-byte messages, million/s", "messages", "messages_per_second", "liena", "", AT_LEAST, 1),
    Target("64-byte messages in mode none, million/s", "messages", "messages_per_second", "liena-none", "", AT_LEAST, 3),
]


def load_lines(medians):
    """Over all conditions with frames: how many are met."""
    waits, ages = [], []
    for name, link in LINKS.items():
        for rate in filter(None, FRAME_RATES):
            key = f"load/{name}/{rate}"
            p99, limit = medians.of(key, "liena", "command_p99"), limit_of(medians, link, f"load/{name}/0", "liena")
            frame, raw = medians.of(key, "liena", "frame_p50"), medians.of(key, "raw", "frame_p50")
            waits += [p99 <= limit] if p99 and limit else []
            ages += [frame <= FRAME_RATIO * raw] if frame and raw else []
    for title, met in (("Commands beside frames: p99 within its limit, conditions", waits),
                       (f"Frames: p50 ÷ raw TCP ≤ {FRAME_RATIO}, conditions", ages)):
        if met:
            yield f"| {title} | all {len(met)} | {sum(met)} | {verdict(all(met))} |"


def sections(medians):
    lines = []
    for target in TARGETS:
        value = target.value(medians)
        if value is not None:
            lines.append(f"| {target.title} | {target.relation} {target.bound:g} | {value:.2f} | {verdict(target.is_met(value))} |")
    lines += load_lines(medians)
    return ["\n".join(["### LiENa's targets", "", "| | target | measured | met |", "|---|---|---|---|", *lines])] if lines else []
