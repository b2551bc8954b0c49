"""Drives that are not a sine."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import bouncing_disk as bd

BOUNCING = bd.ImpactMap(axial_forcing=0.36, restitution=0.5)


def diagram(drive: bd.Drive | None, **start: float) -> bd.OrbitDiagram:
    return bd.orbit_diagram(
        axial_forcing=[0.36, 0.4], restitution=0.5, impact_phase=0.1, normalised_speed=1.3, recorded=8, drive=drive
    )


def test_a_sine_by_another_name_is_the_sine() -> None:
    sine, sum_of_one = diagram(None), diagram(bd.Drive.fourier([(1.0, 0.0)]))
    assert np.allclose(sine.impact_phase, sum_of_one.impact_phase, rtol=0.0, atol=1e-9)
    assert diagram(bd.Drive()) == sine


def test_orbits_and_basins_of_parabolas_by_their_pieces() -> None:
    pieces = bd.Drive.pieces([(0.5, (0.0, 8.0, -16.0, 0.0)), (0.5, (0.0, -8.0, 16.0, 0.0))])
    for drive in [bd.Drive.parabolas(), pieces]:
        own = BOUNCING.replace(drive=drive)
        found = bd.periodic_orbits(own, max_impacts=1, max_platform_periods=1, phases=20, speeds=20)
        known = [orbit for orbit in found if orbit.is_stable]
        basins = bd.basins(own, phases=20, speeds=10, known_orbits=[(orbit, 1e-3) for orbit in known])
        assert len(found) == 2 and len(known) == 1 and 0.0 < basins.share(bd.FIRST_ORBIT) < 1.0
        assert bd.basins(own, phases=20, speeds=10, known_orbits=known).share(bd.FIRST_ORBIT) > 0.0


OTHERS = [
    BOUNCING.replace(drive=bd.Drive.parabolas()),
    BOUNCING.replace(contact_periods=0.1),
    BOUNCING.replace(drive={"height": {"fourier": [[1.0, 0.0], [0.1, 0.3]]}}, contact_periods=0.05),
]


@pytest.mark.parametrize("own", OTHERS, ids=repr)
def test_a_map_steps_as_its_orbits_do(own: bd.ImpactMap) -> None:
    diagram = bd.orbit_diagram(
        axial_forcing=0.36, restitution=0.5, impact_phase=0.1, normalised_speed=1.3, transient=0, recorded=9,
        drive=own.drive, contact_periods=own.contact_periods,
    )  # fmt: skip
    impacts = list(zip(diagram.impact_phase.tolist(), diagram.axial_impact_velocity.tolist(), strict=True))

    def step(phase: float, velocity: float) -> tuple[float, float]:
        return own.step(impact_phase=phase, axial_impact_velocity=velocity)

    assert [step(*impact) for impact in impacts[:-1]] == impacts[1:]
    phase, velocity = impacts[0]
    assert own.iterate(impact_phase=phase, axial_impact_velocity=velocity, impacts=8) == impacts[8]
    half = 5e-7
    by_phase = np.subtract(step(phase + half, velocity), step(phase - half, velocity)) / (2.0 * half)
    by_velocity = np.subtract(step(phase, velocity + half), step(phase, velocity - half)) / (2.0 * half)
    derivative = own.derivative(impact_phase=phase, axial_impact_velocity=velocity)
    assert derivative == pytest.approx(np.stack([by_phase, by_velocity], axis=1), rel=1e-6, abs=1e-6)
    settled = own.settled_orbit(impact_phase=0.1, normalised_speed=1.3)
    assert settled is not None and settled.is_stable and settled.period == 1
    assert (own.normalised_speed_bound > settled.normalised_speed[0]) == (own.contact_periods is None)
    found = bd.periodic_orbits(own, max_impacts=1, max_platform_periods=1, phases=20, speeds=20)
    assert min(abs(orbit.impact_phase[0] - settled.impact_phase[0]) for orbit in found) < 1e-11


def test_a_contact_that_takes_time_moves_the_orbit() -> None:
    orbits = {
        time: bd.periodic_orbits(
            bd.ImpactMap(axial_forcing=0.45, restitution=0.5, contact_periods=time),
            max_impacts=1,
            max_platform_periods=1,
            phases=20,
            speeds=20,
        )
        for time in (None, 1e-4, 0.2)
    }
    phases = {time: [orbit.impact_phase[0] for orbit in found if orbit.is_stable] for time, found in orbits.items()}
    assert phases[1e-4] == pytest.approx(phases[None], abs=1e-2) and abs(phases[0.2][0] - phases[None][0]) > 0.1
    with pytest.raises(ValueError, match="contact_periods = 0"):
        bd.orbit_diagram(
            axial_forcing=0.4, restitution=0.5, impact_phase=0.0, normalised_speed=1.0, contact_periods=0.0
        )


@pytest.mark.parametrize("shift", [1e-9, 0.5 * np.pi, np.pi, 4.0, 2.0 * np.pi - 1e-9])
def test_a_toss_starts_at_the_lowest_point_whenever_the_recording_begins(shift: float) -> None:
    toss, known = bd.System.pizza_toss(), bd.single_toss(bd.System.pizza_toss())
    own = bd.single_toss(toss, drive=bd.Drive.fourier([(1.0, shift)], [(1.0, shift)]))
    assert own.airborne_speed == pytest.approx(known.airborne_speed, rel=1e-9)
    assert own.speed_ratio == pytest.approx(known.speed_ratio, rel=1e-9)


def test_speed_ratios_are_to_the_largest_speed_of_the_drive() -> None:
    toss, drive = bd.System.pizza_toss(), bd.Drive.fourier([(1.0, 0.0)], [(2.0, 0.0)])
    own, peak = bd.single_toss(toss, drive=drive), 2.0 * toss.twist_amplitude * toss.angular_frequency
    assert own.speed_ratio == pytest.approx(own.airborne_speed / peak, rel=1e-12)


def test_tosses_and_motors_of_a_sum_of_one_sine_are_those_of_the_sine() -> None:
    drive = bd.Drive.fourier([(1.0, 0.0)], [(1.0, 0.0)])
    toss, motor = bd.System.pizza_toss(), bd.Motor.paper_70_khz()
    known, found = bd.single_toss(toss), bd.single_toss(toss, drive=drive)
    assert found.airborne_speed == pytest.approx(known.airborne_speed, rel=1e-12)
    curves = [bd.torque_speed_curve(motor, load_torques=[0.0], relative_error=0.1, drive=own) for own in (None, drive)]
    # Chaotic orbits: the means agree, not the impacts.
    apart = abs(curves[0].speed[0] - curves[1].speed[0])
    assert apart < 5.0 * (curves[0].speed_error[0] + curves[1].speed_error[0])
    runs = bd.ensemble(motor.system, members=3, duration=0.02, intervals=4, drive=drive)
    assert runs.speeds.shape == (4, 3) and bool((runs.speeds[-1] > 0.0).all())


def test_a_contact_time_changes_tosses_and_motors_and_a_tiny_one_nothing() -> None:
    toss, motor = bd.System.pizza_toss(), bd.Motor.paper_70_khz()
    for call in (
        lambda time: bd.single_toss(toss, contact_time=time).airborne_speed,
        lambda time: bd.torque_speed_curve(
            motor, load_torques=[0.0], relative_error=0.5, members=4, most_impacts=2_000, contact_time=time
        ).speed[0],
        lambda time: bd.ensemble(
            motor.system, members=2, duration=0.02, intervals=4, contact_time=time
        ).steady_speeds[0],
    ):
        assert call(1e-15) == call(None) != call(1e-5)
        with pytest.raises(ValueError, match=r"contact.time = 0"):
            call(0.0)


@pytest.mark.parametrize(
    ("make", "told"),
    [
        (lambda: bd.Drive("triangel"), "triangle"),
        (lambda: bd.Drive.fourier([(1.0, float("nan"))]), r"height.fourier\[0\]\[1\] = NaN"),
        (lambda: bd.Drive.pieces([]), "sum of the durations"),
        (lambda: bd.Drive.pieces([(1.0, (0.0, 1.0, 0.0, 0.0))]), "jumps by -1"),
        (lambda: bd.Drive.sampled([0.0, 1.0]), "samples = 2"),
        (lambda: bd.Drive.sawtooth(1.0), "rise = 1"),
        (lambda: bd.stall_load(bd.Motor.paper_70_khz(), contact_time=-1.0), "contact_time = -1"),
        (lambda: diagram(bd.Drive(start_phase=1.0)), "start_phase"),
        (lambda: BOUNCING.replace(drive=bd.Drive(start_phase=0.0)), "start_phase"),
        (lambda: BOUNCING.replace(drive={"height": "triangel"}), "triangle"),
        (lambda: BOUNCING.replace(drive={"angle": {"sampled": [0.0, 1.0]}}), "samples = 2"),
    ],
)
def test_bad_drives_are_refused_by_name(make: Callable[[], object], told: str) -> None:
    with pytest.raises(ValueError, match=told):
        make()


@pytest.mark.parametrize("kind", [bytes, bytearray, memoryview])
def test_bytes_are_no_samples(kind: Callable[[bytes], Any]) -> None:
    with pytest.raises(TypeError, match="height.sampled"):
        bd.Drive.sampled(kind(b"\0\1\2"))


@pytest.mark.parametrize("count", [16, 100, 1000])
@pytest.mark.parametrize("start", [0.0, 0.7, 1.5])
def test_a_first_sample_at_the_end_gives_a_warning(count: int, start: float) -> None:
    closed = np.sin(start + 2.0 * np.pi * np.arange(count + 1) / count)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        drive = bd.Drive.sampled(closed[:-1])
    with pytest.warns(UserWarning, match="the angle: the last sample seems to repeat the first"):
        bd.Drive.sampled(closed[:-1], closed)
    with pytest.warns(UserWarning, match="the height: the last sample seems to repeat the first"):
        longer = bd.Drive.sampled(closed)
    assert longer != drive


def test_a_warning_is_of_the_line_that_makes_the_drive() -> None:
    closed = [0.0, 1.0, 0.0, -1.0, 0.0]
    makers: list[Callable[[], bd.Drive]] = [
        lambda: bd.Drive({"sampled": closed}),
        lambda: bd.Drive.sampled(closed),
        lambda: bd.Drive.from_dict({"height": {"sampled": closed}}),
    ]
    for make in makers:
        with pytest.warns(UserWarning, match="the last sample") as told:
            make()
        assert [warning.filename for warning in told] == [__file__]


def test_noisy_samples_give_a_warning() -> None:
    with pytest.warns(UserWarning, match="smooth noisy samples"):
        bd.Drive.sampled(np.sin(2.0 * np.pi * np.arange(64) / 64) + 0.01 * (-1.0) ** np.arange(64))


def test_attractors_on_a_drive_have_basins_and_are_not_stored() -> None:
    bouncing = bd.ImpactMap(axial_forcing=0.45, restitution=0.5)
    own = bouncing.replace(drive=bd.Drive(height="parabolas"))
    found = bd.attractors(own, starts=256)
    assert [one.kind for one in found.all] == ["rest", "chaotic"]
    basins = found.basins(phases=20, speeds=10)
    assert found.impact_map == basins.impact_map == own and found.impact_map.drive == bd.Drive.parabolas()
    assert basins.share(bd.FIRST_ORBIT) > 0.1 and basins.meaning[2] == found.all[1].meaning
    with pytest.raises(TypeError, match="not stored"):
        found.to_json()
    sine = bd.attractors(bouncing, starts=256)
    assert sine != found
    soft = bd.attractors(bouncing.replace(contact_periods=0.05), starts=64)
    assert any(one.kind == "periodic" for one in soft.all)
