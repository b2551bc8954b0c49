"""Attractors of the impact map, their basins on a grid and over the forcing, and measures of basins."""

# mypy: disable-error-code="no-any-return"
from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypedDict

import numpy as np

from bouncing_disk import _native as native
from bouncing_disk._base import *
from bouncing_disk._orbits import ImpactMap, PeriodicOrbit
from bouncing_disk._system import ChatterCut

if TYPE_CHECKING:
    from typing_extensions import Unpack

__all__ = [
    "ATTACHED",
    "Attractor",
    "AttractorSearch",
    "Attractors",
    "BasinEntropy",
    "BasinFractions",
    "Basins",
    "BoundaryScaling",
    "FIRST_ORBIT",
    "UNDECIDED",
    "attractors",
    "basin_entropy",
    "basin_fractions_over",
    "basins",
    "boundary_scaling",
]

#: Label of a start that was neither at rest nor near a known orbit after the allowed impacts.
UNDECIDED: int = native.UNDECIDED
#: Label of a start that comes to rest.
ATTACHED: int = native.ATTACHED
#: Label of the first known orbit; the others follow it.
FIRST_ORBIT: int = native.FIRST_ORBIT


@dataclass(frozen=True, eq=False)
class Attractor(Result):
    """An attractor of an impact map.

    Attributes:
        kind: ``"rest"``, ``"periodic"``, ``"marginal"``, ``"chaotic"`` or ``"transient"``.
        label: its label in :attr:`Basins.labels`; the words of `meaning` use these labels.
        orbit: the orbit of a periodic or marginal attractor.
        radius: the radius (rad) within which a start counts as caught by that orbit, else NaN.
        exponent, standard_error: the largest Lyapunov exponent per impact of a chaotic motion or transient
            and its standard error, else NaN.
        survived: impacts for which orbits on a chaotic motion were followed without leaving it; for a
            transient, impacts after which `share` counts the starts still on it; None for other kinds.
        mean_life, mean_life_interval: the mean life of a transient in impacts and its 95 % interval, else
            NaN. If no orbit left it, the mean is NaN and the interval ends at infinity.
        share: share of the starts that ended on it.
        interval: its 95 % interval.
        lasts: whether the motion lasts (if chaotic, for the impacts in `survived`); false for a rest that
            may not recur, a marginal orbit and a transient.
        leads_to: the index in :attr:`Attractors.all` of the attractor to which a rest leads, one below its label.
        meaning: description in words.
        is_exact: false for a disk that comes to rest again and again in a cycle set by rounding.
    """

    kind: str
    label: int
    orbit: PeriodicOrbit | None
    radius: float
    exponent: float
    standard_error: float
    survived: int | None
    mean_life: float
    mean_life_interval: tuple[float, float]
    share: float
    interval: tuple[float, float]
    lasts: bool
    leads_to: int | None
    meaning: str
    is_exact: bool


@dataclass(frozen=True, eq=False, repr=False)
class Basins(Result):
    """Basins of attraction on a grid of impacts.

    Attributes:
        impact_map: the map.
        labels: the fate of the start in each cell's centre; rows by rising speed, shape (speeds, phases).
        phase: impact phase of the cells' centres, in periods, shape (phases,).
        speed: normalised impact speed of the cells' centres, shape (speeds,).
        phase_range, speed_range: ends of the axes: ``(*phase_range, *speed_range)`` is the ``extent`` of a
            picture with ``origin="lower"``.
        meaning: what each label means.

    >>> import bouncing_disk as bd
    >>> basins = bd.basins(bd.ImpactMap(axial_forcing=0.3, restitution=0.5), phases=20, speeds=10)
    >>> basins.meaning
    ('undecided', 'comes to rest')
    >>> float(basins.labels.min()), basins.share(bd.ATTACHED)
    (1.0, 1.0)
    """

    impact_map: ImpactMap
    labels: ByteArray
    phase: FloatArray
    speed: FloatArray
    phase_range: tuple[float, float]
    speed_range: tuple[float, float]
    meaning: tuple[str, ...]

    def share(self, label: int) -> float:
        """The share of the cells that have this label, in [0, 1]."""
        return int(np.count_nonzero(self.labels == label)) / self.labels.size


@dataclass(frozen=True, eq=False, repr=False)
class Attractors(Stored):
    """The attractors of an impact map: the disk at rest, and all others found.

    Made by :func:`attractors`. Attractors of a map with a drive or a contact time cannot be stored.

    Attributes:
        impact_map: the map.
        all: the disk at rest (index 0) and all other attractors, a tuple of :class:`Attractor`.
        undecided: the share of the starts that ended on none of them.
    """

    impact_map: ImpactMap
    all: tuple[Attractor, ...]
    undecided: float

    def basins(
        self,
        *,
        phases: Int = 400,
        phase_range: Pair = (0.0, 1.0),
        speeds: Int = 300,
        speed_range: Pair = (0.0, 3.0),
        max_impacts: Int = 2000,
        chatter: ChatterCut | None = None,
        progress: Progress = None,
    ) -> Basins:
        """The basins of the attractors on a grid of impacts.

        Args:
            phases, phase_range, speeds, speed_range, max_impacts, chatter: as for :func:`basins`.
        """
        return native.basins_of(locals())

    def __len__(self) -> int:
        """Number of attractors, including the disk at rest."""
        return len(self.all)


class AttractorSearch(TypedDict, total=False):
    """How attractors are searched for: keywords of :func:`attractors` and :func:`basin_fractions_over`.

    Args:
        starts: starts, spread evenly over all impacts that an attractor can have, in [0, 2^18]; 1024 unless given.
        transient: impacts that are skipped, at least 1; 2000 unless given.
        impacts: impacts over which orbits of each aperiodic motion are followed, at least 64; 100000 unless given.
        longest_period: the longest period, in impacts, in [1, 4096]; 256 unless given.
        cells: cells along each axis of the grid that distinguishes aperiodic motions, in [8, 4096]; 256 unless given.
        budget: approximate limit on the impacts of the whole search, in [256 a start, 2^50], 2^28 unless given; starts that
            are still under way when it is used up are undecided. On a drive an impact counts as 32.
    """

    starts: Int
    transient: Int
    impacts: Int
    longest_period: Int
    cells: Int
    budget: Int


def attractors(
    impact_map: ImpactMap,
    *,
    progress: Progress = None,
    **settings: Unpack[AttractorSearch],
) -> Attractors:
    """The attractors of a map, found without known orbits.

    Args:
        settings: the fields of :class:`AttractorSearch`, as keywords.

    >>> import bouncing_disk as bd
    >>> found = bd.attractors(bd.ImpactMap(axial_forcing=0.486, restitution=0.5))
    >>> [attractor.orbit.period for attractor in found.all if attractor.orbit is not None]
    [1, 4]
    >>> on_parabolas = bd.ImpactMap(axial_forcing=0.4, restitution=0.5, drive=bd.Drive.parabolas())
    >>> [one.kind for one in bd.attractors(on_parabolas).all]
    ['rest', 'periodic']
    """
    return native.attractors(locals())


def basins(
    impact_map: ImpactMap,
    *,
    phases: Int = 400,
    phase_range: Pair = (0.0, 1.0),
    speeds: Int = 300,
    speed_range: Pair = (0.0, 3.0),
    known_orbits: Iterable[PeriodicOrbit | tuple[PeriodicOrbit, Float]] | None = None,
    max_impacts: Int = 2000,
    chatter: ChatterCut | None = None,
    progress: Progress = None,
) -> Basins:
    """Which starts come to rest and which end on known periodic orbits, on a grid of impacts.

    :func:`attractors` finds the orbits itself; its ``basins`` cover all attractors.

    Args:
        phases: cells along the impact phase, up to 100000.
        phase_range: lowest and highest impact phase, in periods.
        speeds: cells along the normalised impact speed, up to 100000.
        speed_range: lowest and highest normalised speed.
        known_orbits: attracting orbits of this map, at most 250, each a :class:`PeriodicOrbit` or a pair of one and the
            radius (rad) within which a start counts as caught; without a radius it is the
            :meth:`PeriodicOrbit.trapping_radius`.
        max_impacts: impacts after which a start is left undecided.
        chatter: how a chatter ends; ``None`` sums it.

    Raises:
        InvalidError: ``"not-an-orbit"`` for an orbit of another map.

    >>> import bouncing_disk as bd
    >>> bouncing = bd.ImpactMap(axial_forcing=0.34, restitution=0.5)
    >>> phase, velocity = bouncing.period_one()
    >>> orbit = bouncing.refine(impact_phase=[phase], axial_impact_velocity=[velocity])
    >>> basins = bd.basins(bouncing, phases=64, speeds=20, speed_range=(0.0, 5.0), known_orbits=[orbit])
    >>> basins.labels.shape, basins.labels.dtype
    ((20, 64), dtype('uint8'))
    >>> basins.share(bd.FIRST_ORBIT) + basins.share(bd.ATTACHED)
    1.0
    """
    return native.basins(locals())


@dataclass(frozen=True, eq=False)
class BasinEntropy(Result):
    """The uncertainty of the fate of a start that is known only to within a box of cells, in natural units.

    Attributes:
        box_side: cells along each side of a box.
        boxes: whole boxes that fit into the grid.
        boundary_boxes: boxes with more than one label.
        undecided_cells: undecided cells in the boxes; undecided counts as a separate label.
        labels: number of labels in the boxes.
        entropy: the mean over the boxes of -sum p ln p, p being the shares of the labels in a box: at most
            the logarithm of the number of labels.
        boundary_entropy: the same mean over the boxes with more than one label; None if there is no such box.
    """

    box_side: int
    boxes: int
    boundary_boxes: int
    undecided_cells: int
    labels: int
    entropy: float
    boundary_entropy: float | None


def basin_entropy(basins: Basins, *, box_side: Int = 5) -> BasinEntropy:
    """The entropy of basins: the uncertainty of the fate of a start that is known only to within a box of cells.

    A. Daza and others, Sci. Rep. 6, 31416 (2016). A boundary entropy above ln 2 shows that the boundary is
    not smooth, if boxes are small compared with the basins; a smaller one proves nothing.

    Args:
        basins: as for :func:`basins` and :meth:`Attractors.basins`; undecided cells count as a separate basin.
        box_side: cells along each side of a box, from 2 to the length of the shorter side of the grid.

    >>> import bouncing_disk as bd
    >>> found = bd.attractors(bd.ImpactMap(axial_forcing=0.34, restitution=0.5))
    >>> entropy = bd.basin_entropy(found.basins(phases=100, speeds=100))
    >>> entropy.boxes, entropy.boundary_boxes > 0
    (400, True)
    """
    return native.basin_entropy(locals())


@dataclass(frozen=True, eq=False, repr=False)
class BoundaryScaling(Result):
    """The growth of the share of uncertain cells with the distance, at n distances.

    Attributes:
        distance: the distances, in cells, shape (n,).
        uncertain: cells that have another label within the square up to this distance along both axes, shape (n,).
        cells: examined cells, the same at each distance.
        fit: ``"power-law"``; ``"no-power-law"``, if the slopes between neighbouring distances differ
            by more than 0.05 and a fifth of their mean, as on too coarse a grid; or ``"too-few"``, if
            cells are uncertain at fewer than three distances.
        exponent, exponent_error: the share grows as ``distance**exponent``, and the standard error; NaN
            without a power law.
        dimension: dimension of the boundary, 2 minus the exponent: 1 for a smooth curve, at most 2; NaN
            without a power law.
        slopes: smallest and largest logarithmic slope between neighbouring distances; NaN if `fit` is ``"too-few"``.
    """

    distance: IntArray
    uncertain: IntArray
    cells: int
    fit: str
    exponent: float
    exponent_error: float
    dimension: float
    slopes: tuple[float, float]

    @property
    def share(self) -> FloatArray:
        """The share of the cells that are uncertain at each distance, in [0, 1], shape (n,)."""
        share: FloatArray = self.uncertain / max(self.cells, 1)
        return share


def boundary_scaling(
    basins: Basins, *, distances: Iterable[Int] = (1, 2, 4, 8), progress: Progress = None
) -> BoundaryScaling:
    """The growth of the share of uncertain cells with the distance: the dimension of a boundary of basins.

    S. W. McDonald and others, Physica D 17, 125 (1985). A cell is uncertain if the square up to a
    distance along both axes contains another label. Only cells farther from the edges of the
    grid than the largest distance count; undecided cells count as a separate basin.

    Args:
        basins: as for :func:`basins` and :meth:`Attractors.basins`.
        distances: distances in cells, rising, at least 1, the last less than half the shorter side of the
            grid.

    The basin of the period-1 orbit just above its birth has a smooth boundary:

    >>> import bouncing_disk as bd
    >>> found = bd.attractors(bd.ImpactMap(axial_forcing=0.34, restitution=0.5))
    >>> grid = found.basins(phases=120, speeds=120, max_impacts=20_000)
    >>> scaling = bd.boundary_scaling(grid, distances=[1, 2, 4])
    >>> scaling.fit, scaling.dimension < 1.2
    ('power-law', True)
    """
    return native.boundary_scaling(locals())


@dataclass(frozen=True, eq=False, repr=False)
class BasinFractions(Result):
    """The attractors of impact maps over the axial forcing, each followed from one forcing to the next, with the
    shares of their basins.

    Made by :func:`basin_fractions_over`. There are n forcings and m attractors; index 0 is the disk at rest.

    Attributes:
        restitution: coefficient of restitution.
        axial_forcing: axial forcing parameter Gamma, in the order in which attractors were followed, shape (n,).
        attractors: the attractors at each forcing: a tuple of n :class:`Attractors`.
        followed: for each attractor at a forcing, its index among the m attractors: a tuple of n int64 arrays.
        appears: the first forcing at which each attractor was found, by its index, shape (m,): it appears
            between this one and the one before.
        vanishes: the last forcing at which each was found, by its index, shape (m,): it vanishes between
            this one and the next.
        share: share of the starts that end on each attractor at each forcing, shape (m, n); NaN where it is
            absent. The starts are spread over all impacts that an attractor can have at this forcing.
        share_low: low end of its 95 % interval, shape (m, n).
        share_high: high end of its 95 % interval, shape (m, n).
        moved: distance of each attractor from its position at the previous forcing (rad; a radian counts as
            much as the peak velocity of the platform), shape (m, n); NaN where it appears or is absent, and
            for the disk at rest.
    """

    restitution: float
    axial_forcing: FloatArray
    attractors: tuple[Attractors, ...]
    followed: tuple[IntArray, ...]
    appears: IntArray
    vanishes: IntArray
    share: FloatArray
    share_low: FloatArray
    share_high: FloatArray
    moved: FloatArray

    def __len__(self) -> int:
        """Number of attractors."""
        return len(self.appears)


def basin_fractions_over(
    *,
    restitution: Float,
    axial_forcing: ArrayLike,
    reach: Float = 0.3,
    progress: Progress = None,
    **settings: Unpack[AttractorSearch],
) -> BasinFractions:
    """The attractors at each forcing, matched from one to the next, and the shares of their basins.

    Each attractor continues the nearest one at the previous forcing, if that is within `reach`;
    otherwise it is new. An attractor without a continuation vanishes. An orbit that doubles its period
    continues as the doubled orbit.

    Args:
        restitution: coefficient of restitution, in [0, 1).
        axial_forcing: axial forcing parameter Gamma, in the order in which attractors are followed; at
            most 65536, shape (n,).
        reach: largest distance of an attractor from its position at the previous forcing (rad), in [0, 100].
        settings: the fields of :class:`AttractorSearch`, as keywords.

    The period-1 orbit appears at Gamma = 1/3, next to the disk at rest:

    >>> import bouncing_disk as bd
    >>> found = bd.basin_fractions_over(restitution=0.5, axial_forcing=[0.32, 0.36, 0.4], starts=200)
    >>> found.appears
    array([0, 1])
    >>> found.share.shape, bool(found.share[1, 2] > found.share[1, 1])
    ((2, 3), True)
    """
    return native.basin_fractions_over(locals())
