"""Motors: data sheets, operating points, stall, sweeps, traps and sensitivities."""

# mypy: disable-error-code="no-any-return"
from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Literal, TypedDict

from bouncing_disk import _native as native
from bouncing_disk._base import *
from bouncing_disk._system import Drive, System

if TYPE_CHECKING:
    from typing_extensions import Unpack

__all__ = [
    "Best",
    "InputSpread",
    "LocalSensitivities",
    "LowPeriodTraps",
    "Motor",
    "MotorMap",
    "MotorReport",
    "NearestTrap",
    "OperatingPoints",
    "OperatingSettings",
    "StallLoad",
    "TorqueSpeedCurve",
    "best",
    "input_spreads",
    "local_sensitivities",
    "low_period_traps",
    "motor_map",
    "nearest_trap",
    "stall_load",
    "torque_speed_curve",
]


@dataclass(frozen=True, eq=False)
class MotorReport(Result):
    """The consequences of a data sheet, before any run.

    Attributes:
        axial_forcing: axial forcing parameter Gamma.
        angular_forcing: angular forcing parameter Gamma_T; None without friction.
        peak_acceleration: the stator's largest acceleration in units of the preload acceleration.
        regime: ``"no-lift-off"``, ``"periodic"``, ``"low-period-chattering"``, ``"long-chattering"``,
            ``"chaotic"`` or ``"undecided"``.
        regime_impacts: impacts of a cycle, or impacts examined.
        regime_platform_periods: periods of the stator in a cycle, or between two rests on average; NaN if
            nothing repeats.
        regime_rests: number of rests seen in long chattering.
        lyapunov_exponent: growth per impact of a chaotic motion, else NaN.
        periods_per_flight: mean number of the stator's periods in a flight longer than half a period.
        largest_torque: the largest mean torque of friction (N m).
        static_deflection: static deflection of the preload spring (m).
        preload_change_bound: bound on the relative change of the preload in a flight.
        warnings: values that are unlikely to be intended.
        text: the printed report.
    """

    axial_forcing: float
    angular_forcing: float | None
    peak_acceleration: float
    regime: str
    regime_impacts: int
    regime_platform_periods: float
    regime_rests: int
    lyapunov_exponent: float
    periods_per_flight: float | None
    largest_torque: float
    static_deflection: float | None
    preload_change_bound: float | None
    warnings: tuple[str, ...]
    text: str

    def __str__(self) -> str:
        """The text."""
        return self.text


class Motor(Parameters):
    """A motor by its data sheet, in SI units.

    Give exactly one of each pair of alternatives: ``peak_angular_speed`` or ``twist_amplitude``, ``mass``
    or ``density``, ``preload_force`` or ``preload_acceleration``.

    Args:
        drive_frequency: drive frequency omega/(2 pi) (Hz), positive.
        amplitude: axial amplitude A of the stator (m), not negative; without a rotor if the stator is
            compliant.
        peak_angular_speed: largest angular speed omega Phi of the stator (rad/s), not negative.
        twist_amplitude: twist amplitude Phi of the stator (rad), not negative.
        phase_lag: phase lag theta of the twist (rad).
        mass: mass m of the rotor (kg), positive.
        density: density of the rotor (kg/m^3), positive, with ``rotor_radius`` and ``rotor_thickness`` of a
            solid disc.
        rotor_radius, rotor_thickness: outer radius and thickness of the rotor (m), positive.
        contact_radius: effective contact radius a_e (m), positive.
        gyration_radius: radius of gyration a_g (m), positive; by default the value of a solid disc if a rotor radius
            is given.
        preload_force: the total force that presses the rotor onto the stator (N), positive.
        preload_acceleration: this force over the mass (m/s^2), positive.
        spring_constant: constant of the preload spring (N/m), positive.
        friction: coefficient of friction mu, not negative.
        restitution: coefficient of restitution, in [0, 1).
        load_torque: load torque T_L (N m); a positive one decelerates a positive rotation.
        contact: the table ``[contact]`` of a file: ``time`` (s) and ``law`` of compliant contacts, or the
            ``materials`` (two names), the ``geometry`` and its sizes, from which a report estimates the time.
        stator: the table ``[stator]`` of a file for a compliant stator, by field names (SI): ``mass`` and
            ``quality``; instead of ``amplitude`` also ``force``, or ``volts`` with ``force_per_volt`` or with
            ``anti_resonance`` and ``capacitance``; docs/designing-a-motor.md lists all fields.
        load: the table ``[load]`` of a file for a varying load: the lists ``torques`` (N m) and ``speeds``
            (rad/s), and ``inertia`` (kg m^2).
        drive: motion of the stator other than the sine: a :class:`Drive`, or the table ``[drive]`` of a file.
            Not with ``stator`` or ``load``.

    Attributes:
        inertia: moment of inertia m a_g^2 of the rotor (kg m^2).
        largest_torque: mu m g a_e (N m), the largest possible mean torque.
        static_deflection: static deflection of the preload spring (m); None without one.
        system: the system without the mass.

    >>> import bouncing_disk as bd
    >>> motor = bd.Motor(drive_frequency=70e3, amplitude=1e-8, peak_angular_speed=30.0, mass=1e-3, contact_radius=1.25e-3,
    ...     gyration_radius=6.3e-3, preload_acceleration=9.8, friction=0.1, restitution=0.5)
    >>> motor.replace(friction=0.2).friction
    0.2
    >>> bd.Motor.from_json(motor.to_json()) == motor
    True
    """

    drive_frequency: float
    amplitude: float
    peak_angular_speed: float
    twist_amplitude: float
    phase_lag: float
    mass: float
    inertia: float
    contact_radius: float
    gyration_radius: float
    preload_force: float
    preload_acceleration: float
    friction: float
    restitution: float
    load_torque: float
    largest_torque: float
    static_deflection: float | None
    system: System

    def __init__(
        self,
        *,
        drive_frequency: Float,
        amplitude: Float | None = None,
        peak_angular_speed: Float | None = None,
        twist_amplitude: Float | None = None,
        phase_lag: Float = 0.0,
        mass: Float | None = None,
        density: Float | None = None,
        rotor_radius: Float | None = None,
        rotor_thickness: Float | None = None,
        contact_radius: Float,
        gyration_radius: Float | None = None,
        preload_force: Float | None = None,
        preload_acceleration: Float | None = None,
        spring_constant: Float | None = None,
        friction: Float,
        restitution: Float,
        load_torque: Float = 0.0,
        contact: Table | None = None,
        stator: Table | None = None,
        load: Table | None = None,
        drive: Drive | Table | None = None,
    ) -> None:
        self.__dict__["_native"] = native.motor(locals())

    def replace(self, **changes: Float | Drive | Mapping[str, Any] | None) -> Motor:
        """The same motor with other values in its data sheet.

        Args:
            **changes: arguments of :class:`Motor`; None removes a value. A number replaces
                its alternative: on a motor with a ``preload_acceleration``, setting
                ``preload_force`` is enough.

        >>> import bouncing_disk as bd
        >>> pressed = bd.Motor.paper_70_khz().replace(preload_force=0.02)
        >>> "preload_acceleration" in pressed.to_dict()
        False
        """
        kept = dict(self._given)
        for name, value in changes.items():
            # Naming both alternatives is an error.
            for other in native.excluded_by(name) if value is not None else ():
                kept.pop(other, None)
        return Motor.from_dict({**kept, **changes})

    def report(self, *, progress: Progress = None) -> MotorReport:
        """The consequences of the data sheet, before any run: forcing, regime, largest torque. The load affects
        only the warning of an overload.
        """
        return native.report(locals())

    def stator_report(self) -> dict[str, float] | None:
        """Derived quantities of a compliant stator, before any run; None without one.

        Returns:
            By name: ``mass_ratio``, the stator's effective mass over that of the rotor; ``amplitude_without_rotor`` (m);
            ``force``, the amplitude of the drive's force (N); with a circuit ``volts`` (V),
            ``current_without_rotor`` (A) and ``power_without_rotor`` (W); ``lift_off_preload`` (N), the
            preload above which a rotor at rest is not lifted.

        >>> import bouncing_disk as bd
        >>> motor = bd.Motor.paper_70_khz().replace(amplitude=1e-7, stator={"mass": 0.05, "quality": 300.0})
        >>> print(f"{motor.stator_report()['lift_off_preload']:.3f} N")
        3.224 N
        """
        return native.stator_report(locals())

    @staticmethod
    def paper_70_khz() -> Motor:
        """The motor of the paper's Table III, driven at 70 kHz.

        The paper does not print its mass, which is taken to be that of a solid steel ball with the printed diameter
        of 20 mm.
        """
        return Motor._holding(native.known_motor("70", ""))

    @staticmethod
    def paper_184_khz() -> Motor:
        """The same motor, driven at 184 kHz as in the paper."""
        return Motor._holding(native.known_motor("184", ""))

    @staticmethod
    def from_toml(toml: str) -> Motor:
        """The motor of a data sheet in TOML, as written by the command line's ``--template``.

        Args:
            toml: the text of the file.

        >>> import bouncing_disk as bd
        >>> text = "\\n".join(f"{key} = {value!r}" for key, value in bd.Motor.paper_70_khz().to_dict().items())
        >>> bd.Motor.from_toml(text) == bd.Motor.paper_70_khz()
        True
        """
        return Motor._holding(native.known_motor("toml", readable(toml)))

    def to_json(self) -> str:
        """The data sheet as JSON for the Rust library and its command line."""
        return self._native.to_json()

    @classmethod
    def from_json(cls, json: str) -> Motor:
        """The motor from a string as returned by :meth:`to_json`; errors name the line."""
        return Motor._holding(native.known_motor("json", readable(json)))


class OperatingSettings(TypedDict, total=False):
    """Settings of a steady operation: keywords of all functions that run a motor.

    Args:
        relative_error: requested standard error of the mean speed, relative to this speed or, if it is larger, the
            no-load speed, in [1e-6, 0.5]; by default 0.01.
        members: vertical motions to average over, in [4, 4096]; by default 16.
        most_impacts: largest number of impacts of all members together, in [1, 1e15]; by default 20 million.
        relaunch_perturbation: size of the relaunch perturbation in units of g/omega, in (0, 1]; by default
            0.001.
        seed: seed of the perturbations; by default 1.
    """

    relative_error: Float
    members: Int
    most_impacts: Int
    relaunch_perturbation: Float
    seed: Int


@dataclass(frozen=True, eq=False, repr=False)
class OperatingPoints(Result):
    """Steady operation of motors under their loads: arrays of one shape.

    Fields ``..._error`` are standard errors; undefined numbers are NaN.

    Attributes:
        load_torque: load torque (N m); with a ``load``, its mean torque.
        speed, speed_error: mean angular speed (rad/s).
        mechanical_power, mechanical_power_error: load torque times mean speed (W).
        input_power, input_power_error: power supplied by the stator (W).
        restitution_loss, restitution_loss_error, friction_loss, friction_loss_error: power lost in impacts
            and in friction (W).
        efficiency, efficiency_error: mechanical power over supplied power.
        speed_deviation, speed_deviation_error: standard deviation of the speed over time (rad/s); NaN for a rotor
            that acts back on its stator, like all fields below up to the blocked torque.
        speed_low, speed_low_error, speed_high, speed_high_error: range (rad/s) in which the speed of the rotor lies
            for 95 % of the time, or always if the motion repeats itself.
        time_constant, time_constant_error: time constant of the speed (s), from the difference in speed to the
            nearest other requested load; NaN for a locked motor and for a single load.
        unstable_speed, unstable_speed_error: under a load that falls with the speed and allows two steady
            speeds, the speed between them (rad/s) that separates their ranges of attraction; else NaN.
        blocked_torque, blocked_torque_error: mean torque (N m) of friction on a rotor held at rest.
        stator_amplitude, stator_amplitude_error: amplitude of a compliant stator under load (m): 2^(1/2) times the
            root mean square speed of its axial mode over the angular frequency of the drive, without any static sag.
            This field and the next three are NaN for other stators.
        drive_power, drive_power_error: power supplied by the drive to a compliant stator (W).
        damping_loss, damping_loss_error: power lost in the damping of its modes (W).
        electrical_efficiency, electrical_efficiency_error: mechanical power over drive power.
        load_torque_error: standard error of the load torque; 0 if it is constant.
        perturbation_power: power supplied by the relaunch perturbations (W).
        energy_residual: relative residual of the energy balance.
        averaged_time, start_up: averaged time of all members together, and omitted time of each (s).
        acceleration: limiting acceleration (rad/s^2) of a motor that its load overpowers, else NaN.
        impacts: impacts of all members.
        status: an index into :attr:`STATUSES`.
        motion: vertical motion of the rotor, an index into :attr:`MOTIONS`.
        life: mean lifetime (s) of an irregular motion that ended, else NaN.
        others: the same fields for coexisting motions, the most frequent from rest first; NaN and the status ``none``
            if there are fewer.
    """

    STATUSES: ClassVar[tuple[str, ...]] = ("steady", "unsettled", "runaway", "depends-on-start", "none")
    MOTIONS: ClassVar[tuple[str, ...]] = ("none", "irregular", "periodic", "contact")

    load_torque: FloatArray
    speed: FloatArray
    speed_error: FloatArray
    mechanical_power: FloatArray
    mechanical_power_error: FloatArray
    input_power: FloatArray
    input_power_error: FloatArray
    restitution_loss: FloatArray
    restitution_loss_error: FloatArray
    friction_loss: FloatArray
    friction_loss_error: FloatArray
    efficiency: FloatArray
    efficiency_error: FloatArray
    speed_deviation: FloatArray
    speed_deviation_error: FloatArray
    speed_low: FloatArray
    speed_low_error: FloatArray
    speed_high: FloatArray
    speed_high_error: FloatArray
    time_constant: FloatArray
    time_constant_error: FloatArray
    unstable_speed: FloatArray
    unstable_speed_error: FloatArray
    blocked_torque: FloatArray
    blocked_torque_error: FloatArray
    stator_amplitude: FloatArray
    stator_amplitude_error: FloatArray
    drive_power: FloatArray
    drive_power_error: FloatArray
    damping_loss: FloatArray
    damping_loss_error: FloatArray
    electrical_efficiency: FloatArray
    electrical_efficiency_error: FloatArray
    load_torque_error: FloatArray
    perturbation_power: FloatArray
    energy_residual: FloatArray
    averaged_time: FloatArray
    start_up: FloatArray
    acceleration: FloatArray
    impacts: IntArray
    status: ByteArray
    motion: ByteArray
    life: FloatArray
    others: tuple[OperatingPoints, ...]


@dataclass(frozen=True, eq=False, repr=False)
class TorqueSpeedCurve(OperatingPoints):
    """Steady operation of a motor under n loads; all arrays have the shape (n,)."""

    def names(self) -> list[str]:
        """The status of each point in the words of :attr:`STATUSES`."""
        return [self.STATUSES[status] for status in self.status]


def torque_speed_curve(
    motor: Motor,
    *,
    load_torques: ArrayLike | None = None,
    drive: Drive | None = None,
    contact_time: Float | None = None,
    progress: Progress = None,
    **settings: Unpack[OperatingSettings],
) -> TorqueSpeedCurve:
    """Speed, power and efficiency of a motor over its load.

    Args:
        load_torques: load torques (N m), which replace that of the data sheet, and add to its ``load``, shape
            (n,).
        drive: motion of the stator, instead of the drive of the data sheet; a compliant stator allows only the
            sine.
        contact_time: duration of an impact (s), positive; ``None`` for rigid impacts.
        settings: the fields of :class:`OperatingSettings`, as keywords.
    """
    return native.torque_speed_curve(locals())


@dataclass(frozen=True)
class StallLoad:
    """The load at which a motor stops.

    Attributes:
        torque, torque_error: the torque and its standard error (N m).
        share: the torque as a share of the largest mean torque of friction.
        bracket: loads (N m) under which the motor certainly keeps turning, and is certainly driven back.
        no_load_speed, no_load_speed_error: mean speed without load and its standard error (rad/s).
        blocked_torque, blocked_torque_error: mean torque (N m) on a rotor held at rest, and its standard error;
            NaN for a rotor that acts back on its stator.
        motion: vertical motion of the rotor, a word of :attr:`OperatingPoints.MOTIONS`.
        life: mean lifetime (s) of an irregular motion that ended, else NaN.
        others: the same for coexisting motions.
    """

    torque: float
    torque_error: float
    share: float
    bracket: tuple[float, float]
    no_load_speed: float
    no_load_speed_error: float
    blocked_torque: float
    blocked_torque_error: float
    motion: str
    life: float
    others: tuple[StallLoad, ...]


def stall_load(
    motor: Motor,
    *,
    contact_time: Float | None = None,
    progress: Progress = None,
    **settings: Unpack[OperatingSettings],
) -> StallLoad:
    """The load at which a motor stops.

    Args:
        contact_time: as for :func:`torque_speed_curve`.
        settings: the fields of :class:`OperatingSettings`, as keywords.
    """
    return native.stall_load(locals())


@dataclass(frozen=True)
class InputSpread:
    """The spread of a speed (rad/s) or a stall load (N m) over the tolerances of a motor's inputs.

    Attributes:
        mean, mean_error: the mean over the samples and its standard error.
        standard_deviation, standard_deviation_error: the standard deviation over the samples, without
            their statistical errors, and its standard error.
        from_to: the least and the largest sample: with n samples, a further one lies between them with
            probability (n - 1)/(n + 1).
        draws, without: number of samples with a value, and without one.
        unsettled: samples in which the remaining start-up exceeds the standard deviation.
        trapped: samples in a low-period trap.
    """

    mean: float
    mean_error: float
    standard_deviation: float
    standard_deviation_error: float
    from_to: tuple[float, float]
    draws: int
    without: int
    unsettled: int
    trapped: int


def input_spreads(
    motor: Motor,
    *,
    load_torques: ArrayLike | None = None,
    tolerance: Float = 0.01,
    perturbation_decades: Float = 1.0,
    draws: Int = 39,
    progress: Progress = None,
    **settings: Unpack[OperatingSettings],
) -> list[InputSpread | None]:
    """The spread of the speeds or the stall load of a motor over the tolerances of its inputs.

    The errors of the other calls hold at exactly the given inputs. A motor responds irregularly to preload
    and amplitude, so a designer should rely on this spread.

    Args:
        load_torques: load torques (N m) of the speeds, shape (n,); by default the spread is computed for the
            stall load.
        tolerance: relative tolerance of preload and amplitude, in [0, 0.5].
        perturbation_decades: decades over which the size of the relaunch perturbation is sampled, in [0, 6].
        draws: motors to sample, in [8, 10000].
        settings: the fields of :class:`OperatingSettings`, as keywords.

    Returns:
        One for each load, or only the spread of the stall load; None if fewer than four samples have a speed.
    """
    return native.input_spreads(locals())


@dataclass(frozen=True)
class Best:
    """The best value of a quantity over one or two fields of a data sheet.

    Attributes:
        of: the quantity.
        value, error: the quantity measured at the optimum, and its standard error, which includes a possible
            gain nearby.
        values, value_errors: the fields there, by name, and their standard errors.
        good_from_to: for each field the range around the optimum with at least 99 % of the value, within the
            bounds; None if the curve is too rough.
        at_end: fields whose best value is at an end of their range.
        bounds: the quantities of ``where``, each with its standard error.
        branches: number of coexisting motions; all numbers refer to the first.
    """

    of: str
    value: float
    error: float
    values: dict[str, float]
    value_errors: dict[str, float]
    good_from_to: dict[str, tuple[float, float] | None]
    at_end: list[str]
    bounds: list[tuple[float, float]]
    branches: int


def best(
    motor: Motor,
    of: str = "speed",
    *,
    over: Mapping[str, ArrayLike],
    where: Sequence[str] = (),
    progress: Progress = None,
    **settings: Unpack[OperatingSettings],
) -> Best:
    """The best speed, torque, power or efficiency over one or two fields of the data sheet.

    All other fields, including the load, are taken from the motor. For the largest torque at a speed, vary
    ``load_torque`` and bound the speed.

    Args:
        of: the quantity to maximise: ``speed``, ``torque``, ``power``, ``efficiency``, ...
        over: one or two arguments of :class:`Motor`, each with its least and its largest value (SI). A ``phase_lag`` over a
            whole turn has no ends.
        where: bounds on quantities of the same operation, at most two: ``"speed >= 5"``.
        settings: the fields of :class:`OperatingSettings`, as keywords.

    >>> import bouncing_disk as bd
    >>> found = bd.best(bd.Motor.paper_70_khz(), "speed", over={"phase_lag": (-1.0, 1.0)}, relative_error=0.05)
    >>> abs(found.values["phase_lag"]) < 0.4, found.at_end
    (True, [])
    """
    return native.best(locals())


@dataclass(frozen=True, eq=False, repr=False)
class MotorMap(OperatingPoints):
    """A motor in steady operation over one or two of its parameters.

    All arrays have one axis for each of `axes`, in their order.

    Attributes:
        motor: the motor that is varied.
        axes: the parameters and their values (SI), shape (n,).
    """

    motor: Motor
    axes: dict[str, FloatArray]

    def names(self) -> list[list[str]]:
        """The status of each cell in the words of :attr:`STATUSES`, row by row."""
        rows = self.status.reshape(len(self.status), -1)
        return [[self.STATUSES[status] for status in row] for row in rows]


def motor_map(
    motor: Motor,
    *,
    over: Mapping[str, ArrayLike],
    continued: bool = False,
    progress: Progress = None,
    **settings: Unpack[OperatingSettings],
) -> MotorMap:
    """Speed, power and efficiency of a motor over one or two parameters of its data sheet.

    The numbers of a cell refer to the motion that most rotors reach from rest; `motion` and `status` state
    whether it is periodic and whether it is settled, and `others` lists coexisting motions. Cells that share
    a vertical motion are computed on one orbit. A parameter replaces its alternative: a sweep over
    ``preload_force`` of a motor with a ``preload_acceleration`` uses only the force.

    Args:
        axes: one or two arguments of :class:`Motor` with their values (SI), shape (n,); the values of the first
            correspond to the rows.
        continued: whether each cell of one axis starts from the final state of its predecessor instead of
            from rest: for a compliant ``stator``, whose state may depend on its history. Height and modes
            continue; the speed of the rotor restarts. All other fields of the sheet are held; in a sweep over
            ``drive_frequency`` these include its volts, its force or its amplitude without a rotor, the preload and
            the phase lag. If members are in several states, their mean describes none of them.
        settings: the fields of :class:`OperatingSettings`, as keywords.

    >>> import bouncing_disk as bd
    >>> motor = bd.Motor(drive_frequency=70e3, amplitude=1e-8, peak_angular_speed=30.0, mass=1e-3,
    ...     contact_radius=1.25e-3, gyration_radius=6.3e-3, preload_acceleration=9.8, friction=0.1, restitution=0.5)
    >>> over = {"friction": [0.1, 0.2], "load_torque": [0.0, 0.5 * motor.largest_torque, 1.5 * motor.largest_torque]}
    >>> found = bd.motor_map(motor, over=over, relative_error=0.05)
    >>> found.speed.shape, found.names()[0]
    ((2, 3), ['steady', 'steady', 'runaway'])
    """
    return native.motor_map(locals())


@dataclass(frozen=True, eq=False, repr=False)
class LowPeriodTraps(Result):
    """Whether a motor is in a low-period trap under n preloads, with the evidence.

    Attributes:
        preload_acceleration: preload as an acceleration (m/s^2), shape (n,).
        axial_forcing: axial forcing parameter Gamma, which with the restitution determines the result, shape
            (n,).
        is_trap: whether the perturbed motor repeats the short cycle, shape (n,).
        impacts, platform_periods, long_flights: numbers of the unperturbed cycle from one separation to the
            next, if it has at most eight long flights; 0 without such a cycle, shape (n,).
        relaunches, returns: number of perturbed relaunches, and how many of them led through such a cycle, shape
            (n,).
        mean_platform_periods: mean number of the stator's periods from one perturbed relaunch to the next;
            NaN without a cycle, shape (n,).
    """

    preload_acceleration: FloatArray
    axial_forcing: FloatArray
    is_trap: BoolArray
    impacts: IntArray
    platform_periods: IntArray
    long_flights: IntArray
    relaunches: IntArray
    returns: IntArray
    mean_platform_periods: FloatArray


def low_period_traps(
    motor: Motor, *, preload_accelerations: ArrayLike, progress: Progress = None
) -> LowPeriodTraps:
    """Which preloads trap a motor in a short cycle of flights and rest, at a speed of its own.

    Only the vertical motion matters.

    Args:
        preload_accelerations: preloads as accelerations (m/s^2), positive, which replace that of the data
            sheet, shape (n,).

    A flight of twelve and a half periods, at Gamma = 12.51, lands softly:

    >>> import numpy as np
    >>> import bouncing_disk as bd
    >>> motor = bd.Motor.paper_70_khz()
    >>> soft = motor.preload_acceleration * motor.system.axial_forcing / 12.51
    >>> bd.low_period_traps(motor, preload_accelerations=soft * np.array([0.97, 1.0, 1.03])).is_trap
    array([False,  True, False])
    """
    return native.low_period_traps(locals())


@dataclass(frozen=True, eq=False)
class NearestTrap(Result):
    """The low-period trap nearest to a motor.

    Attributes:
        relative_distance: the smaller of the relative changes of amplitude and preload that reach its
            near edge; 0 for a motor in the trap.
        preload_acceleration, amplitude, drive_frequency: each of these (m/s^2, m, Hz) at the near edge,
            with the others kept.
        forcing_from_to: the range of Gamma of the trap, as far as it was scanned.
        forcing_step: step of the scan in Gamma; narrower traps may have been missed.
        impacts, platform_periods, long_flights: numbers of the cycle in the middle of the trap.
        return_share: the share of perturbed relaunches there that return to the cycle, in [0, 1].
    """

    relative_distance: float
    preload_acceleration: float
    amplitude: float
    drive_frequency: float
    forcing_from_to: tuple[float, float]
    forcing_step: float
    impacts: int
    platform_periods: int
    long_flights: int
    return_share: float


def nearest_trap(
    motor: Motor, *, relative_range: Float = 0.1, progress: Progress = None
) -> NearestTrap | None:
    """The low-period trap nearest to a motor.

    Only Gamma and the restitution matter, so a change of preload, amplitude or frequency
    reaches the same trap; its near edge is given for each, with the others kept.

    Args:
        relative_range: the largest relative change of preload or amplitude to search, in (0, 1].

    Returns:
        None if no trap within the range is at least 0.05 % wide.

    >>> import bouncing_disk as bd
    >>> trap = bd.nearest_trap(bd.Motor.paper_70_khz())
    >>> trap is None or 0.0 <= trap.relative_distance < 0.1
    True
    """
    return native.nearest_trap(locals())


@dataclass(frozen=True, eq=False, repr=False)
class LocalSensitivities(Result):
    """Sensitivity of a quantity of a motor to n of its parameters, near its data sheet.

    Attributes:
        parameters: the parameters.
        derivative, standard_error: d ln(quantity)/d ln(parameter); for the phase lag d ln(quantity)/d theta
            (1/rad), for the load torque d ln(quantity) over the change of load in units of mu m g a_e, shape
            (n,).
        method: ``"shared-motion"``, by a difference of rotors on the same vertical motions, or
            ``"regression"``, by a line through motors with different ones.
        traps: motors omitted from a regression because they are in a low-period trap, shape (n,).
        quantity: ``"steady-speed"`` or ``"stall-torque"``.
    """

    parameters: tuple[str, ...]
    derivative: FloatArray
    standard_error: FloatArray
    method: tuple[str, ...]
    traps: IntArray
    quantity: str


def local_sensitivities(
    motor: Motor,
    *,
    parameters: Iterable[str] | None = None,
    quantity: Literal["steady-speed", "stall-torque"] = "steady-speed",
    half_range: Float = 0.2,
    points: Int = 24,
    progress: Progress = None,
    **settings: Unpack[OperatingSettings],
) -> LocalSensitivities:
    """Sensitivity of the steady speed or the stall torque of a motor to its parameters, near its data sheet.

    Args:
        parameters: any of ``friction``, ``peak_angular_speed``, ``phase_lag``, ``contact_radius``,
            ``gyration_radius``, ``load_torque``, ``amplitude``, ``preload``, ``restitution`` and
            ``drive_frequency``; by default the first six, which share one vertical motion.
        quantity: the quantity whose sensitivity is computed.
        half_range: half the range, in the logarithm of a parameter of the vertical motion, over which motors
            are sampled, in (0, 2].
        points: motors sampled over it, in [5, 10000].
        settings: the fields of :class:`OperatingSettings`, as keywords.

    >>> import bouncing_disk as bd
    >>> motor = bd.Motor(drive_frequency=70e3, amplitude=1e-8, peak_angular_speed=30.0, mass=1e-3,
    ...     contact_radius=1.25e-3, gyration_radius=6.3e-3, preload_acceleration=9.8, friction=0.1, restitution=0.5)
    >>> found = bd.local_sensitivities(motor, parameters=["friction", "peak_angular_speed"], relative_error=0.05)
    >>> bool(found.derivative[0] < 0.5 < found.derivative[1])  # The speed follows the stator, not the friction.
    True
    """
    return native.local_sensitivities(locals())
