"""The same bits as in Rust: the digests of the crate ``bouncing-disk``, and the same calls from here."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import bouncing_disk as bd
from good_calls import MAP, MOTOR, STARTS, TOSS

DIGESTS = json.loads((Path(__file__).parent / "digests.json").read_text())


class Digest:
    """The 64-bit FNV-1a hash of bytes and doubles, as in the Rust library."""

    def __init__(self) -> None:
        self.value = 0xCBF2_9CE4_8422_2325

    def bytes(self, data: bytes) -> None:
        for byte in data:
            self.value = ((self.value ^ byte) * 0x0100_0000_01B3) & 0xFFFF_FFFF_FFFF_FFFF

    def numbers(self, *numbers: float) -> None:
        self.bytes(np.array(numbers, dtype="<f8").tobytes())

    def impacts(self, found: bd.OrbitDiagram | bd.Manifold) -> None:
        self.numbers(*np.stack([found.impact_phase, found.axial_impact_velocity], axis=1).ravel())

    def __str__(self) -> str:
        return f"{self.value:016x}"


def forcings(count: int, low: float, step: float) -> list[float]:
    return [low + index * step for index in range(count)]


def diagram(digest: Digest, chatter: bd.ChatterCut | None = None) -> None:
    found = bd.orbit_diagram(
        axial_forcing=forcings(200, 0.3, 0.002), transient=1000, recorded=50, chatter=chatter, **STARTS
    )
    digest.impacts(found)


def basins(digest: Digest) -> None:
    orbit = MAP.settled_orbit(impact_phase=1.2, normalised_speed=1.3)
    assert orbit is not None
    radius = orbit.trapping_radius(MAP)
    found = bd.basins(MAP, phases=200, speeds=150, speed_range=(0.0, 3.0), known_orbits=[orbit])
    assert found == bd.basins(MAP, phases=200, speeds=150, known_orbits=[(orbit, radius)])
    digest.numbers(radius)
    digest.bytes(found.labels.tobytes())


def verdicts(digest: Digest) -> None:
    found = bd.verdicts(axial_forcing=forcings(100, 0.2, 0.005), impacts=20_000, **STARTS)
    for k, kind in enumerate(found.kind):
        digest.bytes(bytes([kind]))
        if kind == 0:
            digest.numbers(found.period[k], found.platform_periods[k])
        elif kind == 1:
            digest.numbers(found.exponent[k], found.standard_error[k])
        elif kind in (2, 3):
            digest.numbers(found.after[k])
            if not np.isnan(found.exponent[k]):
                digest.numbers(found.exponent[k])


def tosses(digest: Digest) -> None:
    for lag in forcings(100, -1.5, 0.03):
        system = TOSS.replace(phase_lag=lag)
        for spin in ("absolute-rest", "with-hand"):
            toss = bd.single_toss(system, initial_spin=spin)
            digest.numbers(toss.airborne_speed, toss.efficiency, toss.launch_speed, toss.energy.friction_loss)


def motors(digest: Digest) -> None:
    runs = bd.ensemble(bd.System.motor(), members=16, duration=0.5, intervals=50)
    for member in range(16):
        digest.numbers(*runs.times[:, member], *runs.speeds[:, member])
    digest.numbers(runs.steady_speed.mean, runs.time_constant.mean, runs.stall_acceleration.standard_error)


def spectra(digest: Digest) -> None:
    found = bd.lyapunov_spectra(axial_forcing=forcings(60, 0.2, 0.01), impacts=5000, **STARTS)
    for k, name in enumerate(found.names()):
        if name == "exponents":
            digest.numbers(found.largest[k], found.standard_error[k], found.second[k], found.exact_sum[k])
        else:
            digest.numbers(found.impacts[k] if name == "rested" else found.phase[k])


def manifolds(digest: Digest) -> None:
    bouncing = bd.ImpactMap(axial_forcing=0.34, restitution=0.5)
    for orbit in bd.periodic_orbits(bouncing, max_impacts=1, max_platform_periods=1):
        if abs(orbit.multipliers[0]) <= 1.0:
            continue
        for kind in ("unstable", "stable"):
            found = bd.manifold(bouncing, orbit, kind=kind, arclength=10.0, max_points=20_000)
            digest.numbers(found.multiplier)
            digest.impacts(found)


def crisis(digest: Digest) -> None:
    found = bd.crisis(restitution=0.5, axial_forcing=(0.559, 0.562), impacts=400_000)
    assert found.share is not None and found.curvature is not None
    digest.numbers(found.axial_forcing, found.forcing_error, found.share, found.curvature)
    digest.numbers(*found.lives(beyond=[1e-4, 1e-3], orbits=50, impacts=20_000).impacts)


def motor_sweep(digest: Digest) -> None:
    axes = {"friction": [0.1, 0.2], "amplitude": [1e-8, 1.1e-8]}
    digest.numbers(*bd.motor_map(MOTOR, over=axes, relative_error=0.05).speed.ravel())


def local_sensitivities(digest: Digest) -> None:
    digest.numbers(*bd.local_sensitivities(MOTOR, parameters=["friction"], relative_error=0.05).derivative)


def stators(digest: Digest) -> None:
    modes: dict[str, float | str] = {"mass": 0.05, "quality": 300.0}
    twisting = modes | {"kind": "axial_twist", "twist_per_height": 700.0}
    two = modes | {"kind": "axial_and_torsional", "inertia": 1e-6, "torsional_quality": 100.0, "resonance": 70.1e3}
    for stator, speed, contact_time in [(twisting, None, None), (two, 30.0, 1e-5)]:
        motor = bd.Motor.paper_70_khz().replace(stator=stator, amplitude=1e-7, peak_angular_speed=speed)
        loose: dict[str, Any] = {"relative_error": 0.3, "members": 4, "most_impacts": 2_000}
        loads = [0.0, 1e-5]
        found = bd.torque_speed_curve(motor, load_torques=loads, contact_time=contact_time, **loose)
        digest.numbers(*found.speed, *found.stator_amplitude, *found.electrical_efficiency)


CALLS: dict[str, Callable[[Digest], None]] = {
    "diagram": diagram,
    "diagram with the paper's cut": lambda digest: diagram(digest, bd.ChatterCut.paper()),
    "basins": basins,
    "verdicts": verdicts,
    "tosses": tosses,
    "motors": motors,
    "spectra": spectra,
    "manifolds": manifolds,
    "crisis": crisis,
    "motor sweep": motor_sweep,
    "local sensitivities": local_sensitivities,
    "stators": stators,
}


@pytest.mark.parametrize("name", CALLS)
def test_python_and_rust_get_the_same_bits(name: str) -> None:
    digest = Digest()
    CALLS[name](digest)
    assert str(digest) == DIGESTS[name]


def test_every_digest_is_compared() -> None:
    assert CALLS.keys() == DIGESTS.keys()
    digest = Digest()
    digest.bytes(b"foobar")
    assert str(digest) == "85944171f73967e8"
