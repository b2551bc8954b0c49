"""The figures of a motor: its run-up (Figs. 10 to 13) and its torque-speed curve."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

import bouncing_disk as bd
from bouncing_disk.plot._style import BLACK, BLUE, GREY, ORANGE, drawn_on, style

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["motor_transient", "torque_speed"]

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

    Parameters
    ----------
    runs : TransientEnsemble, Motor or System
        What is drawn; of a motor, run-ups that are computed.
    members : int, default 64
        How many, of a motor.
    duration : float, optional
        How long they last (s), of a motor; by default eight of its time constants.
    intervals : int, default 300
        Intervals that the speed is averaged over, of a motor.
    seed : int, default 1
        Seed of the perturbations, of a motor.
    member : int, default 0
        Which member is drawn alone.
    ax : Axes, optional
        Where it is drawn.

    Returns
    -------
    (Figure, Axes)
    """
    if isinstance(runs, bd.Motor):
        runs = runs.system
    if isinstance(runs, bd.System):
        duration = _run_up_time(runs) if duration is None else duration
        runs = bd.ensemble(runs, members=members, duration=duration, intervals=intervals, seed=seed)
    elif not isinstance(runs, bd.TransientEnsemble):
        raise TypeError(f"runs must be a TransientEnsemble, a Motor or a System, not {type(runs).__name__}")
    time = runs.times[:, member]
    low, high = np.percentile(runs.speeds, _BAND, axis=1)
    end = float(time[-1] + 0.5 * (time[1] - time[0]))
    smooth = np.linspace(0.0, end, 400)
    steady, constant = runs.steady_speed, runs.time_constant
    with style():
        fig, ax = drawn_on(ax)
        count = runs.speeds.shape[1]
        if count > 1:
            ax.fill_between(
                time, low, high, color=BLUE, alpha=0.3, linewidth=0.0, label=f"80 % of {count} runs"
            )
        ax.plot(time, runs.speeds[:, member], color=GREY, linewidth=0.7, label="one run")
        # A rise that takes longer than the run-up is not known from it.
        known = 0.0 < constant.mean <= end / 3.0
        if known:
            fitted = steady.mean * -np.expm1(-smooth / constant.mean)
            ax.plot(smooth, fitted, color=BLACK, linestyle=(0, (4, 2)), label="exponential")
        ax.set_xlim(0.0, end)
        ax.set_ylim(bottom=min(0.0, float(runs.speeds.min())))
        ax.set_xlabel("time $t$ (s)")
        ax.set_ylabel(r"rotary speed $\dot\alpha$ (rad/s)")
        ax.legend(
            loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=3, borderaxespad=0.2, columnspacing=0.9,
            handlelength=1.3, handletextpad=0.4,
            title=_values(steady, constant) if known else None, title_fontsize=9.5, alignment="right",
        )  # fmt: skip
    return fig, ax


def _values(steady: bd.Spread, constant: bd.Spread) -> str:
    speed = rf"$\dot\alpha_\mathrm{{ss}} = {_with_error(steady)}$ rad/s"
    return speed + rf",  $t_\mathrm{{c}} = {_with_error(constant)}$ s"


def _with_error(spread: bd.Spread) -> str:
    """A mean and in brackets its standard error, two digits in units of the last one of the mean."""
    error = spread.standard_error
    if not (np.isfinite(error) and error > 0.0):
        return f"{spread.mean:.3g}"
    digits = max(0, 1 - int(np.floor(np.log10(error))))
    if digits > 6 or error > 0.3 * abs(spread.mean):
        return f"{spread.mean:.3g} \\pm {error:.1g}"
    return f"{spread.mean:.{digits}f}({error * 10**digits:.0f})"


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

    Parameters
    ----------
    curve : TorqueSpeedCurve or Motor
        What is drawn; of a motor, a curve that is computed.
    load_torques : (n,) array_like, optional
        The loads (N m), of a motor; by default twelve from none to the stall load.
    relative_error : float, default 0.01
        Standard error of the speeds that is asked for, relative to the speed without load, of a motor.
    ax : Axes, optional
        Where it is drawn. The power has an axis of its own on the right.

    Returns
    -------
    (Figure, Axes)
        The axes of the speed.
    """
    if isinstance(curve, bd.Motor):
        if load_torques is None:
            stall = bd.stall_load(curve, relative_error=max(relative_error, 0.01))
            load_torques = np.linspace(0.0, stall.torque, 12)
        curve = bd.torque_speed_curve(curve, load_torques=load_torques, relative_error=relative_error)
    elif not isinstance(curve, bd.TorqueSpeedCurve):
        raise TypeError(f"curve must be a TorqueSpeedCurve or a Motor, not {type(curve).__name__}")
    factor, unit = _torque_unit(curve.load_torque)
    steady = curve.status == bd.TorqueSpeedCurve.STATUSES.index("steady")
    load = factor * curve.load_torque
    with style():
        fig, ax = drawn_on(ax, 2.5)
        # A load that drives the rotor backwards ever faster has no steady speed.
        runs = steady & np.isfinite(curve.speed)
        ax.errorbar(
            load[runs], curve.speed[runs], 2.0 * curve.speed_error[runs], color=BLACK, marker="o", markersize=3.0,
            capsize=1.5, linewidth=1.0, label="speed",
        )  # fmt: skip
        ax.set_xlim(0.0, load.max() * 1.02 if load.max() > 0.0 else None)
        ax.set_xlabel(f"load torque ({unit})")
        ax.set_ylabel("rotary speed (rad/s)")
        power_axis = ax.twinx()
        watts, watt = _power_unit(curve.mechanical_power[runs])
        power_axis.errorbar(
            load[runs], watts * curve.mechanical_power[runs], 2.0 * watts * curve.mechanical_power_error[runs],
            color=ORANGE, marker="s", markersize=2.6, capsize=1.5, linewidth=1.0, linestyle=(0, (4, 2)), label="power",
        )  # fmt: skip
        power_axis.set_ylabel(f"mechanical power ({watt})", color=ORANGE)
        power_axis.tick_params(axis="y", which="both", colors=ORANGE)
        ax.tick_params(axis="y", which="both", right=False)
        _level(ax, power_axis)
        handles = [*ax.get_legend_handles_labels()[0], *power_axis.get_legend_handles_labels()[0]]
        ax.legend(handles=handles, loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=2, borderaxespad=0.2)
    return fig, ax


def _level(left: Axes, right: Axes) -> None:
    """Both axes get their zeros at one height."""
    shares = []
    for axis in (left, right):
        low, high = axis.get_ylim()
        shares.append(max(-low, 0.0) / (high - min(low, 0.0)))
    below = max(*shares, 0.0)
    for axis in (left, right):
        _, high = axis.get_ylim()
        axis.set_ylim(-high * below / (1.0 - below), high)
    left.axhline(0.0, color=GREY, linewidth=0.6, zorder=0)


def _torque_unit(torques: npt.NDArray[np.float64]) -> tuple[float, str]:
    return _unit(torques, "N m", ("N m", "mN m", "µN m", "nN m"))


def _power_unit(powers: npt.NDArray[np.float64]) -> tuple[float, str]:
    return _unit(powers, "W", ("W", "mW", "µW", "nW"))


def _unit(values: npt.NDArray[np.float64], plain: str, units: tuple[str, ...]) -> tuple[float, str]:
    """The unit in which the largest value is a number from 1 to 1000."""
    largest = float(np.max(np.abs(values), initial=0.0))
    if not largest > 0.0:
        return 1.0, plain
    for power, unit in enumerate(units):
        if largest * 1e3**power >= 1.0:
            return 1e3**power, unit
    return 1e3 ** (len(units) - 1), units[-1]
