"""How tosses and motors depend on their parameters (Figs. 4, 11 and 13)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

import bouncing_disk as bd
from bouncing_disk.plot._checks import finite_array, whole_number
from bouncing_disk.plot._style import BLACK, ORANGE, drawn_on, drawn_on_rows, pyplot, style
from bouncing_disk.plot._words import labelled, legend_above, note, of_pi, unit_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["motor_dependence", "toss_performance"]

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
#: Curves of fewer points have marks, without which one point would not be seen.
_FEW = 8


def toss_performance(
    system: bd.System,
    *,
    phase_lags: npt.ArrayLike = (0.0, np.pi / 8.0, np.pi / 4.0, 3.0 * np.pi / 8.0, np.pi / 2.0),
    points: int = 200,
    ax: Sequence[Axes] | np.ndarray[Any, Any] | None = None,
) -> tuple[Figure, np.ndarray[Any, Any]]:
    """Airborne speed, efficiency and speed ratio of single tosses against the amplitude angle, as Figs. 4(a)
    to (c).

    The stroke c = (A^2 + (a_e Phi)^2)^(1/2) of the system is kept, and divided otherwise between height and
    twist: the amplitude angle is 0 for a vertical motion and pi/2 for a rotary one. Motions that never toss
    the disk have no point.

    Parameters
    ----------
    system : System
        The tosses have its stroke, frequency and disk.
    phase_lags : (n,) array_like, default 0 to pi/2 by pi/8
        The phase lags (rad), a curve each.
    points : int, default 200
        Amplitude angles of each curve.
    ax : three Axes, optional
        Where speed, efficiency and ratio are drawn.

    Returns
    -------
    (Figure, array of three Axes)

    Examples
    --------
    >>> import bouncing_disk as bd
    >>> from bouncing_disk import plot
    >>> fig, (speed, efficiency, ratio) = plot.toss_performance(bd.System.pizza_toss(), points=10)
    >>> speed.get_ylabel()
    'airborne speed (rad/s)'
    """
    if not isinstance(system, bd.System):
        raise TypeError(f"system must be a System, not {type(system).__name__}")
    lags = finite_array("phase_lags", phase_lags)
    if not len(lags):
        raise bd.InvalidError("phase_lags is empty; give one at least", "empty", {"field": "phase_lags"})
    points = whole_number("points", points, 1)
    angles = np.pi / 2.0 * (np.arange(points) + 0.5) / points
    results = np.array([[_toss(system, float(angle), float(lag)) for angle in angles] for lag in lags])
    factor, unit = unit_of(results[..., 0], "rad/s")
    with style():
        fig, axes = drawn_on_rows(ax, 3, 5.0)
        colours = pyplot().get_cmap("viridis")(np.linspace(0.0, 0.85, len(lags)))
        labels = (
            labelled("airborne speed", unit),
            r"efficiency $\eta$",
            r"speed ratio $\nu$",
        )
        for column, (panel, label) in enumerate(zip(axes, labels)):
            for lag, colour, curve in zip(lags, colours, results):
                panel.plot(
                    angles / np.pi,
                    (factor if column == 0 else 1.0) * curve[:, column],
                    color=colour,
                    marker="o" if points < _FEW else None,
                    markersize=2.4,
                    label=f"${of_pi(float(lag))}$",
                )
            panel.set_ylabel(label)
            panel.margins(y=0.08)
            if np.isnan(results[..., column]).all():
                note(panel, "no motion tosses the disk")
        axes[-1].set_xlim(0.0, 0.5)
        axes[-1].set_xlabel(r"amplitude angle $\phi_L/\pi$")
        legend_above(
            axes[0], own=ax is None, most=5, columnspacing=0.8, handlelength=1.0, handletextpad=0.3,
            title=r"phase lag $\theta$", title_fontsize=9.5, alignment="right",
        )  # fmt: skip
        fig.align_ylabels(list(axes))
    return fig, axes


def _toss(system: bd.System, angle: float, lag: float) -> tuple[float, float, float]:
    """Speed, efficiency and ratio of the toss with this amplitude angle and phase lag."""
    changed = bd.System.from_stroke(
        stroke=system.stroke,
        amplitude_angle=angle,
        angular_frequency=system.angular_frequency,
        phase_lag=lag,
        **system.to_dict()["disk"],
    )
    try:
        toss = bd.single_toss(changed)
    except bd.ComputationError as error:
        if error.kind != "never-leaves":
            raise
        return np.nan, np.nan, np.nan
    return toss.airborne_speed, toss.efficiency, np.nan if toss.speed_ratio is None else toss.speed_ratio


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

    Parameters
    ----------
    motor : Motor or System
        What does not vary is its own.
    parameter : str
        What varies: an argument of :class:`~bouncing_disk.Motor`, whose alternative it takes the place of, or of
        :class:`~bouncing_disk.System`, where there is no motor or its data sheet has no such value.
    values : (n,) array_like
        Its values (SI).
    members : int, default 16
        Run-ups at each value, two at least: their scatter gives the errors.
    rise_times : float, default 6
        How long a run-up lasts, in rise times omega Phi a_g^2/(mu a_e g) of the system.
    seed : int, default 1
        Seed of the perturbations.
    ax : Axes, optional
        Where the speed is drawn; the stall acceleration has an axis of its own on the right.

    Returns
    -------
    (Figure, Axes)
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
