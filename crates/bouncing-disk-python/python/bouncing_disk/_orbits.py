"""The impact map, its periodic orbits, their branches and their doublings."""

# mypy: disable-error-code="no-any-return"
from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, TypedDict

from bouncing_disk import _native as native
from bouncing_disk._base import *
from bouncing_disk._native import impact_map
from bouncing_disk._system import Drive, System

if TYPE_CHECKING:
    from typing_extensions import Unpack

__all__ = [
    "Bifurcation",
    "Branch",
    "Curve",
    "DoublingCascade",
    "ImpactMap",
    "PeriodicOrbit",
    "SpecialPoint",
    "continued",
    "curves",
    "doubling_cascade",
    "periodic_orbits",
]


class ImpactMap(Parameters):
    """The map from one impact of a bouncing disk to the next, without units.

    An impact is its phase (rad) and the velocity of the disk relative to the platform just before
    (``axial_impact_velocity``, not positive, in units of g/omega); the paper's normalised impact speed is
    this velocity over -pi. With a contact time an impact is a release, represented by the rigid impact with
    the same rebound speed.

    Functions use the drive and the contact time of the map. Functions for rigid impacts on the sine only
    (:meth:`period_one`, :func:`manifold`) raise :class:`InvalidError` on other maps, of the kind
    ``"drive-not-sine"`` or ``"soft-contact"``.

    Args:
        axial_forcing: axial forcing parameter Gamma = A omega^2/(pi g). Give this or ``peak_acceleration``.
        peak_acceleration: peak acceleration A omega^2/g of the platform (with a drive, of the sine of the
            same amplitude).
        restitution: coefficient of restitution, in [0, 1).
        drive: motion of the platform, a :class:`Drive` or its dictionary; ``None`` for the sine. Only the
            height matters: a drive with the sine's height is dropped unless there is a contact time.
        contact_periods: duration of an isolated impact, in periods of the platform, in [1e-6, 1000]; ``None``
            for rigid impacts. Only for the sine and Fourier sums.

    Attributes:
        normalised_speed_bound: the largest normalised impact speed of every attractor and periodic orbit; NaN with a
            contact time, for which no bound is known.

    >>> import bouncing_disk as bd
    >>> bouncing = bd.ImpactMap(axial_forcing=0.45, restitution=0.5)
    >>> phase, velocity = bouncing.period_one()
    >>> after, _ = bouncing.step(impact_phase=phase, axial_impact_velocity=velocity)
    >>> abs(after - phase) < 1e-15
    True
    >>> parabolas = bouncing.replace(drive=bd.Drive.parabolas())
    >>> [round(number, 6) for number in parabolas.step(impact_phase=1.0, axial_impact_velocity=-4.0)]
    [0.293359, -4.386295]
    """

    axial_forcing: float
    peak_acceleration: float
    restitution: float
    drive: Drive | None
    contact_periods: float | None
    normalised_speed_bound: float

    def __init__(
        self,
        *,
        axial_forcing: Float | None = None,
        peak_acceleration: Float | None = None,
        restitution: Float,
        drive: Drive | Table | None = None,
        contact_periods: Float | None = None,
    ) -> None:
        if drive is None and contact_periods is None:
            self.__dict__["_native"] = impact_map(axial_forcing, peak_acceleration, restitution)
        else:
            self.__dict__["_native"] = impact_map(axial_forcing, peak_acceleration, restitution, drive, contact_periods)

    def _key(self) -> object:
        # Maps that compute the same are equal, whichever forcing was given.
        height = "sine" if self.drive is None else hashable(self.drive.height)
        return self.peak_acceleration, self.restitution, height, self.contact_periods

    @staticmethod
    def of_system(system: System) -> ImpactMap:
        """The vertical motion of a system with rigid impacts on a prescribed platform.

        Raises:
            InvalidError: ``"soft-contact"`` or ``"yielding-stator"`` for another system.
        """
        return native.map_of_system(locals())

    def step(self, *, impact_phase: Float, axial_impact_velocity: Float) -> tuple[float, float]:
        """The next impact.

        Chattering is not cut off: the disk is followed through ever smaller impacts.

        Args:
            impact_phase: phase of this impact (rad).
            axial_impact_velocity: its relative velocity, not positive, in units of g/omega.

        Returns:
            Phase and velocity of the next impact.
        """
        # Here and below the compiled method is called directly, so that loops pay for one call only.
        self.__dict__["step"] = self._native.step
        return self._native.step(impact_phase=impact_phase, axial_impact_velocity=axial_impact_velocity)

    def iterate(
        self, *, impact_phase: Float, axial_impact_velocity: Float, impacts: Int, progress: Progress = None
    ) -> tuple[float, float]:
        """The impact a number of steps later.

        Args:
            impact_phase, axial_impact_velocity: as for :meth:`step`.
            impacts: number of steps.

        Returns:
            Phase and velocity of that impact.
        """
        return native.iterate(locals())

    def derivative(self, *, impact_phase: Float, axial_impact_velocity: Float) -> FloatArray:
        """The derivative of the next impact with respect to this one.

        Args:
            impact_phase, axial_impact_velocity: as for :meth:`step`.

        Returns:
            Rows: next phase and velocity; columns: this phase and velocity (rad, units of g/omega),
            shape (2, 2).

        Raises:
            ComputationError: ``"impact-on-kink"`` if either impact is on a kink of the platform.
        """
        self.__dict__["derivative"] = self._native.derivative
        return self._native.derivative(impact_phase=impact_phase, axial_impact_velocity=axial_impact_velocity)

    def period_one(self, *, platform_periods: Int = 1) -> tuple[float, float] | None:
        """The orbit with one impact every `platform_periods` periods of the platform, in closed form. For rigid impacts on the sine
        only.

        Args:
            platform_periods: at least 1.

        Returns:
            Phase and velocity of its impact; None below the forcing of its birth.
        """
        self.__dict__["period_one"] = self._native.period_one
        return self._native.period_one(platform_periods=platform_periods)

    def refine(
        self,
        *,
        impact_phase: ArrayLike,
        axial_impact_velocity: ArrayLike,
    ) -> PeriodicOrbit:
        """The periodic orbit near a guess, stable or not, by Newton's method on all impacts.

        Args:
            impact_phase: phases of the impacts of one period (rad), in their order, shape (n,).
            axial_impact_velocity: their relative velocities, not positive, in units of g/omega, shape (n,).
        """
        return native.refine(locals())

    def settled_orbit(
        self,
        *,
        impact_phase: Float,
        normalised_speed: Float,
        transient: Int = 2000,
        longest_period: Int = 64,
        tolerance: Float = 1e-07,
        progress: Progress = None,
    ) -> PeriodicOrbit | None:
        """The attracting periodic orbit that an impact leads to.

        Args:
            impact_phase: phase of the impact (rad).
            normalised_speed: its normalised speed, not negative.
            transient: impacts before the search for a period.
            longest_period: the longest period, in impacts, up to 4096.
            tolerance: largest distance at which an orbit counts as closed (rad, and relative speed).

        Returns:
            None if the disk comes to rest or shows no period.
        """
        return native.settled_orbit(locals())


@dataclass(frozen=True, eq=False, repr=False)
class PeriodicOrbit(Stored):
    """A periodic orbit of the impact map, stable or not.

    Orbits are made by :func:`periodic_orbits`, :meth:`ImpactMap.refine` and :meth:`ImpactMap.settled_orbit`.

    Attributes:
        impact_phase: phase of each impact of one period (rad), shape (period,).
        axial_impact_velocity: relative velocity of each impact, not positive, in units of g/omega, shape
            (period,).
        normalised_speed: normalised speed of each impact, shape (period,).
        period: number of impacts in one period of the orbit.
        platform_periods: periods of the platform in one period of the orbit.
        monodromy: the derivative of the map around the orbit, from its first impact, shape (2, 2).
        multipliers: the two Floquet multipliers, complex, the one of larger modulus first, shape (2,).
        is_stable: whether the orbit attracts: both multipliers lie inside the unit circle by more than
            their uncertainty.
        stability: ``"attracts"``, ``"unstable"``, or ``"marginal"`` if a multiplier is 1 or -1 within
            rounding.
    """

    impact_phase: FloatArray
    axial_impact_velocity: FloatArray
    normalised_speed: FloatArray
    period: int
    platform_periods: int
    monodromy: FloatArray
    multipliers: ComplexArray
    is_stable: bool
    stability: str

    def trapping_radius(
        self,
        impact_map: ImpactMap,
        *,
        samples: Int = 64,
        progress: Progress = None,
    ) -> float:
        """The radius within which a start counts as caught by this orbit: the proven radius, or a larger one
        supported by samples.

        Args:
            impact_map: the map of this orbit.
            samples: starts on each tested circle.

        Returns:
            In radians (a radian counts as much as the peak velocity of the platform).

        Raises:
            InvalidError: ``"not-an-orbit"`` for an orbit of another map.
            ComputationError: ``"not-attracting"`` unless the orbit attracts; ``"nothing-proven"`` near a graze, if
                samples find no radius either.
        """
        return native.trapping_radius(locals())


def periodic_orbits(
    impact_map: ImpactMap,
    *,
    max_impacts: Int = 4,
    max_platform_periods: Int = 4,
    phases: Int = 96,
    speeds: Int = 96,
    progress: Progress = None,
) -> list[PeriodicOrbit]:
    """The periodic orbits of few impacts, stable and unstable.

    Orbits of one impact come from a closed form and are complete, except with a contact time. All others are
    found from a grid of starts, which does not prove that the list is complete. On a drive, orbits with an
    impact on a kink are omitted, as they have no multipliers.

    Args:
        max_impacts: the most impacts of an orbit, in [1, 64].
        max_platform_periods: the most periods of the platform in an orbit, in [1, 10000].
        phases, speeds: starts along each axis, in [2, 4096].

    Returns:
        Sorted by number of impacts, then of platform periods, then by falling speed of the fastest impact,
        which comes first in each orbit.

    >>> import bouncing_disk as bd
    >>> bouncing = bd.ImpactMap(axial_forcing=0.5, restitution=0.5)
    >>> orbits = bd.periodic_orbits(bouncing, max_impacts=2, max_platform_periods=2)
    >>> [orbit.period for orbit in orbits if orbit.is_stable]
    [2]
    """
    return native.periodic_orbits(locals())


class Continuation(TypedDict, total=False):
    """The steps along a branch or curve: keywords of :func:`continued`, :meth:`Branch.switched` and :func:`curves`.

    Args:
        first_step, largest_step: arclength of the first and of the largest step, in [1e-9, 1]; 0.01 and 0.05 unless given.
        max_points: the most orbits, in [2, 1000000]; 10000 unless given.
    """

    first_step: Float
    largest_step: Float
    max_points: Int


@dataclass(frozen=True, eq=False)
class Bifurcation(Result):
    """A special point of a branch of periodic orbits.

    Attributes:
        kind: ``"doubling"``, ``"fold"``, ``"graze"``, ``"vanishing-impact"``, ``"border-collision"`` (an impact
            passes a joint or reaches a kink of the platform) or ``"birth"``.
        parameter: the value of the parameter.
        arclength: arclength from the start of the branch.
        impact: index of the impact that grazes, vanishes or collides.
        orbit: the orbit there.
    """

    kind: str
    parameter: float
    arclength: float
    impact: int | None
    orbit: PeriodicOrbit


@dataclass(frozen=True, eq=False, repr=False)
class Branch(Stored):
    """A branch of periodic orbits, stable and unstable, along a parameter.

    Made by :func:`continued` and :meth:`Branch.switched`. Arrays have one row for each orbit, n in all.

    Attributes:
        parameter: the varied parameter, as given.
        values: the parameter of each orbit, shape (n,).
        arclength: arclength from the start of the branch, shape (n,).
        impact_phase: phases of the impacts of each orbit (rad), shape (n, period).
        axial_impact_velocity: relative velocities of the impacts of each orbit, not positive, in units of
            g/omega, shape (n, period).
        normalised_speed: normalised speeds of the impacts of each orbit, shape (n, period).
        multipliers: Floquet multipliers of each orbit, complex, shape (n, 2).
        is_stable: whether each orbit attracts, bool, shape (n,).
        end: why the branch ends, in words.
        bifurcations: the bifurcations along the branch, a tuple of :class:`Bifurcation`.
    """

    parameter: str
    values: FloatArray
    arclength: FloatArray
    impact_phase: FloatArray
    axial_impact_velocity: FloatArray
    normalised_speed: FloatArray
    multipliers: ComplexArray
    is_stable: BoolArray
    end: str
    bifurcations: tuple[Bifurcation, ...]

    def orbit(self, index: Int) -> PeriodicOrbit:
        """One orbit of the branch.

        Args:
            index: its index, from 0.
        """
        return native.branch_orbit(locals())

    def switched(
        self,
        *,
        index: Int,
        parameter_range: Pair,
        progress: Progress = None,
        **settings: Unpack[Continuation],
    ) -> Branch:
        """The branch of twice the period that begins at a doubling.

        Args:
            index: index into :attr:`bifurcations`.
            parameter_range: lowest and highest value of the parameter.
            first_step, largest_step, max_points, progress: as for :func:`continued`.
        """
        return native.switched(locals())

    def __len__(self) -> int:
        """Number of orbits."""
        return len(self.values)


def continued(
    impact_map: ImpactMap,
    orbit: PeriodicOrbit,
    *,
    parameter: str = "axial_forcing",
    parameter_range: Pair,
    rising: bool = True,
    progress: Progress = None,
    **settings: Unpack[Continuation],
) -> Branch:
    """The branch of periodic orbits through one of them, through folds and along unstable parts.

    With a contact time the end of a branch is accurate to 1e-6.

    Args:
        orbit: an orbit of this map.
        parameter: the parameter to vary: ``"axial_forcing"`` or ``"restitution"``; on a map with a drive or a
            contact time also ``"contact_periods"`` and each number of the drive's height by its index, such
            as ``"fourier[1][0]"`` for the amplitude of the second harmonic, or ``"sawtooth"``.
        parameter_range: its lowest and highest value.
        rising: whether the branch begins towards higher values.
        settings: the steps along the branch: :class:`Continuation`, as keywords.

    Raises:
        InvalidError: ``"not-an-orbit"`` for an orbit of another map; ``"no-such-number"`` for a parameter that the
            drive does not have.

    >>> import bouncing_disk as bd
    >>> bouncing = bd.ImpactMap(axial_forcing=0.45, restitution=0.5)
    >>> orbit = bouncing.settled_orbit(impact_phase=1.2, normalised_speed=1.3)
    >>> branch = bd.continued(bouncing, orbit, parameter_range=(0.1, 0.6))
    >>> [(found.kind, round(found.parameter, 6)) for found in branch.bifurcations]
    [('doubling', 0.486003)]
    """
    return native.continued(locals())


@dataclass(frozen=True, eq=False)
class SpecialPoint(Result):
    """A point at which the bifurcation of a :class:`Curve` changes.

    Attributes:
        kind: ``"cusp"``, ``"criticality-change"`` (of a doubling, from super- to subcritical), ``"grazing-fold"``,
            ``"grazing-doubling"``, ``"resonance-1:1"`` or ``"resonance-1:2"`` (at restitution 1).
        values: the two parameters.
        errors: how far they may be off.
        arclength: arclength from the start of the curve.
        flight: which flight grazes.
        impact_phase: phases of the impacts of the orbit (rad), shape (period,).
        axial_impact_velocity: their relative velocities, not positive, in units of g/omega, shape (period,).
    """

    kind: str
    values: tuple[float, float]
    errors: tuple[float, float]
    arclength: float
    flight: int | None
    impact_phase: FloatArray
    axial_impact_velocity: FloatArray


@dataclass(frozen=True, eq=False, repr=False)
class Curve(Result):
    """A curve of bifurcations of one kind in two parameters, made by :func:`curves`; n points.

    Attributes:
        kind: ``"fold"``, ``"doubling"`` or ``"graze"``.
        bifurcation: index in the branch's :attr:`Branch.bifurcations` of the bifurcation at which the curve starts.
        parameters: the parameter of the branch and the second one.
        values: both parameters of each point, shape (n, 2).
        errors: how far rounding may have moved the curve: along the first parameter at this value of the second, and
            along the second at this value of the first; the largest double where the curve runs along that parameter,
            shape (n, 2).
        arclength: arclength from the start of the curve, shape (n,).
        impact_phase: phases of the impacts of each orbit (rad), shape (n, period).
        axial_impact_velocity: relative velocities of the impacts, not positive, in units of g/omega, shape (n, period).
        multipliers: Floquet multipliers of each orbit, complex, shape (n, 2).
        criticality: of a doubling, 1 where it is supercritical (the doubled orbit exists where this one is unstable)
            and -1 where it is subcritical; 0 on other curves and where it is not decided, shape (n,).
        end: why the curve ends, in words.
        special: the points at which the bifurcation changes: a tuple of :class:`SpecialPoint`.
    """

    kind: str
    bifurcation: int
    parameters: tuple[str, str]
    values: FloatArray
    errors: FloatArray
    arclength: FloatArray
    impact_phase: FloatArray
    axial_impact_velocity: FloatArray
    multipliers: ComplexArray
    criticality: IntArray
    end: str
    special: tuple[SpecialPoint, ...]


def curves(
    impact_map: ImpactMap,
    branch: Branch,
    *,
    parameter: str = "restitution",
    parameter_range: Pair,
    branch_range: Pair,
    progress: Progress = None,
    **settings: Unpack[Continuation],
) -> list[Curve]:
    """The curves of the folds, doublings and grazes of a branch as a second parameter varies.

    From each of these bifurcations one curve goes towards higher values of the second parameter at first, and one
    towards lower values unless the first is closed.

    Args:
        impact_map: the map that was continued.
        branch: its branch.
        parameter: the second parameter, chosen as for :func:`continued`.
        parameter_range: its lowest and highest value.
        branch_range: lowest and highest value of the parameter of the branch.
        settings: the steps along a curve: :class:`Continuation`, as keywords.

    Raises:
        InvalidError: ``"not-of-kind"`` if the second parameter is that of the branch.

    >>> import bouncing_disk as bd
    >>> bouncing = bd.ImpactMap(axial_forcing=0.45, restitution=0.5)
    >>> orbit = bouncing.settled_orbit(impact_phase=1.2, normalised_speed=1.3)
    >>> branch = bd.continued(bouncing, orbit, parameter_range=(0.1, 0.6))
    >>> found = bd.curves(bouncing, branch, parameter_range=(0.3, 0.9), branch_range=(0.1, 2))
    >>> [(curve.kind, [round(float(value), 6) for value in curve.values[-1]]) for curve in found]
    [('doubling', [0.323502, 0.9]), ('doubling', [0.677151, 0.3])]
    """
    return native.curves(locals())


@dataclass(frozen=True, eq=False, repr=False)
class DoublingCascade(Result):
    """A period-doubling cascade: n doublings, and Feigenbaum's numbers from m of them.

    Attributes:
        period: impacts of the orbit that loses its stability, shape (n,).
        axial_forcing, forcing_error: the forcing Gamma_n, and the bound on its rounding error, shape (n,).
        multiplier: the multiplier reached by the search, -1 within rounding, shape (n,).
        width: the largest distance (rad) of an impact from the one half a period later, shape (n,).
        graze_margin: smallest gap by which a flight misses an earlier impact, in units of g/omega^2; infinite
            if none comes near, NaN on another drive, shape (n,).
        feigenbaum_number: the last doubling used for each estimate, counted from 1, shape (m,).
        delta, delta_error, alpha, alpha_error: Feigenbaum's numbers, extrapolated, and their errors,
            shape (m,).
        ended_by: why there are fewer doublings than requested; ``None`` if there are not.
    """

    period: IntArray
    axial_forcing: FloatArray
    forcing_error: FloatArray
    multiplier: FloatArray
    width: FloatArray
    graze_margin: FloatArray
    feigenbaum_number: IntArray
    delta: FloatArray
    delta_error: FloatArray
    alpha: FloatArray
    alpha_error: FloatArray
    ended_by: str | None


def doubling_cascade(
    *,
    restitution: Float,
    count: Int = 8,
    drive: Drive | None = None,
    contact_periods: Float | None = None,
    progress: Progress = None,
) -> DoublingCascade:
    """The period doublings of the orbit with one impact per period of the platform, and Feigenbaum's numbers
    from them.

    Args:
        restitution: coefficient of restitution, in (0, 1).
        count: number of doublings, in [1, 13]; fewer if the cascade ends early, as after two for the
            restitution 0.01.
        drive: motion of the platform; ``None`` for the sine. The cascade begins with the attracting orbit of
            one impact per period at the lowest forcing.
        contact_periods: as for :func:`orbit_diagram`.

    >>> import bouncing_disk as bd
    >>> bd.doubling_cascade(restitution=0.5, count=3).axial_forcing.round(4)
    array([0.486 , 0.5307, 0.5401])
    """
    return native.doubling_cascade(locals())
