"""One measurement: both ends as processes, and the lines that they print."""
import json
import select
import subprocess
import time

from .files import free_port

START_SECONDS = 10
MOST_COMPLAINTS = 5


class Peer:
    def __init__(self, words):
        self.process = subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def line(self, deadline):
        """The JSON object it prints, or None when it does not until then."""
        ready, _, _ = select.select([self.process.stdout], [], [], max(0, deadline - time.monotonic()))
        text = self.process.stdout.readline() if ready else ""
        return json.loads(text) if text else None

    def end(self):
        """What it said on its error output."""
        try:
            return self.process.communicate(timeout=5)[1]
        except subprocess.TimeoutExpired:
            self.process.kill()
            return self.process.communicate()[1]


def measure(program, arguments, network, files, measurement, seconds, urgency, meanwhile=lambda: None):
    """The figures of both ends in one dictionary; empty when the run failed. And what they complained about. `meanwhile` is called once
    they run, and takes no longer than they do."""
    # A port that was not used just now: not every library listens where a connection ended a minute ago. LiENa's is in its topology.
    common = ["--workload", measurement.workload, "--host", network.hosts[1], "--port", str(free_port()), "--seconds", str(seconds),
              "--files", str(files), *measurement.arguments, *arguments]
    echo = Peer(network.command(1, [*urgency, str(program), "--role", "echo", *common]))
    client = Peer(network.command(0, [*urgency, str(program), "--role", "client", *common]))
    deadline = time.monotonic() + START_SECONDS + seconds
    meanwhile()
    figures = {}
    tellers = {"load": (echo, client), "roundtrip": (client,), "paced": (client,)}.get(measurement.workload, (echo,))
    for teller in tellers:
        figures.update(teller.line(deadline) or {"failed": True})
    complaints = client.end() + echo.end()
    return ({} if "failed" in figures else figures), "\n".join(list(dict.fromkeys(complaints.splitlines()))[:MOST_COMPLAINTS])
