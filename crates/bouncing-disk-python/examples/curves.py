"""The plane of forcing and restitution: where period 1 is born and doubles to chaos, the crisis, and the grazes.

Writes docs/figures/curves.png, or the file that is named.
"""

from __future__ import annotations

import sys
from typing import Any

import bouncing_disk as bd
import numpy as np
from bouncing_disk import plot

FORCINGS, RESTITUTIONS = (0.1, 1.0), (0.2, 0.9)
PAPER = 0.5


def all_curves() -> list[bd.Curve]:
    """The curves of period 1 and of the orbits of 2, 4, 8 and 16 impacts that its doublings lead to."""
    bouncing = bd.ImpactMap(axial_forcing=0.45, restitution=PAPER)
    orbit = bouncing.settled_orbit(impact_phase=1.2, normalised_speed=1.3)
    assert orbit is not None
    ranges: dict[str, Any] = {"parameter_range": RESTITUTIONS, "branch_range": FORCINGS}
    found: list[bd.Curve] = []
    down = bd.continued(bouncing, orbit, parameter_range=FORCINGS, rising=False)
    branch = bd.continued(bouncing, orbit, parameter_range=FORCINGS)
    found += bd.curves(bouncing, down, **ranges)
    for impacts in (1, 2, 4, 8, 16):
        found += [curve for curve in bd.curves(bouncing, branch, **ranges) if curve.kind == "doubling"]
        doubling = next(k for k, own in enumerate(branch.bifurcations) if own.kind == "doubling")
        print(f"Gamma of {impacts} impacts: {branch.bifurcations[doubling].parameter:.7f}")
        if impacts < 16:
            branch = branch.switched(index=doubling, parameter_range=FORCINGS)
    return found


def crises(last: float) -> tuple[list[float], list[float]]:
    """Forcings and restitutions of the crises from the paper's restitution to another one."""
    restitutions = np.linspace(PAPER, last, round(20.0 * abs(last - PAPER)) + 1)
    found = bd.crises(restitution=restitutions, axial_forcing=(0.555, 0.565), impacts=200_000)
    known = [crisis for crisis in found if crisis is not None]
    return [crisis.axial_forcing for crisis in known], [crisis.restitution for crisis in known]


def main(name: str) -> None:
    """Computes and draws."""
    curves = all_curves()
    forcing, restitution = np.meshgrid(np.linspace(*FORCINGS, 181), np.linspace(*RESTITUTIONS, 141))
    verdicts = bd.verdicts(
        axial_forcing=forcing.ravel(),
        restitution=restitution.ravel(),
        impact_phase=1.2,
        normalised_speed=1.3,
        impacts=100_000,
    )
    with plot.style():
        fig, ax = plot.curves(curves, verdicts=verdicts)
        for last, label in ((0.3, "crisis"), (0.8, None)):
            ax.plot(*crises(last), color="#d55e00", label=label)
        ax.axhline(PAPER, color="#a8a8a8", linewidth=0.6)
        doublings = bd.doubling_cascade(restitution=PAPER, count=5).axial_forcing
        ax.plot(doublings, np.full(5, PAPER), linestyle="", marker="|", markersize=6.0, color="#222222")
        ax.set_xlim(FORCINGS)
        ax.set_ylim(RESTITUTIONS)
        ax.legend(loc="upper right", fontsize=7.5, frameon=True)
        fig.set_size_inches(5.0, 4.0)
        fig.savefig(name, dpi=150)


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "docs/figures/curves.png")
