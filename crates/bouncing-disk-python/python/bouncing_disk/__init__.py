"""A disk that bounces on a platform which vibrates and twists.

Pizza dough on a hand and the rotor of a standing-wave ultrasonic motor obey the same equations (Liu, Friend
and Yeo, Phys. Rev. E 80, 046201 (2009)). Everything is computed by the Rust library ``bouncing-disk``, with
the same bits on every machine and for any number of threads. Arguments are keywords in SI units.

Examples
--------
>>> import bouncing_disk as bd
>>> bd.System.pizza_toss().friction
0.6
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from bouncing_disk._errors import (
    BouncingDiskError,
    ComputationError,
    FitRefusedError,
    InvalidError,
    OutOfRangeError,
    TooLargeError,
)
from bouncing_disk._native import (
    ATTACHED,
    FIRST_ORBIT,
    UNDECIDED,
    Attractors,
    Branch,
    ChatterCut,
    ImpactMap,
    Motor,
    PeriodicOrbit,
    System,
    Trajectory,
    attractors,
    basins,
    best_phase_lag,
    best_toss,
    continued,
    doubling_cascade,
    ensemble,
    fit_exponential,
    fit_parameters,
    fit_transients,
    iterate_orbits,
    lyapunov_exponents,
    multi_toss,
    operating_point,
    orbit_diagram,
    periodic_orbits,
    set_threads,
    simulate,
    single_toss,
    stall_load,
    survival_times,
    threads,
    torque_speed_curve,
    toss_trajectory,
    transient,
    transients,
    verdicts,
)
from bouncing_disk._results import (
    Attractor,
    Basins,
    BestPhaseLag,
    Bifurcation,
    DoublingCascade,
    Energy,
    EventTable,
    ExponentialFit,
    IntervalEstimate,
    MotorReport,
    OperatingPoint,
    OrbitDiagram,
    ParameterFit,
    Result,
    RiseEstimate,
    SpeedCurve,
    SpeedCurves,
    Spread,
    StallLoad,
    TorqueSpeedCurve,
    TossDesign,
    TossOrbit,
    TossPerformance,
    TrajectorySamples,
    TransientEnsemble,
    TransientFit,
    Verdicts,
)

__all__ = [
    "ATTACHED",
    "FIRST_ORBIT",
    "UNDECIDED",
    "Attractor",
    "Attractors",
    "Basins",
    "BestPhaseLag",
    "Bifurcation",
    "BouncingDiskError",
    "Branch",
    "ChatterCut",
    "ComputationError",
    "DoublingCascade",
    "Energy",
    "EventTable",
    "ExponentialFit",
    "FitRefusedError",
    "ImpactMap",
    "IntervalEstimate",
    "InvalidError",
    "Motor",
    "MotorReport",
    "OperatingPoint",
    "OrbitDiagram",
    "OutOfRangeError",
    "ParameterFit",
    "PeriodicOrbit",
    "Result",
    "RiseEstimate",
    "SpeedCurve",
    "SpeedCurves",
    "Spread",
    "StallLoad",
    "System",
    "TooLargeError",
    "TorqueSpeedCurve",
    "TossDesign",
    "TossOrbit",
    "TossPerformance",
    "Trajectory",
    "TrajectorySamples",
    "TransientEnsemble",
    "TransientFit",
    "Verdicts",
    "attractors",
    "basins",
    "best_phase_lag",
    "best_toss",
    "continued",
    "doubling_cascade",
    "ensemble",
    "fit_exponential",
    "fit_parameters",
    "fit_transients",
    "iterate_orbits",
    "lyapunov_exponents",
    "multi_toss",
    "operating_point",
    "orbit_diagram",
    "periodic_orbits",
    "set_threads",
    "simulate",
    "single_toss",
    "stall_load",
    "survival_times",
    "threads",
    "torque_speed_curve",
    "toss_trajectory",
    "transient",
    "transients",
    "verdicts",
]

# Sweeps, and what they raise, are imported when one is asked for: what they need takes longer than all else here.
if TYPE_CHECKING:
    from bouncing_disk._sweep import (
        FailedPoint,
        MissingDependencyError,
        SweepClusterError,
        SweepFailedError,
        SweepFolderError,
        SweepFolderWarning,
        SweepFunctionError,
        SweepResult,
        read_sweep,
        sweep,
    )

__all__ += [
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


def __getattr__(name: str) -> Any:
    if name in __all__:
        return getattr(import_module("bouncing_disk._sweep"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
