"""What the machine itself adds: how late a 1 ms timer of an otherwise idle process is."""
import subprocess
import sys

PROGRAM = """
import time
largest, end = 0.0, time.monotonic() + 1
while (last := time.monotonic()) < end:
    time.sleep(0.001)
    largest = max(largest, time.monotonic() - last - 0.001)
print(largest * 1e3)
"""


def largest_stall_ms(urgency):
    return float(subprocess.run([*urgency, sys.executable, "-c", PROGRAM], check=True, capture_output=True, text=True).stdout)
