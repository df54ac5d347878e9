"""One measurement: both ends as processes, and the lines that they print."""
import json
import select
import subprocess
import time
from dataclasses import dataclass

from .files import free_port

START_SECONDS = 10
START_LAG = 1
MOST_COMPLAINTS = 5


class Peer:
    def __init__(self, words):
        self.process = subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def line(self, deadline):
        """The JSON object it prints, or None when it does not until then."""
        ready, _, _ = select.select([self.process.stdout], [], [], max(0, deadline - time.monotonic()))
        text = self.process.stdout.readline() if ready else ""
        return json.loads(text) if text else None

    def closed(self):
        """What it had still to say once its input ends, and its error output."""
        try:
            return self.process.communicate(timeout=5)
        except subprocess.TimeoutExpired:
            self.process.kill()
            return self.process.communicate()

    def end(self):
        """What it said on its error output."""
        return self.closed()[1]


class Ends:
    """Both ends of a link as processes."""

    def __init__(self, launch, pair, workload, seconds, arguments):
        # A port that was not used just now: not every library listens where a connection ended a minute ago. LiENa's is in its topology.
        common = ["--workload", workload, "--host", launch.network.hosts[1], "--port", str(free_port()), "--seconds", str(seconds),
                  "--pair", str(pair), "--files", str(launch.files[pair]), *arguments, *launch.arguments]
        echo, client = (Peer(launch.network.command(end, [*launch.urgency, str(launch.program), "--role", role, *common]))
                        for end, role in ((1, "echo"), (0, "client")))
        self.both = (client, echo)
        self.tellers = {"load": (echo, client), "roundtrip": (client,), "paced": (client,)}.get(workload, (echo,))
        self.deadline = time.monotonic() + START_SECONDS + seconds

    def figures(self):
        """In one dictionary; empty when the run failed."""
        lines = [teller.line(self.deadline) for teller in self.tellers]
        return {name: value for line in lines for name, value in line.items()} if all(lines) else {}

    def end(self):
        return "".join(peer.end() for peer in self.both)


@dataclass(frozen=True)
class Launch:
    """How the programs of a transport are started."""
    program: str
    arguments: tuple
    network: object
    files: tuple  # of each pair of ends
    urgency: list
    canary: tuple = ()  # the command of the program that watches the processors; none: nobody does


def told_once(complaints):
    return "\n".join(list(dict.fromkeys(complaints.splitlines()))[:MOST_COMPLAINTS])


def measure(launch, measurement, seconds, meanwhile=lambda: None):
    """The figures of both ends; empty when the run failed. And what they complained about. `meanwhile` is called once they run, and takes no
    longer than they do."""
    if measurement.beside:
        return measure_beside(launch, measurement, seconds)
    ends = Ends(launch, 0, measurement.workload, seconds, measurement.arguments)
    meanwhile()
    return ends.figures(), told_once(ends.end())


def measure_beside(launch, measurement, seconds):
    """The commands of the first pair of ends, and the frames of the second."""
    neighbour = Ends(launch, 1, measurement.workload, seconds + 2 * START_LAG, measurement.beside)
    time.sleep(START_LAG)  # its frames flow before the first command counts, and after the last
    ends = Ends(launch, 0, measurement.workload, seconds, measurement.arguments)
    own, others = ends.figures(), neighbour.figures()
    complaints = told_once(ends.end() + neighbour.end())
    if not own or not others:
        return {}, complaints
    return {name: value for figures, kind in ((own, "command"), (others, "frame")) for name, value in figures.items()
            if name.startswith(kind)}, complaints
