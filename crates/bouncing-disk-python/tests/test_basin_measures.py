"""Measures of basins, attractors over the forcing, traps and spins: that arguments and results go where they belong."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import bouncing_disk as bd
from good_calls import MAP, TOSS


def painted(labels: Any) -> bd.Basins:
    """Basins with these labels."""
    rows, columns = np.shape(labels)
    whole = bd.basins(MAP, phases=columns, speeds=rows, max_impacts=1)
    return dataclasses.replace(whole, labels=np.asarray(labels, dtype=np.uint8))


def test_the_entropy_of_four_boxes_is_that_by_hand() -> None:
    labels = np.full((4, 5), bd.ATTACHED)
    labels[:2, 1] = labels[3, 3] = labels[:, 4] = bd.FIRST_ORBIT
    entropy = bd.basin_entropy(painted(labels), box_side=2)
    assert (entropy.boxes, entropy.boundary_boxes, entropy.labels, entropy.box_side) == (4, 2, 2, 2)
    total = math.log(2.0) - (0.75 * math.log(0.75) + 0.25 * math.log(0.25))
    assert entropy.entropy == pytest.approx(total / 4.0, rel=1e-14)
    assert entropy.boundary_entropy == pytest.approx(total / 2.0, rel=1e-14)
    # An array that is laid out in another way is the same.
    turned = bd.basin_entropy(painted(labels.T), box_side=2)
    assert turned == bd.basin_entropy(painted(np.ascontiguousarray(labels.T)), box_side=2)
    one = bd.basin_entropy(painted(np.full((9, 9), bd.UNDECIDED)))
    assert (one.entropy, one.boundary_entropy, one.undecided_cells) == (0.0, None, 25)


def test_a_straight_boundary_has_dimension_one() -> None:
    labels = np.full((100, 120), bd.ATTACHED)
    labels[50:] = bd.FIRST_ORBIT
    scaling = bd.boundary_scaling(painted(labels))
    assert scaling.distance.tolist() == [1, 2, 4, 8] and scaling.cells == 84 * 104
    assert scaling.uncertain.tolist() == [2 * distance * 104 for distance in (1, 2, 4, 8)]
    assert scaling.share.tolist() == (scaling.uncertain / scaling.cells).tolist()
    assert scaling.fit == "power-law" and scaling.exponent_error < 1e-12
    assert scaling.exponent == pytest.approx(1.0) and scaling.dimension == pytest.approx(1.0)
    assert scaling.slopes == pytest.approx((1.0, 1.0))
    flat = bd.boundary_scaling(painted(np.full((30, 30), bd.ATTACHED)), distances=[1, 2])
    assert flat.fit == "too-few" and math.isnan(flat.dimension) and flat.uncertain.tolist() == [0, 0]
    noise = np.random.default_rng(1).integers(1, 3, (60, 60))
    crowded = bd.boundary_scaling(painted(noise), distances=[1, 2, 4])
    assert crowded.fit in ("power-law", "no-power-law")
    calls: list[tuple[int, int]] = []
    bd.boundary_scaling(painted(labels), progress=lambda done, total: calls.append((done, total)))
    assert calls[-1] == (4 * 84, 4 * 84)


def test_what_is_no_grid_of_basins_is_refused() -> None:
    small = painted(np.full((7, 5), bd.ATTACHED))
    cases: list[tuple[Callable[[], Any], str, float]] = [
        (lambda: bd.basin_entropy(small, box_side=6), "box_side", 6.0),
        (lambda: bd.basin_entropy(small, box_side=1), "box_side", 1.0),
        (lambda: bd.boundary_scaling(small, distances=[1, 3]), "distances", 3.0),
        (lambda: bd.boundary_scaling(small, distances=[2, 1]), "distances", 1.0),
        (lambda: bd.basin_entropy(painted(np.full((5, 5), 255))), "basins", 255.0),
    ]
    for call, field, value in cases:
        with pytest.raises(bd.OutOfRangeError) as refused:
            call()
        assert (refused.value.field, refused.value.value) == (field, value)
    for wrong in (None, np.zeros((5, 5), dtype=np.uint8), MAP):
        with pytest.raises(TypeError, match="basins"):
            bd.basin_entropy(wrong)  # type: ignore[arg-type]


def test_attractors_are_followed_over_the_forcing() -> None:
    search: dict[str, Any] = {"starts": 200, "impacts": 1000}
    whole = bd.basin_fractions_over(restitution=0.5, axial_forcing=[0.32, 0.36, 0.4], **search)
    assert (whole.restitution, whole.axial_forcing.tolist(), len(whole)) == (0.5, [0.32, 0.36, 0.4], 2)
    assert whole.appears.tolist() == [0, 1] and whole.vanishes.tolist() == [2, 2]
    assert whole.share.shape == whole.share_low.shape == whole.share_high.shape == whole.moved.shape == (2, 3)
    assert np.isnan(whole.share[1, 0]) and whole.share[0, 0] == 1.0
    there = np.isfinite(whole.share)
    assert (whole.share_low <= whole.share)[there].all() and (whole.share <= whole.share_high)[there].all()
    assert np.isnan(whole.moved[0]).all() and np.isnan(whole.moved[1, :2]).all() and 0.0 < whole.moved[1, 2] < 0.3
    for place, (attractors, followed) in enumerate(zip(whole.attractors, whole.followed, strict=True)):
        assert attractors == bd.attractors(
            bd.ImpactMap(axial_forcing=whole.axial_forcing[place], restitution=0.5), **search
        )
        for attractor, number in zip(attractors.all, followed, strict=True):
            assert whole.share[number, place] == attractor.share
    begun = bd.basin_fractions_over(restitution=0.5, axial_forcing=[0.32], **search)
    assert bd.BasinFractions.from_json(begun.to_json()).extended(axial_forcing=[0.36, 0.4], **search) == whole
    assert repr(begun) == "<BasinFractions of 1 attractor over 1 forcing>"
    with pytest.raises(bd.OutOfRangeError) as refused:
        bd.basin_fractions_over(restitution=0.5, axial_forcing=[0.3], reach=-1.0)
    assert (refused.value.field, refused.value.value) == ("reach", -1.0)


def test_a_motor_whose_flight_lands_softly_is_trapped() -> None:
    motor = bd.Motor.paper_70_khz()
    soft = motor.preload_acceleration * motor.system.axial_forcing / 12.51
    traps = bd.low_period_traps(motor, preload_accelerations=soft * np.array([0.97, 1.0, 1.03]))
    assert traps.is_trap.tolist() == [False, True, False]
    assert traps.preload_acceleration.tolist() == (soft * np.array([0.97, 1.0, 1.03])).tolist()
    assert traps.axial_forcing[1] == pytest.approx(12.51)
    assert (traps.long_flights[1], traps.relaunches[1]) == (1, 64) and traps.returns[1] > 32
    assert traps.mean_platform_periods[1] == pytest.approx(traps.platform_periods[1], rel=0.05)
    assert (np.isnan(traps.mean_platform_periods) == (traps.impacts == 0)).all()
    trapped = bd.nearest_trap(motor.replace(preload_acceleration=soft))
    assert trapped is not None and trapped.relative_distance == 0.0
    assert trapped.forcing_from_to[0] < 12.51 < trapped.forcing_from_to[1]
    assert (trapped.long_flights, trapped.platform_periods) == (1, traps.platform_periods[1])
    beside = bd.nearest_trap(motor.replace(preload_acceleration=0.99 * soft))
    assert beside is not None and 0.0 <= beside.relative_distance < 0.02
    assert bd.low_period_traps(
        motor, preload_accelerations=[beside.preload_acceleration]
    ).is_trap.tolist() == [True]
    assert bd.nearest_trap(motor.replace(amplitude=1e-13)) is None
    with pytest.raises(bd.OutOfRangeError) as refused:
        bd.low_period_traps(motor, preload_accelerations=[9.8, -1.0])
    assert (refused.value.field, refused.value.value) == ("preload_accelerations", -1.0)


def test_the_spin_on_an_orbit_is_in_si() -> None:
    system = TOSS.replace(angular_frequency=8.5)
    (saddle, *_) = bd.periodic_orbits(bd.ImpactMap.of_system(system), max_impacts=1, max_platform_periods=1)
    steady = bd.rotary_response(system, saddle)
    assert (steady.outcome, steady.multiplier, steady.sliding.tolist()) == ("steady", 0.0, [0])
    # The disk sticks at every impact, so that it turns with the platform there.
    platform = system.peak_angular_speed * math.cos(saddle.impact_phase[0] + system.phase_lag)
    assert steady.angular_speed[0] == pytest.approx(platform, rel=1e-9)
    assert steady.mean_angular_speed == pytest.approx(platform, rel=1e-9)
    assert steady.slip[0] == pytest.approx(0.0, abs=1e-9) and steady.stick_margin > 0.0
    assert math.isnan(steady.limit) and math.isnan(steady.change)
    loaded = system.replace(friction=0.0, load_acceleration=2.0)
    runaway = bd.rotary_response(loaded, saddle)
    assert runaway.outcome == "runaway" and math.isnan(runaway.multiplier) and len(runaway.slip) == 0
    assert runaway.change == pytest.approx(-2.0 * system.period)
    kept = bd.rotary_response(system.replace(friction=0.0), saddle)
    assert (kept.outcome, kept.multiplier) == ("kept", 1.0) and math.isnan(kept.limit)
    with pytest.raises(bd.InvalidError) as refused:
        bd.rotary_response(TOSS, saddle)
    assert refused.value.kind == "not-an-orbit"
