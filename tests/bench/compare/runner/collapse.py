"""A link that falls to a tenth of its rate beside frames, and heals: commands before, during and after, and when all frames are back."""
import math
import time

from . import measuring
from .quantile import quantile

WARM_UP = 1.0  # seconds, of the programs
STARTING = 2.0  # in which they have connected
SECOND = 1000  # ms
LATE = 2  # times the frames' median before the collapse: such a frame is not as it was


def measure(launch, measurement, path):
    changes = []

    def meanwhile():
        time.sleep(STARTING + WARM_UP + path.seconds[0])
        for megabits, seconds in ((path.narrow.megabits, path.seconds[1]), (path.link.megabits, 0)):
            launch.network.shape(megabits)
            changes.append(time.monotonic() * 1000)
            time.sleep(seconds)

    try:
        timeline, complaints = measuring.measure(launch, measurement, STARTING + sum(path.seconds), meanwhile)
    finally:
        launch.network.shape(path.link.megabits)
    return (figures(timeline, *changes) if timeline else {}), complaints


def figures(timeline, narrowed, healed):
    """From single latencies; all moments in ms of the monotonic clock."""
    commands = list(zip(timeline["command_due_ms"], timeline["command_late_ms"]))
    spans = {"before": (-math.inf, narrowed), "during": (narrowed, healed), "after": (healed, math.inf)}
    found = {}
    for name, (begin, end) in spans.items():
        late = [1000 * ms for due, ms in commands if begin <= due < end]
        found |= {f"{name}_count": len(late), f"{name}_p99": quantile(late, 0.99), f"{name}_max": max(late, default=math.nan)}
    found["during_second_p99"] = worst_second([c for c in commands if narrowed <= c[0] < healed], narrowed)
    frames = list(zip(timeline["frame_due_ms"], timeline["frame_late_ms"]))
    found["frames_during"] = sum(narrowed <= due < healed for due, _ in frames)
    found["frames_back_s"] = frames_back(frames, narrowed, healed)
    return found


def worst_second(commands, begin):
    """The largest p99 of any second since then, in µs."""
    seconds = {}
    for due, ms in commands:
        seconds.setdefault(int((due - begin) // SECOND), []).append(1000 * ms)
    return max((quantile(late, 0.99) for late in seconds.values()), default=math.nan)


def frames_back(frames, narrowed, healed):
    """Seconds from the healing to the first frame since which no second had more frames left out or late than the worst second before the
    collapse; infinite when that never came."""
    before = [(due, late) for due, late in frames if due < narrowed]
    period = quantile([b[0] - a[0] for a, b in zip(before, before[1:])], 0.5)
    usual = quantile([late for _, late in before], 0.5)
    amiss = [due for (previous, _), (due, late) in zip(frames, frames[1:]) if due - previous > 1.5 * period or late > LATE * usual]

    def worst(begin, end):
        return max((sum(at <= due < at + SECOND for due in amiss) for at in amiss if begin <= at < end), default=0)

    allowed = worst(-math.inf, narrowed - SECOND)
    for due, _ in frames:
        if due >= healed and worst(due, math.inf) <= allowed:
            return (due - healed) / 1000
    return math.inf
