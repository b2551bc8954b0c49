"""The disk and its platform in SI units, and the rule that ends a chatter."""

# mypy: disable-error-code="no-any-return"
from __future__ import annotations

import sys
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, TypeAlias
from warnings import warn

from bouncing_disk import _native as native
from bouncing_disk._base import *

__all__ = [
    "ChatterCut",
    "Drive",
    "System",
]

#: The name of a shape, or a dictionary of one.
Shape: TypeAlias = str | Mapping[str, Any]


def _callers_level() -> int:
    """The ``stacklevel`` at which the caller of this function warns of a line outside of this package."""
    frame, level = sys._getframe(1), 1
    while frame.f_back is not None and Path(frame.f_code.co_filename).parent == Path(__file__).parent:
        frame, level = frame.f_back, level + 1
    return level


class System(Parameters):
    """A disk on a vibrating and twisting platform, in SI units.

    Every value is checked on construction; the object is immutable.

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
        contact, stator: the tables ``[contact]`` and ``[stator]`` of a file, as for :class:`Motor`;
            ``[contact]`` needs the ``mass`` of the disk unless it has a time. Calls that do not support them
            raise an error.

    Attributes:
        period: period of the platform (s).
        peak_angular_speed: largest angular speed omega Phi of the platform (rad/s).
        stroke: stroke c = (A^2 + (a_e Phi)^2)^(1/2) at the contact radius (m), Eq. (13).
        amplitude_angle: amplitude angle phi_L = arctan(a_e Phi/A) (rad): 0 for pure lift, pi/2 for pure
            twist; 0 without motion.
        axial_forcing: axial forcing parameter Gamma = A omega^2/(pi g).
        angular_forcing: angular forcing parameter Gamma_T = a_g^2 Phi omega^2/(a_e pi g mu); None without
            friction.
        peak_acceleration: peak acceleration A omega^2/g of the platform in units of the preload acceleration.
        rise_time: time (s) in which friction acting in one direction accelerates the disk to the platform's largest
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
        contact: Table | None = None,
        stator: Table | None = None,
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
        # Like _holding(), but inlined: a program may make thousands of tosses.
        made = System.__new__(System)
        made.__dict__["_native"] = self._native.replaced(changes)
        return made

    def to_dict(self) -> dict[str, Any]:
        """The parameters as the Rust library stores them: ``{"platform": {...}, "disk": {...}}``, and the tables."""
        parts = list(super().to_dict().items())
        return {"platform": dict(parts[:4]), "disk": dict(parts[4:10]), **dict(parts[10:])}

    @classmethod
    def from_dict(cls, parameters: dict[str, Any]) -> System:
        """The system from a dictionary as returned by :meth:`to_dict`."""
        tables = dict(parameters) if isinstance(parameters, dict) else {}
        platform, disk = tables.pop("platform", None), tables.pop("disk", None)
        if platform is None or disk is None or not set(tables) <= {"contact", "stator"}:
            raise TypeError("a system is a dictionary of its platform and its disk, and perhaps its contact and its stator")
        return System(**platform, **disk, **tables)


class Drive(Parameters):
    """Motion of a platform other than the sine: the table ``[drive]`` of the command line's files.

    A shape multiplies the amplitude of the platform: ``"sine"``, ``"triangle"``, ``"parabolas"``, ``"cubics"``, or a
    dictionary of one item, ``sawtooth``, ``fourier``, ``pieces`` or ``sampled``. The shapes are checked on
    construction; unlikely samples, such as a last one that repeats the first, give a warning.

    Args:
        height, angle: the shapes; the angle leads by the phase lag. A missing shape is the plain sine, whatever the
            other shape: a recorded motion needs both.
        start_phase: phase (rad) at which the command line's toss starts; the calls of this package reject it.

    >>> import bouncing_disk as bd
    >>> bd.Drive.sawtooth(0.3)
    Drive(height={'sawtooth': 0.3}, angle='sine', start_phase=None)
    >>> bd.Drive.from_json(bd.Drive.parabolas().to_json()) == bd.Drive(height="parabolas")
    True
    """

    height: Any
    angle: Any
    start_phase: float | None

    def __init__(
        self,
        height: Shape = "sine",
        angle: Shape = "sine",
        start_phase: Float | None = None,
    ) -> None:
        self.__dict__["_native"] = native.drive(locals())
        for warning in self._native.warnings():
            warn(warning, UserWarning, stacklevel=_callers_level())

    @staticmethod
    def fourier(height: Iterable[Pair], angle: Iterable[Pair] | None = None) -> Drive:
        """Sums of a_j sin(j tau + phi_j) over j = 1, 2, ...: pairs of a_j and phi_j (rad), at most 32.

        Args:
            height: the terms of the height.
            angle: the terms of the angle; by default the sine.
        """
        return Drive._of("fourier", height, angle)

    @staticmethod
    def pieces(height: Iterable[Any], angle: Iterable[Any] | None = None) -> Drive:
        """Successive polynomials: pairs of a duration and (c0, c1, c2, c3), in periods from its start.

        Args:
            height: the pieces of the height, which is continuous; its velocity may jump.
            angle: the pieces of the angle; by default the sine.
        """
        return Drive._of("pieces", height, angle)

    @staticmethod
    def sampled(height: ArrayLike, angle: ArrayLike | None = None) -> Drive:
        """The periodic cubic spline through equidistant samples over one period.

        Args:
            height: at least 3 heights, in multiples of the amplitude, shape (n,); the first one is not repeated at the end.
            angle: samples of the angle; by default the sine.
        """
        return Drive._of("sampled", height, angle)

    @staticmethod
    def triangle() -> Drive:
        """A piecewise linear height through the zeros and extremes of the sine."""
        return Drive("triangle")

    @staticmethod
    def sawtooth(rise: Float) -> Drive:
        """A height that rises and falls linearly.

        Args:
            rise: share of the period in which it rises, in [1e-9, 1 - 1e-9].
        """
        return Drive({"sawtooth": rise})

    @staticmethod
    def parabolas() -> Drive:
        """A height with one parabola in each half of the period."""
        return Drive("parabolas")

    @staticmethod
    def _of(kind: str, height: Any, angle: Any) -> Drive:
        return Drive({kind: height}, "sine" if angle is None else {kind: angle})


class ChatterCut(Parameters):
    """A rule that puts a chattering disk on the platform, as impact-by-impact simulations need.

    Without such a rule (``chatter=None``) the infinite sequence of impacts is summed in closed form.

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
