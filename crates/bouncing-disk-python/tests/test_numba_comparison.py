"""The Numba programs of the comparison have the answers of this package. How fast they are is no test."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("numba")

sys.path.insert(0, str(Path(__file__).parents[1] / "benchmarks"))

import numba_comparison as comparison  # noqa: E402


def test_single_flights_have_the_same_first_impacts() -> None:
    assert comparison.flights_differ(1_000) < 1e-9


def test_orbits_agree_until_chaos_parts_them() -> None:
    workload = comparison.w1(count=40, impacts=8)
    phases, velocities = workload.package()
    by_hand_phases, by_hand_velocities = workload.by_hand()
    assert np.allclose(velocities, by_hand_velocities, rtol=0.0, atol=1e-9)
    assert np.allclose(np.cos(phases - by_hand_phases), 1.0, rtol=0.0, atol=1e-15)


@pytest.mark.parametrize("prove", [False, True])
def test_all_labels_of_a_basin_are_the_same(prove: bool) -> None:
    workload = comparison.w3(cells=60, prove=prove)
    assert comparison.labels_differ(workload) == 0
    assert set(np.unique(workload.by_hand())) == {1, 2}


def test_motors_run_as_fast() -> None:
    # Chance alone gives four standard errors once in 16,000 times; the seeds are fixed.
    workload = comparison.motors(members=48)
    assert comparison.motors_differ(workload) < 4.0
    assert 15.0 < workload.by_hand()[-100:].mean() < 25.0


def test_the_comparison_runs() -> None:
    first, second = comparison.least_times(comparison.w1(count=64, impacts=10), 2)
    assert 0.0 < first < 10.0 and 0.0 < second < 10.0
