"""The regime map: what the disk does for good, over axial forcing and restitution. A worked example of a
sweep.

    python crates/bouncing-disk-python/benchmarks/regime_map.py --side 1000 --folder regimes
    python crates/bouncing-disk-python/benchmarks/regime_map.py --side 20000 --paper

The first computes the map by local processes; ended and called again, it goes on. The second computes a few
thousand cells of the map, and says what all of it would take: chunks, memory, hours of a core.
"""

from __future__ import annotations

import argparse
import time
from typing import NamedTuple

import numpy as np

import bouncing_disk as bd

#: Ends of the axes; cells are looked at in their middles.
FORCINGS, RESTITUTIONS = (0.0, 3.0), (0.0, 0.95)
#: Impacts before and in a measurement: those of a draft, enough to tell the regimes apart.
TRANSIENT, IMPACTS = 300, 600
#: Cells of a chunk: some seconds of one core.
CHUNK = 65_536


def regimes(axial_forcing, restitution, transient, impacts):
    """The verdict on each cell: a place in ``bd.Verdicts.KINDS``.

    A start is an impact where the platform rises fastest, with the speed of the period-1 orbit.
    """
    return bd.verdicts(
        axial_forcing=axial_forcing,
        restitution=restitution,
        impact_phase=0.0,
        normalised_speed=2.0 / (1.0 + restitution),
        transient=transient,
        impacts=impacts,
        longest_period=64,
        tolerance=1e-6,
    ).kind


def grid(side):
    """The axes of a map of so many cells a side."""
    middles = (np.arange(side) + 0.5) / side
    return {
        "axial_forcing": FORCINGS[0] + (FORCINGS[1] - FORCINGS[0]) * middles,
        "restitution": RESTITUTIONS[0] + (RESTITUTIONS[1] - RESTITUTIONS[0]) * middles,
    }


def regime_map(side, client=None, folder=None, chunk_size=CHUNK, progress=None):
    """The map, forcing by restitution."""
    return bd.sweep(
        regimes,
        grid(side),
        client,
        arguments={"transient": TRANSIENT, "impacts": IMPACTS},
        folder=folder,
        chunk_size=chunk_size,
        progress=progress,
    )


class Plan(NamedTuple):
    """What a map takes."""

    points: int
    chunks: int
    seconds_a_chunk: float
    core_hours: float
    worker_bytes: int
    result_bytes: int

    def __str__(self):
        """The same in words."""
        return (
            f"{self.points:,} cells in {self.chunks:,} chunks of {self.seconds_a_chunk:.1f} s; {self.core_hours:.1f} hours "
            f"of a core; {self.worker_bytes / 1e6:.0f} MB of memory in a worker; "
            f"{self.result_bytes / 1e6:.0f} MB of results"
        )


def plan(side, rate, chunk_size=CHUNK):
    """What a map of so many cells a side takes at this rate (cells a second and core).

    A worker holds for each cell of a chunk its map, its start, its orbit and the evidence of its verdict.
    What a process grew by was measured, 1,900 bytes a cell.
    """
    points = side * side
    return Plan(
        points=points,
        chunks=-(-points // chunk_size),
        seconds_a_chunk=chunk_size / rate,
        core_hours=points / rate / 3600.0,
        worker_bytes=2_000 * min(chunk_size, points),
        result_bytes=points,
    )


def measured_rate(cells=8_192):
    """Cells a second of one core, from cells that are strewn over the map."""
    random = np.random.default_rng(1)
    forcings, restitutions = random.uniform(*FORCINGS, cells), random.uniform(*RESTITUTIONS, cells)
    before = bd.threads()
    bd.set_threads(count=1)
    try:
        start = time.perf_counter()
        regimes(forcings, restitutions, TRANSIENT, IMPACTS)
        return cells / (time.perf_counter() - start)
    finally:
        bd.set_threads(count=before)


def main():
    """Computes a map, or says what it would take."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--side", type=int, default=1_000, help="cells a side (default 1000)")
    parser.add_argument("--folder", help="where finished chunks are stored")
    parser.add_argument("--paper", action="store_true", help="only say what it would take")
    arguments = parser.parse_args()
    if arguments.paper:
        rate = measured_rate()
        print(f"{rate:,.0f} cells a second and core")
        print(plan(arguments.side, rate))
        return
    start = time.perf_counter()
    result = regime_map(arguments.side, folder=arguments.folder)
    seconds = time.perf_counter() - start
    shares = np.bincount(result.values.ravel(), minlength=len(bd.Verdicts.KINDS)) / result.values.size
    for name, share in zip(bd.Verdicts.KINDS, shares, strict=True):
        print(f"{name:10} {100.0 * share:6.2f} %")
    print(f"{result.values.size:,} cells in {seconds:.1f} s")


if __name__ == "__main__":
    main()
