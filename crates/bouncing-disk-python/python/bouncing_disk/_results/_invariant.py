"""What lies between orbits: exponents, manifolds, and lives beyond a crisis."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from bouncing_disk._results._base import ByteArray, FloatArray, IntArray, Result


@dataclass(frozen=True, eq=False, repr=False)
class LyapunovSpectra(Result):
    """Both Lyapunov exponents per impact of many orbits; NaN where there are none.

    Attributes
    ----------
    axial_forcing, restitution : (n,) float64 array
        The parameters of each orbit.
    outcome : (n,) uint8 array
        A place in :attr:`OUTCOMES`.
    largest, standard_error : (n,) float64 array
        The largest exponent, and its standard error by batch means.
    second : (n,) float64 array
        The other exponent; minus infinity for restitution 0.
    exact_sum : (n,) float64 array
        What the sum of both must be over these very impacts.
    impacts : (n,) int64 array
        Impacts that were measured over; up to the rest or the graze, with those of the transient, where there is
        one.
    phase : (n,) float64 array
        Phase (rad) of the impact that grazes the platform.
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
        """The outcome of each orbit in words, those of :attr:`OUTCOMES`."""
        return [self.OUTCOMES[outcome] for outcome in self.outcome]


@dataclass(frozen=True, eq=False, repr=False)
class Manifold(Result):
    """A manifold of a saddle: pieces without a jump, p in all, of m impacts, on b branches.

    The impacts of piece ``k`` are the items from ``offsets[k]`` to ``offsets[k + 1]``. Each impact of the saddle
    has two branches, on its later and its earlier side.

    Attributes
    ----------
    kind : str
        ``"stable"`` or ``"unstable"``.
    multiplier : float
        The Floquet multiplier that belongs to it.
    offsets : (p + 1,) int64 array
        Where the impacts of each piece begin; the last number is m.
    impact_phase : (m,) float64 array
        Phase of each impact (rad), in [0, 2 pi): between neighbours it may pass 2 pi.
    axial_impact_velocity : (m,) float64 array
        Its relative velocity, not positive, in units of g/omega.
    piece_branch : (p,) int64 array
        Of which branch each piece is.
    piece_start, piece_end : (p,) uint8 array
        Why it does not begin earlier, and why it ends: places in :attr:`PIECE_ENDS`.
    branch_impact : (b,) int64 array
        At which impact of the saddle each branch begins.
    branch_side : (b,) uint8 array
        On which side: a place in :attr:`SIDES`.
    branch_arclength : (b,) float64 array
        Its length (rad, and speeds in units of 1 + P).
    branch_generations : (b,) int64 array
        How often its first piece was mapped.
    branch_end : (b,) uint8 array
        Why it is not longer: a place in :attr:`BRANCH_ENDS`.
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

    @property
    def normalised_speed(self) -> FloatArray:
        """Normalised speed of each impact, shape (m,)."""
        speed: FloatArray = -self.axial_impact_velocity / np.pi
        return speed

    def of(self, piece: int) -> tuple[FloatArray, FloatArray]:
        """Phases (rad) and normalised speeds of the impacts of one piece, as views."""
        impacts = slice(self.offsets[:-1][piece], self.offsets[1:][piece])
        return self.impact_phase[impacts], self.normalised_speed[impacts]

    def branch_end_names(self) -> list[str]:
        """Why each branch is not longer, in words, those of :attr:`BRANCH_ENDS`."""
        return [self.BRANCH_ENDS[end] for end in self.branch_end]


@dataclass(frozen=True, eq=False, repr=False)
class CrisisLives(Result):
    """How long orbits live beyond a crisis, at n distances from it.

    Attributes
    ----------
    beyond : (n,) float64 array
        Gamma less that of the crisis.
    impacts : (n,) float64 array
        Mean life in impacts; infinity where no orbit ended.
    relative_error : (n,) float64 array
        Its standard error relative to it; infinity where no orbit ended.
    ended, orbits : (n,) int64 array
        Orbits that came to rest, and all of them.
    exponent, exponent_error : float
        The mean life goes as ``beyond**exponent``; NaN if it follows no power law.
    no_power_law : str or None
        Why it follows none.
    """

    beyond: FloatArray
    impacts: FloatArray
    relative_error: FloatArray
    ended: IntArray
    orbits: IntArray
    exponent: float
    exponent_error: float
    no_power_law: str | None
