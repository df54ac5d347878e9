"""The part of the table about commands beside two streams of frames of one device."""
from .conditions import COMMAND_RATE, LINKS, STREAM_RATES
from .load_table import FRAME_RATIO, command_cells, limits_of, number, segment_limits, verdict, within

STREAMS = ("frame", "second_frame")  # in the names of the figures
HEAD = ("| | p50 | p99 | p99.9 | max | arrived / sent / due | limits of p99, p99.9 | met |"
        + "".join(f" frames of {rate}/s: p50, p99, ms | ÷ raw | arrived, per s |" for rate in STREAM_RATES) + "\n" + "|---" * 14 + "|")


def key_of(link_name, streams):
    return f"two-streams/{link_name}/{streams}"


def stream_cells(of, raw, stream):
    """`of` and `raw`: figures of the transport and of raw TCP."""
    frame, reference = of(f"{stream}_p50"), raw(f"{stream}_p50")
    return [f"{number(frame, 1000, 1)}, {number(of(f'{stream}_p99'), 1000, 1)}", number(frame / reference, 1, 2) if frame and reference else "–",
            number(of(f"{stream}s_per_second"), 1, 1)]


def row(medians, link_name, streams, transport, seconds):
    def of(figure, transport_key=transport.key):
        return medians.of(key_of(link_name, streams), transport_key, figure)

    cells = command_cells(of, COMMAND_RATE * seconds)
    if streams:
        limits = limits_of(medians, LINKS[link_name], key_of(link_name, 0), transport.key)
        cells += ["–" if None in limits else ", ".join(map(number, limits)), verdict(within((of("command_p99"), of("command_p999")), limits))]
        cells += [cell for stream in STREAMS for cell in stream_cells(of, lambda figure: of(figure, "raw"), stream)]
    else:
        cells += ["–"] * 8
    return "| " + " | ".join([transport.title, *cells]) + " |"


def rows(medians, link_name, transports, seconds):
    for streams, title in ((0, "no frames"), (2, f"two streams of frames of {LINKS[link_name].frame_bytes // 1024} KiB")):
        measured = medians.results.get(key_of(link_name, streams), {})
        if measured:
            yield f"| *{title}* |" + " |" * 13
        for transport in transports:
            if any(measured.get(transport.key, [])):
                yield row(medians, link_name, streams, transport, seconds)
            elif measured.get(transport.key):
                yield f"| {transport.title} | did not come through |" + " |" * 12


def explanation(link_name):
    first, second = STREAM_RATES
    return (f"64-byte commands at {COMMAND_RATE} Hz, one-way latency in µs since they were due, beside two streams of frames from the same "
            f"device: {first} and {second} a second, so that they drift through all overlaps. LiENa sends each on a lane of its session, raw TCP "
            f"each on a socket of its own, beside that of the commands. {segment_limits(LINKS[link_name])} Frames: beside raw TCP's p50 of the same stream (target {FRAME_RATIO}).")


def sections(medians, transports, seconds):
    for name, link in LINKS.items():
        lines = list(rows(medians, name, transports, seconds))
        if lines:
            title = f"### Commands beside two streams of frames, {link.name}{' each way' if link.delay_ms else ''}"
            yield "\n".join([title, "", explanation(name), "", HEAD, *lines])
