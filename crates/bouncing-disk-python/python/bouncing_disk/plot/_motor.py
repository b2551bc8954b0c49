"""Motors: the run-up and its dependence on parameters (Figs. 10 to 13), the curve, and braking (Fig. 9)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

import bouncing_disk as bd
from bouncing_disk.plot._frame import (
    BLACK,
    BLUE,
    COLOURS,
    GREY,
    ORANGE,
    drawn_on,
    drawn_on_columns,
    equation,
    finite_array,
    in_words,
    labelled,
    legend_above,
    note,
    number,
    out_of_range,
    rising_array,
    same_length,
    style,
    unit_of,
    whole_number,
    with_error,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

#: The part of the members that the band holds, in percent of either end.
_BAND = (10.0, 90.0)


def motor_transient(
    runs: bd.TransientEnsemble | bd.Motor | bd.System,
    *,
    members: int = 64,
    duration: float | None = None,
    intervals: int = 300,
    seed: int = 1,
    member: int = 0,
    ax: Axes | None = None,
) -> tuple[Figure, Axes]:
    """The speed of a motor from rest: one member, the band of four fifths of all, and the fit of their means.

    Args:
        runs: what is drawn; of a motor, run-ups that are computed.
        members: how many, of a motor.
        duration: how long they last (s), of a motor; by default eight of its time constants.
        intervals: intervals that the speed is averaged over, of a motor.
        seed: seed of the perturbations, of a motor.
        member: which member is drawn alone, from 0 on.
        ax: where it is drawn.
    """
    if isinstance(runs, bd.Motor):
        runs = runs.system
    if isinstance(runs, bd.System):
        duration = _run_up_time(runs) if duration is None else duration
        runs = bd.ensemble(runs, members=members, duration=duration, intervals=intervals, seed=seed)
    elif not isinstance(runs, bd.TransientEnsemble):
        raise TypeError(f"runs must be a TransientEnsemble, a Motor or a System, not {type(runs).__name__}")
    count = runs.speeds.shape[1]
    member = whole_number("member", member, 0, count - 1)
    low, high = np.percentile(runs.speeds, _BAND, axis=1)
    time = runs.times[:, member]
    end = float(time[-1] + 0.5 * (time[1] - time[0]))
    smooth = np.linspace(0.0, end, 400)
    steady, constant = runs.steady_speed, runs.time_constant
    seconds, second = unit_of(end, "s")
    speeds, speed_unit = unit_of(runs.speeds, "rad/s")
    with style():
        fig, axes = drawn_on(ax)
        if count > 1:
            words = f"80 % of {count} runs"
            axes.fill_between(
                seconds * time, speeds * low, speeds * high, color=BLUE, alpha=0.3, linewidth=0.0, label=words
            )
        axes.plot(seconds * time, speeds * runs.speeds[:, member], color=GREY, linewidth=0.7, label="one run")
        known = _is_known(steady, constant, end)
        if known:
            fitted = speeds * steady.mean * -np.expm1(-smooth / constant.mean)
            axes.plot(seconds * smooth, fitted, color=BLACK, linestyle=(0, (4, 2)), label="exponential")
        axes.margins(y=0.05)
        axes.set_xlim(0.0, seconds * end)
        bottom, top = axes.get_ylim()
        if runs.speeds.any():
            axes.set_ylim(
                bottom if runs.speeds.min() < 0.0 else 0.0, top if runs.speeds.max() > 0.0 else -0.05 * bottom
            )
        else:
            axes.set_ylim(-1.0, 1.0)
        axes.set_xlabel(labelled("time $t$", second))
        axes.set_ylabel(labelled(r"rotary speed $\dot\alpha$", speed_unit))
        legend_above(
            axes, own=ax is None, most=3, columnspacing=0.9, handlelength=1.3, handletextpad=0.4,
            title=_values(steady, constant) if known else None, title_fontsize=9.5, alignment="right",
        )  # fmt: skip
    return fig, axes


def _is_known(steady: bd.Spread, constant: bd.Spread, end: float) -> bool:
    """Whether the fit of the means says anything.

    A rise that takes longer than the run-up is not known from it, and neither is a mean that is smaller than
    twice its own error.
    """
    for spread in (steady, constant):
        error = spread.standard_error
        if not abs(spread.mean) > 0.0 or (np.isfinite(error) and abs(spread.mean) < 2.0 * error):
            return False
    return 0.0 < constant.mean <= end / 3.0


def _values(steady: bd.Spread, constant: bd.Spread) -> str:
    speed = rf"$\dot\alpha_\mathrm{{ss}} = {with_error(steady.mean, steady.standard_error)}$ rad/s"
    return speed + rf",  $t_\mathrm{{c}} = {with_error(constant.mean, constant.standard_error)}$ s"


def _run_up_time(system: bd.System) -> float:
    """Eight time constants, of a short trial of this motor, or of longer ones until it is long enough."""
    duration = 4.0 * (system.rise_time or 0.25)
    for _ in range(12):
        trial = bd.ensemble(system, members=8, duration=duration, intervals=100)
        constant = trial.time_constant.mean
        if np.isfinite(constant) and 4.0 * constant <= duration:
            return float(8.0 * constant)
        duration *= 2.0
    return duration


def torque_speed(
    curve: bd.TorqueSpeedCurve | bd.Motor,
    *,
    load_torques: npt.ArrayLike | None = None,
    relative_error: float = 0.01,
    ax: Axes | None = None,
) -> tuple[Figure, Axes]:
    """Speed and mechanical power of a motor against its load, with two standard errors.

    Args:
        curve: what is drawn; of a motor, a curve that is computed.
        load_torques: the loads (N m), of a motor; by default twelve from none to the stall load, shape (n,).
        relative_error: standard error of the speeds that is asked for, relative to the speed without load, of
            a motor.
        ax: where it is drawn. The power has an axis of its own on the right.

    Returns:
        The axes of the speed.
    """
    if isinstance(curve, bd.Motor):
        if load_torques is None:
            stall = bd.stall_load(curve, relative_error=max(relative_error, 0.01))
            load_torques = np.linspace(0.0, stall.torque, 12)
        curve = bd.torque_speed_curve(curve, load_torques=load_torques, relative_error=relative_error)
    elif not isinstance(curve, bd.TorqueSpeedCurve):
        raise TypeError(f"curve must be a TorqueSpeedCurve or a Motor, not {type(curve).__name__}")
    order = np.argsort(curve.load_torque, kind="stable")
    # A load that drives the rotor backwards ever faster has no steady speed.
    steady = curve.status == bd.TorqueSpeedCurve.STATUSES.index("steady")
    runs = order[(steady & np.isfinite(curve.speed))[order]]
    torques, torque = unit_of(curve.load_torque, "N m", least=1.0)
    speeds, speed = unit_of(curve.speed[runs], "rad/s")
    watts, watt = unit_of(curve.mechanical_power[runs], "W", least=1.0)
    load = torques * curve.load_torque
    with style():
        fig, axes = drawn_on(ax, 2.5)
        axes.errorbar(
            load[runs], speeds * curve.speed[runs], _bars(speeds, curve.speed_error[runs]), color=BLACK,
            marker="o", markersize=3.0, capsize=1.5, linewidth=1.0, label="speed",
        )  # fmt: skip
        axes.set_xlabel(labelled("load torque", torque))
        axes.set_ylabel(labelled("rotary speed", speed))
        power_axis = axes.twinx()
        power_axis.errorbar(
            load[runs], watts * curve.mechanical_power[runs],
            _bars(watts, curve.mechanical_power_error[runs]), color=ORANGE, marker="s", markersize=2.6,
            capsize=1.5, linewidth=1.0, linestyle=(0, (4, 2)), label="power",
        )  # fmt: skip
        power_axis.set_ylabel(labelled("mechanical power", watt), color=ORANGE)
        power_axis.tick_params(axis="y", which="both", colors=ORANGE)
        axes.tick_params(axis="y", which="both", right=False)
        low, high = min(load.min(initial=0.0), 0.0), max(load.max(initial=0.0), 0.0)
        if low < high:
            axes.set_xlim(low - 0.03 * (high - low), high + 0.03 * (high - low))
        if not len(runs):
            note(axes, "no load with a steady speed")
        _level(axes, power_axis)
        handles = [*axes.get_legend_handles_labels()[0], *power_axis.get_legend_handles_labels()[0]]
        legend_above(axes, handles, own=ax is None)
    return fig, axes


def _bars(factor: float, errors: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """Two standard errors; none where the error is not known."""
    bars: npt.NDArray[np.float64] = 2.0 * factor * np.where(np.isfinite(errors), errors, np.nan)
    return bars


def _level(left: Axes, right: Axes) -> None:
    """Both axes get their zeros at one height, and show all that they have."""
    ends = []
    for axis in (left, right):
        low, high = axis.dataLim.intervaly
        low, high = (min(low, 0.0), max(high, 0.0)) if np.isfinite(low) and np.isfinite(high) else (0.0, 0.0)
        room = 0.06 * (high - low) or 1.0
        ends.append((low - room if low < 0.0 else 0.0, high + room if high > 0.0 or low == 0.0 else 0.0))
    shares = sorted(-low / (high - low) for low, high in ends)
    # The share below zero: that of the one that needs most, unless this squeezes the other one.
    below = shares[1] if shares[1] <= 0.7 else max(shares[0], 0.7)
    for axis, (low, high) in zip((left, right), ends):
        height = max(-low / below if below > 0.0 else 0.0, high / (1.0 - below) if below < 1.0 else 0.0)
        # A little more at the zero itself, so that points on it are whole.
        edge = 0.03 * height
        axis.set_ylim(-below * height - edge, (1.0 - below) * height + edge)
    left.axhline(0.0, color=GREY, linewidth=0.6, zorder=0)


#: Time constants that a run-up must last for its fit to be shown, as ``fit_transients`` asks for.
_SHORTEST = 3.0

#: The parameters of a system that a motor may depend on, with what stands at their axis.
_SHEET = {
    "drive_frequency": ("drive frequency", "Hz"),
    "peak_angular_speed": (r"angular speed of the stator $\omega\Phi$", "rad/s"),
    "mass": ("mass $m$", "kg"),
    "density": ("density", "kg/m$^3$"),
    "rotor_radius": ("radius of the rotor", "m"),
    "rotor_thickness": ("thickness of the rotor", "m"),
    "preload_force": ("preload $mg$", "N"),
    "load_torque": (r"load torque $T_\mathrm{L}$", "N m"),
}
#: Those of a system; a motor's data sheet has some of them, too.
_AXES = {
    "amplitude": ("axial amplitude $A$", "m"),
    "twist_amplitude": (r"twist amplitude $\Phi$", "rad"),
    "angular_frequency": (r"angular frequency $\omega$", "rad/s"),
    "phase_lag": (r"phase lag $\theta$", "rad"),
    "contact_radius": (r"contact radius $a_\mathrm{e}$", "m"),
    "gyration_radius": (r"radius of gyration $a_\mathrm{g}$", "m"),
    "friction": (r"coefficient of friction $\mu$", ""),
    "restitution": (r"coefficient of restitution $\epsilon$", ""),
    "preload_acceleration": ("preload $g$", "m/s$^2$"),
    "load_acceleration": (r"load $T/(m a_\mathrm{g}^2)$", "rad/s$^2$"),
}
#: Values that differ by this factor get a logarithmic axis.
_DECADES = 50.0


def motor_dependence(
    motor: bd.Motor | bd.System,
    parameter: str,
    values: npt.ArrayLike,
    *,
    members: int = 16,
    rise_times: float = 6.0,
    seed: int = 1,
    ax: Axes | None = None,
) -> tuple[Figure, Axes]:
    """Steady speed and stall acceleration of a motor against one of its parameters, as Figs. 11 and 13.

    Both are of the exponential fits to its run-ups, with two standard errors over the members. The stall
    acceleration of such a fit is what the paper takes for the stall torque; the load that stops the motor is
    ``stall_load``.

    Args:
        motor: what does not vary is its own.
        parameter: what varies: an argument of :class:`~bouncing_disk.Motor`, whose alternative it takes the
            place of, or of :class:`~bouncing_disk.System`, where there is no motor or its data sheet has no
            such value.
        values: its values (SI), shape (n,).
        members: run-ups at each value, two at least: their scatter gives the errors.
        rise_times: how long a run-up lasts, in rise times omega Phi a_g^2/(mu a_e g) of the system.
        seed: seed of the perturbations.
        ax: where the speed is drawn; the stall acceleration has an axis of its own on the right.

    Returns:
        The axes of the speed.
    """
    if not isinstance(motor, (bd.Motor, bd.System)):
        raise TypeError(f"motor must be a Motor or a System, not {type(motor).__name__}")
    words = _AXES if isinstance(motor, bd.System) else _AXES | _SHEET
    if parameter not in words:
        raise ValueError(f"parameter must be one of {', '.join(words)}, not {parameter!r}")
    members = whole_number("members", members, 2)
    given = finite_array("values", values)
    fits = np.array(
        [_fit(_with(motor, parameter, float(value)), members, rise_times, seed) for value in given]
    )
    fits = fits.reshape(len(given), 4)
    name, plain = words[parameter]
    across, unit = unit_of(given, plain)
    speeds, speed = unit_of(fits[:, 0], "rad/s")
    stalls, acceleration = unit_of(fits[:, 2], "rad/s$^2$")
    with style():
        fig, axes = drawn_on(ax, 2.5)
        axes.errorbar(
            across * given, speeds * fits[:, 0], 2.0 * speeds * fits[:, 1], color=BLACK, marker="x",
            markersize=4.0, capsize=1.5, linewidth=0.8, label="steady speed",
        )  # fmt: skip
        axes.set_xlabel(labelled(name, unit))
        axes.set_ylabel(labelled("steady speed", speed))
        axes.margins(x=0.03, y=0.08)
        _span(axes, across * given)
        stall = axes.twinx()
        stall.errorbar(
            across * given, stalls * fits[:, 2], 2.0 * stalls * fits[:, 3], color=ORANGE, marker="o",
            markersize=2.6, capsize=1.5, linewidth=0.8, linestyle=(0, (4, 2)), label="stall acceleration",
        )  # fmt: skip
        stall.set_ylabel(labelled("stall acceleration", acceleration), color=ORANGE)
        stall.tick_params(axis="y", which="both", colors=ORANGE)
        stall.margins(y=0.08)
        axes.tick_params(axis="y", which="both", right=False)
        if not np.isfinite(fits[:, 0]).any():
            note(axes, "no exponential run-up" if len(given) else "no values")
        handles = [*axes.get_legend_handles_labels()[0], *stall.get_legend_handles_labels()[0]]
        legend_above(axes, handles, own=ax is None)
    return fig, axes


def _span(ax: Axes, values: npt.NDArray[np.float64]) -> None:
    """The abscissa from the lowest to the highest value, also where there is no fit."""
    low, high = values.min(initial=np.inf), values.max(initial=-np.inf)
    if not low < high:
        return
    if low > 0.0 and high >= _DECADES * low:
        room = (high / low) ** 0.03
        ax.set_xlim(low / room, high * room)
        ax.set_xscale("log")
    else:
        room = 0.03 * (high - low)
        ax.set_xlim(low - room, high + room)


def _with(motor: bd.Motor | bd.System, parameter: str, value: float) -> bd.System:
    """The system with another value of a parameter: a motor's is that of its data sheet, if there is one."""
    if isinstance(motor, bd.System):
        return motor.replace(**{parameter: value})
    if parameter in ("angular_frequency", "load_acceleration"):
        return motor.system.replace(**{parameter: value})
    return motor.replace(**{parameter: value}).system


def _fit(system: bd.System, members: int, rise_times: float, seed: int) -> tuple[float, float, float, float]:
    """Steady speed and stall acceleration with their standard errors, NaN where no fit is meaningful."""
    # Without twist or friction there is no rise time, and any time will do.
    rise = system.rise_time
    duration = rise_times * (rise if np.isfinite(rise) and rise > 0.0 else 0.5)
    runs = bd.ensemble(system, members=members, duration=duration, intervals=200, seed=seed)
    speed, stall = runs.steady_speed, runs.stall_acceleration
    # A rise that takes longer than the run-up is not known from it, as where a load drives the rotor.
    if not 0.0 <= runs.time_constant.mean <= duration / _SHORTEST:
        return np.nan, np.nan, np.nan, np.nan
    return speed.mean, speed.standard_error, stall.mean, stall.standard_error


_Array = npt.NDArray[np.float64]

#: Of the preload of the motor, where none are given.
_SHARES = (0.5, 1.0, 2.0)
#: Lines that can be told apart without colour, too.
_LINES = ("-", (0, (5, 2)), (0, (5, 1.5, 1, 1.5)), (0, (1, 1)))
_SAMPLES = 60


def braking(
    motor: bd.Motor | bd.System,
    *,
    preload_accelerations: npt.ArrayLike | None = None,
    first_speed: float | None = None,
    measured: Iterable[tuple[npt.ArrayLike, npt.ArrayLike, float]] = (),
    frictions: tuple[npt.ArrayLike, npt.ArrayLike] | None = None,
    ax: Axes | Sequence[Axes] | np.ndarray[Any, Any] | None = None,
) -> tuple[Figure, np.ndarray[Any, Any]]:
    """The speed of a rotor on its stator at rest, and coefficients of friction, as Fig. 9 of the paper.

    Without vibration the rotor slides until it stops, and Coulomb friction makes its speed a straight line,
    the slope of which tells the coefficient of friction. Measured speeds beside the curves show whether the
    coefficient of the motor is the right one.

    Args:
        motor: the motor that is switched off.
        preload_accelerations: the preloads (m/s^2), a curve each; by default those of the measured curves, or
            half, once and twice that of the motor, shape (n,).
        first_speed: angular speed at the beginning (rad/s); by default that of the first measured point, or
            without measurements the largest one of the stator, omega Phi.
        measured: curves of your own: times (s) from the switching off, angular speeds (rad/s), and the
            preload (m/s^2).
        frictions: coefficients of friction that were measured, and at which preloads (m/s^2). They are drawn
            in a second panel, with their mean and standard deviation and with the coefficient of the motor.
        ax: where speeds and coefficients are drawn.

    Returns:
        (Figure, array of one or two Axes).

    >>> import bouncing_disk as bd
    >>> from bouncing_disk import plot
    >>> fig, (speeds,) = plot.braking(bd.System.motor(), preload_accelerations=[4.9, 9.8], first_speed=30.0)
    >>> [round(float(line.get_xdata()[-1]), 3) for line in speeds.lines]  # s
    [1.944, 0.972]
    """
    system = motor.system if isinstance(motor, bd.Motor) else motor
    if not isinstance(system, bd.System):
        raise TypeError(f"motor must be a Motor or a System, not {type(motor).__name__}")
    own_curves = [_measured(curve) for curve in measured]
    if preload_accelerations is not None:
        preloads = finite_array("preload_accelerations", preload_accelerations, positive=True)
    elif own_curves:
        preloads = np.unique([preload for _, _, preload in own_curves])
    else:
        preloads = np.array([share * system.preload_acceleration for share in _SHARES])
    if not len(preloads):
        message = "preload_accelerations is empty; give one at least"
        raise bd.InvalidError(message, "empty", {"field": "preload_accelerations"})
    if first_speed is not None and number("first_speed", first_speed) == 0.0:
        raise out_of_range("first_speed", 0.0, "(-infinity, 0) or (0, infinity)")
    curves = [
        _curve(system, float(preload), *_beginning(motor, float(preload), first_speed, own_curves))
        for preload in preloads
    ]
    points = None if frictions is None else _frictions(frictions)
    with style():
        fig, panels = drawn_on_columns(ax, 1 if points is None else 2, 2.5)
        _speeds(panels[0], preloads, curves, own_curves)
        if points is not None:
            _coefficients(panels[1], system.friction, *points)
            legend_above(panels[1], own=ax is None, most=2)
        legend_above(panels[0], own=ax is None, most=3)
    return fig, panels


def _measured(curve: Any) -> tuple[_Array, _Array, float]:
    try:
        times, speeds, preload = curve
    except (TypeError, ValueError) as error:
        raise TypeError("measured must hold (times, speeds, preload_acceleration)") from error
    times, speeds = rising_array("times", times), finite_array("speeds", speeds)
    same_length(("times", "speeds"), times, speeds)
    return times, speeds, number("preload_acceleration", preload, positive=True)


def _beginning(
    motor: bd.Motor | bd.System,
    preload: float,
    first_speed: float | None,
    own: list[tuple[_Array, _Array, float]],
) -> tuple[float, float]:
    """Time and speed from which the model goes on: given, or measured, or the stator's largest speed."""
    if first_speed is not None:
        return 0.0, float(first_speed)
    for times, speeds, measured_preload in own:
        if measured_preload == preload and len(speeds) and speeds[0] != 0.0:
            return float(times[0]), float(speeds[0])
    return 0.0, motor.peak_angular_speed


def _curve(system: bd.System, preload: float, begin: float, first_speed: float) -> tuple[_Array, _Array]:
    """Time and speed on the platform at rest, until the rotor stops."""
    if first_speed == 0.0:
        message = "the stator does not turn, so that the first speed of the rotor must be given"
        raise bd.InvalidError(message, "not-given", {"field": "first_speed"})
    still = system.replace(amplitude=0.0, twist_amplitude=0.0, preload_acceleration=preload)
    motion = bd.simulate(still, angular_speed=first_speed, events=1)
    if len(motion) == 0:
        message = f"at a preload of {preload} m/s^2 the rotor never stops"
        raise bd.InvalidError(
            message, "never-stops", {"preload_acceleration": preload, "friction": system.friction}
        )
    samples = motion.samples(count=_SAMPLES)
    return begin + (samples.time - motion.start_time), samples.angular_speed


def _speeds(
    ax: Axes, preloads: _Array, curves: list[tuple[_Array, _Array]], own: list[tuple[_Array, _Array, float]]
) -> None:
    seconds, second = unit_of(np.concatenate([[0.0], *(time for time, *_ in [*curves, *own])]), "s")
    speeds, unit = unit_of(np.concatenate([[0.0], *(speed for _, speed, *_ in [*curves, *own])]), "rad/s")
    colours = {}
    for place, (preload, (time, speed)) in enumerate(zip(preloads, curves)):
        # Grey is hard to see in a line of dots.
        colour = [shade for shade in COLOURS if shade != GREY][place % (len(COLOURS) - 1)]
        colours[float(preload)] = colour
        ax.plot(
            seconds * time,
            speeds * speed,
            color=colour,
            linestyle=_LINES[place % len(_LINES)],
            linewidth=1.2,
            label=equation("g", float(preload), "m/s$^2$"),
        )
    for place, (time, speed, preload) in enumerate(own):
        ax.plot(
            seconds * time,
            speeds * speed,
            linestyle="",
            marker="x",
            markersize=3.5,
            markeredgewidth=0.8,
            color=colours.get(preload, BLACK),
            label=None if place else "measured",
        )
    times = [*(time for time, _ in curves), *(time for time, _, _ in own)]
    ends = [float(time[-1]) for time in times if len(time)]
    ax.set_xlim(0.0, 1.05 * seconds * max(ends, default=1.0) or None)
    low, high = ax.get_ylim()
    ax.set_ylim(0.0 if low > -0.1 * abs(high) else 1.05 * low, 0.0 if high < -0.1 * low else 1.05 * high)
    ax.set_xlabel(labelled("time $t$", second))
    ax.set_ylabel(labelled(r"rotary speed $\dot\alpha$", unit))


def _frictions(frictions: Any) -> tuple[_Array, _Array]:
    try:
        preloads, coefficients = frictions
    except (TypeError, ValueError) as error:
        raise TypeError("frictions must be (preload_accelerations, frictions)") from error
    preloads = finite_array("frictions[0]", preloads, positive=True)
    coefficients = finite_array("frictions[1]", coefficients)
    same_length(("frictions[0]", "frictions[1]"), preloads, coefficients)
    return preloads, coefficients


def _coefficients(ax: Axes, friction: float, preloads: _Array, coefficients: _Array) -> None:
    factor, unit = unit_of(preloads, "m/s$^2$")
    ax.axhline(friction, color=BLACK, linewidth=0.8, linestyle=(0, (4, 2)), label=r"the motor's $\mu$")
    if len(coefficients) > 1:
        mean, deviation = float(coefficients.mean()), float(coefficients.std(ddof=1))
        ax.axhspan(
            mean - deviation,
            mean + deviation,
            color=GREY,
            alpha=0.35,
            linewidth=0.0,
            label=rf"mean ${in_words(mean, 2)} \pm {in_words(deviation, 2)}$",
        )
    ax.plot(
        factor * preloads,
        coefficients,
        linestyle="",
        marker="x",
        markersize=4.0,
        color=BLACK,
        label="measured",
    )
    ax.margins(x=0.06)
    lowest = min(0.0, float(coefficients.min(initial=0.0)))
    ax.set_ylim(1.2 * lowest, 1.15 * max(friction, float(coefficients.max(initial=0.0))) or 1.0)
    ax.set_xlabel(labelled("preload $g$", unit))
    ax.set_ylabel(r"coefficient of friction $\mu$")
