#!/usr/bin/env python3
"""Tables of the runs that run.sh listed: ratios of the pairs, then every run. Usage: table.py peers.csv"""
import collections
import csv
import statistics
import sys

BONDS_MAY_DIFFER = 1e-3  # of each other: two programs round the same rule
with open(sys.argv[1]) as file:
    rows = list(csv.DictReader(file))

runs = collections.defaultdict(dict)  # (threads, pair) -> program -> row
for row in rows:
    runs[int(row["threads"]), int(row["pair"])][row["program"]] = row
counts = {program: next((int(r["particles"]), int(r["bonds"])) for r in rows if r["program"] == program)
          for program in ("platen", "yade")}
if counts["platen"][0] != counts["yade"][0] or \
        abs(counts["platen"][1] - counts["yade"][1]) > BONDS_MAY_DIFFER * counts["platen"][1]:
    sys.exit("particles and bonds differ, the rates do not compare: %s" % counts)
print("%d particles; bonds: Platen %d, Yade %d. Rates in M bond-steps/s.\n"
      % (counts["platen"] + counts["yade"][1:]))


def numbers(threads, program, column):
    return [float(both[program][column]) for (t, _), both in sorted(runs.items()) if t == threads]


def spread(values, form):
    return (form + " (" + form + " ... " + form + ")") % (statistics.median(values), min(values), max(values))


print("| threads | Platen | Yade | Platen over Yade | Platen, MB | Yade, MB |")
print("| --- | --- | --- | --- | --- | --- |")
for threads in sorted({t for t, _ in runs}):
    platen, yade = numbers(threads, "platen", "rate"), numbers(threads, "yade", "rate")
    print("| %d | %s | %s | **%s** | %.0f | %.0f |" % (
        threads, spread(platen, "%.2f"), spread(yade, "%.2f"), spread([p / y for p, y in zip(platen, yade)], "%.2f"),
        max(numbers(threads, "platen", "memory_mb")), max(numbers(threads, "yade", "memory_mb"))))
print("\nMedian (smallest ... largest) of the runs; the ratio is taken pair by pair. Memory is the largest peak.\n")

print("| threads | pair | Platen | Yade | ratio |")
print("| --- | --- | --- | --- | --- |")
for (threads, pair), both in sorted(runs.items()):
    p, y = float(both["platen"]["rate"]), float(both["yade"]["rate"])
    print("| %d | %d | %.2f | %.2f | %.2f |" % (threads, pair, p, y, p / y))
