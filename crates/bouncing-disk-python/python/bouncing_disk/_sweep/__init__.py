"""Functions at every point of a grid, on one processor or a cluster: `bouncing_disk.sweep`."""

from bouncing_disk._sweep.api import *
from bouncing_disk._sweep.errors import *
from bouncing_disk._sweep.result import SweepFailedError as SweepFailedError
from bouncing_disk._sweep.result import SweepResult as SweepResult
