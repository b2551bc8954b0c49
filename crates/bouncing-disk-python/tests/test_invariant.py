"""Exponents, manifolds and crises: that arguments and results go where they belong."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import bouncing_disk as bd
from good_calls import MAP, STARTS


def saddle(bouncing: bd.ImpactMap = MAP) -> bd.PeriodicOrbit:
    orbits = bd.periodic_orbits(bouncing, max_impacts=1, max_platform_periods=1)
    return next(orbit for orbit in orbits if abs(orbit.multipliers[0]) > 1.0)


def test_spectra_have_the_sum_of_the_map() -> None:
    found = bd.lyapunov_spectra(axial_forcing=[0.2, 0.44, 0.56], **STARTS)
    assert found.names() == ["rested", "exponents", "exponents"]
    assert np.isnan(found.largest[0]) and found.impacts[0] < 100
    assert np.allclose((found.largest + found.second)[1:], found.exact_sum[1:], rtol=0.0, atol=1e-11)
    assert np.allclose(found.exact_sum[1:], 2.0 * math.log(0.5), atol=1e-2)
    alone = bd.lyapunov_exponents(axial_forcing=[0.44, 0.56], **STARTS)
    assert np.allclose(found.largest[1:], alone, rtol=1e-9)
    assert found.impacts[1:].tolist() == [10_000, 10_000]
    forgets = bd.lyapunov_spectra(axial_forcing=0.6, **{**STARTS, "restitution": 0.0}, impacts=16)
    assert forgets.names() != ["exponents"] or forgets.second[0] == -np.inf
    assert bd.lyapunov_spectra(axial_forcing=[], **STARTS).names() == []
    with pytest.raises(bd.OutOfRangeError) as refused:
        bd.lyapunov_spectra(axial_forcing=0.5, impacts=15, **STARTS)
    assert (refused.value.field, refused.value.value) == ("impacts", 15.0)


def test_a_step_back_is_undone_by_a_step() -> None:
    for phase in np.linspace(0.0, 6.2, 30):
        ahead = MAP.step(impact_phase=phase, axial_impact_velocity=-4.0)
        back = MAP.step_back(impact_phase=ahead[0], axial_impact_velocity=ahead[1])
        assert back == pytest.approx((phase, -4.0), abs=1e-11)
    forgets = bd.ImpactMap(axial_forcing=0.5, restitution=0.0)
    with pytest.raises(bd.OutOfRangeError) as refused:
        forgets.step_back(impact_phase=1.0, axial_impact_velocity=-4.0)
    assert refused.value.field == "self.restitution"


@pytest.mark.parametrize("kind", ["stable", "unstable"])
def test_a_manifold_is_mapped_into_itself(kind: Any) -> None:
    start = saddle()
    found = bd.manifold(MAP, start, kind=kind, arclength=4.0, chord=0.02, turn=0.05)
    assert found.kind == kind and (abs(found.multiplier) > 1.0) == (kind == "unstable")
    assert found.offsets[0] == 0 and found.offsets[-1] == len(found.impact_phase)
    pieces, branches = len(found.offsets) - 1, len(found.branch_impact)
    assert branches == 2 * start.period and len(found.piece_branch) == len(found.piece_end) == pieces
    assert set(found.piece_branch.tolist()) <= set(range(branches))
    assert found.branch_side.tolist() == [0, 1]
    assert (found.branch_arclength <= 4.0 + 0.02).all() and found.piece_start[0] == 0
    assert sum(len(found.of(piece)[0]) for piece in range(pieces)) == found.offsets[-1]
    # The image of an impact lies on the curve again: next to one of its points.
    place = int(found.offsets[1]) // 4
    phase, velocity = MAP.step(
        impact_phase=found.impact_phase[place], axial_impact_velocity=found.axial_impact_velocity[place]
    )
    turned = np.abs(np.angle(np.exp(1j * (found.impact_phase - phase))))
    speed = np.abs(found.axial_impact_velocity - velocity) / (1.0 + MAP.peak_acceleration)
    assert np.hypot(turned, speed).min() < 0.02


def test_what_is_no_saddle_has_no_manifold() -> None:
    attracting = MAP.settled_orbit(impact_phase=1.2, normalised_speed=1.3)
    assert attracting is not None
    with pytest.raises(bd.OutOfRangeError) as refused:
        bd.manifold(MAP, attracting, arclength=1.0)
    assert refused.value.field == "orbit"
    other = bd.ImpactMap(axial_forcing=0.7, restitution=0.5)
    with pytest.raises(bd.BouncingDiskError):
        bd.manifold(other, saddle(), arclength=1.0)
    with pytest.raises(ValueError, match="kind"):
        bd.manifold(MAP, saddle(), kind="both", arclength=1.0)  # type: ignore[arg-type]


def edge() -> bd.PeriodicOrbit:
    bouncing = bd.ImpactMap(axial_forcing=0.56, restitution=0.5)
    orbits = bd.periodic_orbits(bouncing, max_impacts=3, max_platform_periods=3)
    return next(
        orbit
        for orbit in orbits
        if orbit.period == orbit.platform_periods == 3 and orbit.multipliers.real.min() > 0.0
    )


def test_a_crisis_lies_where_the_attractor_of_fig_6_is_lost() -> None:
    found = bd.crisis(restitution=0.5, axial_forcing=(0.559, 0.562), impacts=400_000)
    low, high = found.bracket
    assert low < 0.56075 < high and low < found.axial_forcing < high and found.is_boundary_crisis
    assert abs(found.axial_forcing - 0.5607507) < found.forcing_error < 1e-3
    assert found.restitution == 0.5 and found.side is not None and found.share is not None
    assert found.no_tangency is None and found.curvature is not None
    assert found.inside is not None and found.touched is not None and found.touched.period == 3
    assert found.life_exponent is not None and 0.5 < found.life_exponent < 1.5
    assert found.impact_phase is not None and found.axial_impact_velocity is not None
    assert len(found.impact_phase) == len(found.axial_impact_velocity) > 3
    lives = found.lives(beyond=[1e-5, 1e-4, 1e-3], orbits=60, impacts=50_000)
    assert (np.diff(lives.impacts) < 0.0).all() and (lives.orbits == 60).all()
    assert (lives.ended <= 60).all() and (lives.no_power_law is None) == np.isfinite(lives.exponent)
    none = found.lives(beyond=[1e-12], orbits=1, impacts=1)
    assert none.impacts.tolist() == [np.inf] and none.relative_error.tolist() == [np.inf]
    assert none.no_power_law is not None and np.isnan(none.exponent)
    with pytest.raises(bd.OutOfRangeError) as refused:
        found.lives(beyond=[0.0])
    assert refused.value.field == "beyond"


def test_no_crisis_says_why() -> None:
    with pytest.raises(bd.ComputationError) as failed:
        bd.crisis(edge(), restitution=0.5, axial_forcing=(0.559, 0.5600), impacts=20_000)
    assert failed.value.kind == "none-rests" and failed.value.details["samples"] == 64
    with pytest.raises(bd.ComputationError) as failed:
        bd.crisis(edge(), restitution=0.5, axial_forcing=(0.5615, 0.562), impacts=20_000)
    assert failed.value.kind == "rests-before"
    with pytest.raises(bd.OutOfRangeError) as refused:
        bd.crisis(edge(), restitution=0.5, axial_forcing=(0.562, 0.559))
    assert (refused.value.field, refused.value.value) == ("axial_forcing", 0.559)
