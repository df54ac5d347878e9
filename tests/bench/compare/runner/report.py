"""The Markdown table: medians over the rounds, ratios within the run, and the machine's noise."""
import os
import platform
import statistics

from . import calm_table, collapse_table, load_table, loopback_table, measured_state, streams_table, targets


class Medians:
    """Of what a transport did in a measurement, over the rounds in which it came through."""

    def __init__(self, results):
        self.results = results

    def values(self, measurement, transport, figure):
        rounds = self.results.get(measurement, {}).get(transport, [])
        return [figures[figure] for figures in rounds if figure in figures]

    def of(self, measurement, transport, figure):
        values = self.values(measurement, transport, figure)
        return statistics.median(values) if values else None

    def spread(self, measurement, transport, figure):
        """Largest minus least over the median, in percent."""
        values = self.values(measurement, transport, figure)
        return 100 * (max(values) - min(values)) / statistics.median(values) if len(values) > 1 else None


def machine(comparison):
    chosen = comparison.chosen
    stalls = comparison.stalls
    stalled = (f"median {statistics.median(stalls):.1f} ms, worst {max(stalls):.1f} ms" if stalls else "not known")
    return (f"{os.cpu_count()} processors, {platform.system()} {platform.release()}, load {os.getloadavg()[1]:.1f} (5 minutes, these "
            f"programs included); {chosen.rounds} round{'s' if chosen.rounds > 1 else ''} of {chosen.seconds:g} s"
            f"{', both ends under SCHED_FIFO' if chosen.real_time else ''}. Largest stall of a 1 ms timer before a round: {stalled}. "
            f"Sources: {'; '.join(dict.fromkeys(comparison.states)) or measured_state.UNKNOWN}.")


def missed(comparison):
    """The titles of LiENa's targets that are not reached; None where none can be told."""
    judged = targets.all_judged(Medians(comparison.results))
    return [one.title for one in judged if not one.met] if judged else None


def markdown(comparison, measurements):
    medians = Medians(comparison.results)
    sections = ["<!-- Written by tests/bench/compare/run. -->", machine(comparison), *targets.sections(medians)]
    sections += loopback_table.sections(medians, measurements, comparison.transports)
    sections += load_table.sections(medians, comparison.transports, comparison.chosen.seconds)
    sections += calm_table.sections(medians)
    sections += streams_table.sections(medians, comparison.transports, comparison.chosen.seconds)
    sections += collapse_table.sections(medians, comparison.transports)
    return "\n\n".join(sections) + "\n"
