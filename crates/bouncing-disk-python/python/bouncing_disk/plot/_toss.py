"""Tosses: their motion (Fig. 5), a film of it, and how they depend on the hand (Fig. 4)."""

from __future__ import annotations

from collections.abc import Sequence
from importlib import import_module
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import numpy.typing as npt

import bouncing_disk as bd
from bouncing_disk.plot._frame import (
    BLACK,
    BLUE,
    COLOURS,
    GREY,
    ORANGE,
    SINGLE_COLUMN,
    drawn_on_columns,
    drawn_on_rows,
    finite_array,
    in_words,
    labelled,
    legend_above,
    note,
    number,
    of_pi,
    out_of_range,
    pyplot,
    style,
    unit_of,
    whole_number,
)

if TYPE_CHECKING:
    from matplotlib.animation import FuncAnimation
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

#: The events that are drawn, with their marks and whether these are filled.
_EVENTS = (("separation", "o", False), ("impact", "o", True), ("attachment", "s", True))
#: Of more events the marks would cover the curves.
_MOST_EVENTS = 400
#: Points of the curves.
_SAMPLES_PER_PERIOD = 24.0
_LEAST_SAMPLES, _MOST_SAMPLES = 2_000, 200_000


def trajectory_of(
    motion: bd.System | bd.Trajectory, initial_spin: Literal["absolute-rest", "with-hand"]
) -> bd.Trajectory:
    """The motion that is drawn."""
    if isinstance(motion, bd.System):
        return bd.toss_trajectory(motion, initial_spin=initial_spin)
    if not isinstance(motion, bd.Trajectory):
        raise TypeError(f"motion must be a System or a Trajectory, not {type(motion).__name__}")
    return motion


def enough_samples(trajectory: bd.Trajectory) -> int:
    """So many that the oscillation of the platform is seen as one."""
    periods = (trajectory.end_time - trajectory.start_time) / trajectory.system.period
    return int(np.clip(_SAMPLES_PER_PERIOD * periods, _LEAST_SAMPLES, _MOST_SAMPLES))


def toss(
    motion: bd.System | bd.Trajectory,
    *,
    initial_spin: Literal["absolute-rest", "with-hand"] = "absolute-rest",
    samples: int | None = None,
    ax: Sequence[Axes] | np.ndarray[Any, Any] | None = None,
) -> tuple[Figure, np.ndarray[Any, Any]]:
    """Height and angle of disk and platform over time, with the events, as Fig. 5 of the paper.

    Of a motion with more than 400 events, the events are left out: they would cover the curves.

    Args:
        motion: what is drawn; of a system, its toss until the disk lands.
        initial_spin: how the toss of a system starts, as of ``toss_trajectory``.
        samples: points of the curves; by default 2000, or of a long motion 24 in each period of the platform,
            but not more than 200000.
        ax: where height and angle are drawn.

    Returns:
        (Figure, array of two Axes).

    >>> import bouncing_disk as bd
    >>> from bouncing_disk import plot
    >>> fig, (height, angle) = plot.toss(bd.System.pizza_toss())
    >>> height.get_ylabel(), angle.get_xlabel()
    ('height (m)', 'time (s)')
    """
    trajectory = trajectory_of(motion, initial_spin)
    began = trajectory.start_time
    periods = (trajectory.end_time - began) / trajectory.system.period
    samples = enough_samples(trajectory) if samples is None else samples
    curve, events = trajectory.samples(count=samples), trajectory.events()
    if len(curve.time) == 0:
        raise bd.InvalidError("a motion without events has no trajectory to draw", "no-events", {})
    names = events.names()
    seconds, second = unit_of(curve.time - began, "s")
    metres, metre = unit_of(np.concatenate([curve.height, curve.platform_height]), "m")
    radians, radian = unit_of(np.concatenate([curve.angle, curve.platform_angle]), "rad")
    time = seconds * (curve.time - began)
    # Of many oscillations, thick lines would leave a black area.
    of_platform, of_disk = (
        float(np.clip(40.0 / max(count, 1.0), 0.3, 1.0)) for count in (periods, len(names))
    )
    with style():
        fig, axes = drawn_on_rows(ax, 2, 3.6)
        rows = [
            (axes[0], metres, curve.height, curve.platform_height, events.height, labelled("height", metre)),
            (axes[1], radians, curve.angle, curve.platform_angle, events.angle, labelled("angle", radian)),
        ]
        for panel, factor, disk, platform, _, label in rows:
            width = 1.2 if panel is axes[1] else 1.2 * of_disk
            panel.plot(time, factor * platform, color=BLUE, linewidth=0.8 * of_platform, label="platform")
            panel.plot(time, factor * disk, color=BLACK, linewidth=width, label="disk")
            panel.set_ylabel(label)
            panel.margins(y=0.08)
        for kind, marker, filled in _EVENTS if len(names) <= _MOST_EVENTS else ():
            chosen = [place for place, name in enumerate(names) if name == kind]
            for panel, factor, _, _, values, _ in rows if chosen else ():
                panel.plot(
                    seconds * (events.time[chosen] - began),
                    factor * values[chosen],
                    linestyle="",
                    marker=marker,
                    markersize=3.6 if len(names) <= 40 else 2.2,
                    markerfacecolor=BLACK if filled else "white",
                    markeredgecolor=BLACK,
                    markeredgewidth=0.8 if len(names) <= 40 else 0.5,
                    clip_on=False,
                    zorder=3,
                    label=kind,
                )
        axes[1].set_xlim(0.0, 1.02 * time[-1])
        axes[1].set_xlabel(labelled("time", second))
        legend = legend_above(axes[0], own=ax is None)
        for line in legend.get_lines():
            line.set_linewidth(1.0)
        fig.align_ylabels(list(axes))
    return fig, axes


_FRAMES_PER_SECOND = 30
_MOST_FRAMES = 100_000


def toss_animation(
    motion: bd.System | bd.Trajectory,
    *,
    initial_spin: Literal["absolute-rest", "with-hand"] = "absolute-rest",
    slow_motion: float = 4.0,
    frames: int | None = None,
) -> FuncAnimation:
    """Disk and platform from the side, beside their heights over time.

    Dots at the contact radius, in front of the disk and of the platform, turn with them; they are paler
    behind.

    Args:
        motion: what is shown; of a system, its toss until the disk lands.
        initial_spin: how the toss of a system starts, as of ``toss_trajectory``.
        slow_motion: how many times longer the film lasts than the motion.
        frames: pictures, two at least; by default 30 a second, and not more than 100000.

    Returns:
        ``animation.save("toss.gif")`` writes it, ``HTML(animation.to_jshtml())`` shows it in a notebook. Keep
            it in a variable: Matplotlib ends an animation that nobody holds.
    """
    trajectory = trajectory_of(motion, initial_spin)
    duration = trajectory.end_time - trajectory.start_time
    slow_motion = number("slow_motion", slow_motion, positive=True)
    if frames is None:
        frames = round(min(max(duration * slow_motion * _FRAMES_PER_SECOND, 2.0), _MOST_FRAMES))
    curve = trajectory.samples(count=whole_number("frames", frames, 2))
    # The curves do not get coarser with the film.
    graphs = trajectory.samples(count=enough_samples(trajectory))
    if len(curve.time) == 0:
        raise bd.InvalidError("a motion without events has nothing to show", "no-events", {})
    across, across_unit = unit_of(trajectory.system.contact_radius, "m")
    metres, metre = unit_of(np.concatenate([graphs.height, graphs.platform_height]), "m")
    seconds, second = unit_of(duration, "s")
    radius = across * trajectory.system.contact_radius
    time = seconds * (curve.time - trajectory.start_time)
    heights, platform_heights = metres * curve.height, metres * curve.platform_height
    plt: Any = pyplot()
    with style():
        fig, (side, graph) = plt.subplots(
            1,
            2,
            sharey=True,
            figsize=(1.6 * SINGLE_COLUMN, 2.8),
            width_ratios=(1.0, 1.4),
            layout="constrained",
        )
        (platform,) = side.plot([], [], color=BLUE, linewidth=3.0, solid_capstyle="butt", label="platform")
        (disk,) = side.plot([], [], color=BLACK, linewidth=2.0, solid_capstyle="butt", label="disk")
        (platform_dot,) = side.plot([], [], "o", color=BLUE, markersize=5.0)
        (disk_dot,) = side.plot([], [], "o", color=ORANGE, markersize=5.0)
        side.set_xlim(-1.6 * radius, 1.6 * radius)
        side.set_xlabel(labelled("across", across_unit))
        side.set_ylabel(labelled("height", metre))
        instants = seconds * (graphs.time - trajectory.start_time)
        graph.plot(instants, metres * graphs.platform_height, color=GREY, linewidth=0.8)
        graph.plot(instants, metres * graphs.height, color=GREY, linewidth=0.8)
        (platform_now,) = graph.plot([], [], "o", color=BLUE, markersize=3.6, label="platform")
        (disk_now,) = graph.plot([], [], "o", color=BLACK, markersize=3.6, label="disk")
        graph.set_xlim(0.0, time[-1])
        graph.set_xlabel(labelled("time", second))
        # Above the axes, where it hides no flight.
        graph.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=2, borderaxespad=0.2)
        low = metres * min(graphs.platform_height.min(), graphs.height.min())
        high = metres * max(graphs.platform_height.max(), graphs.height.max())
        room = 0.08 * (high - low) or 1.0
        side.set_ylim(low - room, high + room)
        # Laid out once and not in every picture, which takes ten times as long as the picture itself.
        fig.canvas.draw()
        fig.set_layout_engine("none")

    def show(frame: int) -> tuple[Any, ...]:
        bodies = (
            (platform, platform_dot, platform_now, platform_heights[frame], curve.platform_angle[frame], 1.3),
            (disk, disk_dot, disk_now, heights[frame], curve.angle[frame], 1.0),
        )
        for line, dot, now, height, angle, width in bodies:
            line.set_data([-width * radius, width * radius], [height, height])
            dot.set_data([radius * np.cos(angle)], [height])
            dot.set_alpha(1.0 if np.sin(angle) <= 0.0 else 0.35)
            now.set_data([time[frame]], [height])
        return platform, platform_dot, platform_now, disk, disk_dot, disk_now

    animation: FuncAnimation = import_module("matplotlib.animation").FuncAnimation(
        fig, show, frames=frames, interval=1000.0 * slow_motion * duration / frames, blit=True
    )
    return animation


_Toss = tuple[float, float]

#: The default coefficients of friction, in units of the system's own.
_FRICTIONS = (5.0 / 6.0, 1.0, 7.0 / 6.0)
#: A maximum lies between the neighbours of the best of these points, and is looked for there again.
_FIRST_POINTS, _POINTS, _ROUNDS = 60, 9, 8
#: Of the largest angular speed that the platform may have, which is no speed of the disk.
_ROUNDING = 1.0e-14
#: Curves of fewer points have marks, without which one point would not be seen.
_FEW = 8


def toss_speed(
    system: bd.System,
    *,
    phase_lags: npt.ArrayLike = (0.0, np.pi / 8.0, np.pi / 4.0, 3.0 * np.pi / 8.0, np.pi / 2.0),
    frictions: npt.ArrayLike | None = None,
    points: int = 200,
    ax: Sequence[Axes] | np.ndarray[Any, Any] | None = None,
) -> tuple[Figure, np.ndarray[Any, Any]]:
    """Airborne speed of single tosses against the phase of separation, and against the amplitude angle for
    several coefficients of friction, as Figs. 4(d) and (e).

    The stroke c = (A^2 + (a_e Phi)^2)^(1/2) of the system is kept, and divided otherwise between height and
    twist, from a vertical motion up to the last one that tosses the disk. The more twist there is, the later
    the disk leaves. A circle marks the fastest toss of each coefficient of friction.

    Args:
        system: the tosses have its stroke, frequency and disk.
        phase_lags: the phase lags (rad) of the first panel, a curve each; the friction is that of the system,
            shape (n,).
        frictions: the coefficients of friction of the second panel, a curve each; the phase lag is that of
            the system. By default 5/6, 1 and 7/6 of the system's own, which are the paper's for its toss,
            shape (m,).
        points: amplitude angles of each curve.
        ax: where the panels are drawn.

    Returns:
        (Figure, array of two Axes).

    >>> import bouncing_disk as bd
    >>> from bouncing_disk import plot
    >>> fig, (separation, friction) = plot.toss_speed(bd.System.pizza_toss(), points=10)
    >>> [text.get_text() for text in friction.get_legend().get_texts()]
    ['$0.5$', '$0.6$', '$0.7$']
    """
    if not isinstance(system, bd.System):
        raise TypeError(f"system must be a System, not {type(system).__name__}")
    lags = finite_array("phase_lags", phase_lags)
    if frictions is None:
        coefficients = np.unique(system.friction * np.array(_FRICTIONS))
    else:
        coefficients = finite_array("frictions", frictions)
    for field, given in (("phase_lags", lags), ("frictions", coefficients)):
        if not len(given):
            raise bd.InvalidError(f"{field} is empty; give one at least", "empty", {"field": field})
    if coefficients.min() < 0.0:
        raise out_of_range("frictions", float(coefficients.min()), "[0, infinity)")
    points = whole_number("points", points, 1)
    last = _last_angle(system)
    # They crowd at the last one, at which the phase of separation has a square root.
    angles = last * (1.0 - (1.0 - (np.arange(points) + 0.5) / points) ** 2)
    by_lag = np.array([_curve(system.replace(phase_lag=lag), angles) for lag in lags.tolist()])
    rubbing = [system.replace(friction=friction) for friction in coefficients.tolist()]
    by_friction = np.array([_curve(changed, angles) for changed in rubbing])
    best = np.array([_fastest(changed, last) for changed in rubbing])
    marker = "o" if points < _FEW else None
    factor, unit = unit_of(np.concatenate([by_lag[..., 0].ravel(), by_friction[..., 0].ravel()]), "rad/s")
    with style():
        fig, axes = drawn_on_columns(ax, 2, 2.6)
        colours = pyplot().get_cmap("viridis")(np.linspace(0.0, 0.85, len(lags)))
        for lag, colour, curve in zip(lags, colours, by_lag):
            axes[0].plot(
                curve[:, 1] / np.pi, factor * curve[:, 0], color=colour, marker=marker, markersize=2.4,
                label=f"${of_pi(float(lag))}$",
            )  # fmt: skip
        for place, (friction, curve) in enumerate(zip(coefficients, by_friction)):
            colour = COLOURS[place % len(COLOURS)]
            axes[1].plot(
                angles / np.pi, factor * curve[:, 0], color=colour, marker=marker, markersize=2.4,
                label=f"${in_words(float(friction))}$",
            )  # fmt: skip
            axes[1].plot(
                best[place, 0] / np.pi, factor * best[place, 1], linestyle="", marker="o", markersize=4.5,
                markerfacecolor="white", markeredgecolor=colour, clip_on=False, zorder=3,
            )  # fmt: skip
        axes[0].set_xlabel(r"phase of separation $\tau_\mathrm{sep}/\pi$")
        axes[1].set_xlabel(r"amplitude angle $\phi_L/\pi$")
        for panel, title in zip(axes, (r"phase lag $\theta$", r"friction $\mu$")):
            panel.set_ylabel(labelled("airborne speed", unit))
            panel.margins(y=0.08)
            panel.set_xlim(0.0, 0.5)
            if np.isnan(best[:, 0]).all():
                note(panel, "no motion tosses the disk")
            legend_above(
                panel, own=ax is None, most=5, columnspacing=0.8, handlelength=1.0, handletextpad=0.3,
                title=title, title_fontsize=9.5, alignment="right",
            )  # fmt: skip
    return fig, axes


def _at(system: bd.System, angle: float) -> bd.System:
    """The system with its stroke at another amplitude angle."""
    return bd.System.from_stroke(
        stroke=system.stroke,
        amplitude_angle=angle,
        angular_frequency=system.angular_frequency,
        phase_lag=system.phase_lag,
        **system.to_dict()["disk"],
    )


def _last_angle(system: bd.System) -> float:
    """Up to this angle the platform falls away from the disk: its peak acceleration exceeds the preload."""
    return float(np.arccos(min(1.0, 1.0 / max(1.0, _at(system, 0.0).peak_acceleration))))


def _toss(system: bd.System, angle: float) -> _Toss:
    """Airborne speed and phase of separation."""
    toss = _single_toss(_at(system, angle))
    if toss is None:
        return np.nan, np.nan
    # Where nothing turns the disk, its speed is a rounding error of that of the platform.
    turns = (
        abs(toss.airborne_speed)
        > _ROUNDING * system.stroke * system.angular_frequency / system.contact_radius
    )
    return toss.airborne_speed if turns else 0.0, toss.separation_phase


def _curve(system: bd.System, angles: npt.NDArray[np.float64]) -> list[_Toss]:
    return [_toss(system, angle) for angle in angles.tolist()]


def _fastest(system: bd.System, last: float) -> _Toss:
    """The angle and the speed of the fastest toss, whichever way it turns."""
    low, high, points = 0.0, last, _FIRST_POINTS
    for _ in range(_ROUNDS):
        angles = np.linspace(low, high, points)
        speeds = np.array([speed for speed, _ in _curve(system, angles)])
        if not np.isfinite(speeds).any():
            return np.nan, np.nan
        place = int(np.nanargmax(np.abs(speeds)))
        # Where nothing turns there is nothing to mark.
        if speeds[place] == 0.0:
            return 0.0, np.nan
        low, high = angles[max(place - 1, 0)], angles[min(place + 1, points - 1)]
        points = _POINTS
    return float(angles[place]), float(speeds[place])


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

    Args:
        system: the tosses have its stroke, frequency and disk.
        phase_lags: the phase lags (rad), a curve each, shape (n,).
        points: amplitude angles of each curve.
        ax: where speed, efficiency and ratio are drawn.

    Returns:
        (Figure, array of three Axes).

    >>> import bouncing_disk as bd
    >>> from bouncing_disk import plot
    >>> fig, (speed, efficiency, ratio) = plot.toss_performance(bd.System.pizza_performance(), points=10)
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
    results = np.array([[_performance(system, float(angle), float(lag)) for angle in angles] for lag in lags])
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


def _performance(system: bd.System, angle: float, lag: float) -> tuple[float, float, float]:
    """Speed, efficiency and ratio of the toss with this amplitude angle and phase lag."""
    toss = _single_toss(_at(system.replace(phase_lag=lag), angle))
    if toss is None:
        return np.nan, np.nan, np.nan
    return toss.airborne_speed, toss.efficiency, np.nan if toss.speed_ratio is None else toss.speed_ratio


def _single_toss(system: bd.System) -> bd.TossPerformance | None:
    """The toss, where the disk leaves the platform."""
    try:
        return bd.single_toss(system)
    except bd.ComputationError as error:
        if error.kind != "never-leaves":
            raise
        return None
