"""The figure of the rotation over the forcing (Figs. 6(c) and (d))."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

import bouncing_disk as bd
from bouncing_disk.plot._checks import out_of_range, whole_number
from bouncing_disk.plot._dynamics import OFF_PERIOD_ONE, dot_size, dots_legend, forcing_ends
from bouncing_disk.plot._style import COLOURS, drawn_on, style
from bouncing_disk.plot._words import labelled, note, unit_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["rotation_diagram"]

#: Impacts that are left out at least. More are left out where the rotation takes longer than the vertical
#: motion to settle: so many in each period, of a chatter, for so many rise times.
_LEAST_TRANSIENT, _IMPACTS_PER_PERIOD, _RISE_TIMES = 3000, 4.0, 5.0
#: How much longer a motion whose rotation has not settled is followed, each time, and how many times.
_LONGER, _TIMES = 4, 2
#: Phases and speeds of two rounds of a settled motion agree to this.
_TOLERANCE = 1.0e-7


def rotation_diagram(
    system: bd.System,
    *,
    axial_forcing: tuple[float, float] = (0.3, 0.62),
    columns: int = 400,
    transient: int | None = None,
    recorded: int = 256,
    normalised: bool = True,
    ax: Axes | None = None,
) -> tuple[Figure, Axes]:
    r"""The angular speed of the disk at impacts over the axial forcing, as Figs. 6(c) and (d) of the paper.

    The amplitude of the vibration alone is varied: Gamma = A omega^2/(pi g). Twist, frequency and disk are
    those of the system, and so is the angular forcing Gamma_T. Two disks that do not turn are followed at
    each forcing: one a hundredth off the period-1 orbit (black), where there is one, and one at rest on the
    platform (grey), which is drawn above it. Of a periodic or chattering motion one round is drawn. A disk
    that never leaves the platform has no point.

    Parameters
    ----------
    system : System
        What is driven; its amplitude does not matter.
    axial_forcing : (float, float), default (0.3, 0.62)
        Lowest and highest axial forcing parameter Gamma.
    columns : int, default 400
        Forcings, one at least.
    transient : int, optional
        Impacts that are left out at each of them; by default at least 3000, and more where the rotation takes
        longer to settle. Of an ultrasonic motor these are millions, and each column takes a second: choose
        few columns. How many periodic or chattering motions have not settled is said in the legend.
    recorded : int, default 256
        Impacts that are looked at after them, in [2, 10000000].
    normalised : bool, default True
        Whether speeds are in units of the platform's largest angular speed, omega Phi, or in rad/s.
    ax : Axes, optional
        Where it is drawn.

    Returns
    -------
    (Figure, Axes)

    Examples
    --------
    >>> import bouncing_disk as bd
    >>> from bouncing_disk import plot
    >>> fig, ax = plot.rotation_diagram(bd.System.pizza_toss(), columns=5)
    >>> [text.get_text() for text in ax.get_legend().get_texts()]
    ['from the period-1 orbit', 'from rest']
    """
    if not isinstance(system, bd.System):
        raise TypeError(f"system must be a System, not {type(system).__name__}")
    lowest, highest = forcing_ends(axial_forcing)
    if lowest < 0.0:
        raise out_of_range("axial_forcing", lowest, "[0, infinity)")
    columns = whole_number("columns", columns, 1)
    recorded = whole_number("recorded", recorded, 2, 10_000_000)
    left_out = [whole_number("transient", transient, 0)] if transient is not None else _long_enough(system)
    largest = system.peak_angular_speed
    if normalised and largest == 0.0:
        message = "a platform that does not twist has no angular speed as a unit; give normalised=False"
        raise bd.InvalidError(message, "no-twist", {"field": "normalised"})
    forcings = np.linspace(lowest, highest, columns)
    followed = _two_starts(system, forcings, left_out, recorded)
    speeds = np.concatenate([orbit.angular_speed for orbits in followed.values() for _, orbit in orbits])
    up, up_unit = (1.0 / largest, "") if normalised else unit_of(speeds, "rad/s")
    across, across_unit = unit_of(forcings, "")
    with style():
        fig, axes = drawn_on(ax)
        for colour, (name, orbits) in zip(COLOURS, followed.items()):
            impacts = [len(orbit.angular_speed) for _, orbit in orbits]
            axes.plot(
                across * np.repeat([forcing for forcing, _ in orbits], impacts),
                up * np.concatenate([orbit.angular_speed for _, orbit in orbits]),
                linestyle="",
                marker="o",
                markersize=dot_size(len(speeds)),
                markeredgewidth=0.0,
                color=colour,
                label=name + _unsettled([orbit for _, orbit in orbits]),
                rasterized=True,
            )
        if lowest < highest:
            axes.set_xlim(across * lowest, across * highest)
        elif lowest > 0.0:
            axes.set_xlim(0.9 * across * lowest, 1.1 * across * lowest)
        axes.margins(y=0.06)
        if normalised:
            axes.set_ylabel(r"angular speed at impacts $\dot{\alpha}\,^{\prime}/(\omega\Phi)$")
        else:
            axes.set_ylabel(labelled(r"angular speed at impacts $\dot{\alpha}\,^{\prime}$", up_unit))
        axes.set_xlabel(labelled(r"axial forcing $\Gamma$", across_unit))
        if not len(speeds):
            note(axes, "all disks rest")
        dots_legend(axes, own=ax is None)
    return fig, axes


def _long_enough(system: bd.System) -> list[int]:
    """Impacts after which the rotation has settled in most cases, and those for the others."""
    periods = _RISE_TIMES * system.rise_time / system.period
    # Without friction it never changes.
    impacts = int(_IMPACTS_PER_PERIOD * periods) if np.isfinite(periods) else 0
    return [max(_LEAST_TRANSIENT, impacts) * _LONGER**time for time in range(_TIMES + 1)]


def _two_starts(
    system: bd.System, forcings: npt.NDArray[np.float64], transients: list[int], recorded: int
) -> dict[str, list[tuple[float, bd.TossOrbit]]]:
    """What the two starts at each forcing settle on."""
    # Gamma = A omega^2/(pi g), and the unit of speed of the impact map.
    unit_of_speed = system.preload_acceleration / system.angular_frequency
    amplitude = np.pi * unit_of_speed / system.angular_frequency
    starts: dict[str, list[tuple[float, bd.TossOrbit]]] = {"from the period-1 orbit": [], "from rest": []}
    for forcing in forcings.tolist():
        driven = system.replace(amplitude=amplitude * forcing)
        orbit = bd.ImpactMap.of_system(driven).period_one() if forcing > 0.0 else None
        if orbit is not None:
            phase, velocity = orbit
            thrown = -OFF_PERIOD_ONE * driven.restitution * velocity * unit_of_speed
            settled = _settled(driven, phase, thrown, transients, recorded)
            starts["from the period-1 orbit"].append((forcing, settled))
        # On top: beyond the crisis both are on the same attractor.
        starts["from rest"].append((forcing, _settled(driven, 0.0, None, transients, recorded)))
    return {name: orbits for name, orbits in starts.items() if orbits}


def _settled(
    system: bd.System, phase: float, thrown: float | None, transients: list[int], recorded: int
) -> bd.TossOrbit:
    """What a disk settles on that does not turn at first, and rests on the platform unless it is thrown."""
    for transient in transients:
        orbit = bd.multi_toss(
            system,
            phase=phase,
            angular_speed=0.0,
            relative_velocity=thrown,
            transient_impacts=transient,
            examined_impacts=recorded,
            tolerance=_TOLERANCE,
        )
        if orbit.rotation_repeats is not False:
            break
    return orbit


def _unsettled(orbits: list[bd.TossOrbit]) -> str:
    """How many motions repeat, but for the rotation."""
    rising = sum(orbit.rotation_repeats is False for orbit in orbits)
    return f" ({rising} of {len(orbits)} not settled)" if rising else ""
