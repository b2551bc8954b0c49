"""The vertical motion: orbit diagrams (Fig. 6) and basins of attraction (Fig. 7)."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from importlib import import_module
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import numpy.typing as npt

import bouncing_disk as bd
from bouncing_disk.plot._frame import (
    BLACK,
    BLUE,
    COLOURS,
    GREEN,
    ORANGE,
    drawn_on,
    labelled,
    legend_above,
    note,
    number,
    out_of_range,
    pyplot,
    style,
    unit_of,
    whole_number,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

#: Size of a point (1/72 inch): if many make lines, and if each of a few must be visible.
_DOT, _LARGE_DOT = 0.6, 2.4
#: The number of points that counts as many.
_MANY = 20_000
#: Labels of basins that a legend explains.
_MOST_LABELS = 8
#: Normalised speed of the slow start, which comes to rest.
_SLOW = 0.05
#: Distance of a start from the period-1 orbit, so that it leaves an unstable one.
OFF_PERIOD_ONE = 1.01


def orbit_diagram(
    diagram: bd.OrbitDiagram | Mapping[str, bd.OrbitDiagram] | None = None,
    *,
    restitution: float = 0.5,
    axial_forcing: tuple[float, float] = (0.3, 0.62),
    columns: int = 600,
    transient: int = 3000,
    recorded: int = 256,
    quantity: Literal["phase", "speed"] = "phase",
    ax: Axes | None = None,
) -> tuple[Figure, Axes]:
    """An orbit (bifurcation) diagram, as in Fig. 6 of the paper.

    Without a diagram, two starts are followed at each forcing: one a hundredth off the period-1
    orbit (black), if that exists, and a slow one (grey), drawn on top.

    Args:
        diagram: the diagram to draw, with a legend if it has names.
        restitution: coefficient of restitution, without a diagram.
        axial_forcing: lowest and highest axial forcing parameter Gamma.
        columns: number of forcings, at least 1.
        transient, recorded: impacts to discard, and to draw, at each forcing.
        quantity: the quantity to draw over the forcing: the phase of the impacts in periods, or their normalised
            speed.
        ax: axes to draw into.

    >>> from bouncing_disk import plot
    >>> fig, ax = plot.orbit_diagram(restitution=0.6, axial_forcing=(0.26, 0.3), columns=5, transient=200)
    >>> [text.get_text() for text in ax.get_legend().get_texts()]
    ['from the period-1 orbit', 'from a slow impact']
    """
    if quantity not in ("phase", "speed"):
        raise ValueError(f'quantity must be "phase" or "speed", not {quantity!r}')
    ends = np.array(forcing_ends(axial_forcing))
    if diagram is None:
        columns = whole_number("columns", columns, 1)
        diagram = _two_starts(restitution, (ends[0], ends[1]), columns, transient, recorded)
    named = diagram if isinstance(diagram, Mapping) else {"": diagram}
    for orbits in named.values():
        if not isinstance(orbits, bd.OrbitDiagram):
            raise TypeError(
                f"diagram must be an OrbitDiagram or a mapping to them, not {type(orbits).__name__}"
            )
    # The forcings of the diagrams, not the requested ones, if there are any.
    forcings = np.concatenate([orbits.axial_forcing for orbits in named.values()] or [ends])
    impacts = sum(len(orbits.impact_phase) for orbits in named.values())
    speeds = np.concatenate([orbits.normalised_speed for orbits in named.values()] or [ends])
    factors = [unit_of(forcings, ""), (1.0, "")]
    if quantity == "speed":
        factors[1] = unit_of(speeds, "")
    (across, across_unit), (up, up_unit) = factors
    with style():
        fig, axes = drawn_on(ax)
        for place, (name, orbits) in enumerate(named.items()):
            values = orbits.impact_phase / (2.0 * np.pi) if quantity == "phase" else orbits.normalised_speed
            axes.plot(
                across * orbits.axial_forcing[orbits.column()],
                up * values,
                linestyle="",
                marker="o",
                markersize=dot_size(impacts),
                markeredgewidth=0.0,
                color=COLOURS[place % len(COLOURS)],
                label=str(name) or None,
                rasterized=True,
            )
        if len(forcings) and forcings.min() < forcings.max():
            axes.set_xlim(across * forcings.min(), across * forcings.max())
        elif len(forcings) and forcings[0] > 0.0:
            axes.set_xlim(0.9 * across * forcings[0], 1.1 * across * forcings[0])
        if quantity == "phase":
            axes.set_ylim(0.0, 1.0)
            axes.set_ylabel(r"impact phase $\tau_\mathrm{imp}/2\pi$")
        else:
            axes.set_ylim(bottom=0.0)
            axes.set_ylabel(labelled(r"impact speed $|w_A\Gamma/(\omega A)|$", up_unit))
        axes.set_xlabel(labelled(r"axial forcing $\Gamma$", across_unit))
        if impacts == 0:
            note(axes, "all disks rest" if len(forcings) and named else "no orbits")
        if any(map(str, named)):
            dots_legend(axes, own=ax is None)
    return fig, axes


def forcing_ends(axial_forcing: tuple[float, float]) -> tuple[float, float]:
    """The lowest and the highest forcing of a diagram."""
    ends = tuple(axial_forcing)
    if len(ends) != 2:
        raise bd.InvalidError(
            f"axial_forcing must be two numbers, the lowest and the highest, but has {len(ends)}; for other "
            "forcings pass bd.orbit_diagram(...)",
            "axial-forcing",
            {},
        )
    lowest, highest = (number("axial_forcing", end) for end in ends)
    if not lowest <= highest:
        raise out_of_range("axial_forcing", highest, f"[{lowest}, infinity), the lowest one first")
    return lowest, highest


def dot_size(points: int) -> float:
    """The size of a point: few must each be visible, many make lines."""
    return float(np.clip(_LARGE_DOT - (_LARGE_DOT - _DOT) * points / _MANY, _DOT, _LARGE_DOT))


#: Colour of a curve by its kind, and the mark of a special point.
_KINDS = {"fold": BLUE, "doubling": BLACK, "graze": GREEN}
_MARKS = {"fold": "s", "doubling": "o", "birth": "o", "graze": "x", "vanishing-impact": "x", "border-collision": "+"}
_SPECIAL = {
    "cusp": "^",
    "criticality-change": "D",
    "grazing-fold": "s",
    "grazing-doubling": "o",
    "resonance-1:1": "*",
    "resonance-1:2": "*",
}
#: Colours of verdicts behind curves, in the order of :attr:`bouncing_disk.Verdicts.KINDS`.
_VERDICTS = ("#dbe9f6", "#f9d5c0", "#efefef", "white", "#d9d9d9")
_NAMES = {"axial_forcing": r"axial forcing $\Gamma$", "restitution": "restitution $r$"}


def curves(
    curves: Sequence[bd.Curve], *, verdicts: bd.Verdicts | None = None, ax: Axes | None = None
) -> tuple[Figure, Axes]:
    """Curves of bifurcations in the plane of two parameters, over a map of verdicts.

    A curve of subcritical doublings is dashed.

    Args:
        curves: curves over the same two parameters.
        verdicts: what the disk does in the long run on a grid of the axial forcing and the restitution, drawn behind
            curves over these two.
        ax: where it is drawn.

    >>> import bouncing_disk as bd
    >>> from bouncing_disk import plot
    >>> bouncing = bd.ImpactMap(axial_forcing=0.45, restitution=0.5)
    >>> orbit = bouncing.settled_orbit(impact_phase=1.2, normalised_speed=1.3)
    >>> branch = bd.continued(bouncing, orbit, parameter_range=(0.1, 0.6))
    >>> found = bd.curves(bouncing, branch, parameter_range=(0.3, 0.9), branch_range=(0.1, 2))
    >>> fig, ax = plot.curves(found)
    >>> ax.get_ylabel()
    'restitution $r$'
    """
    planes = {curve.parameters for curve in curves}
    if len(planes) > 1:
        raise ValueError(f"curves must be over the same two parameters, not {sorted(planes)}")
    names = planes.pop() if planes else ("axial_forcing", "restitution")
    with style():
        fig, axes = drawn_on(ax)
        if verdicts is not None:
            if names != ("axial_forcing", "restitution"):
                raise ValueError(f"verdicts are over the axial forcing and the restitution, not {names}")
            _verdicts_behind(axes, verdicts)
        shown = set()
        for curve in curves:
            label = None if curve.kind in shown else curve.kind
            shown.add(curve.kind)
            colour = _KINDS.get(curve.kind, BLACK)
            across, up = curve.values.T
            axes.plot(across, up, color=colour, label=label)
            below = np.where(curve.criticality < 0, up, np.nan)
            axes.plot(across, below, color="white", linestyle=(0, (2, 2)), linewidth=0.9)
        for kind, mark in _SPECIAL.items():
            points = [found.values for curve in curves for found in curve.special if found.kind == kind]
            if points:
                across, up = np.array(points).T
                axes.plot(across, up, linestyle="", marker=mark, markersize=3.5, color=ORANGE, label=kind)
        axes.set_xlabel(_NAMES.get(names[0], names[0]))
        axes.set_ylabel(_NAMES.get(names[1], names[1]))
        if curves:
            legend_above(axes, own=ax is None, most=3)
        else:
            note(axes, "no curves")
    return fig, axes


def _verdicts_behind(axes: Any, verdicts: bd.Verdicts) -> None:
    """A cell for each verdict of a grid of forcings and restitutions."""
    across, column = np.unique(verdicts.axial_forcing, return_inverse=True)
    up, row = np.unique(verdicts.restitution, return_inverse=True)
    if len(across) < 2 or len(up) < 2 or len(across) * len(up) != len(verdicts.kind):
        raise ValueError("verdicts must lie on a grid of axial forcings and restitutions")
    kinds = np.zeros((len(up), len(across)), dtype=int)
    kinds[row, column] = verdicts.kind
    colours = import_module("matplotlib.colors").ListedColormap(_VERDICTS)
    axes.pcolormesh(
        across, up, kinds, cmap=colours, vmin=-0.5, vmax=len(_VERDICTS) - 0.5, shading="nearest", rasterized=True
    )


def branches(
    branches: bd.Branch | Sequence[bd.Branch],
    *,
    quantity: Literal["phase", "speed"] = "phase",
    ax: Axes | None = None,
) -> tuple[Figure, Axes]:
    """Branches of periodic orbits over their parameter: solid where they attract, dashed elsewhere, with their
    bifurcations.

    Args:
        branches: one branch, or several over the same parameter.
        quantity: the quantity to draw: the phase of the impacts in periods, or their normalised speed.
        ax: where it is drawn.

    >>> import bouncing_disk as bd
    >>> from bouncing_disk import plot
    >>> bouncing = bd.ImpactMap(axial_forcing=0.45, restitution=0.5)
    >>> orbit = bouncing.settled_orbit(impact_phase=1.2, normalised_speed=1.3)
    >>> fig, ax = plot.branches(bd.continued(bouncing, orbit, parameter_range=(0.1, 0.6)))
    >>> [text.get_text() for text in ax.get_legend().get_texts()]
    ['doubling']
    """
    if quantity not in ("phase", "speed"):
        raise ValueError(f'quantity must be "phase" or "speed", not {quantity!r}')
    all_of = [branches] if isinstance(branches, bd.Branch) else list(branches)
    with style():
        fig, axes = drawn_on(ax)
        shown = set()
        for branch in all_of:
            phases = np.mod(branch.impact_phase, 2.0 * np.pi) / (2.0 * np.pi)
            values = phases if quantity == "phase" else branch.normalised_speed
            for one in values.T:
                # A phase that passes 2 pi is no line across the figure.
                jumps = np.abs(np.diff(one, prepend=one[:1])) > 0.5
                line = np.where(jumps & (quantity == "phase"), np.nan, one)
                axes.plot(branch.values, np.where(branch.is_stable, line, np.nan), color=BLACK)
                axes.plot(branch.values, line, color=BLACK, linestyle=(0, (2, 2)), linewidth=0.6)
            for found in branch.bifurcations:
                orbit = found.orbit
                own = orbit.impact_phase / (2.0 * np.pi) if quantity == "phase" else orbit.normalised_speed
                label = None if found.kind in shown else found.kind
                shown.add(found.kind)
                axes.plot(
                    np.full(len(own), found.parameter),
                    own,
                    linestyle="",
                    marker=_MARKS.get(found.kind, "."),
                    markersize=3.5,
                    color=_KINDS.get(found.kind, ORANGE),
                    label=label,
                )
        names = {branch.parameter for branch in all_of}
        axes.set_xlabel(", ".join(_NAMES.get(name, name) for name in sorted(names)))
        if quantity == "phase":
            axes.set_ylim(0.0, 1.0)
            axes.set_ylabel(r"impact phase $\tau_\mathrm{imp}/2\pi$")
        else:
            axes.set_ylim(bottom=0.0)
            axes.set_ylabel(r"impact speed $|w_A\Gamma/(\omega A)|$")
        legend_above(axes, own=ax is None, most=3)
        if not all_of:
            note(axes, "no branches")
    return fig, axes


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
        diagrams["from the period-1 orbit"] = diagram(
            forcings[born], phases, -OFF_PERIOD_ONE * velocities / np.pi
        )
    # On top, because beyond the crisis both are on the same attractor.
    diagrams["from a slow impact"] = diagram(forcings, 0.0, _SLOW)
    return diagrams


def dots_legend(ax: Any, own: bool) -> None:
    """A legend with visible dots that hides no point."""
    legend = legend_above(ax, own=own, most=2, handletextpad=0.1)
    for handle in legend.get_lines():
        handle.set_marker("o")
        handle.set_markersize(3.0)


def basins(
    basins: bd.Basins | bd.Attractors | bd.ImpactMap,
    *,
    phases: int = 600,
    speeds: int = 400,
    speed_range: tuple[float, float] = (0.0, 3.0),
    legend: bool = True,
    ax: Axes | None = None,
) -> tuple[Figure, Axes]:
    """Basins of attraction, as in Fig. 7 of the paper: white where the disk comes to rest, dark where it bounces
    for ever.

    Args:
        basins: the basins to draw; for attractors or a map, the basins of all attractors that
            :func:`bouncing_disk.attractors` finds.
        phases, speeds: cells along the impact phase and speed, for attractors or a map.
        speed_range: lowest and highest normalised speed, for attractors or a map.
        legend: whether the colours are explained above the axes.
        ax: axes to draw into.

    >>> import bouncing_disk as bd
    >>> from bouncing_disk import plot
    >>> bouncing = bd.ImpactMap(axial_forcing=0.34, restitution=0.5)
    >>> fig, ax = plot.basins(bd.basins(bouncing, phases=40, speeds=30))
    >>> [float(end) for end in ax.get_xlim()]
    [0.0, 1.0]
    """
    if isinstance(basins, bd.ImpactMap):
        basins = bd.attractors(basins)
    if isinstance(basins, bd.Attractors):
        basins = basins.basins(phases=phases, speeds=speeds, speed_range=speed_range)
    elif not isinstance(basins, bd.Basins):
        raise TypeError(f"basins must be Basins, Attractors or an ImpactMap, not {type(basins).__name__}")
    colours = _basin_colours(len(basins.meaning))
    factor, unit = unit_of(basins.speed_range, "")
    low, high = (factor * speed for speed in basins.speed_range)
    with style():
        fig, axes = drawn_on(ax)
        axes.imshow(
            np.array(colours)[basins.labels],
            origin="lower",
            extent=(*basins.phase_range, low, high),
            aspect="auto",
            interpolation="nearest",
        )
        axes.set_xlabel(r"impact phase $\tau_\mathrm{imp}/2\pi$")
        axes.set_ylabel(labelled(r"impact speed $|w_A\Gamma/(\omega A)|$", unit))
        # Ticks must be visible on white and on dark parts of the image.
        axes.tick_params(which="both", direction="out", top=False, right=False)
        if legend:
            _label_legend(axes, basins, colours, own=ax is None)
    return fig, axes


def _basin_colours(labels: int) -> list[tuple[float, float, float]]:
    """The colour of each label: undecided, at rest, the known orbits."""
    to_rgb = import_module("matplotlib.colors").to_rgb
    dark = pyplot().get_cmap("viridis")(np.linspace(0.35, 0.95, max(labels - 3, 1)))
    named = [ORANGE, "white", BLACK, *dark]
    return [to_rgb(colour) for colour in named[:labels]]


def _label_legend(ax: Any, basins: bd.Basins, colours: list[tuple[float, float, float]], own: bool) -> None:
    """The labels that occur; if there are many, the rarest share one line."""
    patch: Any = import_module("matplotlib.patches").Patch
    shares = {label: basins.share(label) for label in range(len(basins.meaning))}
    shown = [label for label, share in shares.items() if share > 0.0]
    if len(shown) > _MOST_LABELS:
        by_share = sorted(shown, key=lambda label: -shares[label])
        shown = sorted(by_share[: _MOST_LABELS - 1])
    handles = [
        patch(facecolor=colours[label], edgecolor=BLACK, linewidth=0.6, label=_explained(basins, label))
        for label in shown
    ]
    others = [label for label, share in shares.items() if share > 0.0 and label not in shown]
    if others:
        share = sum(shares[label] for label in others)
        words = f"{len(others)} others ({100.0 * share:.1f} %)"
        handles.append(patch(facecolor="none", edgecolor="none", label=words))
    most = len(handles) if len(handles) < 3 else 2
    legend_above(ax, handles, own=own, most=most, handlelength=1.0, columnspacing=1.2)


def _explained(basins: bd.Basins, label: int) -> str:
    """A short meaning of a label, and its share."""
    orbit = re.fullmatch(r"periodic orbit: impacts (\d+), platform periods (\d+)", basins.meaning[label])
    if orbit is None:
        meaning = re.sub(r"(:|, then| again and again| for ever).*", "", basins.meaning[label])
    else:
        impacts, periods = orbit.groups()
        meaning = f"period {impacts}" if impacts == periods else f"period {impacts} in {periods} cycles"
    return f"{meaning} ({100.0 * basins.share(label):.1f} %)"


