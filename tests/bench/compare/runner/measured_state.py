"""Which state of the sources a round measured, and when."""
import datetime
import subprocess

UNKNOWN = "not known"


def of(source):
    try:
        found = subprocess.run(["git", "-C", source, "describe", "--always", "--dirty"], capture_output=True, text=True, check=True)
    except (OSError, subprocess.CalledProcessError):
        return UNKNOWN
    return f"{found.stdout.strip()}, {datetime.date.today():%d %B %Y}"
