"""Many orbits advanced together have the bits of each of them alone."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import bouncing_disk as bd


def starts(count: int) -> dict[str, Any]:
    random = np.random.default_rng(5)
    return {
        "axial_forcing": random.uniform(0.1, 3.0, count),
        "restitution": random.uniform(0.3, 0.9, count),
        "impact_phase": random.uniform(0.0, 2.0 * np.pi, count),
        "normalised_speed": random.uniform(0.5, 4.0, count),
    }


@pytest.mark.parametrize("impacts", [0, 1, 7])
def test_the_bits_of_single_orbits(impacts: int) -> None:
    # More than one share of the threads, and one that is not full.
    given = starts(2_100)
    phases, velocities = bd.iterate_orbits(**given, impacts=impacts)
    for k in [0, 1, 1_023, 1_024, 2_047, 2_048, 2_099]:
        forcing, restitution, phase, speed = (values[k] for values in given.values())
        alone = bd.ImpactMap(axial_forcing=forcing, restitution=restitution).iterate(
            impact_phase=phase, axial_impact_velocity=-np.pi * speed, impacts=impacts
        )
        assert (phases[k], velocities[k]) == alone


def test_threads_change_nothing_and_progress_ends_with_all() -> None:
    given = starts(3_000)
    told: list[tuple[int, int]] = []
    many = bd.iterate_orbits(**given, impacts=50, progress=lambda done, total: told.append((done, total)))
    assert told[-1] == (150_000, 150_000)
    bd.set_threads(count=1)
    try:
        one = bd.iterate_orbits(**given, impacts=50)
    finally:
        bd.set_threads()
    assert all(a.tobytes() == b.tobytes() for a, b in zip(many, one, strict=True))


def test_seams() -> None:
    none = bd.iterate_orbits(
        axial_forcing=[], restitution=0.5, impact_phase=0.0, normalised_speed=1.0, impacts=3
    )
    assert [len(values) for values in none] == [0, 0]
    one: dict[str, Any] = {
        "axial_forcing": 0.5,
        "restitution": 0.5,
        "impact_phase": 0.0,
        "normalised_speed": 1.0,
    }
    assert bd.iterate_orbits(**one, impacts=2)[0].shape == (1,)
    for field, value in [("restitution", 1.5), ("normalised_speed", np.nan), ("axial_forcing", -1.0)]:
        with pytest.raises(bd.OutOfRangeError):
            bd.iterate_orbits(**{**one, field: value}, impacts=2)
    with pytest.raises((bd.OutOfRangeError, OverflowError)):
        bd.iterate_orbits(**one, impacts=-1)

    def stop(done: int, total: int) -> None:
        raise LookupError("enough")

    with pytest.raises(LookupError):
        bd.iterate_orbits(**one, impacts=10**12, progress=stop)
