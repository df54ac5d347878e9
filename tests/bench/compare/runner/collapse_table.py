"""The part of the table about a link that falls to a tenth."""
from .conditions import COLLAPSES, SEGMENT_BYTES
from .load_table import STALL_US, number, verdict

BACK_S = 5
HEAD = ("| | p99 before | p99 during | its worst second | p99 after | max | limit during | met | frames during | all frames again after, s | met |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|")


def limit_during(medians, path, transport_key):
    """Of the commands' p99 on the narrow link, µs: from that of the idle link, or, where that was not measured, from that before the fall."""
    idle = medians.of(f"load/{path.key}/0", transport_key, "command_p99")
    start = medians.of(f"collapse/{path.key}", transport_key, "before_p99") if idle is None else idle
    return None if start is None else start + SEGMENT_BYTES[0] * 8 / path.narrow.megabits + STALL_US


def judge(medians, path, transport_key):
    """Whether p99 during the fall is within its limit, and whether all frames came again in time. A failure is neither."""
    during, back = (medians.of(f"collapse/{path.key}", transport_key, figure) for figure in ("during_p99", "frames_back_s"))
    limit = limit_during(medians, path, transport_key)
    return (False, False) if None in (limit, during, back) else (during <= limit, back <= BACK_S)


def row(medians, path, transport):
    def of(figure):
        return medians.of(f"collapse/{path.key}", transport.key, figure)

    before, during, back = of("before_p99"), of("during_p99"), of("frames_back_s")
    prompt, again = judge(medians, path, transport.key)
    worst = max(of(name + "_max") for name in ("before", "during", "after"))
    cells = [number(before), number(during), number(of("during_second_p99")), number(of("after_p99")), number(worst),
             number(limit_during(medians, path, transport.key)), verdict(prompt), number(of("frames_during")),
             "never" if back == float("inf") else number(back, 1, 1), verdict(again)]
    return "| " + " | ".join([transport.title, *cells]) + " |"


def sections(medians, transports):
    for path in COLLAPSES:
        measured = medians.results.get(f"collapse/{path.key}", {})
        lines = [row(medians, path, transport) for transport in transports if any(measured.get(transport.key, []))]
        if lines:
            before, narrow, after = path.seconds
            yield "\n".join([
                f"### A link that falls from {path.link.name} to {path.narrow.name}", "",
                f"Commands at 500 Hz beside 15 frames/s of {path.link.frame_bytes // 1024} KiB, which the narrow link cannot carry: "
                f"{before} s, {narrow} s narrow, {after} s healed. µs. Limit: the same transport's p99 without frames, the time of a "
                f"{SEGMENT_BYTES[0] / 1024:.1f} KiB segment on the narrow link and {STALL_US} µs. "
                f"*Worst second*: the largest p99 of any second of it. *Again*: since then no second had more frames left out, or late by a factor of two, than the worst one before the fall.", "",
                HEAD, *lines])
