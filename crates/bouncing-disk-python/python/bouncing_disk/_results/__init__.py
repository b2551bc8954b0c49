"""What computations return: plain objects of NumPy arrays and numbers, which never change, compare and pickle."""

from __future__ import annotations

from bouncing_disk._results._base import Result, _restored
from bouncing_disk._results._dynamics import (
    Attractor,
    BasinEntropy,
    Basins,
    Bifurcation,
    BoundaryScaling,
    DoublingCascade,
    OrbitDiagram,
    Verdicts,
)
from bouncing_disk._results._invariant import CrisisLives, LyapunovSpectra, Manifold
from bouncing_disk._results._motors import (
    BestPhaseLag,
    InputSpread,
    LowPeriodTraps,
    MotorMap,
    MotorReport,
    NearestTrap,
    OperatingPoint,
    StallLoad,
    TorqueSpeedCurve,
)
from bouncing_disk._results._sensitivities import (
    ElementaryEffects,
    LocalSensitivities,
    SobolIndices,
)
from bouncing_disk._results._tosses import (
    Energy,
    EventTable,
    RotaryResponse,
    TossDesign,
    TossOrbit,
    TossPerformance,
    TrajectorySamples,
)
from bouncing_disk._results._transients import (
    BrakingFit,
    ExponentialFit,
    IntervalEstimate,
    ParameterFit,
    RiseEstimate,
    SpeedCurve,
    SpeedCurves,
    Spread,
    TransientEnsemble,
    TransientFit,
)

__all__ = [
    "Attractor",
    "BasinEntropy",
    "Basins",
    "BestPhaseLag",
    "Bifurcation",
    "BoundaryScaling",
    "CrisisLives",
    "DoublingCascade",
    "ElementaryEffects",
    "Energy",
    "EventTable",
    "BrakingFit",
    "ExponentialFit",
    "InputSpread",
    "IntervalEstimate",
    "LocalSensitivities",
    "LowPeriodTraps",
    "LyapunovSpectra",
    "Manifold",
    "MotorMap",
    "MotorReport",
    "NearestTrap",
    "OperatingPoint",
    "OrbitDiagram",
    "ParameterFit",
    "Result",
    "RiseEstimate",
    "RotaryResponse",
    "SobolIndices",
    "SpeedCurve",
    "SpeedCurves",
    "Spread",
    "StallLoad",
    "TorqueSpeedCurve",
    "TossDesign",
    "TossOrbit",
    "TossPerformance",
    "TrajectorySamples",
    "TransientEnsemble",
    "TransientFit",
    "Verdicts",
    "_restored",
]
