"""Motors: the run-up (Figs. 10 to 13) and the torque-speed curve."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

import bouncing_disk as bd
from bouncing_disk.plot._frame import (
    BLACK,
    BLUE,
    GREY,
    ORANGE,
    drawn_on,
    labelled,
    legend_above,
    note,
    style,
    unit_of,
    whole_number,
    with_error,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

#: Percentage of the members outside the band at either end.
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
    """The speed of a motor from rest: one member, the band of the middle 80 % of all, and the fit of their
    means.

    Args:
        runs: the run-ups to draw; for a motor, they are computed.
        members: number of run-ups, for a motor.
        duration: duration of a run-up (s), for a motor; by default eight of its time constants.
        intervals: number of intervals over which the speed is averaged, for a motor.
        seed: seed of the perturbations, for a motor.
        member: index of the member that is drawn as a curve.
        ax: axes to draw into.
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
    """Whether the fit of the means is meaningful.

    A run-up does not determine a rise longer than itself, nor a mean smaller than twice its error.
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
    """Eight time constants, from a short trial run of this motor, lengthened until it suffices."""
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
    """Speed and mechanical power of a motor over its load, with two standard errors, and speeds of coexisting
    motions.

    Args:
        curve: the curve to draw; for a motor, it is computed.
        load_torques: the loads (N m), for a motor, shape (n,); by default twelve from zero to the stall load.
        relative_error: requested standard error of the speeds, relative to the no-load speed, for a
            motor.
        ax: axes to draw into. The power has its own axis on the right.

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
    # A load that drives the rotor backwards ever faster leaves no steady speed.
    steady_status = bd.TorqueSpeedCurve.STATUSES.index("steady")
    steady = curve.status == steady_status
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
        for index, other in enumerate(curve.others):
            there = order[(other.status == steady_status)[order]]
            axes.errorbar(
                torques * other.load_torque[there], speeds * other.speed[there],
                _bars(speeds, other.speed_error[there]), color=BLACK, marker="o", markersize=3.0,
                markerfacecolor="white", capsize=1.5, linewidth=0.7, linestyle=(0, (1, 1)),
                label="coexisting motion" if index == 0 else None,
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
    """Two standard errors; none if the error is unknown."""
    bars: npt.NDArray[np.float64] = 2.0 * factor * np.where(np.isfinite(errors), errors, np.nan)
    return bars


def _level(left: Axes, right: Axes) -> None:
    """Aligns the zeros of both axes and shows all data."""
    ends = []
    for axis in (left, right):
        low, high = axis.dataLim.intervaly
        low, high = (min(low, 0.0), max(high, 0.0)) if np.isfinite(low) and np.isfinite(high) else (0.0, 0.0)
        room = 0.06 * (high - low) or 1.0
        ends.append((low - room if low < 0.0 else 0.0, high + room if high > 0.0 or low == 0.0 else 0.0))
    shares = sorted(-low / (high - low) for low, high in ends)
    # The share below zero, as the more demanding axis needs it unless this squeezes the other.
    below = shares[1] if shares[1] <= 0.7 else max(shares[0], 0.7)
    for axis, (low, high) in zip((left, right), ends):
        height = max(-low / below if below > 0.0 else 0.0, high / (1.0 - below) if below < 1.0 else 0.0)
        # A small margin below zero, so that points on it are whole.
        edge = 0.03 * height
        axis.set_ylim(-below * height - edge, (1.0 - below) * height + edge)
    left.axhline(0.0, color=GREY, linewidth=0.6, zorder=0)
