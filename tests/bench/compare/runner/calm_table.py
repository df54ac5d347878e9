"""The part of the table about calm commands of LiENa."""
from .calm import BEFORE_MS, WORTH_MS
from .load_table import KINDS, limits_of, number, verdict, within

HEAD = ("| | calm, of all | p99 | p99.9 | max | limits of p99, p99.9 | met |\n"
        "|---|---|---|---|---|---|---|")


def keys_of(kind):
    """`(key, idle key, link, frames per second)` of each condition."""
    return [(f"{kind.key}/{name}/{rate}", f"{kind.key}/{name}/0", link, rate) for name, link in kind.links.items() for rate in link.frame_rates]


def limits(medians, link, idle_key):
    return limits_of(medians, link, idle_key, "liena", "calm_p99")


def is_within(medians, key, idle_key, link):
    """None when too few commands were calm, or none was looked at."""
    return within([medians.of(key, "liena", "calm_" + part) for part in ("p99", "p999")], limits(medians, link, idle_key))


def row(medians, key, idle_key, link, title, has_frames):
    def of(figure):
        return medians.of(key, "liena", figure)

    bounds = limits(medians, link, idle_key)
    judged = has_frames and None not in bounds
    return "| " + " | ".join([
        title, f"{number(100 * of('calm_count') / of('command_count'))} %", *(number(of("calm_" + part)) for part in ("p99", "p999", "max")),
        ", ".join(map(number, bounds)) if judged else "–", verdict(is_within(medians, key, idle_key, link)) if judged else "–"]) + " |"


def rows(medians):
    for kind in KINDS:
        for key, idle_key, link, rate in keys_of(kind):
            if medians.of(key, "liena", "calm_count") is not None:
                frames = f"{rate} {kind.name}/s{kind.whose}" if rate else f"no {kind.name}"
                yield row(medians, key, idle_key, link, f"{link.name}, {frames}", rate > 0)


EXPLANATION = (f"LiENa's commands of the tables above on whose way nothing stood still: from {BEFORE_MS:g} ms before they were due until they were there no "
               f"processor kept an idle thread of high priority from running for {WORTH_MS} ms, and the program that is a line of 20 ms was not "
               "late for as long. In µs; the limits are reckoned from calm commands without frames. The others are not held against them: whose packets keep "
               "the kernel of a processor busy for so long would be spared some of its own late commands.")


def sections(medians):
    lines = list(rows(medians))
    return ["\n".join(["### Calm commands", "", EXPLANATION, "", HEAD, *lines])] if lines else []
