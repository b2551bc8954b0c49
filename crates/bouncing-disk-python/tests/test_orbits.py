"""Orbits, tosses, attractors, manifolds and crises: that arguments and results go where they belong."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable
from typing import Any

import bouncing_disk as bd
import numpy as np
import pytest

from good_calls import MAP, STARTS, TOSS, saddle_of


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


@pytest.mark.parametrize("kind", ["stable", "unstable"])
def test_a_manifold_has_pieces_on_branches(kind: Any) -> None:
    start = saddle_of()
    found = bd.manifold(MAP, start, kind=kind, arclength=4.0, chord=0.02, turn=0.05)
    assert found.kind == kind and (abs(found.multiplier) > 1.0) == (kind == "unstable")
    assert found.offsets[0] == 0 and found.offsets[-1] == len(found.impact_phase)
    pieces, branches = len(found.offsets) - 1, len(found.branch_impact)
    assert branches == 2 * start.period and len(found.piece_branch) == len(found.piece_end) == pieces
    assert set(found.piece_branch.tolist()) <= set(range(branches))
    assert found.branch_side.tolist() == [0, 1]
    assert (found.branch_arclength <= 4.0 + 0.02).all() and found.piece_start[0] == 0
    assert sum(len(found.of(piece)[0]) for piece in range(pieces)) == found.offsets[-1]


def test_orbits_of_another_motion_are_refused_by_name() -> None:
    own, other = (bd.ImpactMap(axial_forcing=forcing, restitution=0.8) for forcing in (0.2, 0.345))
    orbit = own.settled_orbit(impact_phase=1.0, normalised_speed=1.1)
    assert orbit is not None and orbit.period == 1
    known: Any = {"phases": 3, "speeds": 3, "known_orbits": [(orbit, 0.01)]}
    bd.basins(own, **known)
    calls: list[Callable[[], Any]] = [
        lambda: orbit.trapping_radius(other),
        lambda: bd.basins(other, **known),
        lambda: bd.basins(other, **{**known, "known_orbits": [orbit]}),
        lambda: bd.basins(own.replace(drive=bd.Drive.parabolas()), **known),
        lambda: bd.basins(own.replace(contact_periods=0.1), **known),
        lambda: bd.continued(other, orbit, parameter_range=(0.3, 0.4)),
        lambda: bd.manifold(other, saddle_of(own), arclength=1.0),
    ]
    for call in calls:
        with pytest.raises(bd.InvalidError) as refused:
            call()
        assert refused.value.kind == "not-an-orbit" and refused.value.details["impact"] == 0
        assert float(refused.value.details["distance"]) > 1e-3


def test_what_is_no_saddle_has_no_manifold() -> None:
    attracting = MAP.settled_orbit(impact_phase=1.2, normalised_speed=1.3)
    assert attracting is not None
    with pytest.raises(bd.OutOfRangeError) as refused:
        bd.manifold(MAP, attracting, arclength=1.0)
    assert refused.value.field == "orbit"
    other = bd.ImpactMap(axial_forcing=0.7, restitution=0.5)
    with pytest.raises(bd.BouncingDiskError):
        bd.manifold(other, saddle_of(), arclength=1.0)
    with pytest.raises(ValueError, match="kind"):
        bd.manifold(MAP, saddle_of(), kind="both", arclength=1.0)  # type: ignore[arg-type]


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


def test_bands_merge_below_the_crisis() -> None:
    found = bd.crisis(restitution=0.5, axial_forcing=(0.548, 0.552), event="band merging", impacts=200_000)
    assert found.kind == "band merging" and found.is_boundary_crisis is False
    assert abs(found.axial_forcing - 0.5500648590699) < 1e-12 and found.touched is not None and found.touched.period == 1
    with pytest.raises(bd.ComputationError, match="bands"):
        bd.crisis(restitution=0.5, axial_forcing=(0.46, 0.48), event="band merging", impacts=20_000)
    with pytest.raises(bd.OutOfRangeError):
        bd.crisis(restitution=0.5, axial_forcing=(0.46, 0.48), event="band merging", bands=17)


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


def painted(labels: Any) -> bd.Basins:
    """Basins with these labels."""
    rows, columns = np.shape(labels)
    whole = bd.basins(MAP, phases=columns, speeds=rows, max_impacts=1)
    return dataclasses.replace(whole, labels=np.asarray(labels, dtype=np.uint8))


def test_the_entropy_is_that_of_the_labels_of_a_grid() -> None:
    labels = np.full((4, 5), bd.ATTACHED)
    labels[:2, 1] = labels[3, 3] = labels[:, 4] = bd.FIRST_ORBIT
    entropy = bd.basin_entropy(painted(labels), box_side=2)
    assert (entropy.boxes, entropy.boundary_boxes, entropy.labels, entropy.box_side) == (4, 2, 2, 2)
    assert entropy.boundary_entropy == pytest.approx(2.0 * entropy.entropy, rel=1e-14)
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
    assert (*scaling.slopes, scaling.exponent, scaling.dimension) == pytest.approx((1.0,) * 4)
    flat = bd.boundary_scaling(painted(np.full((30, 30), bd.ATTACHED)), distances=[1, 2])
    assert flat.fit == "too-few" and math.isnan(flat.dimension) and flat.uncertain.tolist() == [0, 0]
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
    text = "BasinFractions(restitution=0.5, axial_forcing=[0.32, 0.36, 0.4], attractors=<3 Attractors>"
    assert repr(whole).startswith(text)
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


def test_a_trajectory_is_a_flight_above_the_platform() -> None:
    motion = bd.toss_trajectory(TOSS)
    toss = bd.single_toss(TOSS)
    events, samples = motion.events(), motion.samples(count=500)
    separation = events.names().index("separation")
    assert events.axial_velocity_after[separation] == toss.launch_speed
    assert events.angular_speed_after[separation] == toss.airborne_speed
    assert events.phase[separation] == toss.separation_phase
    assert samples.time[0] == motion.start_time and samples.time[-1] == pytest.approx(motion.end_time)
    flying = samples.mode == 0
    assert flying.any() and not flying.all()
    above = samples.height - samples.platform_height
    assert (above[flying][1:-1] > 0.0).all()
    assert np.abs(above[~flying]).max() < 1e-12
    fastest = np.abs(np.diff(samples.height) / np.diff(samples.time) - samples.axial_velocity[:-1]).max()
    assert fastest < 0.1
    assert (samples.angular_speed[flying][:-1] == toss.airborne_speed).all()


def test_the_energy_of_a_motion_is_balanced() -> None:
    energy = bd.simulate(TOSS, phase=4.7, events=500).energy
    into = energy.normal_work - energy.restitution_loss
    assert energy.axial_kinetic_change + energy.potential_change == pytest.approx(into, rel=1e-12)
    turned = energy.friction_work - energy.friction_loss - energy.load_work
    assert energy.rotary_kinetic_change == pytest.approx(turned, rel=1e-10)


def test_a_motion_starts_as_it_is_told() -> None:
    on = bd.simulate(TOSS, phase=4.7, events=3).samples(count=2)
    assert on.mode[0] in (1, 2, 3) and on.angular_speed[0] == pytest.approx(on.platform_angular_speed[0])
    still = bd.simulate(TOSS, phase=4.7, angular_speed=0.0, events=3).samples(count=2)
    assert still.angular_speed[0] == 0.0
    thrown = bd.simulate(TOSS, phase=1.0, relative_velocity=2.0, angular_speed=3.0, events=1).samples(count=2)
    assert thrown.mode[0] == 0 and thrown.angular_speed[0] == pytest.approx(3.0)
    assert thrown.axial_velocity[0] - thrown.platform_axial_velocity[0] == pytest.approx(2.0)
    dropped = bd.simulate(TOSS, phase=1.0, gap=0.5, events=1).samples(count=2)
    assert dropped.height[0] - dropped.platform_height[0] == pytest.approx(0.5)
    assert dropped.axial_velocity[0] == pytest.approx(dropped.platform_axial_velocity[0])
    wrong: dict[str, Any] = {"gap": -1.0, "relative_velocity": -1.0, "phase": np.nan, "angular_speed": np.inf}
    for name, value in wrong.items():
        with pytest.raises(bd.OutOfRangeError):
            bd.simulate(TOSS, **{name: value})


def test_a_motion_ends_as_it_is_told() -> None:
    assert len(bd.simulate(TOSS, phase=4.7, events=7)) == 7
    long = bd.simulate(TOSS, phase=4.7, duration=2.0, events=10**5)
    assert long.end_time - long.start_time >= 2.0
    assert long.events().time[-2] - long.start_time < 2.0
    # It rests and sticks for ever.
    assert len(bd.simulate(TOSS.replace(amplitude=0.0, twist_amplitude=0.0))) == 0
    for wrong in (0, -1, 10**6 + 1):
        with pytest.raises(bd.OutOfRangeError):
            bd.simulate(TOSS, events=wrong)
    for duration in (0.0, -1.0, np.nan, np.inf):
        with pytest.raises(bd.OutOfRangeError):
            bd.simulate(TOSS, duration=duration)
    with pytest.raises(bd.OutOfRangeError):
        bd.toss_trajectory(TOSS).samples(count=1)


def test_basins_of_attractors_have_their_labels() -> None:
    found = bd.attractors(bd.ImpactMap(axial_forcing=0.486, restitution=0.5))
    assert [attractor.kind for attractor in found.all] == ["rest", "periodic", "periodic"]
    assert [attractor.label for attractor in found.all] == [bd.ATTACHED, bd.FIRST_ORBIT, bd.FIRST_ORBIT + 1]
    shares = sum(attractor.share for attractor in found.all) + found.undecided
    assert shares == pytest.approx(1.0)
    basins = found.basins(phases=80, speeds=60)
    assert basins.labels.shape == (60, 80) and basins.labels.flags.c_contiguous
    assert basins.meaning == ("undecided", *(attractor.meaning for attractor in found.all))
    assert set(np.unique(basins.labels)) <= {0, 1, 2, 3}
    assert (basins.phase[0], basins.phase[-1]) == (0.5 / 80, 79.5 / 80)
    # Each cell is what becomes of its start.
    row, column = 17, 33
    start = {"impact_phase": 2.0 * np.pi * basins.phase[column], "normalised_speed": basins.speed[row]}
    verdict = bd.verdicts(axial_forcing=0.486, restitution=0.5, **start)
    label = basins.labels[row, column]
    expected = {1: verdict.rests[0] > 0}.get(
        int(label), verdict.names()[0] == "periodic" and verdict.rests[0] == 0
    )
    assert expected
    if label >= bd.FIRST_ORBIT:
        orbit = found.all[int(label) - 1].orbit
        assert orbit is not None and orbit.period == verdict.period[0]


def test_a_branch_is_continued_through_its_doubling() -> None:
    bouncing = bd.ImpactMap(axial_forcing=0.45, restitution=0.5)
    orbit = bouncing.settled_orbit(impact_phase=1.2, normalised_speed=1.3)
    assert orbit is not None
    branch = bd.continued(bouncing, orbit, parameter_range=(0.1, 0.6))
    assert branch.impact_phase.shape == (len(branch), 1)
    doubling = branch.bifurcations[0]
    first = bd.doubling_cascade(restitution=0.5, count=1).axial_forcing[0]
    assert doubling.parameter == pytest.approx(first, abs=1e-13)
    assert (branch.is_stable == (branch.values < doubling.parameter)).all()
    assert branch.orbit(0).impact_phase == pytest.approx(orbit.impact_phase, abs=1e-14)
    doubled = branch.switched(index=0, parameter_range=(0.1, 0.6))
    assert doubled.impact_phase.shape[1] == 2 and doubled.orbit(0).period == 2
    with pytest.raises(bd.OutOfRangeError):
        branch.orbit(len(branch))
    with pytest.raises(bd.InvalidError, match="the bifurcation is not a doubling"):
        branch.switched(index=1, parameter_range=(0.1, 0.6))


def test_a_trajectory_without_events_says_that_it_has_no_samples() -> None:
    still = bd.System.pizza_toss().replace(amplitude=0.0, twist_amplitude=0.0)
    resting = bd.simulate(still)
    assert len(resting) == 0 and resting.start_time == resting.end_time
    assert resting.events().names() == []
    with pytest.raises(bd.ComputationError, match="no events") as refused:
        resting.samples(count=10)
    assert refused.value.kind == "no-events"
    # Friction, 60.06 rad/s^2, does not hold the load: it slides for ever.
    loaded = still.replace(
        angular_frequency=100.0, contact_radius=0.1, gyration_radius=0.07, friction=0.3,
        preload_acceleration=9.81, load_acceleration=120.12,
    )  # fmt: skip
    sliding = bd.simulate(loaded, duration=1.0)
    assert len(sliding) == 0 and abs(sliding.end_time - 1.0) < 1e-12
    friction = 0.3 * 9.81 * 0.1 / 0.07**2
    assert abs(sliding.samples(count=3).angular_speed[-1] - (friction - 120.12)) < 1e-9
    assert sliding.energy.friction_loss > 0.0


def test_a_cascade_that_ends_has_the_doublings_before() -> None:
    found = bd.doubling_cascade(restitution=0.01, count=8)
    assert found.axial_forcing == pytest.approx([1.162039896, 1.243863813], abs=1e-9)
    assert found.ended_by is not None and "the disk hits the platform after" in found.ended_by
    assert bd.doubling_cascade(restitution=0.01, count=2).ended_by is None
    with pytest.raises(bd.OutOfRangeError, match="count"):
        bd.doubling_cascade(restitution=0.5, count=0)


def test_branches_and_doublings_on_a_drive_and_with_a_compliant_contact() -> None:
    parabolas = bd.Drive(height="parabolas")
    bouncing = bd.ImpactMap(axial_forcing=0.35, restitution=0.5, drive=parabolas)
    orbits = bd.periodic_orbits(bouncing, max_impacts=1, max_platform_periods=1)
    orbit = next(orbit for orbit in orbits if orbit.is_stable)
    again = bouncing.refine(
        impact_phase=orbit.impact_phase + 1e-3, axial_impact_velocity=orbit.axial_impact_velocity
    )
    assert again.impact_phase == pytest.approx(orbit.impact_phase, abs=1e-13)
    assert 0 < orbit.trapping_radius(bouncing) < 1
    up = bd.continued(bouncing, orbit, parameter_range=(0.2, 0.5))
    # By hand: the doubling, and the corner at which the branch turns.
    by_hand = np.pi * 1.25 / 9
    assert up.parameter == "axial_forcing" and up.bifurcations[0].parameter == pytest.approx(by_hand, abs=1e-13)
    down = bd.continued(bouncing, orbit, parameter_range=(0.2, 0.5), rising=False)
    corner = down.bifurcations[0]
    assert (corner.kind, corner.impact) == ("border-collision", 0)
    assert corner.parameter == pytest.approx(np.pi / 12, abs=1e-12)
    with pytest.raises(TypeError, match="not stored"):
        up.to_json()
    first = bd.doubling_cascade(restitution=0.5, count=1, drive=parabolas)
    assert first.axial_forcing[0] == pytest.approx(by_hand, abs=first.forcing_error[0])

    # A member of two families: over the second harmonic, and over the contact time.
    bouncing = bouncing.replace(drive={"height": {"fourier": [[1.0, 0.0], [0.1, 0.3]]}}, contact_periods=0.05)
    orbits = bd.periodic_orbits(bouncing, max_impacts=1, max_platform_periods=1)
    orbit = next(orbit for orbit in orbits if orbit.is_stable and orbit.normalised_speed[0] > 1)
    for parameter, now in [("fourier[1][0]", 0.1), ("fourier[1][1]", 0.3), ("contact_periods", 0.05), ("restitution", 0.5)]:
        branch = bd.continued(bouncing, orbit, parameter=parameter, parameter_range=(now - 0.04, now + 0.04))
        assert branch.values[0] == now and branch.parameter == parameter and len(branch) > 1
        assert branch.orbit(0).period == 1
    for parameter in ["fourier[2][0]", "fourier[1]", "sawtooth", "", "fourier[1", "fourier[x][0]"]:
        with pytest.raises(bd.InvalidError) as refused:
            bd.continued(bouncing, orbit, parameter=parameter, parameter_range=(0, 1))
        assert refused.value.kind == "no-such-number"


def test_curves_are_those_by_hand_and_name_their_points() -> None:
    bouncing = bd.ImpactMap(axial_forcing=0.45, restitution=0.5)
    orbit = bouncing.settled_orbit(impact_phase=1.2, normalised_speed=1.3)
    assert orbit is not None
    ranges: dict[str, Any] = {"parameter_range": (0.01, 0.9), "branch_range": (0.01, 2.0)}
    down = bd.continued(bouncing, orbit, parameter_range=(0.1, 0.6), rising=False)
    fold = [curve for curve in bd.curves(bouncing, down, **ranges) if curve.kind == "fold"]
    assert [curve.bifurcation for curve in fold] == [0, 0]
    for curve in fold:
        forcing, restitution = curve.values.T
        off = np.abs(forcing - (1.0 - restitution) / (1.0 + restitution))
        assert np.all(off <= curve.errors[:, 0]) and curve.multipliers.shape == (len(forcing), 2)
    # Towards restitution 0 the flight of the fold grazes the platform.
    assert [found.kind for curve in fold for found in curve.special] == ["grazing-fold"]
    assert fold[1].special[0].flight == 0 and fold[1].end == "flight 0 touches the platform"
    with pytest.raises(bd.InvalidError, match="a parameter other than that of the branch"):
        bd.curves(bouncing, down, parameter="axial_forcing", **ranges)


def test_curves_on_a_drive_are_those_by_hand() -> None:
    parabolas = bd.ImpactMap(axial_forcing=0.35, restitution=0.5, drive=bd.Drive.parabolas())
    orbits = bd.periodic_orbits(parabolas, max_impacts=1, max_platform_periods=1)
    orbit = next(orbit for orbit in orbits if orbit.is_stable)
    branch = bd.continued(parabolas, orbit, parameter_range=(0.2, 0.5))
    found = bd.curves(parabolas, branch, parameter_range=(0.3, 0.7), branch_range=(0.1, 2.0))
    assert {curve.kind for curve in found} == {"doubling"}
    for curve in found:
        forcing, restitution = curve.values.T
        by_hand = 0.25 * np.pi * (1.0 + restitution**2) / (1.0 + restitution) ** 2
        assert np.all(np.abs(forcing - by_hand) < 1e-12)
