"""The part of the table about round trips and throughput on loopback."""
from .load_table import number

TITLES = {
    "roundtrip": ("Round trip of 64 bytes, back to back, µs", "round_trip_p50", "round_trip_p99", 1),
    "paced": ("Round trip of 64 bytes at 1 kHz, µs", "round_trip_p50", "round_trip_p99", 1),
    "frames": ("1 MiB frames, MB/s", "megabytes_per_second", None, 0),
    "messages": ("64-byte messages, thousand/s", "messages_per_second", None, 0),
}


def cell_of(medians, measurement, transport, base):
    _, first, second, digits = TITLES[measurement.key]
    value = medians.of(measurement.key, transport.key, first)
    if value is None:
        return "–"
    scale = 1000 if measurement.key == "messages" else 1
    text = number(value, scale, digits)
    if second:
        text += " / " + number(medians.of(measurement.key, transport.key, second), 1, digits)
    reference = medians.of(measurement.key, base, first)
    return text + (f" ({value / reference:.2f})" if reference else "")


def base_of(transport):
    """Plain transports are held against plain Asio, and what never sleeps against a plain socket that never does."""
    if "--spin" in transport.arguments:
        return "raw-spin"
    return "asio" if transport.mode == "none" else "asio-tls"


def sections(medians, measurements, transports):
    shown = [m for m in measurements if m.key in TITLES]
    if not shown:
        return []
    spreads = ", ".join(f"{m.key} {number(medians.spread(m.key, 'asio-tls', TITLES[m.key][1]))} %" for m in shown)
    lines = ["### Loopback", "",
             "Round trips: p50 / p99. In brackets the ratio to Asio TLS, for what has no TLS to plain Asio, and for what never sleeps to raw "
             f"TCP that never does. Spread of Asio TLS over the rounds: {spreads}.", "",
             "| | " + " | ".join(TITLES[m.key][0] for m in shown) + " |", "|---" * (len(shown) + 1) + "|"]
    for transport in transports:
        cells = [cell_of(medians, m, transport, base_of(transport)) for m in shown]
        lines.append(f"| {transport.title} | " + " | ".join(cells) + " |")
    return ["\n".join(lines)]
