#!/usr/bin/env python3
"""Efficiency of N ranks by a model of the step, with and without overlap of messages and computation.

A step of B bonds on N ranks of one thread each takes

  compute   B/N t_bond
  halo      messages to m neighbours and back, each latency + share of the bytes over the bandwidth:
            3.3 n^(2/3) rows of 104 bytes and as many ghosts of 48, n = B / (3.8 N) particles a rank
  loads     of boundaries to all: N - 1 messages a rank, 152 bytes a contact of a platen, (B / 3.8 / 2)^(2/3) of them
  sum       one reduction, log2 N latencies
  bodies    what every rank does alike: adding up the loads, t_load each

Overlapped, halo and sum hide behind 0.9 of the computation, loads behind the inner blocks that come after them, 0.45.
"""
import argparse
import math

BONDS_A_PARTICLE = 3.8
ROW_BYTES, GHOST_BYTES, LOAD_BYTES = 104, 48, 152


def step(bonds, ranks, o):
    """Seconds without overlap, and with all of it."""
    particles = bonds / BONDS_A_PARTICLE
    own = particles / ranks
    compute = bonds / ranks * o.bond * 1e-9
    if ranks == 1:
        return compute, compute
    surface = 1.1 * (own ** (2 / 3)) * min(3.0, ranks / 2)
    neighbours = min(ranks - 1, 13)
    halo = 3 * neighbours * o.latency * 1e-6 + surface * (ROW_BYTES + GHOST_BYTES) / (o.bandwidth * 1e9)
    contacts = (particles / 2) ** (2 / 3)
    loads = (ranks - 1) * o.message * 1e-6 + contacts * LOAD_BYTES / (o.bandwidth * 1e9)
    total = 2 * math.log2(ranks) * o.latency * 1e-6
    bodies = contacts * o.load * 1e-9
    plain = compute + halo + loads + total + bodies
    hidden = compute + max(0.0, halo + total - 0.9 * compute) + max(0.0, loads - 0.45 * compute) + bodies
    return plain, hidden


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bond", type=float, default=9.0, help="ns a bond of a step on one thread, all of it")
    parser.add_argument("--load", type=float, default=20.0, help="ns to add up the load of a contact")
    parser.add_argument("--latency", type=float, default=2.7, help="us a message")
    parser.add_argument("--message", type=float, default=0.7, help="us of a processor for a message")
    parser.add_argument("--bandwidth", type=float, default=1.5, help="GB/s a rank")
    o = parser.parse_args()
    print("| bonds | " + " | ".join(f"{n} ranks" for n in (2, 16, 64, 256, 1024)) + " |")
    for bonds in (85741, 1e6, 4.28e6, 1e8):
        cells = []
        for ranks in (2, 16, 64, 256, 1024):
            if bonds / BONDS_A_PARTICLE / 512 < ranks:
                cells.append("")
                continue
            alone = step(bonds, 1, o)[0] / ranks
            plain, hidden = step(bonds, ranks, o)
            cells.append(f"{alone / plain:.2f} / {alone / hidden:.2f}")
        print(f"| {bonds:.3g} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()
