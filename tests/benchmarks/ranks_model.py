#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The model of tests/benchmarks/README.md of what many processes cost: prints its table."""
from math import log2, sqrt

RUNS = [(1.6e7, 1, 0), (1.28e8, 8, 3), (1e9, 64, 6), (1e10, 1024, 10), (1e11, 8192, 13), (1e11, 10000, 16)]
NETWORK = 1e10  # bytes per second into and out of each process: assumed
MESSAGE = 2e-6  # seconds: assumed
SEND = 85e-9  # seconds per sample that is parted and sent: measured
LEAST_IN_GROUPS = 64  # processes


def pass_ns(depth):
    """Nanoseconds per sample of a pass at a depth: measured."""
    return next(ns for end, ns in ((2, 11), (5, 22), (8, 34), (11, 47), (14, 62), (99, 75)) if depth < end)


def tree(samples, levels):
    """Passes over the samples, their nanoseconds per sample, positions drawn for each."""
    drawn = min(8 * samples ** (2 / 3), max(2**21, 256 * 2**levels))
    passes, ns = 1, pass_ns(0)
    for depth in range(levels):
        left, needed = samples, 0
        while left > drawn:
            left *= 3.5 / sqrt(drawn / 2**depth)
            needed += 1
        passes += needed
        # What lies between bounds is kept for the next pass; one median of 2000 lies elsewhere.
        ns += (1 + (needed - 1) * min(1, 2**depth / 2000) if needed else 0) * pass_ns(depth)
    return passes, ns, drawn


def column(samples, ranks, levels, groups):
    own = samples / ranks
    top = round(log2(groups))
    steps = [(samples, ranks, top), (samples / groups, ranks / groups, levels - top)] if groups > 1 else [(samples, ranks, levels)]
    passes, work, drawn, lengths = [], 0.0, 0.0, 0.0
    for n, talking, depth in steps:
        count, ns, positions = tree(n, depth)
        passes.append(count)
        work += 1e-9 * ns * own
        drawn += (count if talking > 1 else 0) * 16 * positions / NETWORK
        # Each pass and six more exchanges begin with lengths, and may have contents.
        lengths += (count + 6) * 2 * talking * MESSAGE if talking > 1 else 0
    away = 0 if ranks == 1 else len(steps)
    send = max(away, 1) * SEND * own * (1 if ranks > 1 else 20 / 85) + away * 24 * own / NETWORK
    ghosts = 0 if ranks == 1 else 16e6 * (own / 2e6) ** (2 / 3)
    rows = {
        "processes": ranks,
        "groups": groups,
        "reading": 30e-9 * own,
        "passes": " + ".join(map(str, passes)),
        "decomposition, passes": work,
        "decomposition, positions drawn": drawn,
        "lengths of messages": lengths,
        "redistribution": send,
        "tree, ranges": 217e-9 * own,
        "ghosts": 10 * ghosts / NETWORK,
        "isopoints, fields, write": 4.8e-6 * 2.2 * own ** (2 / 3),
    }
    rows["total"] = sum(value for value in rows.values() if isinstance(value, float))
    return rows


columns = []
for samples, ranks, levels in RUNS:
    columns.append(column(samples, ranks, levels, 1))
    if ranks >= LEAST_IN_GROUPS:
        columns.append(column(samples, ranks, levels, 2 ** round(log2(ranks) / 2)))
for name in columns[0]:
    values = [one[name] for one in columns]
    print("| " + " | ".join([name] + [f"{v:.2f}" if isinstance(v, float) else str(v) for v in values]) + " |")
