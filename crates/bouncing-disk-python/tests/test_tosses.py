"""Tosses, trajectories and attractors: that arguments and results go where they belong."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import bouncing_disk as bd

TOSS = bd.System.pizza_toss()


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
    wrong: list[dict[str, Any]] = [
        {"gap": -1.0},
        {"relative_velocity": -1.0},
        {"phase": np.nan},
        {"angular_speed": np.inf},
    ]
    for start in wrong:
        with pytest.raises(bd.OutOfRangeError):
            bd.simulate(TOSS, **start)


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


def test_a_toss_that_repeats_is_told_by_its_collisions() -> None:
    bouncing = TOSS.replace(amplitude=0.45 * np.pi * 9.8 / 15.0**2)
    # Thrown next to the orbit.
    orbit = bd.multi_toss(bouncing, phase=0.74, relative_velocity=0.5 * 4.2 * 9.8 / 15.0)
    expected = bd.ImpactMap.of_system(bouncing).period_one()
    assert (
        expected is not None and orbit.kind == "periodic" and (orbit.period, orbit.platform_periods) == (1, 1)
    )
    assert orbit.impact_phase == pytest.approx([expected[0]])
    assert orbit.axial_impact_velocity == pytest.approx([expected[1] * 9.8 / 15.0])
    assert np.abs(orbit.multipliers[0]) == pytest.approx(0.5)
    resting = bd.multi_toss(TOSS.replace(amplitude=0.01))
    assert resting.kind == "at-rest" and resting.mean_angular_speed is None and len(resting.time) == 0


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
    with pytest.raises(bd.InvalidError, match="1 of 1 is not a doubling"):
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
