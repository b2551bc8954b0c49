"""The disk and its platform in SI units, and the rule that ends a chatter."""

# mypy: disable-error-code="no-any-return"
from __future__ import annotations

import json as json_module
from collections.abc import Iterable
from dataclasses import asdict, dataclass, field
from typing import Any

import numpy as np

from bouncing_disk import _native as native
from bouncing_disk._base import *

__all__ = [
    "ChatterCut",
    "Drive",
    "System",
]


class System(Parameters):
    """A disk on a vibrating and twisting platform, in SI units.

    Every value is checked as the object is made; the object never changes.

    Args:
        amplitude: amplitude A of the platform's height (m), not negative.
        twist_amplitude: amplitude Phi of its angle (rad), not negative.
        angular_frequency: angular frequency omega (rad/s), positive.
        phase_lag: phase lag theta of the twist (rad).
        contact_radius: effective contact radius a_e (m) of the disk, positive.
        gyration_radius: radius of gyration a_g (m), positive.
        friction: coefficient of friction mu, not negative.
        restitution: coefficient of restitution, in [0, 1).
        preload_acceleration: preload acceleration g (m/s^2), positive.
        load_acceleration: angular deceleration by a load torque (rad/s^2).

    Attributes:
        period: period of the platform (s).
        peak_angular_speed: largest angular speed omega Phi of the platform (rad/s).
        stroke: stroke c = (A^2 + (a_e Phi)^2)^(1/2) at the contact radius (m), Eq. (13).
        amplitude_angle: amplitude angle phi_L = arctan(a_e Phi/A) (rad): 0 lifts, pi/2 turns; 0 where nothing
            moves.
        axial_forcing: axial forcing parameter Gamma = A omega^2/(pi g).
        angular_forcing: angular forcing parameter Gamma_T = a_g^2 Phi omega^2/(a_e pi g mu); None without
            friction.
        peak_acceleration: peak acceleration A omega^2/g of the platform in units of the preload acceleration.
        rise_time: time (s) in which friction that pushes one way gives the disk the platform's largest
            angular speed.

    >>> import bouncing_disk as bd
    >>> toss = bd.System.pizza_toss()
    >>> round(toss.axial_forcing, 3)
    1.558
    >>> toss.replace(friction=0.05).friction
    0.05
    """

    amplitude: float
    twist_amplitude: float
    angular_frequency: float
    phase_lag: float
    contact_radius: float
    gyration_radius: float
    friction: float
    restitution: float
    preload_acceleration: float
    load_acceleration: float
    period: float
    peak_angular_speed: float
    stroke: float
    amplitude_angle: float
    axial_forcing: float
    angular_forcing: float | None
    peak_acceleration: float
    rise_time: float

    def __init__(
        self,
        *,
        amplitude: Float,
        twist_amplitude: Float,
        angular_frequency: Float,
        phase_lag: Float = 0.0,
        contact_radius: Float,
        gyration_radius: Float,
        friction: Float,
        restitution: Float,
        preload_acceleration: Float,
        load_acceleration: Float = 0.0,
    ) -> None:
        self.__dict__["_native"] = native.system(locals())

    @staticmethod
    def pizza_toss() -> System:
        """The pizza toss of Table I of the paper."""
        return System._holding(native.known_system("pizza_toss"))

    @staticmethod
    def motor() -> System:
        """The motor of Table III of the paper."""
        return System._holding(native.known_system("motor"))

    def replace(self, **changes: Any) -> System:
        """The same system with other arguments."""
        # As _holding() does, without its call: thousands of tosses are asked for.
        made = System.__new__(System)
        made.__dict__["_native"] = self._native.replaced(changes)
        return made

    def to_dict(self) -> dict[str, Any]:
        """The parameters as the Rust library stores them: ``{"platform": {...}, "disk": {...}}``."""
        parts = list(self._given.items())
        return {"platform": dict(parts[:4]), "disk": dict(parts[4:])}

    @classmethod
    def from_dict(cls, parameters: dict[str, Any]) -> System:
        """The system of such a dictionary."""
        if not isinstance(parameters, dict) or set(parameters) != {"platform", "disk"}:
            raise TypeError("a system is a dictionary of two: its platform and its disk")
        return System(**parameters["platform"], **parameters["disk"])


@dataclass(frozen=True)
class Drive:
    """How a platform moves in place of the sine: the table ``[drive]`` of the command line's files.

    A shape multiplies the amplitude of the platform: ``"sine"``, ``"triangle"``, ``"parabolas"``, ``"cubics"``, or a
    dictionary of one item, ``sawtooth``, ``fourier``, ``pieces`` or ``sampled``. The shapes are checked as the object is made.

    Args:
        height, angle: the shapes; the angle is the phase lag earlier. One that is left out is the plain sine, whatever
            the other one is: a recorded motion needs both.
        start_phase, segments, then: a schedule for files of the command line; the calls of this package refuse it.
            Where it starts (rad); dictionaries of ``periods``, ``amplitude``, ``ramp_to``, ``frequency`` and ``lag``;
            ``"repeat"`` the last one, or ``"rest"``.

    >>> import bouncing_disk as bd
    >>> bd.Drive.sawtooth(0.3)
    Drive(height={'sawtooth': 0.3}, angle='sine', start_phase=0.0, segments=[], then='repeat')
    >>> bd.Drive.from_json(bd.Drive.parabolas().to_json()) == bd.Drive(height="parabolas")
    True
    """

    height: Any = "sine"
    angle: Any = "sine"
    start_phase: float = 0.0
    segments: list[dict[str, float]] = field(default_factory=list)
    then: str = "repeat"

    def __post_init__(self) -> None:
        native.check_drive(locals())

    @staticmethod
    def fourier(height: Iterable[Pair], angle: Iterable[Pair] | None = None) -> Drive:
        """Sums of a_j sin(j tau + phi_j) over j = 1, 2, ...: pairs of a_j and phi_j (rad), at most 32.

        Args:
            height: those of the height.
            angle: those of the angle; the sine unless given.
        """
        return Drive._of(lambda sums: {"fourier": np.asarray(list(sums), float).tolist()}, height, angle)

    @staticmethod
    def pieces(height: Iterable[Any], angle: Iterable[Any] | None = None) -> Drive:
        """Polynomials one after the other: pairs of a duration and (c0, c1, c2, c3), in periods from its start.

        Args:
            height: those of the height, which is continuous; its velocity may jump.
            angle: those of the angle; the sine unless given.
        """
        return Drive._of(
            lambda all: {"pieces": [[float(d), np.asarray(c, float).tolist()] for d, c in all]}, height, angle
        )

    @staticmethod
    def sampled(height: ArrayLike, angle: ArrayLike | None = None) -> Drive:
        """The periodic cubic spline through samples at equal distances over one period.

        Args:
            height: at least 3 heights, in multiples of the amplitude, shape (n,).
            angle: those of the angle; the sine unless given.
        """
        return Drive._of(lambda samples: {"sampled": np.asarray(samples, float).tolist()}, height, angle)

    @staticmethod
    def triangle() -> Drive:
        """A height of straight lines through the zeros and extremes of the sine."""
        return Drive("triangle")

    @staticmethod
    def sawtooth(rise: Float) -> Drive:
        """A height of straight lines.

        Args:
            rise: share of the period in which it rises, in [1e-9, 1 - 1e-9].
        """
        return Drive({"sawtooth": float(rise)})

    @staticmethod
    def parabolas() -> Drive:
        """A height of one parabola for each half of the period."""
        return Drive("parabolas")

    @staticmethod
    def _of(shape: Any, height: Any, angle: Any) -> Drive:
        return Drive(shape(height), "sine" if angle is None else shape(angle))

    def to_json(self) -> str:
        """The table as JSON."""
        return json_module.dumps(asdict(self), allow_nan=False)

    @staticmethod
    def from_json(json: str) -> Drive:
        """The drive of such a text."""
        return Drive(**json_module.loads(readable(json)))


class ChatterCut(Parameters):
    """Put a chattering disk on the platform by a rule, as simulations impact by impact do.

    Without one (``chatter=None``) the infinite sequence of impacts is summed in closed form.

    Args:
        smallest_speed: normalised impact speed, not negative, below which the disk is put on the platform.
        short_flight: duration, not negative, in periods of the platform, below which a flight is short.
        short_flights: how many consecutive short flights put the disk on the platform, at least 1.

    >>> import bouncing_disk as bd
    >>> bd.ChatterCut(smallest_speed=1e-6, short_flight=0.01, short_flights=50)
    ChatterCut(smallest_speed=1e-06, short_flight=0.01, short_flights=50)
    """

    smallest_speed: float
    short_flight: float
    short_flights: int

    def __init__(self, *, smallest_speed: Float, short_flight: Float, short_flights: Int) -> None:
        self.__dict__["_native"] = native.chatter_cut(locals())

    @staticmethod
    def paper() -> ChatterCut:
        """The rule of the paper's simulations."""
        return ChatterCut._holding(native.paper_cut())
