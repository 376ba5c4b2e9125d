#!/usr/bin/env python3
"""Runs a command with its output in a log; prints its seconds, from start to end, those of processors, and the peak of its
resident memory, MB. Fails as the command does, without the figures. Usage: measured.py LOG COMMAND..."""
import resource
import subprocess
import sys
import time

with open(sys.argv[1], "w") as log:
    begun = time.monotonic()
    status = subprocess.run(sys.argv[2:], stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT).returncode
    seconds = time.monotonic() - begun
if status:
    sys.exit(1)
used = resource.getrusage(resource.RUSAGE_CHILDREN)
print("%.2f %.2f %.0f" % (seconds, used.ru_utime + used.ru_stime, used.ru_maxrss / 1024))
