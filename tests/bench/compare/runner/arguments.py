"""The command line: what is not known, not built or not writable is said before an hour is spent."""
import argparse
import pathlib

from . import conditions, transports

WORKLOADS = ("load", "neighbour", "status", "two-streams", "roundtrip", "paced", "throughput", "collapse")


def words_of(known):
    """An option's comma-separated words, each of which is known; each counts once."""
    def read(text):
        words = list(dict.fromkeys(word.strip() for word in text.split(",") if word.strip()))
        strange = [word for word in words if word not in known]
        if strange or not words:
            raise argparse.ArgumentTypeError(f"{', '.join(strange) or 'nothing'} is not among {', '.join(known)}")
        return words
    return read


def above_zero(number):
    def read(text):
        try:
            value = number(text)
        except ValueError:
            value = 0
        if not 0 < value < float("inf"):
            raise argparse.ArgumentTypeError(f"{text} is not a number above 0")
        return value
    return read


def try_output(path):
    """Raises OSError when the table could not be written there; leaves nothing behind."""
    is_new = not path.exists()
    path.open("a").close()
    if is_new:
        path.unlink()


def parse(description, build_dir, given=None):
    parser = argparse.ArgumentParser(description=description)
    keys = [t.key for t in transports.TRANSPORTS]
    parser.add_argument("--workloads", type=words_of(WORKLOADS), default=list(WORKLOADS),
                        help="of " + ", ".join(WORKLOADS) + "; load, neighbour, status, two-streams and collapse need root")
    parser.add_argument("--transports", type=words_of(keys), help="of " + ", ".join(keys) + "; all that are built")
    parser.add_argument("--links", type=words_of(conditions.LINKS), default=list(conditions.LINKS),
                        help=f"of load, of status ({', '.join(conditions.STATUS_LINKS)} only), and of two-streams as far as they carry both and lose nothing: " + ", ".join(conditions.LINKS))
    parser.add_argument("--rounds", type=above_zero(int), default=5)
    parser.add_argument("--seconds", type=above_zero(float), default=5, help="measured of each transport in each condition and round")
    parser.add_argument("--quick", action="store_true", help="one round of two seconds, and two links")
    parser.add_argument("--real-time", action="store_true", help="both ends under SCHED_FIFO: less noise on a busy machine, and commands on whose way it stood still are told apart")
    parser.add_argument("--output", type=pathlib.Path, help="the Markdown file; standard output")
    parser.add_argument("--json", type=pathlib.Path, help="write every single result there as well, a line each")
    parser.add_argument("--tables", type=pathlib.Path, nargs="+", help="measure nothing: the table of results that --json kept")
    parser.add_argument("--strict", action="store_true", help="end with status 1 where one of LiENa's targets is missed, or none could be told")
    parser.add_argument("--build-dir", type=pathlib.Path, default=build_dir)
    parser.add_argument("--no-build", action="store_true", help="take what --build-dir holds")
    chosen = parser.parse_args(given)
    if chosen.quick:
        chosen.rounds, chosen.seconds, chosen.links = 1, 2, ["1g", "400m"]
    return chosen


def chosen_transports(wanted, built):
    """Those of `built` that are wanted; raises LookupError, which says why, when one that was named is missing or none is there."""
    found = [t for t in built if wanted is None or t.key in wanted]
    missing = [key for key in wanted or [] if key not in [t.key for t in found]]
    if missing:
        raise LookupError(f"{', '.join(missing)}: not built; README.md says which packages the other transports need")
    if not found:
        raise LookupError("no program is built: leave out --no-build")
    return found
