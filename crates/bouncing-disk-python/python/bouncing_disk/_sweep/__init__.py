"""Functions at every point of a grid, on one processor or a cluster: `bouncing_disk.sweep`."""

from bouncing_disk._sweep.api import read_sweep, sweep
from bouncing_disk._sweep.errors import (
    FailedPoint,
    MissingDependencyError,
    SweepClusterError,
    SweepFailedError,
    SweepFolderError,
    SweepFolderWarning,
    SweepFunctionError,
)
from bouncing_disk._sweep.result import SweepResult

__all__ = [
    "FailedPoint",
    "MissingDependencyError",
    "SweepClusterError",
    "SweepFailedError",
    "SweepFolderError",
    "SweepFolderWarning",
    "SweepFunctionError",
    "SweepResult",
    "read_sweep",
    "sweep",
]
