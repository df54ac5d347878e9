"""The part of the table about commands beside frames."""
from .conditions import COMMAND_RATE, FRAME_RATES, LINKS

STALL_US = 500  # what a command may be later than on the idle link, beside the time of one segment
FRAME_RATIO = 1.15
HEAD = ("| | p50 | p99 | p99.9 | max | arrived / sent / due | limit of p99 | met | frame p50, ms | ÷ raw | frames arrived / sent |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|")


def number(value, scale=1.0, digits=0):
    return "–" if value is None else f"{value / scale:,.{digits}f}".replace(",", " ")


def verdict(met):
    return "–" if met is None else ("yes" if met else "**no**")


def limit_of(medians, link, idle_key, transport_key):
    """Of p99 beside frames, in µs."""
    idle = medians.of(idle_key, transport_key, "command_p99")
    return None if idle is None else idle + link.segment_us() + STALL_US


def command_cells(of, due):
    counts = f"{number(of('command_count'))} / {number(of('commands_sent'))} / {number(due)}"
    return [*(number(of("command_" + part)) for part in ("p50", "p99", "p999", "max")), counts]


def frame_cells(of, limit, raw):
    p99, frame = of("command_p99"), of("frame_p50")
    return [number(limit), verdict(None if None in (p99, limit) else p99 <= limit), number(frame, 1000, 1),
            number(frame / raw, 1, 2) if frame and raw else "–", f"{number(of('frame_count'))} / {number(of('frames_sent'))}"]


def row(medians, link_name, rate, transport, seconds):
    key, idle_key = f"load/{link_name}/{rate}", f"load/{link_name}/0"

    def of(figure):
        return medians.of(key, transport.key, figure)

    cells = command_cells(of, COMMAND_RATE * seconds)
    if rate:
        cells += frame_cells(of, limit_of(medians, LINKS[link_name], idle_key, transport.key), medians.of(key, "raw", "frame_p50"))
    else:
        cells += ["–"] * 5
    return "| " + " | ".join([transport.title, *cells]) + " |"


def rows(medians, link_name, transports, seconds):
    for rate in FRAME_RATES:
        measured = medians.results.get(f"load/{link_name}/{rate}", {})
        if measured:
            kib = LINKS[link_name].frame_bytes // 1024
            yield (f"| *{rate} frames/s of {kib} KiB* |" if rate else "| *no frames* |") + " |" * 10
        for transport in transports:
            if measured.get(transport.key):
                yield row(medians, link_name, rate, transport, seconds)


def explanation(medians, link_name):
    spread = medians.spread(f"load/{link_name}/0", "raw", "command_p99")
    return (f"64-byte commands at {COMMAND_RATE} Hz, one-way latency in µs since they were due. Limit: the same transport's p99 without "
            f"frames, the time of a 16 KiB segment ({LINKS[link_name].segment_us():.0f} µs) and {STALL_US} µs. Frames: p50 in ms, and "
            f"beside raw TCP's (target {FRAME_RATIO}). Spread of raw TCP's p99 without frames over the rounds: {number(spread)} %.")


def sections(medians, transports, seconds):
    parts = []
    for name, link in LINKS.items():
        lines = list(rows(medians, name, transports, seconds))
        if lines:
            title = f"### Commands beside frames, {link.name}{' each way' if link.delay_ms else ''}"
            parts.append("\n".join([title, "", explanation(medians, name), "", HEAD, *lines]))
    return parts
