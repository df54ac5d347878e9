"""Commands on whose way nothing stood still: no processor, and not the program that is the line. What a restless machine adds to the latency
of all transports is left out of them, and of all alike."""
import dataclasses
import json

from . import measuring
from .quantile import quantile

WORTH_MS = 0.5  # shorter stalls are a part of what is measured
BEFORE_MS = 3.0  # what waited for a stall's end goes on being late for a moment
ENOUGH = 1000  # commands; of fewer one in a thousand says nothing


class Watch:
    """Of all processors by a thread of high priority on each, and of the line."""

    def __init__(self, launch):
        self.network = launch.network
        self.network.late()  # before now
        self.canary = measuring.Peer(launch.canary)

    def end(self):
        """The spans in which something stood still, ms of the monotonic clock; None when it cannot be known."""
        text, complaints = self.canary.closed()
        if not text.strip():
            return None, complaints
        said = json.loads(text)
        return [*zip(said["begin_ms"], said["end_ms"]), *self.network.late()], complaints


def joined(spans):
    """Those worth it, in order, none overlapping another."""
    found = []
    for begin, end in sorted(span for span in spans if span[1] - span[0] >= WORTH_MS):
        if found and begin <= found[-1][1]:
            found[-1] = (found[-1][0], max(end, found[-1][1]))
        else:
            found.append((begin, end))
    return found


def calm_latencies(commands, spans):
    """In µs, of the commands `(due, late)` in ms with no span from BEFORE_MS before they were due until they were there."""
    rest = joined(spans)
    found = []
    for due, late in sorted(commands):
        while rest and rest[0][1] < due - BEFORE_MS:
            rest.pop(0)
        if not rest or rest[0][0] > due + late:
            found.append(1000 * late)
    return found


def figures(commands, spans):
    latencies = calm_latencies(commands, spans)
    found = {"calm_count": len(latencies)}
    if len(latencies) >= ENOUGH:
        found |= {"calm_p99": quantile(latencies, 0.99), "calm_p999": quantile(latencies, 0.999), "calm_max": max(latencies)}
    return found


def measure(launch, measurement, seconds):
    """As measuring.measure(), with the figures of calm commands as well."""
    watch = Watch(launch)
    told = dataclasses.replace(measurement, arguments=(*measurement.arguments, "--timeline"))
    found, complaints = measuring.measure(launch, told, seconds)
    spans, more = watch.end()
    if found and spans is not None:
        found |= figures(zip(found["command_due_ms"], found["command_late_ms"]), spans)
    return {name: value for name, value in found.items() if not name.endswith("_ms")}, complaints + more
