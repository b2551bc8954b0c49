"""The long-term behaviour of orbits: diagrams, lifetimes, exponents, verdicts, manifolds and crises."""

# mypy: disable-error-code="no-any-return"
from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from bouncing_disk import _native as native
from bouncing_disk._base import *
from bouncing_disk._orbits import ImpactMap, PeriodicOrbit
from bouncing_disk._system import ChatterCut, Drive

__all__ = [
    "Crisis",
    "CrisisLives",
    "LyapunovSpectra",
    "Manifold",
    "OrbitDiagram",
    "Verdicts",
    "crises",
    "crisis",
    "lyapunov_exponents",
    "lyapunov_spectra",
    "manifold",
    "orbit_diagram",
    "verdicts",
]


class _Impacts:
    """Rows of impacts, one after the other."""

    offsets: IntArray
    impact_phase: FloatArray
    axial_impact_velocity: FloatArray

    @property
    def normalised_speed(self) -> FloatArray:
        """Normalised impact speed |w_A Gamma/(omega A)| of each impact, shape (m,)."""
        speed: FloatArray = -self.axial_impact_velocity / np.pi
        return speed

    def of(self, row: int) -> tuple[FloatArray, FloatArray]:
        """Phases (rad) and normalised speeds of the impacts of one orbit or piece, as views."""
        impacts = slice(self.offsets[:-1][row], self.offsets[1:][row])
        return self.impact_phase[impacts], self.normalised_speed[impacts]


@dataclass(frozen=True, eq=False, repr=False)
class OrbitDiagram(_Impacts, Result):
    """The impacts of many orbits, one after the other.

    The impacts of orbit ``k`` are the items from ``offsets[k]`` to ``offsets[k + 1]``.

    Attributes:
        axial_forcing: axial forcing parameter Gamma of each orbit, shape (n,).
        restitution: coefficient of restitution of each orbit, shape (n,).
        offsets: index of the first impact of each orbit; the last entry is the number of impacts, m, shape (n +
            1,).
        impact_phase: phase of each impact (rad), in [0, 2 pi), shape (m,).
        axial_impact_velocity: velocity of the disk relative to the platform just before each impact, not positive, in
            units of g/omega, shape (m,).

    >>> import bouncing_disk as bd
    >>> diagram = bd.orbit_diagram(axial_forcing=[0.45, 0.6], restitution=0.5, impact_phase=1.2,
    ...     normalised_speed=1.3, recorded=3)
    >>> diagram.column()
    array([0, 0, 0, 1, 1, 1])
    >>> diagram.of(0)[1].round(6)
    array([1.333333, 1.333333, 1.333333])
    """

    axial_forcing: FloatArray
    restitution: FloatArray
    offsets: IntArray
    impact_phase: FloatArray
    axial_impact_velocity: FloatArray

    def column(self) -> IntArray:
        """The orbit of each impact, shape (m,): ``axial_forcing[diagram.column()]`` is the abscissa of a plot."""
        return np.repeat(np.arange(len(self.axial_forcing), dtype=np.int64), np.diff(self.offsets))


def orbit_diagram(
    *,
    axial_forcing: ArrayLike,
    restitution: ArrayLike,
    impact_phase: ArrayLike,
    normalised_speed: ArrayLike,
    transient: Int = 3000,
    recorded: Int = 256,
    drive: Drive | None = None,
    contact_periods: Float | None = None,
    chatter: ChatterCut | None = None,
    progress: Progress = None,
) -> OrbitDiagram:
    """The impacts of many orbits after their transients: an orbit (bifurcation) diagram.

    The first four arguments are numbers or 1-d arrays of the same length.

    Args:
        axial_forcing: axial forcing parameter Gamma of each orbit, shape (n,).
        restitution: coefficient of restitution, in [0, 1), shape (n,).
        impact_phase: phase of the first impact (rad), shape (n,).
        normalised_speed: normalised speed of the first impact, not negative, shape (n,).
        transient: impacts of each orbit to discard first.
        recorded: impacts of each orbit to record; fewer if the disk rests for ever.
        drive: motion of the platform; ``None`` for the sine.
        contact_periods: duration of an isolated impact, as for :class:`ImpactMap`; ``None`` for rigid impacts.
        chatter: how a chatter ends; ``None`` sums it.

    >>> import bouncing_disk as bd
    >>> import numpy as np
    >>> diagram = bd.orbit_diagram(axial_forcing=np.linspace(0.4, 0.6, 5), restitution=0.5, impact_phase=1.2,
    ...     normalised_speed=1.3, transient=500, recorded=20)
    >>> diagram.offsets
    array([  0,  20,  40,  60,  80, 100])
    """
    return native.orbit_diagram(locals())


def lyapunov_exponents(
    *,
    axial_forcing: ArrayLike,
    restitution: ArrayLike,
    impact_phase: ArrayLike,
    normalised_speed: ArrayLike,
    transient: Int = 1000,
    impacts: Int = 10_000,
    drive: Drive | None = None,
    contact_periods: Float | None = None,
    progress: Progress = None,
) -> FloatArray:
    """The largest Lyapunov exponent per impact of each orbit.

    Args:
        axial_forcing, restitution, impact_phase, normalised_speed: as for :func:`orbit_diagram`, shape (n,).
        drive, contact_periods: the platform and the contact, as for :func:`orbit_diagram`.
        transient: impacts before the exponent is measured.
        impacts: impacts over which it is measured.

    Returns:
        Mean logarithmic growth per impact; NaN where the disk comes to rest, grazes the platform or hits a
        kink of its motion.

    >>> import bouncing_disk as bd
    >>> exponents = bd.lyapunov_exponents(axial_forcing=[0.44, 0.56], restitution=0.5, impact_phase=1.2,
    ...     normalised_speed=1.3)
    >>> exponents.round(2)
    array([-0.69,  0.4 ])
    """
    return native.lyapunov_exponents(locals())


@dataclass(frozen=True, eq=False, repr=False)
class LyapunovSpectra(Result):
    """Both Lyapunov exponents per impact of many orbits; NaN where they are undefined.

    Attributes:
        axial_forcing, restitution: the parameters of each orbit, shape (n,).
        outcome: An index into :attr:`OUTCOMES`, shape (n,).
        largest, standard_error: the largest exponent, and its standard error by batch means, shape (n,).
        second: the other exponent; minus infinity for restitution 0, shape (n,).
        exact_sum: exact sum of both exponents over these impacts; minus infinity for restitution 0, NaN for a
            compliant contact, shape (n,).
        impacts: measured impacts; after a rest or a graze, all impacts before it, including the transient,
            shape (n,).
        phase: phase (rad) of the impact that grazes the platform, shape (n,).
    """

    OUTCOMES: ClassVar[tuple[str, ...]] = ("exponents", "rested", "grazed")

    axial_forcing: FloatArray
    restitution: FloatArray
    outcome: ByteArray
    largest: FloatArray
    standard_error: FloatArray
    second: FloatArray
    exact_sum: FloatArray
    impacts: IntArray
    phase: FloatArray

    def names(self) -> list[str]:
        """The outcome of each orbit in the words of :attr:`OUTCOMES`."""
        return [self.OUTCOMES[outcome] for outcome in self.outcome]


def lyapunov_spectra(
    *,
    axial_forcing: ArrayLike,
    restitution: ArrayLike,
    impact_phase: ArrayLike,
    normalised_speed: ArrayLike,
    transient: Int = 1000,
    impacts: Int = 10_000,
    drive: Drive | None = None,
    contact_periods: Float | None = None,
    progress: Progress = None,
) -> LyapunovSpectra:
    """Both Lyapunov exponents per impact of each orbit, with the standard error of the largest.

    Args:
        axial_forcing, restitution, impact_phase, normalised_speed: as for :func:`orbit_diagram`, shape (n,).
        drive, contact_periods: the platform and the contact, as for :func:`orbit_diagram`.
        transient: impacts before the exponents are measured.
        impacts: impacts over which they are measured, at least 16.

    >>> import bouncing_disk as bd
    >>> spectra = bd.lyapunov_spectra(axial_forcing=[0.2, 0.55], restitution=0.5, impact_phase=1.2, normalised_speed=1.3)
    >>> spectra.names()
    ['rested', 'exponents']
    >>> bool(spectra.largest[1] > 10 * spectra.standard_error[1])  # Chaos.
    True
    """
    return native.lyapunov_spectra(locals())


@dataclass(frozen=True, eq=False, repr=False)
class Verdicts(Result):
    """The long-term motion of many orbits, with the evidence; numbers that a verdict lacks are 0 or NaN.

    Attributes:
        axial_forcing, restitution: the parameters of each orbit, shape (n,).
        kind: the verdict, an index into :attr:`KINDS`, shape (n,).
        reason: why an orbit is undecided, an index into :attr:`REASONS`, shape (n,).
        period: impacts of one period of a periodic orbit or of one cycle of a chattering one, shape (n,).
        platform_periods: periods of the platform in that period or cycle, shape (n,).
        after: impacts before the verdict, shape (n,).
        rests: 1 if the disk came to rest before the verdict, shape (n,).
        exponent, standard_error: the largest Lyapunov exponent per impact and its standard error, if
            measured, shape (n,).
        rounding_error: bound on the rounding error of the impacts of a chattering cycle (rad and g/omega),
            shape (n,).
        multipliers: Floquet multipliers of a periodic orbit, also of a neutral or repelling periodic orbit that the
            orbit follows, shape (n, 2).
    """

    KINDS: ClassVar[tuple[str, ...]] = ("periodic", "chaotic", "chattering", "at-rest", "undecided")
    REASONS: ClassVar[tuple[str, ...]] = (
        "",
        "exponent-near-zero",
        "no-period-found",
        "grazing",
        "on-periodic-orbit",
        "transient-may-last",
        "rest-not-proven",
    )

    axial_forcing: FloatArray
    restitution: FloatArray
    kind: ByteArray
    reason: ByteArray
    period: IntArray
    platform_periods: IntArray
    after: IntArray
    rests: IntArray
    exponent: FloatArray
    standard_error: FloatArray
    rounding_error: FloatArray
    multipliers: ComplexArray

    def names(self) -> list[str]:
        """The verdicts in the words of :attr:`KINDS`."""
        return [self.KINDS[kind] for kind in self.kind]

    def reasons(self) -> list[str]:
        """Why orbits are undecided, in the words of :attr:`REASONS`; empty for all others."""
        return [self.REASONS[reason] for reason in self.reason]


def verdicts(
    *,
    axial_forcing: ArrayLike,
    restitution: ArrayLike,
    impact_phase: ArrayLike,
    normalised_speed: ArrayLike,
    transient: Int = 2000,
    impacts: Int = 100_000,
    longest_period: Int = 256,
    tolerance: Float = 1e-07,
    drive: Drive | None = None,
    contact_periods: Float | None = None,
    progress: Progress = None,
) -> Verdicts:
    """The long-term motion from each start: periodic, chaotic, chattering, at rest or undecided, with the
    evidence.

    Args:
        axial_forcing, restitution, impact_phase, normalised_speed: as for :func:`orbit_diagram`, shape (n,).
        drive, contact_periods: the platform and the contact, as for :func:`orbit_diagram`.
        transient: impacts before the exponent is measured.
        impacts: impacts over which the exponent is measured, at least 64.
        longest_period: the longest period searched for, in impacts, in [1, 4096].
        tolerance: distance of an impact from an earlier one below which a period is tried, in (0, 0.01].

    >>> import bouncing_disk as bd
    >>> verdicts = bd.verdicts(axial_forcing=[0.2, 0.44, 0.56], restitution=0.5, impact_phase=1.2, normalised_speed=1.3,
    ...     impacts=2000)
    >>> verdicts.names()
    ['at-rest', 'periodic', 'chaotic']
    """
    return native.verdicts(locals())


@dataclass(frozen=True, eq=False, repr=False)
class Manifold(_Impacts, Result):
    """A manifold of a saddle: p continuous pieces with m impacts on b branches.

    The impacts of piece ``k`` are the items from ``offsets[k]`` to ``offsets[k + 1]``. Each impact of the saddle
    has two branches, on its later and its earlier side.

    Attributes:
        kind: ``"stable"`` or ``"unstable"``.
        multiplier: Floquet multiplier of the saddle along the manifold.
        offsets: index of the first impact of each piece; the last entry is m, shape (p + 1,).
        impact_phase: phase of each impact (rad), in [0, 2 pi): between neighbours it may pass 2 pi, shape
            (m,).
        axial_impact_velocity: relative velocity of each impact, not positive, in units of g/omega, shape (m,).
        piece_branch: the branch of each piece, shape (p,).
        piece_start, piece_end: why each piece begins and ends where it does, indices into :attr:`PIECE_ENDS`, shape
            (p,).
        branch_impact: impact of the saddle at which each branch begins, shape (b,).
        branch_side: side of that impact, an index into :attr:`SIDES`, shape (b,).
        branch_arclength: length of each branch (rad, and speeds in units of 1 + P), shape (b,).
        branch_generations: number of times the first piece of each branch was mapped, shape (b,).
        branch_end: why each branch is not longer, an index into :attr:`BRANCH_ENDS`, shape (b,).
    """

    PIECE_ENDS: ClassVar[tuple[str, ...]] = ("saddle", "graze", "rest", "too-fast", "cut")
    BRANCH_ENDS: ClassVar[tuple[str, ...]] = ("arclength", "points", "generations", "attracted", "lost")
    SIDES: ClassVar[tuple[str, ...]] = ("later", "earlier")

    kind: str
    multiplier: float
    offsets: IntArray
    impact_phase: FloatArray
    axial_impact_velocity: FloatArray
    piece_branch: IntArray
    piece_start: ByteArray
    piece_end: ByteArray
    branch_impact: IntArray
    branch_side: ByteArray
    branch_arclength: FloatArray
    branch_generations: IntArray
    branch_end: ByteArray

    def branch_end_names(self) -> list[str]:
        """Why each branch is not longer, in the words of :attr:`BRANCH_ENDS`."""
        return [self.BRANCH_ENDS[end] for end in self.branch_end]


def manifold(
    impact_map: ImpactMap,
    orbit: PeriodicOrbit,
    *,
    kind: Literal["unstable", "stable"] = "unstable",
    arclength: Float,
    max_points: Int = 100_000,
    chord: Float = 0.05,
    turn: Float = 0.2,
    max_generations: Int = 200,
    launch_speed: Float | None = None,
    progress: Progress = None,
) -> Manifold:
    """The stable or the unstable manifold of a saddle, grown from it piece by piece. For rigid impacts on the sine only.

    Lengths are measured in the plane of impact phase (rad) and impact velocity in units of 1 + P, with the peak
    acceleration P.

    Args:
        orbit: A saddle of this map, with one real multiplier inside the unit circle and one outside.
        kind: ``"unstable"`` for the states that come from the saddle, ``"stable"`` for the states that tend
            to it.
        arclength: length of each branch, in (0, 1e6].
        max_points: the most points of a branch, in [16, 1e7].
        chord: the largest distance between neighbours, in [1e-6, 1].
        turn: the largest turn of the polygon (rad), in [0.001, 1].
        max_generations: largest number of times the first piece is mapped, in [1, 10000].
        launch_speed: largest absolute speed after an impact (units of g/omega) to which a stable
            manifold is followed.

    >>> import bouncing_disk as bd
    >>> bouncing = bd.ImpactMap(axial_forcing=0.45, restitution=0.5)
    >>> saddle = next(orbit for orbit in bd.periodic_orbits(bouncing, max_impacts=1, max_platform_periods=1)
    ...     if not orbit.is_stable)
    >>> manifold = bd.manifold(bouncing, saddle, arclength=5.0)
    >>> sorted(manifold.branch_end_names())  # One branch ends in the orbit that attracts.
    ['arclength', 'attracted']
    """
    return native.manifold(locals())


@dataclass(frozen=True, eq=False, repr=False)
class CrisisLives(Result):
    """Lifetimes of orbits beyond a crisis, at n distances from it.

    Attributes:
        beyond: Gamma minus its value at the crisis, shape (n,).
        impacts: mean lifetime in impacts; infinity if no orbit ended, shape (n,).
        relative_error: relative standard error of the mean lifetime; infinity if no orbit ended, shape (n,).
        ended, orbits: orbits that came to rest, and all orbits, shape (n,).
        exponent, exponent_error: the mean lifetime varies as ``beyond**exponent``; NaN without a power law.
        no_power_law: the reason if there is no power law.
    """

    beyond: FloatArray
    impacts: FloatArray
    relative_error: FloatArray
    ended: IntArray
    orbits: IntArray
    exponent: float
    exponent_error: float
    no_power_law: str | None


@dataclass(frozen=True, eq=False, repr=False)
class Crisis(Stored):
    """A crisis: a chaotic attractor begins to lose orbits, merges its bands or becomes larger.

    Made by :func:`crisis`.

    Attributes:
        restitution: coefficient of restitution.
        axial_forcing: axial forcing parameter Gamma of the tangency, or without one the middle of the bracket.
        forcing_error: its error: half of the bracket, or the part below the tangency.
        bracket: the values of Gamma between which lifetimes place the crisis; the lower bound holds in 95
            of 100 searches.
        kind: ``"boundary"`` (the attractor is lost to rest), ``"interior"`` (rest becomes a part of it),
            ``"undecided"``, ``"band merging"``, ``"growth"`` (it becomes larger without rest) or ``"other
            attractor"`` (orbits leave and do not return).
        is_boundary_crisis: whether the attractor is lost: kind ``"boundary"`` or ``"other attractor"``. None if
            undecided.
        no_tangency: why no tangency is known as the cause; None if one is.
        inside: the saddle on the attractor, at the crisis; None without a tangency, like all attributes below.
        touched: the saddle whose stable manifold is touched, at the crisis.
        impact_phase: phases of the impacts of the orbit of tangency (rad), shape (n,).
        axial_impact_velocity: their relative velocities, not positive, in units of g/omega, shape (n,).
        side: the side of the saddle on which the manifold begins: ``"later"`` or ``"earlier"``.
        share: share of the first piece of the unstable manifold at which the orbit of tangency begins, in [0,
            1].
        curvature: curvature that sets the escaping share of the first piece: sqrt(8 (Gamma -
            Gamma_c)/abs(curvature)).
        life_exponent: exponent of the mean lifetime beyond the crisis, (Gamma - Gamma_c)^-exponent, from
            the multipliers of the saddles; None if they do not determine it.
    """

    restitution: float
    axial_forcing: float
    forcing_error: float
    bracket: tuple[float, float]
    kind: str
    is_boundary_crisis: bool | None
    no_tangency: str | None
    inside: PeriodicOrbit | None
    touched: PeriodicOrbit | None
    impact_phase: FloatArray | None
    axial_impact_velocity: FloatArray | None
    side: str | None
    share: float | None
    curvature: float | None
    life_exponent: float | None

    def lives(
        self, *, beyond: ArrayLike, orbits: Int = 1000, impacts: Int = 100_000, progress: Progress = None
    ) -> CrisisLives:
        """Lifetimes of orbits beyond the crisis, and the power law of their mean.

        Args:
            beyond: distances from the crisis in Gamma, positive, shape (n,).
            orbits: orbits at each distance, in [1, 1e6].
            impacts: largest number of impacts over which an orbit is followed, at least 1.
        """
        return native.lives(locals())


def crisis(
    inside: PeriodicOrbit | None = None,
    touched: PeriodicOrbit | None = None,
    *,
    restitution: Float,
    axial_forcing: Pair,
    event: Literal["rest", "band merging", "growth"] = "rest",
    bands: Int = 1,
    samples: Int = 64,
    impacts: Int = 2_000_000,
    progress: Progress = None,
) -> Crisis:
    """The forcing at which a chaotic attractor begins to lose orbits to rest, merges its bands or becomes larger.

    Orbits on the attractor are followed to a bracket; a tangency of manifolds within it refines the result.

    Args:
        inside: A saddle on the attractor, or at its edge. By default the attractor is the one to which
            the period-1 orbit leads, and the saddles are searched for.
        touched: the saddle whose stable manifold is touched; by default the saddle `inside`.
        restitution: coefficient of restitution, in (0, 1).
        axial_forcing: Gamma below the crisis and beyond it.
        event: what to look for: orbits that come to rest, that change between the bands of the attractor, or that
            leave the part of the plane that it occupied at lower forcings.
        bands: number of bands, in [1, 16], into which twice as many merge.
        samples: orbits followed at each forcing, in [16, 1e6].
        impacts: impacts of all orbits together, in [1e4, 1e12]; at least 200 per orbit. More impacts narrow the
            bracket.

    Raises:
        ComputationError: There is no crisis, with the reason as its kind: ``"not-born"``, ``"not-followed"``,
            ``"none-rests"``, ``"rests-before"``, ``"no-bands"``, ``"not-chaotic"``, ``"lives-do-not-shrink"`` or
            ``"other-reason"``.

    >>> import bouncing_disk as bd
    >>> found = bd.crisis(restitution=0.5, axial_forcing=(0.559, 0.562), impacts=400_000)
    >>> round(found.axial_forcing, 5)
    0.56075
    """
    return native.crisis(locals())


def crises(
    *,
    restitution: ArrayLike,
    axial_forcing: Pair,
    event: Literal["rest", "band merging", "growth"] = "rest",
    bands: Int = 1,
    samples: Int = 64,
    impacts: Int = 2_000_000,
    progress: Progress = None,
) -> list[Crisis | None]:
    """The curve of crises over the restitution: :func:`crisis` at each restitution.

    The first is sought in the given range, each later one around the forcing extrapolated from the crises before.

    Args:
        restitution: coefficients of restitution, in (0, 1), each close to the one before, shape (n,).
        axial_forcing: Gamma below the first crisis and beyond it.
        event, bands, samples, impacts: as for :func:`crisis`.

    Returns:
        A crisis for each restitution; None where none is found.

    >>> import bouncing_disk as bd
    >>> found = bd.crises(restitution=[0.5, 0.48], axial_forcing=(0.559, 0.562), impacts=200_000)
    >>> [round(crisis.axial_forcing, 3) for crisis in found]
    [0.561, 0.578]
    """
    return native.crises(locals())
