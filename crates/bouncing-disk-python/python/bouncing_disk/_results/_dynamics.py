"""What the impact map and its orbits give."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
import numpy.typing as npt

from bouncing_disk._native import ImpactMap, PeriodicOrbit
from bouncing_disk._results._base import ByteArray, FloatArray, IntArray, Result


@dataclass(frozen=True, eq=False, repr=False)
class OrbitDiagram(Result):
    """The impacts of many orbits, one after the other.

    Those of orbit ``k`` are the items from ``offsets[k]`` to ``offsets[k + 1]``.

    Attributes
    ----------
    axial_forcing : (n,) float64 array
        Axial forcing parameter Gamma of each orbit.
    restitution : (n,) float64 array
        Coefficient of restitution of each orbit.
    offsets : (n + 1,) int64 array
        Where the impacts of each orbit begin; the last number is that of all impacts, m.
    impact_phase : (m,) float64 array
        Phase of each impact (rad), in [0, 2 pi).
    axial_impact_velocity : (m,) float64 array
        Velocity of the disk relative to the platform just before, not positive, in units of g/omega.

    Examples
    --------
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

    @property
    def normalised_speed(self) -> FloatArray:
        """Normalised impact speed |w_A Gamma/(omega A)| of each impact, shape (m,)."""
        speed: FloatArray = -self.axial_impact_velocity / np.pi
        return speed

    def column(self) -> IntArray:
        """Of which orbit each impact is, shape (m,): ``axial_forcing[diagram.column()]`` is the abscissa of a plot."""
        return np.repeat(np.arange(len(self.axial_forcing), dtype=np.int64), np.diff(self.offsets))

    def of(self, orbit: int) -> tuple[FloatArray, FloatArray]:
        """Phases (rad) and normalised speeds of the impacts of one orbit, as views."""
        impacts = slice(self.offsets[:-1][orbit], self.offsets[1:][orbit])
        return self.impact_phase[impacts], self.normalised_speed[impacts]


@dataclass(frozen=True, eq=False, repr=False)
class Basins(Result):
    """Basins of attraction on a grid of impacts.

    Attributes
    ----------
    impact_map : ImpactMap
        The map.
    labels : (speeds, phases) uint8 array
        What becomes of the start in each cell's centre; rows by rising speed.
    phase : (phases,) float64 array
        Impact phase of the cells' centres, in periods.
    speed : (speeds,) float64 array
        Normalised impact speed of the cells' centres.
    phase_range, speed_range : (float, float)
        Ends of the axes: ``(*phase_range, *speed_range)`` is the ``extent`` of a picture with
        ``origin="lower"``.
    meaning : tuple of str
        What each label means.

    Examples
    --------
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


@dataclass(frozen=True, eq=False)
class BasinEntropy(Result):
    """How uncertain the end of a start is that is known up to a box of cells; in natural units.

    Attributes
    ----------
    box_side : int
        Cells along each side of a box.
    boxes : int
        Boxes that fit into the grid whole.
    boundary_boxes : int
        Boxes with more than one label.
    undecided_cells : int
        Cells of the boxes that are undecided, which counts as a label of its own.
    labels : int
        Labels that occur in the boxes.
    entropy : float
        The mean over the boxes of -sum p ln p, p being the shares of the labels in a box: at most the
        logarithm of the number of labels.
    boundary_entropy : float or None
        The same mean over the boxes with more than one label; None if there is none.
    """

    box_side: int
    boxes: int
    boundary_boxes: int
    undecided_cells: int
    labels: int
    entropy: float
    boundary_entropy: float | None


@dataclass(frozen=True, eq=False, repr=False)
class BoundaryScaling(Result):
    """How the share of uncertain cells grows with their distance, at n distances.

    Attributes
    ----------
    distance : (n,) int64 array
        The distances, in cells.
    uncertain : (n,) int64 array
        Cells with another label than their own in the square up to this distance along both axes.
    cells : int
        Cells that were looked at, the same at each distance.
    fit : str
        ``"power-law"``; ``"no-power-law"``, where the slopes from one distance to the next differ by more
        than 0.05 and a fifth of their mean, as on a grid that is too coarse; or ``"too-few"``, where cells
        are uncertain at fewer than three distances.
    exponent, exponent_error : float
        The share grows as ``distance**exponent``, and the standard error; NaN without a power law.
    dimension : float
        The boundary's dimension, 2 less the exponent: 1 of a smooth curve, up to 2; NaN without a power law.
    slopes : (float, float)
        The smallest and the largest slope from one distance to the next, in the logarithms; NaN of too few.
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


@dataclass(frozen=True, eq=False, repr=False)
class Verdicts(Result):
    """What many orbits do for good, and the evidence; numbers that a verdict does not have are 0 or NaN.

    Attributes
    ----------
    axial_forcing, restitution : (n,) float64 array
        The parameters of each orbit.
    kind : (n,) uint8 array
        The verdict: a place in :attr:`KINDS`.
    reason : (n,) uint8 array
        Why there is none: a place in :attr:`REASONS`.
    period : (n,) int64 array
        Impacts of one period of a periodic orbit or of one round of a chattering one.
    platform_periods : (n,) int64 array
        Periods of the platform that this takes.
    after : (n,) int64 array
        Impacts after which the verdict was known.
    rests : (n,) int64 array
        How often the disk came to rest on the way.
    exponent, standard_error : (n,) float64 array
        The largest Lyapunov exponent per impact and its standard error, where it was measured.
    rounding_error : (n,) float64 array
        How far rounding may have carried the impacts of a chattering round (rad and g/omega).
    multipliers : (n, 2) complex128 array
        Floquet multipliers of a periodic orbit, also of a neutral or repelling one that is stayed at.
    """

    KINDS: ClassVar[tuple[str, ...]] = ("periodic", "chaotic", "chattering", "at-rest", "undecided")
    REASONS: ClassVar[tuple[str, ...]] = (
        "",
        "exponent-near-zero",
        "no-period-found",
        "grazing",
        "on-periodic-orbit",
        "transient-may-last",
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
    multipliers: npt.NDArray[np.complex128]

    def names(self) -> list[str]:
        """The verdicts in words, those of :attr:`KINDS`."""
        return [self.KINDS[kind] for kind in self.kind]

    def reasons(self) -> list[str]:
        """Why there is no verdict, those of :attr:`REASONS`: an empty text where there is one."""
        return [self.REASONS[reason] for reason in self.reason]


@dataclass(frozen=True, eq=False)
class Attractor(Result):
    """An attractor of an impact map.

    Attributes
    ----------
    kind : str
        ``"rest"``, ``"periodic"``, ``"marginal"``, ``"chaotic"`` or ``"unclassified"``.
    label : int
        Its label in :attr:`Basins.labels`.
    orbit : PeriodicOrbit or None
        The orbit of a periodic or marginal one.
    radius : float
        The radius (rad) within which a start counts as caught by that orbit, else NaN.
    exponent, standard_error : float
        The largest Lyapunov exponent per impact of a chaotic one and its standard error, else NaN.
    share : float
        The share of the starts that ended on it.
    interval : (float, float)
        Its 95 % interval.
    lasts : bool
        Whether the motion lasts: not that of a disk which rests and never does so again.
    leads_to : int or None
        The number of the attractor that a rest leads to.
    meaning : str
        What it is, in words.
    is_exact : bool
        False of a disk that comes to rest again and again in a cycle which rounding has chosen.
    """

    kind: str
    label: int
    orbit: PeriodicOrbit | None
    radius: float
    exponent: float
    standard_error: float
    share: float
    interval: tuple[float, float]
    lasts: bool
    leads_to: int | None
    meaning: str
    is_exact: bool


@dataclass(frozen=True, eq=False)
class Bifurcation(Result):
    """A special point of a branch of periodic orbits.

    Attributes
    ----------
    kind : str
        ``"doubling"``, ``"fold"``, ``"graze"``, ``"vanishing-impact"`` or ``"birth"``.
    parameter : float
        The value of the parameter.
    arclength : float
        Arclength from the start of the branch.
    impact : int or None
        Which impact grazes or vanishes.
    orbit : PeriodicOrbit
        The orbit there.
    """

    kind: str
    parameter: float
    arclength: float
    impact: int | None
    orbit: PeriodicOrbit


@dataclass(frozen=True, eq=False, repr=False)
class DoublingCascade(Result):
    """A period-doubling cascade; n doublings, and Feigenbaum's numbers from some of them.

    Attributes
    ----------
    period : (n,) int64 array
        Impacts of the orbit that loses its stability.
    axial_forcing, forcing_error : (n,) float64 array
        The forcing Gamma_n, and how far rounding may have moved it.
    multiplier : (n,) float64 array
        The multiplier that the search left, -1 but for rounding.
    width : (n,) float64 array
        The largest distance (rad) of an impact from the one half a period later.
    graze_margin : (n,) float64 array
        How near a flight comes to an earlier impact, in units of g/omega^2; infinite where none dips.
    feigenbaum_number : (m,) int64 array
        The last doubling that was used for each estimate, from 1.
    delta, delta_error, alpha, alpha_error : (m,) float64 array
        Feigenbaum's numbers, extrapolated, and how far they may be off.
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
