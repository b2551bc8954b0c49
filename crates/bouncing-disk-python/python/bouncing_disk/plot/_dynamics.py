"""The figures of the vertical motion: orbit diagrams (Fig. 6) and basins of attraction (Fig. 7)."""

from __future__ import annotations

import re
from collections.abc import Mapping
from importlib import import_module
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import numpy.typing as npt

import bouncing_disk as bd
from bouncing_disk.plot._style import BLACK, BLUE, GREY, ORANGE, drawn_on, pyplot, style

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["basins", "orbit_diagram"]

_COLOURS = (BLACK, GREY, BLUE, ORANGE)
#: Size of a point (1/72 inch): several of them make a line.
_DOT = 0.6
#: Of the normalised speed of a start that comes to rest: a slow one.
_SLOW = 0.05
#: How far off the period-1 orbit a start is, so that it leaves it where it is unstable.
_OFF = 1.01


def orbit_diagram(
    diagram: bd.OrbitDiagram | Mapping[str, bd.OrbitDiagram] | None = None,
    *,
    restitution: float = 0.5,
    axial_forcing: tuple[float, float] = (0.3, 0.62),
    columns: int = 600,
    transient: int = 2000,
    recorded: int = 100,
    quantity: Literal["phase", "speed"] = "phase",
    ax: Axes | None = None,
) -> tuple[Figure, Axes]:
    """An orbit (bifurcation) diagram, as Fig. 6 of the paper.

    Without a diagram, two starts are followed at each forcing: one a hundredth off the period-1 orbit
    (black), where there is one, and a slow one (grey), which is drawn above it.

    Parameters
    ----------
    diagram : OrbitDiagram, or mapping of names to them, optional
        What is drawn, with a legend if it has names.
    restitution : float, default 0.5
        Coefficient of restitution, if none is given.
    axial_forcing : (float, float), default (0.3, 0.62)
        Lowest and highest axial forcing parameter Gamma.
    columns : int, default 600
        Forcings.
    transient, recorded : int, default 2000, 100
        Impacts that are left out, and drawn, at each of them.
    quantity : {"phase", "speed"}, default "phase"
        What is drawn over the forcing: the phase of the impacts in periods, or their normalised speed.
    ax : Axes, optional
        Where it is drawn.

    Returns
    -------
    (Figure, Axes)
    """
    if quantity not in ("phase", "speed"):
        raise ValueError(f'quantity must be "phase" or "speed", not {quantity!r}')
    if diagram is None:
        diagram = _two_starts(restitution, axial_forcing, columns, transient, recorded)
    named = diagram if isinstance(diagram, Mapping) else {"": diagram}
    colours = _COLOURS if len(named) > 1 else (BLACK,)
    with style():
        fig, ax = drawn_on(ax)
        for place, (name, orbits) in enumerate(named.items()):
            values = orbits.impact_phase / (2.0 * np.pi) if quantity == "phase" else orbits.normalised_speed
            ax.plot(
                orbits.axial_forcing[orbits.column()],
                values,
                linestyle="",
                marker="o",
                markersize=_DOT,
                markeredgewidth=0.0,
                color=colours[place % len(colours)],
                label=name or None,
                rasterized=True,
            )
        ends = np.concatenate([orbits.axial_forcing for orbits in named.values()])
        if len(ends) and ends.min() < ends.max():
            ax.set_xlim(ends.min(), ends.max())
        if quantity == "phase":
            ax.set_ylim(0.0, 1.0)
            ax.set_ylabel(r"impact phase $\tau_\mathrm{imp}/2\pi$")
        else:
            ax.set_ylim(bottom=0.0)
            ax.set_ylabel(r"impact speed $|w_A\Gamma/(\omega A)|$")
        ax.set_xlabel(r"axial forcing $\Gamma$")
        if any(named):
            _dots_legend(ax)
    return fig, ax


def _two_starts(
    restitution: float, axial_forcing: tuple[float, float], columns: int, transient: int, recorded: int
) -> dict[str, bd.OrbitDiagram]:
    def diagram(forcings: npt.ArrayLike, phases: npt.ArrayLike, speeds: npt.ArrayLike) -> bd.OrbitDiagram:
        return bd.orbit_diagram(
            axial_forcing=forcings,
            restitution=restitution,
            impact_phase=phases,
            normalised_speed=speeds,
            transient=transient,
            recorded=recorded,
        )

    forcings = np.linspace(*axial_forcing, columns)
    orbits = [
        bd.ImpactMap(axial_forcing=forcing, restitution=restitution).period_one() for forcing in forcings
    ]
    born = np.array([orbit is not None for orbit in orbits], dtype=np.bool_)
    diagrams = {}
    if born.any():
        phases, velocities = np.array([orbit for orbit in orbits if orbit is not None]).T
        diagrams["from the period-1 orbit"] = diagram(forcings[born], phases, -_OFF * velocities / np.pi)
    # On top: beyond the crisis both are on the same attractor.
    diagrams["from a slow impact"] = diagram(forcings, 0.0, _SLOW)
    return diagrams


def _dots_legend(ax: Any) -> None:
    """A legend with dots that can be seen, behind which no point is lost."""
    legend = ax.legend(
        loc="lower right",
        bbox_to_anchor=(1.0, 1.0),
        ncols=2,
        borderaxespad=0.2,
        handletextpad=0.1,
        columnspacing=1.0,
    )
    for handle in legend.legend_handles:
        handle.set_marker("o")
        handle.set_markersize(3.0)


def basins(
    basins: bd.Basins | bd.ImpactMap,
    *,
    phases: int = 600,
    speeds: int = 400,
    speed_range: tuple[float, float] = (0.0, 3.0),
    legend: bool = True,
    ax: Axes | None = None,
) -> tuple[Figure, Axes]:
    """Basins of attraction, as Fig. 7 of the paper: white where the disk comes to rest, dark where it bounces
    for ever.

    Parameters
    ----------
    basins : Basins or ImpactMap
        What is drawn; of a map, the basins of all attractors that :func:`bouncing_disk.attractors` finds.
    phases, speeds : int, default 600, 400
        Cells along the impact phase and speed, of a map.
    speed_range : (float, float), default (0, 3)
        Lowest and highest normalised speed, of a map.
    legend : bool, default True
        Whether the colours are explained above the axes.
    ax : Axes, optional
        Where it is drawn.

    Returns
    -------
    (Figure, Axes)
    """
    if isinstance(basins, bd.ImpactMap):
        basins = bd.attractors(basins).basins(phases=phases, speeds=speeds, speed_range=speed_range)
    elif not isinstance(basins, bd.Basins):
        raise TypeError(f"basins must be Basins or an ImpactMap, not {type(basins).__name__}")
    colours = _basin_colours(len(basins.meaning))
    with style():
        fig, ax = drawn_on(ax)
        ax.imshow(
            np.array(colours)[basins.labels],
            origin="lower",
            extent=(*basins.phase_range, *basins.speed_range),
            aspect="auto",
            interpolation="nearest",
        )
        ax.set_xlabel(r"impact phase $\tau_\mathrm{imp}/2\pi$")
        ax.set_ylabel(r"impact speed $|w_A\Gamma/(\omega A)|$")
        # Ticks of an image lie under it: they are dark where it is white, and must be seen where it is dark.
        ax.tick_params(which="both", direction="out", top=False, right=False)
        if legend:
            _label_legend(ax, basins, colours)
    return fig, ax


def _basin_colours(labels: int) -> list[tuple[float, float, float]]:
    """Of each label: undecided, at rest, the known orbits."""
    to_rgb = import_module("matplotlib.colors").to_rgb
    dark = pyplot().get_cmap("viridis")(np.linspace(0.35, 0.95, max(labels - 3, 1)))
    named = [ORANGE, "white", BLACK, *dark]
    return [to_rgb(colour) for colour in named[:labels]]


def _label_legend(ax: Any, basins: bd.Basins, colours: list[tuple[float, float, float]]) -> None:
    patch: Any = import_module("matplotlib.patches").Patch
    shown = [label for label in range(len(basins.meaning)) if basins.share(label) > 0.0]
    handles = [
        patch(facecolor=colours[label], edgecolor=BLACK, linewidth=0.6, label=_explained(basins, label))
        for label in shown
    ]
    ax.legend(
        handles=handles,
        loc="lower right",
        bbox_to_anchor=(1.0, 1.0),
        ncols=max(1, len(handles) if len(handles) < 3 else 2),
        borderaxespad=0.2,
        handlelength=1.0,
        columnspacing=1.2,
    )


def _explained(basins: bd.Basins, label: int) -> str:
    """What a label means, in a few words, and its share."""
    orbit = re.fullmatch(r"periodic orbit: impacts (\d+), platform periods (\d+)", basins.meaning[label])
    if orbit is None:
        meaning = re.sub(r"(:|, then| again and again| for ever).*", "", basins.meaning[label])
    else:
        impacts, periods = orbit.groups()
        meaning = f"period {impacts}" if impacts == periods else f"period {impacts} in {periods} cycles"
    return f"{meaning} ({100.0 * basins.share(label):.1f} %)"
