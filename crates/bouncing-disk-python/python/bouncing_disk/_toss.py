"""Tosses and trajectories: the motion of a disk in SI units."""

# mypy: disable-error-code="no-any-return"
from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Literal, NamedTuple

from bouncing_disk import _native as native
from bouncing_disk._base import *
from bouncing_disk._orbits import PeriodicOrbit
from bouncing_disk._system import ChatterCut, Drive, System

__all__ = [
    "Energy",
    "EventTable",
    "RotaryResponse",
    "TossPerformance",
    "Trajectory",
    "TrajectorySamples",
    "rotary_response",
    "simulate",
    "single_toss",
    "toss_trajectory",
]


class Energy(NamedTuple):
    """An energy balance per unit mass (J/kg).

    Attributes:
        normal_work, friction_work: work of the platform by normal forces and by friction.
        restitution_loss, friction_loss: losses in impacts and by friction.
        load_work: work done against the load.
        axial_kinetic_change, potential_change, rotary_kinetic_change: changes of the three energies of the
            disk.
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
    """The results of a single toss, in SI units.

    Attributes:
        airborne_speed: rotary speed of the disk in the air (rad/s).
        efficiency: rotary energy gained by the disk over the energy put in; NaN if none was put in.
        speed_ratio: airborne speed over the largest rotary speed of the platform; None without twist.
        separation_phase: phase of the separation (rad).
        sliding_at_separation: whether the disk slides as it leaves.
        launch_speed: vertical speed of the disk as it leaves (m/s).
        rotary_energy_gain: rotary kinetic energy gained (J/kg).
        energy: the balance up to the separation.
    """

    airborne_speed: float
    efficiency: float
    speed_ratio: float | None
    separation_phase: float
    sliding_at_separation: bool
    launch_speed: float
    rotary_energy_gain: float
    energy: Energy


def single_toss(
    system: System,
    *,
    initial_spin: Literal["absolute-rest", "with-hand"] = "absolute-rest",
    drive: Drive | None = None,
    contact_time: Float | None = None,
) -> TossPerformance:
    """The toss of a disk from its platform, up to the separation.

    It starts at the lowest point of the platform, for any motion. A disk that starts on a kink moves with the
    platform after the kink.

    Args:
        initial_spin: whether the disk starts at absolute rest or turns with the platform.
        drive: motion of the platform; ``None`` for the sine.
        contact_time: duration of an impact (s), positive; ``None`` for rigid impacts.

    >>> import bouncing_disk as bd
    >>> toss = bd.single_toss(bd.System.pizza_toss())
    >>> round(toss.airborne_speed)  # rad/s, as the paper prints for the toss of Table I
    14
    """
    return native.single_toss(system, initial_spin, drive, contact_time)


@dataclass(frozen=True, eq=False, repr=False)
class TrajectorySamples(Result):
    """Disk and platform at many instants, in SI units; all arrays have the shape (n,).

    Attributes:
        time: seconds from phase 0 of the first period.
        height, axial_velocity: of the disk (m, m/s), above the platform's mean height.
        angle, angular_speed: of the disk (rad, rad/s); the angle starts at the platform's own.
        platform_height, platform_axial_velocity, platform_angle, platform_angular_speed: the same for the
            platform.
        mode: mode of the disk, an index into :attr:`MODES`.
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

    Attributes:
        time, phase: instant (s) and phase of the platform (rad).
        kind: the kind of event, an index into :attr:`KINDS`.
        mode_before, mode_after: mode of the disk, indices into :attr:`TrajectorySamples.MODES`.
        height, angle: of the disk (m, rad).
        axial_velocity_before, axial_velocity_after: of the disk (m/s).
        angular_speed_before, angular_speed_after: of the disk (rad/s).
        axial_impact_velocity, tangential_impact_velocity: disk minus platform just before an impact (m/s,
            rad/s), else NaN.
        capped: whether friction ended the slip within an impact.
        summed_impacts: impacts summed by an attachment, else 0.
        error_bound: bound on the error of an attachment's phase (rad), else NaN.
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
        """The kind of each event, in the words of :attr:`KINDS`."""
        return [self.KINDS[kind] for kind in self.kind]


@dataclass(frozen=True, eq=False, repr=False)
class Trajectory(Stored):
    """The motion of a disk up to an event, in SI units.

    Made by :func:`simulate` and :func:`toss_trajectory`.

    Attributes:
        system: the system.
        start_time: time of the start (s), from phase 0 of the first period.
        end_time: time of the last event (s); if no event follows, the requested end of the motion.
        event_count: number of events.
        energy: the energy balance of the whole motion, per unit mass.
    """

    system: System
    start_time: float
    end_time: float
    event_count: int
    energy: Energy

    def samples(self, *, count: Int) -> TrajectorySamples:
        """Disk and platform at equidistant instants from the start to the end.

        Args:
            count: number of instants, in [2, 2^24].

        Raises:
            ComputationError: The motion has no events and was given no duration.

        >>> import bouncing_disk as bd
        >>> samples = bd.toss_trajectory(bd.System.pizza_toss()).samples(count=200)
        >>> round(float(samples.height.max()), 2)  # m
        0.54
        """
        return native.samples(locals())

    def events(self) -> EventTable:
        """The events.

        >>> import bouncing_disk as bd
        >>> bd.toss_trajectory(bd.System.pizza_toss()).events().names()
        ['stick-to-slip', 'separation', 'impact']
        """
        return native.events(locals())

    def __len__(self) -> int:
        """Number of events."""
        return self.event_count


def toss_trajectory(
    system: System, *, initial_spin: Literal["absolute-rest", "with-hand"] = "absolute-rest"
) -> Trajectory:
    """The whole toss of a disk from its platform, from the start until it lands.

    Args:
        initial_spin: whether the disk starts at absolute rest or turns with the platform.
    """
    return native.toss_trajectory(locals())


def simulate(
    system: System,
    *,
    phase: Float = 0.0,
    angular_speed: Float | None = None,
    gap: Float | None = None,
    relative_velocity: Float | None = None,
    events: Int = 1000,
    duration: Float | None = None,
    chatter: ChatterCut | None = None,
    progress: Progress = None,
) -> Trajectory:
    """The motion of a disk, event by event.

    The disk starts on the platform if neither ``gap`` nor ``relative_velocity`` is given, leaves it if only
    the latter is given, and is in the air if there is a gap.

    Args:
        phase: phase of the platform at the start (rad).
        angular_speed: angular speed of the disk (rad/s); by default that of the platform.
        gap: height above the platform (m), positive.
        relative_velocity: axial velocity relative to the platform (m/s); not negative without a gap.
        events: the most events, in [1, 1000000].
        duration: time (s), positive, after which the next event is the last; without events the motion ends at
            this time.
        chatter: how a chatter ends; ``None`` sums it.

    >>> import bouncing_disk as bd
    >>> motion = bd.simulate(bd.System.pizza_toss(), phase=4.7, events=100)
    >>> len(motion)
    100
    """
    return native.simulate(locals())


@dataclass(frozen=True, eq=False, repr=False)
class RotaryResponse(Result):
    """The fate of the spin of a disk on a periodic orbit of n impacts.

    Attributes:
        outcome: ``"steady"``: any spin tends to the steady one of ``angular_speed``;
            ``"kept"``: the load exactly balances the largest mean friction, and a disk that slides
            through every impact in the direction of the load keeps its spin; ``"runaway"``: the load exceeds
            friction, and no spin repeats itself.
        multiplier: the rotary multiplier of the orbit: 0 if steady, 1 if kept, NaN for a runaway.
        angular_speed: the steady angular speed just before each impact (rad/s), shape (n,). This array and
            the next two are empty unless the outcome is ``"steady"``.
        slip: angular speed relative to the platform just before each impact (rad/s), shape (n,).
        sliding: the direction of the slip after each impact, shape (n,): 1 if the disk turns faster
            than the platform, -1 if more slowly, 0 if the impact ends the slip.
        stick_margin: the largest margin (rad/s) with which friction ends the slip in an impact: a smaller
            disturbance of the spin decays within one period of the orbit. NaN unless steady.
        mean_angular_speed: the mean steady angular speed (rad/s), NaN unless steady.
        limit: the end of the kept spins, as a spin before the first impact (rad/s): a positive load
            keeps all slower spins, a negative one all faster ones. NaN if every spin is kept, or none.
        change: the change of a runaway disk's angular speed in one period of the orbit once every impact
            slides (rad/s), else NaN.
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


def rotary_response(system: System, orbit: PeriodicOrbit) -> RotaryResponse:
    """The fate of the spin of a disk on a periodic orbit of its vertical motion, stable or unstable.

    Args:
        orbit: an orbit of ``ImpactMap.of_system(system)``.

    Dough tossed on the saddle with one impact per period, which attracts no motion:

    >>> import bouncing_disk as bd
    >>> system = bd.System.pizza_toss().replace(angular_frequency=8.5)
    >>> orbits = bd.periodic_orbits(bd.ImpactMap.of_system(system), max_impacts=1, max_platform_periods=1)
    >>> [(orbit.is_stable, bd.rotary_response(system, orbit).outcome) for orbit in orbits]
    [(False, 'steady'), (False, 'steady')]
    """
    return native.rotary_response(locals())
