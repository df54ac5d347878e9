"""What the figures of LiENa are held against."""
from dataclasses import dataclass

from . import calm_table, collapse_table, streams_table
from .conditions import COLLAPSES, LINKS, NEIGHBOUR_LINKS, STATUS_LINKS
from .load_table import FRAME_RATIO, limits_of, verdict, within
from .streams_table import STREAMS
from .transports import OWN

BELOW = "<"
AT_MOST = "≤"
AT_LEAST = "≥"
ALL_FRAMES = 0.98  # a frame that is withheld for a newer one has not arrived


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


@dataclass(frozen=True)
class Judged:
    title: str
    asked: str
    measured: str
    met: bool


OTHERS = (("zeromq", "ZeroMQ"), ("cyclone", "Cyclone DDS"), ("fastdds", "Fast DDS"))
ROUND_TRIPS = (("roundtrip", "back to back"), ("paced", "at 1 kHz"))
TARGETS = [
    *(Target(f"Round trip {how}, awake in dialogues ÷ Asio TLS", key, "round_trip_p50", "liena", "asio-tls", AT_MOST, 1.15) for key, how in ROUND_TRIPS),
    Target("Round trip back to back, asleep between messages ÷ Asio TLS", "roundtrip", "round_trip_p50", "liena-asleep", "asio-tls", AT_MOST,
           1.15),
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


def conditions_with_frames(medians, fitting):
    """`(key, idle key, link)` of those that were measured with LiENa, whether it came through or not: where the link carries the frames, or
    where it does not. Links that lose packets are judged by themselves."""
    for name, link in LINKS.items():
        for rate in filter(None, link.frame_rates):
            key = f"load/{name}/{rate}"
            if not link.loss and link.carries(rate) == fitting and medians.results.get(key, {}).get("liena"):
                yield key, f"load/{name}/0", link


def conditions_beside_another(medians):
    """The same of those with the frames of another session."""
    return [(f"neighbour/{name}/{rate}", f"neighbour/{name}/0", link) for name, link in NEIGHBOUR_LINKS.items()
            for rate in filter(None, link.frame_rates) if medians.results.get(f"neighbour/{name}/{rate}", {}).get("liena")]


def conditions_beside_status(medians):
    """The same of those with status messages in place of the frames, also where they are more than the link carries."""
    return [(f"status/{name}/{rate}", f"status/{name}/0", link) for name, link in STATUS_LINKS.items()
            for rate in filter(None, link.frame_rates) if medians.results.get(f"status/{name}/{rate}", {}).get("liena")]


def conditions_with_losses(medians):
    """The keys of those that were measured with LiENa's packets, with frames and without."""
    keys = [f"load/{name}/{rate}" for name, link in LINKS.items() if link.loss for rate in link.frame_rates]
    return [key for key in keys if medians.results.get(key, {}).get("liena-udp")]


def best_of_others(medians, key):
    """The least p99 of any other transport there; None when there is no other."""
    found = [medians.of(key, other, "command_p99") for other in medians.results[key] if other not in OWN]
    return min((p99 for p99 in found if p99 is not None), default=None)


def came_through(medians, key):
    """LiENa's commands, its frames and raw TCP's: p99, p99.9, p50, p50, and which part of the frames arrived; None where it failed."""
    p99, p999, frame = (medians.of(key, "liena", figure) for figure in ("command_p99", "command_p999", "frame_p50"))
    arrived, sent = (medians.of(key, "liena", figure) for figure in ("frame_count", "frames_sent"))
    return None if None in (p99, p999, frame, arrived, sent) or not sent else (p99, p999, frame, arrived / sent)


def judge_load(medians, key, idle_key, link):
    """What LiENa reached in one condition: four answers, None for one that has nothing to be held against. A failure is none of them."""
    reached = came_through(medians, key)
    if reached is None:
        return False, False, False, False
    p99, p999, frame, arrived = reached
    best, raw = best_of_others(medians, key), medians.of(key, "raw", "frame_p50")
    return (within((p99, p999), limits_of(medians, link, idle_key, "liena")), None if best is None else p99 <= best,
            None if raw is None else frame <= FRAME_RATIO * raw, arrived >= ALL_FRAMES)


def judge_streams(medians, link_name):
    """What LiENa reached beside two streams of frames: whether commands, the age of both streams' frames and their arrival are within the
    limits of `load`. A failure is none of them."""
    key, idle_key = (streams_table.key_of(link_name, streams) for streams in (2, 0))

    def of(figure, transport="liena"):
        return medians.of(key, transport, figure)

    if of("command_p99") is None:
        return False, False, False
    raw = [of(f"{stream}_p50", "raw") for stream in STREAMS]
    return (within((of("command_p99"), of("command_p999")), limits_of(medians, LINKS[link_name], idle_key, "liena")),
            all(of(f"{stream}_p50") <= FRAME_RATIO * base for stream, base in zip(STREAMS, raw)) if all(raw) else None,
            all(of(f"{stream}_count") >= ALL_FRAMES * of(f"{stream}s_sent") for stream in STREAMS))


def judge_packets(medians, key):
    """Whether LiENa's commands as packets of their own are as prompt as those of the best other transport; None without another. A failure
    is not."""
    p99, best = medians.of(key, "liena-udp", "command_p99"), best_of_others(medians, key)
    return False if p99 is None else None if best is None else p99 <= best


def counted(title, answers, remark=""):
    """How many of the conditions are met; nothing where none is known."""
    known = [answer for answer in answers if answer is not None]
    return [Judged(title, f"all {len(known)}", f"{sum(known)}{remark}", all(known))] if known else []


def kept_without_frames(medians, conditions):
    """In how many of them the line itself keeps the limits, with nothing beside the commands: elsewhere nobody could."""
    kept = [within([medians.of(idle_key, "liena", figure) for figure in ("command_p99", "command_p999")],
                   limits_of(medians, link, idle_key, "liena")) for _, idle_key, link in conditions]
    return "" if None in kept else f"; without frames {sum(kept)}"


def judged_load(medians):
    """Over all conditions with frames that the link carries."""
    conditions = list(conditions_with_frames(medians, fitting=True))
    judged = [judge_load(medians, *condition) for condition in conditions]
    titles = ("Commands beside frames: p99 and p99.9 within their limits, conditions",
              "Commands beside frames: p99 not above the best other transport's, conditions",
              f"Frames: p50 ÷ raw TCP ≤ {FRAME_RATIO}, conditions", "Frames: all arrive but one in fifty, conditions")
    remarks = (kept_without_frames(medians, conditions), "", "", "")
    return [one for title, answers, remark in zip(titles, zip(*judged), remarks) for one in counted(title, answers, remark)]


def judged_calm(medians):
    return counted("Calm commands beside frames: p99 and p99.9 within their limits, conditions",
                   [calm_table.is_within(medians, *condition) for condition in conditions_with_frames(medians, fitting=True)])


def judged_neighbour(medians):
    judged = [judge_load(medians, *condition) for condition in conditions_beside_another(medians)]
    titles = ("Commands beside another session's frames: p99 and p99.9 within their limits, conditions",
              "Commands beside another session's frames: p99 not above the best other transport's, conditions",
              f"Another session's frames: p50 ÷ raw TCP ≤ {FRAME_RATIO}, conditions",
              "Another session's frames: all arrive but one in fifty, conditions")
    return [one for title, answers in zip(titles, zip(*judged)) for one in counted(title, answers)]


def judged_status(medians):
    """How old status messages may be is not asked for."""
    judged = [judge_load(medians, *condition)[:2] for condition in conditions_beside_status(medians)]
    titles = ("Commands beside status messages: p99 and p99.9 within their limits, conditions",
              "Commands beside status messages: p99 not above the best other transport's, conditions")
    return [one for title, answers in zip(titles, zip(*judged)) for one in counted(title, answers)]


def judged_streams(medians):
    judged = [judge_streams(medians, name) for name in LINKS if medians.results.get(streams_table.key_of(name, 2), {}).get("liena")]
    titles = ("Commands beside two streams of frames: p99 and p99.9 within their limits, conditions",
              f"Two streams of frames: p50 of each ÷ raw TCP ≤ {FRAME_RATIO}, conditions",
              "Two streams of frames: all of each arrive but one in fifty, conditions")
    return [one for title, answers in zip(titles, zip(*judged)) for one in counted(title, answers)]


def judged_overload(medians):
    """Frames are withheld there, so that how old and how many they are is no target."""
    judged = [judge_load(medians, *condition)[0] for condition in conditions_with_frames(medians, fitting=False)]
    return counted("Commands beside more frames than the link carries: p99 and p99.9 within their limits, conditions", judged)


def judged_loss(medians):
    judged = [judge_packets(medians, key) for key in conditions_with_losses(medians)]
    return counted("Commands as sealed UDP packets where packets are lost: p99 not above the best other transport's, conditions", judged)


def judged_collapse(medians):
    judged = [collapse_table.judge(medians, path, "liena") for path in COLLAPSES if medians.results.get(f"collapse/{path.key}", {}).get("liena")]
    titles = ("A link that falls to a tenth: commands' p99 during that within its limit, links",
              f"A link that falls to a tenth: all frames again within {collapse_table.BACK_S} s of its healing, links")
    return [one for title, answers in zip(titles, zip(*judged)) for one in counted(title, answers)]


def all_judged(medians):
    """All that can be told."""
    values = [(target, target.value(medians)) for target in TARGETS]
    found = [Judged(target.title, f"{target.relation} {target.bound:g}", f"{value:.2f}", target.is_met(value))
             for target, value in values if value is not None]
    for of_conditions in (judged_load, judged_calm, judged_neighbour, judged_status, judged_streams, judged_overload, judged_loss, judged_collapse):
        found += of_conditions(medians)
    return found


def sections(medians):
    lines = [f"| {one.title} | {one.asked} | {one.measured} | {verdict(one.met)} |" for one in all_judged(medians)]
    return ["\n".join(["### LiENa's targets", "", "| | target | measured | met |", "|---|---|---|---|", *lines])] if lines else []
