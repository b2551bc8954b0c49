"""The same work in this package and in Numba, one thread each: prints how many times faster the package is.

    pip install './crates/bouncing-disk-python' numba
    python crates/bouncing-disk-python/benchmarks/numba_comparison.py

The workloads are those of docs/performance.md. W1: 500 orbits at Gamma = 0.55, 10,000 impacts of each. W3:
the basin at Gamma = 0.5 on 300 x 300 cells. Motor: 512 run-ups of two seconds of the motor of Table III. Both
programs run in turn, and the least of 20 times of each counts. Before, the answers are compared: single
flights to the last digits, all labels of the basin, and the mean speed of the motors within its standard
error (single run-ups are chaotic).
"""

from __future__ import annotations

import argparse
import math
import time
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numba import njit
from numba_basin import basin
from numba_flight import TAU, first_impact, lift_off_phase
from numba_motor import run_ups

import bouncing_disk as bd

RESTITUTION = 0.5
ORBITS, IMPACTS, FORCING = 500, 10_000, 0.55
CELLS, BASIN_FORCING, RADIUS, MOST = 300, 0.5, 0.3257, 500
ORBIT_PHASES = np.array([1.1144591407077336, 0.49631693677637584])
ORBIT_VELOCITIES = np.array([-4.046922954066734, -4.330657455506047])
MEMBERS, SECONDS, INTERVALS, PERTURBATION = 512, 2.0, 600, 1e-3


class Workload(NamedTuple):
    """The same work for both, and what it counts."""

    name: str
    required: float | None
    package: Callable[[], object]
    by_hand: Callable[[], object]
    count: float
    unit: str


@njit(cache=True)
def orbits(peak, restitution, phases, velocities, impacts, last_phases, last_velocities):
    """The last impact of each orbit."""
    lift_off = lift_off_phase(peak)
    for k in range(len(phases)):
        angle, velocity = phases[k], velocities[k]
        for _ in range(impacts):
            _, angle, velocity = first_impact(peak, lift_off, angle, -restitution * velocity)
        last_phases[k], last_velocities[k] = angle, velocity


def starts(count):
    """The first impacts of W1's orbit: phases, relative velocities."""
    peak = math.pi * FORCING
    phases, velocities = np.empty(count), np.empty(count)
    angle, velocity = 0.8, -1.3 * math.pi
    for k in range(count):
        phases[k], velocities[k] = angle, velocity
        _, angle, velocity = first_impact(peak, lift_off_phase(peak), angle, -RESTITUTION * velocity)
    return phases, velocities


def w1(count=ORBITS, impacts=IMPACTS):
    """Chaotic orbits."""
    phases, velocities = starts(count)
    last = np.empty(count), np.empty(count)

    def package():
        return bd.iterate_orbits(
            axial_forcing=FORCING,
            restitution=RESTITUTION,
            impact_phase=phases,
            normalised_speed=-velocities / math.pi,
            impacts=impacts,
        )

    def by_hand():
        orbits(math.pi * FORCING, RESTITUTION, phases, velocities, impacts, *last)
        return last

    return Workload("W1", 10.0, package, by_hand, count * impacts, "impacts")


def w3(cells=CELLS, prove=False):
    """Basins; `prove`: in Numba, too, rest is proven and not waited for, more than W3 asks for."""
    bouncing = bd.ImpactMap(axial_forcing=BASIN_FORCING, restitution=RESTITUTION)
    orbit = bouncing.refine(impact_phase=ORBIT_PHASES, axial_impact_velocity=ORBIT_VELOCITIES)
    centres = (np.arange(cells) + 0.5) / cells
    labels = np.empty((cells, cells), dtype=np.uint8)

    def package():
        return bd.basins(
            bouncing,
            phases=cells,
            speeds=cells,
            speed_range=(0.0, 2.0),
            known_orbits=[(orbit, RADIUS)],
            max_impacts=MOST,
        )

    def by_hand():
        peak = math.pi * BASIN_FORCING
        basin(
            peak,
            RESTITUTION,
            TAU * centres,
            2.0 * centres,
            ORBIT_PHASES,
            ORBIT_VELOCITIES,
            RADIUS,
            MOST,
            prove,
            labels,
        )
        return labels

    name, required = ("W3 with a proof of rest", None) if prove else ("W3", 8.0)
    return Workload(name, required, package, by_hand, cells * cells, "cells")


def motors(members=MEMBERS, seconds=SECONDS):
    """Run-ups of a motor, in rad/s, a column for each."""
    system = bd.System.motor()
    frequency, preload = system.angular_frequency, system.preload_acceleration
    unit = preload * system.contact_radius / (system.gyration_radius**2 * frequency)
    twist = system.twist_amplitude * frequency / unit
    phases = TAU * (np.arange(members) + 0.5) / members
    seeds = np.arange(members, dtype=np.uint64)

    def package():
        return bd.transients(
            [system] * members,
            phases=phases,
            seeds=seeds,
            duration=seconds,
            intervals=INTERVALS,
            relaunch_perturbation=PERTURBATION,
        ).speeds

    def by_hand():
        length = seconds * frequency
        angles = np.zeros((members, INTERVALS))
        run_ups(
            system.peak_acceleration,
            twist,
            system.friction,
            system.restitution,
            phases,
            length,
            PERTURBATION,
            seeds,
            angles,
        )
        return angles.T * (unit * INTERVALS / length)

    return Workload("motor ensemble", 2.0, package, by_hand, members * seconds, "motor seconds")


def flights_differ(count=2_000):
    """The largest difference of impact phases (rad) of single flights, as both find them."""
    largest = 0.0
    for forcing in (FORCING, BASIN_FORCING, bd.System.motor().peak_acceleration / math.pi):
        bouncing = bd.ImpactMap(axial_forcing=forcing, restitution=RESTITUTION)
        peak = bouncing.peak_acceleration
        random = np.random.default_rng(7)
        for phase, velocity in zip(
            TAU * random.random(count), -(1.0 + peak) * 2.0 * random.random(count), strict=True
        ):
            found, _ = bouncing.step(impact_phase=phase, axial_impact_velocity=velocity)
            _, by_hand, _ = first_impact(peak, lift_off_phase(peak), phase, -RESTITUTION * velocity)
            largest = max(largest, abs(math.remainder(found - by_hand, TAU)))
    return largest


def labels_differ(workload):
    """In how many cells the labels differ."""
    # Rest is label 1 and the orbit label 2 of both.
    return int(np.count_nonzero(workload.package().labels != workload.by_hand()))


def motors_differ(workload):
    """The difference of the members' mean speeds over the last sixth, in its standard errors."""
    means = [run()[-INTERVALS // 6 :].mean(axis=0) for run in (workload.package, workload.by_hand)]
    error = math.sqrt(sum(mean.var(ddof=1) / len(mean) for mean in means))
    return abs(means[0].mean() - means[1].mean()) / error


def least_times(workload, rounds):
    """The least time of each, run in turn."""
    least = [math.inf, math.inf]
    for _ in range(rounds):
        for which, run in enumerate((workload.package, workload.by_hand)):
            start = time.perf_counter()
            run()
            least[which] = min(least[which], time.perf_counter() - start)
    return least


def main():
    """Compares, measures, prints."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=20, help="times that both run in turn (default 20)")
    rounds = parser.parse_args().rounds
    bd.set_threads(count=1)
    workloads = [w1(), w3(), w3(prove=True), motors()]
    print(f"single flights: impact phases differ by at most {flights_differ():.1e} rad")
    print(
        f"W3: {labels_differ(workloads[1])} and {labels_differ(workloads[2])} of {CELLS * CELLS} labels differ"
    )
    print(f"motor: mean speeds differ by {motors_differ(workloads[3]):.1f} standard errors")
    for workload in workloads:
        package, by_hand = least_times(workload, rounds)
        required = "" if workload.required is None else f", required {workload.required:g}"
        print(
            f"{workload.name}: {by_hand / package:.1f} times faster than Numba{required} "
            f"({workload.count / package:.3g} and {workload.count / by_hand:.3g} {workload.unit} a second)"
        )


if __name__ == "__main__":
    main()
