"""Functions that the tests sweep: at the top of a module, as a user's are."""

from __future__ import annotations

import os
import time
from pathlib import Path
from typing import Any

import numpy as np

import bouncing_disk as bd


def product(a: Any, b: Any) -> Any:
    return a * b


def scaled(a: Any, b: Any, factor: float) -> Any:
    return factor * a * b


def fields(a: Any, b: Any) -> dict[str, Any]:
    return {
        "sum": a + b,
        "pair": np.stack([a, b], axis=-1),
        "count": np.arange(len(a), dtype=np.int16) * 0 + 3,
    }


def point_fields(a: float, b: float) -> dict[str, Any]:
    return {"sum": a + b, "pair": [a, b], "count": np.int16(3)}


def nothing_or_ratio(a: Any, b: Any) -> Any:
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(a) / b


def refuses_three(a: Any, b: Any) -> Any:
    if np.any((np.asarray(a) == 3.0) & (np.asarray(b) == 20.0)):
        raise ValueError("three and twenty")
    return np.asarray(a) * b


def refuses_unless_mended(a: Any, b: Any, flag: str) -> Any:
    if not Path(flag).exists() and np.any(np.asarray(a) == 3.0):
        raise ValueError("not yet")
    return np.asarray(a) * b


def always_refuses(a: Any, b: Any) -> Any:
    raise RuntimeError("no")


def leaves(a: Any, b: Any) -> Any:
    raise SystemExit(3)


def branches(a: Any, b: Any) -> Any:
    """Takes one point alone, whatever it is given."""
    return a if a > b else b


def wrong_length(a: Any, b: Any) -> Any:
    return np.zeros(len(a) + 1)


def counted(a: Any, b: Any, log: str) -> Any:
    """Notes each call, so that a test knows what was computed."""
    with open(log, "a", encoding="utf-8") as file:
        file.write(f"{len(a)}\n")
    return a + b


def slow_speeds(axial_forcing: Any, restitution: Any, seconds: float, log: str) -> Any:
    """Chaotic orbits, whose last bit would show: and who computed them."""
    time.sleep(seconds)
    with open(log, "a", encoding="utf-8") as file:
        file.write(f"{os.getpid()}\n")
    diagram = bd.orbit_diagram(
        axial_forcing=axial_forcing,
        restitution=restitution,
        impact_phase=0.8,
        normalised_speed=1.3,
        transient=1000,
        recorded=1,
    )
    speeds = np.zeros(len(axial_forcing))
    speeds[diagram.column()] = diagram.normalised_speed
    return speeds
