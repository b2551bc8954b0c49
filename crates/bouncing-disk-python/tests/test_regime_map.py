"""The worked example of a sweep: the regime map."""

from __future__ import annotations

import importlib
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import bouncing_disk as bd

sys.path.insert(0, str(Path(__file__).parents[1] / "benchmarks"))

regime_map: Any = importlib.import_module("regime_map")


def test_the_map_of_a_hundred_by_a_hundred(tmp_path: Path) -> None:
    result = regime_map.regime_map(100, "serial", tmp_path / "map", chunk_size=1_500)
    assert result.values.dtype == np.uint8 and result.values.shape == (100, 100)
    forcings, restitutions = result.axes.values()
    cells = (axis.ravel() for axis in np.meshgrid(forcings, restitutions, indexing="ij"))
    alone = regime_map.regimes(*cells, regime_map.TRANSIENT, regime_map.IMPACTS)
    assert np.array_equal(result.values.ravel(), alone)
    # Below 1/pi the platform never falls away; below the birth of the period-1 orbit, too, the disk comes to
    # rest.
    weak = forcings[:, np.newaxis] < np.minimum(1.0 / np.pi, (1.0 - restitutions) / (1.0 + restitutions))
    rest = bd.Verdicts.KINDS.index("at-rest")
    assert (result.values[weak] == rest).mean() > 0.99
    assert len(np.unique(result.values)) >= 4


def test_the_plan_of_a_map_of_four_hundred_million_cells() -> None:
    plan = regime_map.plan(20_000, 16_000.0)
    assert plan.points == 400_000_000 and plan.chunks == 6_104
    assert plan.core_hours == pytest.approx(6.94, abs=0.01)
    assert plan.seconds_a_chunk == pytest.approx(4.096)
    assert plan.result_bytes == 400_000_000
    assert regime_map.measured_rate(256) > 0.0
