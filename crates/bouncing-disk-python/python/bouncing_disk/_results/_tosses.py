"""What tosses and trajectories give."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, NamedTuple

import numpy as np
import numpy.typing as npt

from bouncing_disk._results._base import BoolArray, ByteArray, FloatArray, IntArray, Result


class Energy(NamedTuple):
    """An energy balance per unit mass (J/kg).

    Attributes
    ----------
    normal_work, friction_work : float
        Work of the platform by normal forces and by friction.
    restitution_loss, friction_loss : float
        What impacts and friction take away.
    load_work : float
        Work done against the load.
    axial_kinetic_change, potential_change, rotary_kinetic_change : float
        Changes of the three energies of the disk.
    """

    normal_work: float
    friction_work: float
    restitution_loss: float
    friction_loss: float
    load_work: float
    axial_kinetic_change: float
    potential_change: float
    rotary_kinetic_change: float


class TossPerformance(NamedTuple):
    """What a single toss gives, in SI units.

    Attributes
    ----------
    airborne_speed : float
        Rotary speed of the disk in the air (rad/s).
    efficiency : float
        Rotary energy that the disk has gained over the energy that was put in; NaN where none was.
    speed_ratio : float or None
        Airborne speed over the largest rotary speed of the platform; None without twist.
    separation_phase : float
        Phase of the separation (rad).
    sliding_at_separation : bool
        Whether the disk slides as it leaves.
    launch_speed : float
        Vertical speed of the disk as it leaves (m/s).
    rotary_energy_gain : float
        Rotary kinetic energy gained (J/kg).
    energy : Energy
        The balance up to the separation.
    """

    airborne_speed: float
    efficiency: float
    speed_ratio: float | None
    separation_phase: float
    sliding_at_separation: bool
    launch_speed: float
    rotary_energy_gain: float
    energy: Energy


@dataclass(frozen=True, eq=False, repr=False)
class TossOrbit(Result):
    """What a motion has settled on, in SI units.

    Attributes
    ----------
    kind : str
        ``"periodic"``, ``"chattering"``, ``"chaotic"``, ``"undecided"`` or ``"at-rest"``.
    period, platform_periods : int
        Impacts and platform periods of one round of a periodic or chattering motion, else 0.
    long_flights : int
        Flights of a chattering round that last longer than half a period.
    multipliers : (3,) complex128 array
        Floquet multipliers of a periodic orbit: two of the vertical motion, one of the rotation; else NaN.
    lyapunov_exponent : float or None
        Growth per impact of a motion that does not repeat, where it was measured.
    mean_angular_speed : float or None
        Mean angular speed (rad/s); None at rest.
    rotation_repeats : bool or None
        Whether the angular speed repeats as well; None where nothing repeats.
    time, impact_phase : (m,) float64 array
        Instant (s) and phase (rad) of each collision: of one round, or all that were examined.
    axial_impact_velocity : (m,) float64 array
        Axial velocity of the disk relative to the platform just before (m/s), not positive.
    tangential_impact_velocity : (m,) float64 array
        Angular speed of the disk relative to the platform just before (rad/s).
    angular_speed, angle : (m,) float64 array
        Angular speed of the disk just before (rad/s), and the angle that it has turned (rad).
    capped : (m,) bool array
        Whether friction ended the slip within the impact.
    lyapunov_exponent_error : float or None
        Standard error of the exponent: scatter, drift and rounding.
    """

    kind: str
    period: int
    platform_periods: int
    long_flights: int
    multipliers: npt.NDArray[np.complex128]
    lyapunov_exponent: float | None
    mean_angular_speed: float | None
    rotation_repeats: bool | None
    time: FloatArray
    impact_phase: FloatArray
    axial_impact_velocity: FloatArray
    tangential_impact_velocity: FloatArray
    angular_speed: FloatArray
    angle: FloatArray
    capped: BoolArray
    lyapunov_exponent_error: float | None


@dataclass(frozen=True, eq=False, repr=False)
class TrajectorySamples(Result):
    """Disk and platform at many instants, in SI units; all arrays have the shape (n,).

    Attributes
    ----------
    time : float64 array
        Seconds from phase 0 of the first period.
    height, axial_velocity : float64 array
        Of the disk (m, m/s), above the platform's mean height.
    angle, angular_speed : float64 array
        Of the disk (rad, rad/s); the angle starts at the platform's own.
    platform_height, platform_axial_velocity, platform_angle, platform_angular_speed : float64 array
        Those of the platform.
    mode : uint8 array
        How the disk moves: a place in :attr:`MODES`.
    """

    MODES: ClassVar[tuple[str, ...]] = ("flight", "sticking", "sliding-forward", "sliding-backward")

    time: FloatArray
    height: FloatArray
    axial_velocity: FloatArray
    angle: FloatArray
    angular_speed: FloatArray
    platform_height: FloatArray
    platform_axial_velocity: FloatArray
    platform_angle: FloatArray
    platform_angular_speed: FloatArray
    mode: ByteArray


@dataclass(frozen=True, eq=False, repr=False)
class EventTable(Result):
    """The events of a motion, in SI units; all arrays have the shape (n,).

    Attributes
    ----------
    time, phase : float64 array
        Instant (s) and phase of the platform (rad).
    kind : uint8 array
        What happened: a place in :attr:`KINDS`.
    mode_before, mode_after : uint8 array
        How the disk moves: places in :attr:`TrajectorySamples.MODES`.
    height, angle : float64 array
        Of the disk (m, rad).
    axial_velocity_before, axial_velocity_after : float64 array
        Of the disk (m/s).
    angular_speed_before, angular_speed_after : float64 array
        Of the disk (rad/s).
    axial_impact_velocity, tangential_impact_velocity : float64 array
        Disk minus platform just before an impact (m/s, rad/s), else NaN.
    capped : bool array
        Whether friction ended the slip within an impact.
    summed_impacts : int64 array
        Impacts that an attachment has summed, else 0.
    error_bound : float64 array
        Bound on the error of an attachment's phase (rad), else NaN.
    """

    KINDS: ClassVar[tuple[str, ...]] = (
        "impact",
        "attachment",
        "separation",
        "stick-to-slip",
        "slip-to-stick",
        "slip-reversal",
    )

    time: FloatArray
    phase: FloatArray
    kind: ByteArray
    mode_before: ByteArray
    mode_after: ByteArray
    height: FloatArray
    axial_velocity_before: FloatArray
    axial_velocity_after: FloatArray
    angle: FloatArray
    angular_speed_before: FloatArray
    angular_speed_after: FloatArray
    axial_impact_velocity: FloatArray
    tangential_impact_velocity: FloatArray
    capped: BoolArray
    summed_impacts: IntArray
    error_bound: FloatArray

    def names(self) -> list[str]:
        """What happened, in words: those of :attr:`KINDS`."""
        return [self.KINDS[kind] for kind in self.kind]


@dataclass(frozen=True)
class TossDesign:
    """The best hand motion, and what it gives.

    Attributes
    ----------
    stroke, amplitude_angle, angular_frequency, phase_lag : float
        The hand motion (m, rad, rad/s, rad).
    amplitude_ratio : float
        The tangent of the amplitude angle.
    value : float
        The objective, over the range of friction: rad/s, a share, or turns.
    toss : TossPerformance
        The toss at the middle of the range of friction.
    flight_height : float
        How high the dough flies above the place where it leaves the hand (m).
    turns : float
        Turns until it is back there.
    grid_points : int
        Hand motions on the grid from which the optimum was found.
    best_on_grid : float
        The best of them.
    hidden_gain : float
        What the objective could be above the optimum at most.
    """

    stroke: float
    amplitude_angle: float
    angular_frequency: float
    phase_lag: float
    amplitude_ratio: float
    value: float
    toss: TossPerformance
    flight_height: float
    turns: float
    grid_points: int
    best_on_grid: float
    hidden_gain: float


@dataclass(frozen=True, eq=False, repr=False)
class RotaryResponse(Result):
    """What becomes of the spin of a disk on a periodic orbit of n impacts.

    Attributes
    ----------
    outcome : str
        ``"steady"``: from every spin the disk comes to the one below; ``"kept"``: the load is as large as
        friction, and every spin repeats itself for which all impacts slide in its direction; ``"runaway"``:
        the load exceeds friction, and no spin repeats itself.
    multiplier : float
        That of the spin around the orbit: 0 of a steady one, 1 of one that is kept, NaN of a runaway.
    angular_speed : (n,) float64 array
        A steady disk's angular speed just before each impact (rad/s); empty of all others, as are those
        below.
    slip : (n,) float64 array
        That speed less the platform's (rad/s).
    sliding : (n,) int64 array
        The slip that an impact leaves: 1 where the disk still turns faster, -1 where slower, 0 where the slip
        ends.
    stick_margin : float
        The largest margin (rad/s) by which friction ends a slip: a smaller disturbance of the spin is
        forgotten within one period of the orbit. NaN of all but a steady one, as is the next.
    mean_angular_speed : float
        Mean angular speed (rad/s).
    limit : float
        The end of the spins that are kept (rad/s): those below it for a positive load, above it for a
        negative one; NaN where every spin is, and of all others.
    change : float
        How much a runaway disk's angular speed changes in one period of the orbit in the end (rad/s), else
        NaN.
    """

    outcome: str
    multiplier: float
    angular_speed: FloatArray
    slip: FloatArray
    sliding: IntArray
    stick_margin: float
    mean_angular_speed: float
    limit: float
    change: float
