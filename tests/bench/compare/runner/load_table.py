"""The part of the table about commands beside frames."""
from dataclasses import dataclass

from .conditions import COMMAND_RATE, LINKS, NEIGHBOUR_LINKS, STATUS_LINKS

STALL_US = 500  # what a command may be later than on the idle link, beside the time of one segment
LONG_STALL_US = 1500  # and one in a thousand
FRAME_RATIO = 1.15
HEAD = ("| | p50 | p99 | p99.9 | max | arrived / sent / due | limits of p99, p99.9 | met | frame p50 / p99, ms | p50 ÷ raw | frames arrived / sent |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|")


@dataclass(frozen=True)
class Kind:
    """Of load: what goes the same way as the commands."""
    key: str
    links: dict
    title: str
    name: str = "frames"
    whose: str = ""
    about: str = ""
    age_counts: bool = True  # how old the frames are, and how many came, is a target where the link carries them


KINDS = (
    Kind("load", LINKS, "frames"),
    Kind("neighbour", NEIGHBOUR_LINKS, "the frames of another session", whose=" of another session",
         about="Commands and frames are those of two pairs of programs over one link, from the same computer: two sessions that know nothing of each "
               "other."),
    Kind("status", STATUS_LINKS, "status messages", "status messages", about=
         "LiENa sends status messages on the connection that its commands go by; for the others they are small frames. Where they are more "
         "than the link carries LiENa withholds those that a newer one follows. Their age and their number are no target.", age_counts=False),
)


def number(value, scale=1.0, digits=0):
    return "–" if value is None else f"{value / scale:,.{digits}f}".replace(",", " ")


def verdict(met):
    return "–" if met is None else ("yes" if met else "**no**")


def limits_of(medians, link, idle_key, transport_key, figure="command_p99"):
    """Of p99 and p99.9 beside frames, in µs; both are reckoned from the idle link's p99. There are none where packets are lost."""
    idle = medians.of(idle_key, transport_key, figure)
    return (None, None) if idle is None or link.loss else tuple(idle + link.segment_us() + stall for stall in (STALL_US, LONG_STALL_US))


def within(found, limits):
    """Whether p99 and p99.9 are; None when something is not known."""
    return None if None in (*found, *limits) else all(value <= limit for value, limit in zip(found, limits))


def arrived(of):
    """Commands that came themselves; results of earlier versions count no others."""
    count = of("commands_arrived")
    return of("command_count") if count is None else count


def command_cells(of, due):
    counts = f"{number(arrived(of))} / {number(of('commands_sent'))} / {number(due)}"
    return [*(number(of("command_" + part)) for part in ("p50", "p99", "p999", "max")), counts]


def frame_cells(of, limits, raw):
    frame = of("frame_p50")
    return ["–" if None in limits else ", ".join(map(number, limits)),
            verdict(within((of("command_p99"), of("command_p999")), limits)),
            f"{number(frame, 1000, 1)} / {number(of('frame_p99'), 1000, 1)}",
            number(frame / raw, 1, 2) if frame and raw else "–", f"{number(of('frame_count'))} / {number(of('frames_sent'))}"]


def row(medians, kind, link_name, rate, transport, seconds):
    key, idle_key = f"{kind.key}/{link_name}/{rate}", f"{kind.key}/{link_name}/0"

    def of(figure):
        return medians.of(key, transport.key, figure)

    cells = command_cells(of, COMMAND_RATE * seconds)
    if rate:
        cells += frame_cells(of, limits_of(medians, kind.links[link_name], idle_key, transport.key), medians.of(key, "raw", "frame_p50"))
    else:
        cells += ["–"] * 5
    return "| " + " | ".join([transport.title, *cells]) + " |"


def rows(medians, kind, link_name, transports, seconds):
    link = kind.links[link_name]
    for rate in link.frame_rates:
        measured = medians.results.get(f"{kind.key}/{link_name}/{rate}", {})
        if measured:
            yield (f"| *{rate} {kind.name}/s of {link.frame_bytes // 1024} KiB* |" if rate else f"| *no {kind.name}* |") + " |" * 10
        for transport in transports:
            if any(measured.get(transport.key, [])):
                yield row(medians, kind, link_name, rate, transport, seconds)
            elif measured.get(transport.key):
                yield f"| {transport.title} | did not come through |" + " |" * 9


def what_is_no_target(link):
    """Where packets are lost, or the frames are too many; nothing where all columns are targets."""
    if link.loss:
        return (f"{100 * link.loss:g} % of the packets are lost, each way and each by itself. There are no limits: sealed UDP packets' p99 is "
                "held against the best other transport's. What is lost of them is not sent again, and late until the next one is there.")
    if not all(map(link.carries, link.frame_rates)):
        return ("The link cannot carry these frames: LiENa withholds those that a newer one follows, and neither "
                "their age nor their number is a target.")
    return ""


def segment_limits(link):
    return (f"Limits: the same transport's p99 without frames, the time of a {link.segment_bytes() / 1024:.1f} KiB segment "
            f"({link.segment_us():.0f} µs), and {STALL_US} µs for p99, {LONG_STALL_US} µs for p99.9.")


def explanation(medians, kind, link_name):
    spread = medians.spread(f"{kind.key}/{link_name}/0", "raw", "command_p99")
    link = kind.links[link_name]
    exception = what_is_no_target(link) if kind.age_counts else ""
    has_target = kind.age_counts and not exception
    parts = [kind.about, f"64-byte commands at {COMMAND_RATE} Hz, one-way latency in µs since they were due.", "" if link.loss else segment_limits(link), exception,
             f"{kind.name.capitalize()}: p50 in ms, and beside raw TCP's{f' (target {FRAME_RATIO})' if has_target else ''}.",
             "" if spread is None else f"Spread of raw TCP's p99 without {kind.name} over the rounds: {number(spread)} %."]
    return " ".join(filter(None, parts))


def sections(medians, transports, seconds):
    parts = []
    for kind in KINDS:
        for name, link in kind.links.items():
            lines = list(rows(medians, kind, name, transports, seconds))
            if lines:
                title = f"### Commands beside {kind.title}, {link.name}{' each way' if link.delay_ms else ''}"
                parts.append("\n".join([title, "", explanation(medians, kind, name), "", HEAD, *lines]))
    return parts
