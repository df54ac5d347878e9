"""Where the two ends run: on loopback, or in two network namespaces joined by a link of limited rate, of some length, and with losses."""
import os
import subprocess

from .conditions import QUEUE_BYTES

HOSTS = ("10.78.0.1", "10.78.0.2")


def sh(*words):
    subprocess.run(words, check=True, stdout=subprocess.DEVNULL)


class Loopback:
    hosts = ("127.0.0.1", "127.0.0.1")

    def command(self, end, words):
        return words

    def late(self):
        """Spans in ms of the monotonic clock, since the last asking, in which what passes waited for a program that is the line."""
        return []

    def close(self):
        pass


class Namespaces:
    """Two namespaces, each with its `eth0`. Nothing leaves them, and close() leaves nothing of them."""
    hosts = HOSTS

    def __init__(self):
        self.names = [f"compare-{os.getpid()}-{end}" for end in ("near", "far")]
        for name in self.names:
            sh("ip", "netns", "add", name)

    def command(self, end, words):
        return ["ip", "netns", "exec", self.names[end], *words]

    def late(self):
        return []

    def inside(self, end, *words):
        sh(*self.command(end, words))

    def configure(self):
        for end, host in enumerate(HOSTS):
            self.inside(end, "ip", "link", "set", "lo", "up")
            self.inside(end, "ip", "link", "set", "eth0", "mtu", "1500", "up")
            self.inside(end, "ip", "addr", "add", host + "/24", "dev", "eth0", "noprefixroute")
            # The congestion control is named, since its default differs between kernels.
            self.inside(end, "ip", "route", "replace", "10.78.0.0/24", "dev", "eth0", "src", host, "congctl", "cubic")
            self.inside(end, "ip", "route", "replace", "default", "dev", "eth0", "src", host)  # multicast of the discoveries

    def close(self):
        for name in self.names:
            subprocess.run(["ip", "netns", "del", name], check=False)


class ShapedPair(Namespaces):
    """A pair of virtual Ethernet devices with the kernel's token bucket at each end: a rate, and a queue before it."""

    def __init__(self, link):
        super().__init__()
        sh("ip", "link", "add", "eth0", "netns", self.names[0], "type", "veth", "peer", "name", "eth0", "netns", self.names[1])
        self.configure()
        self.shape(link.megabits, "replace")

    def shape(self, megabits, how="change"):
        # What may leave at once: as much as passes while the kernel's timer is late. Larger packets are cut to frames.
        burst = max(8192, megabits * 1000000 // 8 // 4000)
        for end in (0, 1):
            self.inside(end, "tc", "qdisc", how, "dev", "eth0", "root", "tbf", "rate", f"{megabits}mbit", "burst", str(burst), "limit",
                        str(QUEUE_BYTES))


class WiredPair(Namespaces):
    """The lab's wire, which also delays and loses; it is a program, and takes processor time from the ends."""

    def __init__(self, link, wire, urgency):
        super().__init__()
        descriptors = [os.open(f"/run/netns/{name}", os.O_RDONLY) for name in self.names]
        # Where each packet may have a fate of its own, each is a frame; else as network cards have them, with fewer calls.
        form = [] if link.loss else ["--long-frames"]
        self.wire = subprocess.Popen([*urgency, str(wire), *form, "1", *map(str, descriptors)], stdin=subprocess.PIPE,
                                     stdout=subprocess.PIPE, text=True, pass_fds=descriptors)
        for descriptor in descriptors:
            os.close(descriptor)
        self.wire.stdout.readline()
        for port in (1, 2):
            self.say(f"port {port} rate={link.megabits * 1000000} queue={QUEUE_BYTES}")
        self.say(f"link *>* delay={link.delay_ms}ms drop={link.loss}")
        self.configure()

    def say(self, order):
        self.wire.stdin.write(order + "\n")
        self.wire.stdin.flush()
        answer = self.wire.stdout.readline()
        if " ok" not in answer:
            raise RuntimeError(f"the wire refused `{order}`: {answer}")
        return answer

    def late(self):
        return [tuple(map(float, span.split("-"))) for span in self.say("late").split()[2:]]

    def close(self):
        self.wire.stdin.close()
        self.wire.wait()
        super().close()


def make(link, wire, urgency):
    if not link.megabits:
        return Loopback()
    return WiredPair(link, wire, urgency) if link.delay_ms or link.loss else ShapedPair(link)
