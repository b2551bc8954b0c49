"""The types of the compiled module; what its functions and classes do is in their docstrings."""

import os
from collections.abc import Callable, Iterable, Mapping
from typing import Any, ClassVar, Literal, SupportsFloat, SupportsIndex, TypeAlias, final

import numpy as np
import numpy.typing as npt

from bouncing_disk._results import (
    Attractor,
    BasinEntropy,
    Basins,
    BestPhaseLag,
    Bifurcation,
    BoundaryScaling,
    CrisisLives,
    DoublingCascade,
    ElementaryEffects,
    Energy,
    EventTable,
    BrakingFit,
    ExponentialFit,
    InputSpread,
    LocalSensitivities,
    LowPeriodTraps,
    LyapunovSpectra,
    Manifold,
    MotorMap,
    MotorReport,
    NearestTrap,
    OperatingPoint,
    OrbitDiagram,
    ParameterFit,
    RotaryResponse,
    SobolIndices,
    SpeedCurve,
    SpeedCurves,
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
    "Attractors",
    "BasinFractions",
    "Branch",
    "ChatterCut",
    "Crisis",
    "ImpactMap",
    "Motor",
    "PeriodicOrbit",
    "System",
    "Trajectory",
    "attractors",
    "basin_entropy",
    "basin_fractions_over",
    "basins",
    "best_phase_lag",
    "best_toss",
    "boundary_scaling",
    "continued",
    "crisis",
    "doubling_cascade",
    "elementary_effects",
    "ensemble",
    "fit_braking",
    "fit_exponential",
    "fit_parameters",
    "fit_transients",
    "input_spreads",
    "iterate_orbits",
    "local_sensitivities",
    "low_period_traps",
    "lyapunov_exponents",
    "lyapunov_spectra",
    "manifold",
    "motor_map",
    "multi_toss",
    "nearest_trap",
    "operating_point",
    "orbit_diagram",
    "periodic_orbits",
    "read_speeds",
    "rotary_response",
    "set_threads",
    "simulate",
    "single_toss",
    "sobol_indices",
    "stall_load",
    "survival_times",
    "threads",
    "torque_speed_curve",
    "toss_trajectory",
    "transient",
    "transients",
    "verdicts",
]

_Float: TypeAlias = SupportsFloat | SupportsIndex
_Int: TypeAlias = SupportsIndex
_Pair: TypeAlias = tuple[_Float, _Float] | list[float]
_Progress: TypeAlias = Callable[[int, int], object] | None

UNDECIDED: int
ATTACHED: int
FIRST_ORBIT: int

@final
class Attractors:
    @property
    def impact_map(self) -> ImpactMap: ...
    @property
    def all(self) -> tuple[Attractor, ...]: ...
    @property
    def undecided(self) -> float: ...
    def basins(
        self,
        *,
        phases: _Int = 400,
        phase_range: _Pair = (0.0, 1.0),
        speeds: _Int = 300,
        speed_range: _Pair = (0.0, 3.0),
        max_impacts: _Int = 2000,
        chatter: ChatterCut | None = None,
        progress: _Progress = None,
    ) -> Basins: ...
    def to_json(self) -> str: ...
    @staticmethod
    def from_json(json: str) -> Attractors: ...
    def __eq__(self, value: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]
    def __len__(self) -> int: ...
    def __reduce__(self) -> tuple[Callable[[Any, str], Any], tuple[type[Any], str]]: ...

@final
class BasinFractions:
    @property
    def restitution(self) -> float: ...
    @property
    def axial_forcing(self) -> npt.NDArray[np.float64]: ...
    @property
    def attractors(self) -> tuple[Attractors, ...]: ...
    @property
    def followed(self) -> tuple[npt.NDArray[np.int64], ...]: ...
    @property
    def appears(self) -> npt.NDArray[np.int64]: ...
    @property
    def vanishes(self) -> npt.NDArray[np.int64]: ...
    @property
    def share(self) -> npt.NDArray[np.float64]: ...
    @property
    def share_low(self) -> npt.NDArray[np.float64]: ...
    @property
    def share_high(self) -> npt.NDArray[np.float64]: ...
    @property
    def moved(self) -> npt.NDArray[np.float64]: ...
    def extended(
        self,
        *,
        axial_forcing: npt.ArrayLike,
        reach: _Float = 0.3,
        starts: _Int = 1024,
        transient: _Int = 2000,
        impacts: _Int = 100000,
        longest_period: _Int = 256,
        cells: _Int = 256,
        progress: _Progress = None,
    ) -> BasinFractions: ...
    def to_json(self) -> str: ...
    @staticmethod
    def from_json(json: str) -> BasinFractions: ...
    def __eq__(self, value: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]
    def __len__(self) -> int: ...
    def __reduce__(self) -> tuple[Callable[[Any, str], Any], tuple[type[Any], str]]: ...

@final
class Branch:
    @property
    def values(self) -> npt.NDArray[np.float64]: ...
    @property
    def axial_impact_velocity(self) -> npt.NDArray[np.float64]: ...
    @property
    def end(self) -> str: ...
    @property
    def is_stable(self) -> npt.NDArray[np.bool_]: ...
    @property
    def impact_phase(self) -> npt.NDArray[np.float64]: ...
    @property
    def arclength(self) -> npt.NDArray[np.float64]: ...
    @property
    def parameter(self) -> str: ...
    @property
    def normalised_speed(self) -> npt.NDArray[np.float64]: ...
    @property
    def multipliers(self) -> npt.NDArray[np.complex128]: ...
    @property
    def bifurcations(self) -> tuple[Bifurcation, ...]: ...
    def orbit(self, index: _Int) -> PeriodicOrbit: ...
    def switched(
        self,
        *,
        index: _Int,
        parameter_range: _Pair,
        first_step: _Float = 0.01,
        largest_step: _Float = 0.05,
        max_points: _Int = 10000,
        progress: _Progress = None,
    ) -> Branch: ...
    def to_json(self) -> str: ...
    @staticmethod
    def from_json(json: str) -> Branch: ...
    def __eq__(self, value: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]
    def __len__(self) -> int: ...
    def __reduce__(self) -> tuple[Callable[[Any, str], Any], tuple[type[Any], str]]: ...

@final
class ChatterCut:
    def __new__(cls, *, smallest_speed: _Float, short_flight: _Float, short_flights: _Int) -> ChatterCut: ...
    @property
    def short_flights(self) -> int: ...
    @property
    def short_flight(self) -> float: ...
    @property
    def smallest_speed(self) -> float: ...
    @staticmethod
    def paper() -> ChatterCut: ...
    def to_dict(self) -> dict[str, float]: ...
    @staticmethod
    def from_dict(parameters: dict[str, float]) -> ChatterCut: ...
    def to_json(self) -> str: ...
    @staticmethod
    def from_json(json: str) -> ChatterCut: ...
    def __eq__(self, value: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __getnewargs_ex__(self) -> tuple[tuple[()], dict[str, float]]: ...

@final
class Crisis:
    @property
    def restitution(self) -> float: ...
    @property
    def axial_forcing(self) -> float: ...
    @property
    def forcing_error(self) -> float: ...
    @property
    def bracket(self) -> tuple[float, float]: ...
    @property
    def is_boundary_crisis(self) -> bool | None: ...
    @property
    def no_tangency(self) -> str | None: ...
    @property
    def inside(self) -> PeriodicOrbit | None: ...
    @property
    def touched(self) -> PeriodicOrbit | None: ...
    @property
    def impact_phase(self) -> npt.NDArray[np.float64] | None: ...
    @property
    def axial_impact_velocity(self) -> npt.NDArray[np.float64] | None: ...
    @property
    def side(self) -> str | None: ...
    @property
    def share(self) -> float | None: ...
    @property
    def curvature(self) -> float | None: ...
    @property
    def life_exponent(self) -> float | None: ...
    def lives(
        self,
        *,
        beyond: npt.ArrayLike,
        orbits: _Int = 1000,
        impacts: _Int = 100000,
        progress: _Progress = None,
    ) -> CrisisLives: ...
    def to_json(self) -> str: ...
    @staticmethod
    def from_json(json: str) -> Crisis: ...
    def __eq__(self, value: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]
    def __reduce__(self) -> tuple[Callable[[Any, str], Any], tuple[type[Any], str]]: ...

@final
class ImpactMap:
    def __new__(
        cls,
        *,
        axial_forcing: _Float | None = None,
        peak_acceleration: _Float | None = None,
        restitution: _Float,
    ) -> ImpactMap: ...
    @property
    def axial_forcing(self) -> float: ...
    @property
    def peak_acceleration(self) -> float: ...
    @property
    def restitution(self) -> float: ...
    @property
    def normalised_speed_bound(self) -> float: ...
    @staticmethod
    def of_system(system: System) -> ImpactMap: ...
    def step(self, *, impact_phase: _Float, axial_impact_velocity: _Float) -> tuple[float, float]: ...
    def step_back(self, *, impact_phase: _Float, axial_impact_velocity: _Float) -> tuple[float, float]: ...
    def iterate(
        self,
        *,
        impact_phase: _Float,
        axial_impact_velocity: _Float,
        impacts: _Int,
        progress: _Progress = None,
    ) -> tuple[float, float]: ...
    def derivative(
        self,
        *,
        impact_phase: _Float,
        axial_impact_velocity: _Float,
    ) -> npt.NDArray[np.float64]: ...
    def period_one(self, *, platform_periods: _Int = 1) -> tuple[float, float] | None: ...
    def refine(
        self,
        *,
        impact_phase: npt.ArrayLike,
        axial_impact_velocity: npt.ArrayLike,
    ) -> PeriodicOrbit: ...
    def settled_orbit(
        self,
        *,
        impact_phase: _Float,
        normalised_speed: _Float,
        transient: _Int = 2000,
        longest_period: _Int = 64,
        tolerance: _Float = 1e-07,
        progress: _Progress = None,
    ) -> PeriodicOrbit | None: ...
    def to_dict(self) -> dict[str, float]: ...
    @staticmethod
    def from_dict(parameters: dict[str, float]) -> ImpactMap: ...
    def to_json(self) -> str: ...
    @staticmethod
    def from_json(json: str) -> ImpactMap: ...
    def __eq__(self, value: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __getnewargs_ex__(self) -> tuple[tuple[()], dict[str, float]]: ...

@final
class Motor:
    def __new__(
        cls,
        *,
        drive_frequency: _Float,
        amplitude: _Float,
        peak_angular_speed: _Float | None = None,
        twist_amplitude: _Float | None = None,
        phase_lag: _Float = 0.0,
        mass: _Float | None = None,
        density: _Float | None = None,
        rotor_radius: _Float | None = None,
        rotor_thickness: _Float | None = None,
        contact_radius: _Float,
        gyration_radius: _Float | None = None,
        preload_force: _Float | None = None,
        preload_acceleration: _Float | None = None,
        spring_constant: _Float | None = None,
        friction: _Float,
        restitution: _Float,
        load_torque: _Float = 0.0,
    ) -> Motor: ...
    @property
    def amplitude(self) -> float: ...
    @property
    def static_deflection(self) -> float | None: ...
    @property
    def peak_angular_speed(self) -> float: ...
    @property
    def load_torque(self) -> float: ...
    @property
    def twist_amplitude(self) -> float: ...
    @property
    def restitution(self) -> float: ...
    @property
    def preload_force(self) -> float: ...
    @property
    def largest_torque(self) -> float: ...
    @property
    def friction(self) -> float: ...
    @property
    def system(self) -> System: ...
    @property
    def gyration_radius(self) -> float: ...
    @property
    def drive_frequency(self) -> float: ...
    @property
    def mass(self) -> float: ...
    @property
    def phase_lag(self) -> float: ...
    @property
    def preload_acceleration(self) -> float: ...
    @property
    def inertia(self) -> float: ...
    @property
    def contact_radius(self) -> float: ...
    def replace(self, **changes: _Float | None) -> Motor: ...
    def warnings(self) -> tuple[str, ...]: ...
    def report(self, *, progress: _Progress = None) -> MotorReport: ...
    def to_dict(self) -> dict[str, float]: ...
    @staticmethod
    def from_dict(parameters: dict[str, float]) -> Motor: ...
    def to_json(self) -> str: ...
    @staticmethod
    def paper_70_khz() -> Motor: ...
    @staticmethod
    def paper_184_khz() -> Motor: ...
    @staticmethod
    def from_toml(toml: str) -> Motor: ...
    @staticmethod
    def from_json(json: str) -> Motor: ...
    def __eq__(self, value: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __getnewargs_ex__(self) -> tuple[tuple[()], dict[str, float]]: ...

@final
class PeriodicOrbit:
    @property
    def monodromy(self) -> npt.NDArray[np.float64]: ...
    @property
    def normalised_speed(self) -> npt.NDArray[np.float64]: ...
    @property
    def period(self) -> int: ...
    @property
    def platform_periods(self) -> int: ...
    @property
    def impact_phase(self) -> npt.NDArray[np.float64]: ...
    @property
    def axial_impact_velocity(self) -> npt.NDArray[np.float64]: ...
    @property
    def is_stable(self) -> bool: ...
    @property
    def multipliers(self) -> npt.NDArray[np.complex128]: ...
    @property
    def stability(self) -> str: ...
    def proven_radius(self, impact_map: ImpactMap) -> float: ...
    def trapping_radius(
        self,
        impact_map: ImpactMap,
        *,
        samples: _Int = 64,
        progress: _Progress = None,
    ) -> float: ...
    def to_json(self) -> str: ...
    @staticmethod
    def from_json(json: str) -> PeriodicOrbit: ...
    def __eq__(self, value: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]
    def __reduce__(self) -> tuple[Callable[[Any, str], Any], tuple[type[Any], str]]: ...

@final
class System:
    def __new__(
        cls,
        *,
        amplitude: _Float,
        twist_amplitude: _Float,
        angular_frequency: _Float,
        phase_lag: _Float = 0.0,
        contact_radius: _Float,
        gyration_radius: _Float,
        friction: _Float,
        restitution: _Float,
        preload_acceleration: _Float,
        load_acceleration: _Float = 0.0,
    ) -> System: ...
    @property
    def twist_amplitude(self) -> float: ...
    @property
    def friction(self) -> float: ...
    @property
    def load_acceleration(self) -> float: ...
    @property
    def restitution(self) -> float: ...
    @property
    def gyration_radius(self) -> float: ...
    @property
    def angular_forcing(self) -> float | None: ...
    @property
    def rise_time(self) -> float: ...
    @property
    def phase_lag(self) -> float: ...
    @property
    def peak_angular_speed(self) -> float: ...
    @property
    def stroke(self) -> float: ...
    @property
    def amplitude_angle(self) -> float: ...
    def platform_motion(
        self, *, phases: npt.ArrayLike
    ) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]: ...
    @property
    def angular_frequency(self) -> float: ...
    @property
    def contact_radius(self) -> float: ...
    @property
    def amplitude(self) -> float: ...
    @property
    def peak_acceleration(self) -> float: ...
    @property
    def period(self) -> float: ...
    @property
    def axial_forcing(self) -> float: ...
    @property
    def preload_acceleration(self) -> float: ...
    @staticmethod
    def pizza_toss() -> System: ...
    @staticmethod
    def motor() -> System: ...
    @staticmethod
    def from_stroke(
        *,
        stroke: _Float,
        amplitude_angle: _Float,
        angular_frequency: _Float,
        phase_lag: _Float = 0.0,
        contact_radius: _Float,
        gyration_radius: _Float,
        friction: _Float,
        restitution: _Float,
        preload_acceleration: _Float,
        load_acceleration: _Float = 0.0,
    ) -> System: ...
    def replace(self, **changes: _Float) -> System: ...
    def with_load_torque(self, *, torque: _Float, mass: _Float) -> System: ...
    def to_dict(self) -> dict[str, dict[str, float]]: ...
    @staticmethod
    def from_dict(parameters: dict[str, dict[str, float]]) -> System: ...
    def to_json(self) -> str: ...
    @staticmethod
    def from_json(json: str) -> System: ...
    def __eq__(self, value: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __getnewargs_ex__(self) -> tuple[tuple[()], dict[str, float]]: ...

@final
class Trajectory:
    @property
    def system(self) -> System: ...
    @property
    def energy(self) -> Energy: ...
    @property
    def end_time(self) -> float: ...
    @property
    def start_time(self) -> float: ...
    def samples(self, *, count: _Int) -> TrajectorySamples: ...
    def events(self) -> EventTable: ...
    def to_json(self) -> str: ...
    @staticmethod
    def from_json(json: str) -> Trajectory: ...
    def __eq__(self, value: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]
    def __len__(self) -> int: ...
    def __reduce__(self) -> tuple[Callable[[Any, str], Any], tuple[type[Any], str]]: ...

def attractors(
    impact_map: ImpactMap,
    *,
    starts: _Int = 1024,
    transient: _Int = 2000,
    impacts: _Int = 100000,
    longest_period: _Int = 256,
    cells: _Int = 256,
    progress: _Progress = None,
) -> Attractors: ...
def basins(
    impact_map: ImpactMap,
    *,
    phases: _Int = 400,
    phase_range: _Pair = (0.0, 1.0),
    speeds: _Int = 300,
    speed_range: _Pair = (0.0, 3.0),
    known_orbits: Iterable[PeriodicOrbit | tuple[PeriodicOrbit, _Float]] | None = None,
    max_impacts: _Int = 2000,
    chatter: ChatterCut | None = None,
    progress: _Progress = None,
) -> Basins: ...
def best_phase_lag(
    motor: Motor,
    *,
    relative_error: _Float = 0.01,
    members: _Int = 16,
    most_impacts: _Int = 20000000,
    relaunch_perturbation: _Float = 0.001,
    seed: _Int = 1,
    progress: _Progress = None,
) -> BestPhaseLag: ...
def best_toss(
    *,
    contact_radius: _Float | None = None,
    gyration_radius: _Float | None = None,
    preload_acceleration: _Float | None = None,
    initial_spin: Literal["absolute-rest", "with-hand"] = "absolute-rest",
    stroke: _Float | None = None,
    friction: _Pair | None = None,
    angular_frequency: _Pair | None = None,
    phase_lag: _Pair | None = None,
    highest_flight: _Float | None = None,
    objective: Literal["airborne-speed", "efficiency", "turns-per-toss"] = "airborne-speed",
    over_friction: Literal["worst", "mean"] = "worst",
    progress: _Progress = None,
) -> TossDesign: ...
def continued(
    impact_map: ImpactMap,
    orbit: PeriodicOrbit,
    *,
    parameter: Literal["axial_forcing", "restitution"] = "axial_forcing",
    parameter_range: _Pair,
    rising: bool = True,
    first_step: _Float = 0.01,
    largest_step: _Float = 0.05,
    max_points: _Int = 10000,
    progress: _Progress = None,
) -> Branch: ...
def doubling_cascade(*, restitution: _Float, count: _Int, progress: _Progress = None) -> DoublingCascade: ...
def ensemble(
    system: System,
    *,
    members: _Int,
    duration: _Float = 3.0,
    intervals: _Int = 600,
    relaunch_perturbation: _Float = 0.001,
    seed: _Int = 1,
    chatter: ChatterCut | None = None,
    progress: _Progress = None,
) -> TransientEnsemble: ...
def fit_braking(
    *,
    times: npt.ArrayLike,
    speeds: npt.ArrayLike,
    normal_force: _Float,
    mass: _Float,
    contact_radius: _Float,
    gyration_radius: _Float,
) -> BrakingFit: ...
def fit_exponential(
    *,
    times: npt.ArrayLike,
    speeds: npt.ArrayLike,
    progress: _Progress = None,
) -> ExponentialFit: ...
def fit_parameters(
    motor: Motor,
    *,
    transients: Iterable[tuple[npt.ArrayLike, npt.ArrayLike, _Float]],
    ranges: Mapping[str, _Pair],
    speed_error: _Float | None = None,
    members: _Int = 64,
    windows: _Int = 6,
    relaunch_perturbation: _Float = 0.001,
    seed: _Int = 1,
    most_evaluations: _Int = 100,
    resamples: _Int = 1000,
    largest_misfit: _Float = 1.0,
    progress: _Progress = None,
) -> ParameterFit: ...
def fit_transients(
    *,
    times: npt.ArrayLike,
    speeds: npt.ArrayLike,
    resamples: _Int = 1000,
    seed: _Int = 1,
    least_duration: _Float = 3.0,
    largest_residual: _Float = 0.1,
    from_rest: bool = False,
    progress: _Progress = None,
) -> TransientFit: ...
def input_spreads(
    motor: Motor,
    *,
    load_torques: npt.ArrayLike | None = None,
    tolerance: _Float = 0.01,
    perturbation_decades: _Float = 1.0,
    draws: _Int = 39,
    relative_error: _Float = 0.01,
    members: _Int = 16,
    most_impacts: _Int = 20000000,
    relaunch_perturbation: _Float = 0.001,
    seed: _Int = 1,
    progress: _Progress = None,
) -> list[InputSpread | None]: ...
def iterate_orbits(
    *,
    axial_forcing: npt.ArrayLike,
    restitution: npt.ArrayLike,
    impact_phase: npt.ArrayLike,
    normalised_speed: npt.ArrayLike,
    impacts: _Int,
    progress: _Progress = None,
) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]: ...
def lyapunov_exponents(
    *,
    axial_forcing: npt.ArrayLike,
    restitution: npt.ArrayLike,
    impact_phase: npt.ArrayLike,
    normalised_speed: npt.ArrayLike,
    transient: _Int = 1000,
    impacts: _Int = 10000,
    progress: _Progress = None,
) -> npt.NDArray[np.float64]: ...
def multi_toss(
    system: System,
    *,
    phase: _Float = 0.0,
    angular_speed: _Float | None = None,
    gap: _Float | None = None,
    relative_velocity: _Float | None = None,
    transient_impacts: _Int = 4000,
    examined_impacts: _Int = 1024,
    longest_period: _Int = 128,
    tolerance: _Float = 1e-09,
    chatter: ChatterCut | None = None,
    progress: _Progress = None,
) -> TossOrbit: ...
def operating_point(
    motor: Motor,
    *,
    load_torque: _Float | None = None,
    relative_error: _Float = 0.01,
    members: _Int = 16,
    most_impacts: _Int = 20000000,
    relaunch_perturbation: _Float = 0.001,
    seed: _Int = 1,
    progress: _Progress = None,
) -> OperatingPoint: ...
def orbit_diagram(
    *,
    axial_forcing: npt.ArrayLike,
    restitution: npt.ArrayLike,
    impact_phase: npt.ArrayLike,
    normalised_speed: npt.ArrayLike,
    transient: _Int = 3000,
    recorded: _Int = 256,
    chatter: ChatterCut | None = None,
    progress: _Progress = None,
) -> OrbitDiagram: ...
def periodic_orbits(
    impact_map: ImpactMap,
    *,
    max_impacts: _Int,
    max_platform_periods: _Int,
    phases: _Int = 96,
    speeds: _Int = 96,
    progress: _Progress = None,
) -> list[PeriodicOrbit]: ...
def read_speeds(
    path: str | os.PathLike[str],
    *,
    time_column: str | None = None,
    speed_column: str | None = None,
    time_unit: str | None = None,
    speed_unit: str | None = None,
) -> list[tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]]: ...
def set_threads(*, count: _Int | None = None) -> None: ...
def simulate(
    system: System,
    *,
    phase: _Float = 0.0,
    angular_speed: _Float | None = None,
    gap: _Float | None = None,
    relative_velocity: _Float | None = None,
    events: _Int = 1000,
    duration: _Float | None = None,
    chatter: ChatterCut | None = None,
    progress: _Progress = None,
) -> Trajectory: ...
def single_toss(
    system: System,
    *,
    initial_spin: Literal["absolute-rest", "with-hand"] = "absolute-rest",
) -> TossPerformance: ...
def stall_load(
    motor: Motor,
    *,
    relative_error: _Float = 0.01,
    members: _Int = 16,
    most_impacts: _Int = 20000000,
    relaunch_perturbation: _Float = 0.001,
    seed: _Int = 1,
    progress: _Progress = None,
) -> StallLoad: ...
def survival_times(
    *,
    axial_forcing: npt.ArrayLike,
    restitution: npt.ArrayLike,
    impact_phase: npt.ArrayLike,
    normalised_speed: npt.ArrayLike,
    most: _Int,
    chatter: ChatterCut | None = None,
    progress: _Progress = None,
) -> npt.NDArray[np.int64]: ...
def threads() -> int: ...
def torque_speed_curve(
    motor: Motor,
    *,
    load_torques: npt.ArrayLike,
    relative_error: _Float = 0.01,
    members: _Int = 16,
    most_impacts: _Int = 20000000,
    relaunch_perturbation: _Float = 0.001,
    seed: _Int = 1,
    progress: _Progress = None,
) -> TorqueSpeedCurve: ...
def toss_trajectory(
    system: System,
    *,
    initial_spin: Literal["absolute-rest", "with-hand"] = "absolute-rest",
) -> Trajectory: ...
def transient(
    system: System,
    *,
    phase: _Float = 0.0,
    duration: _Float = 3.0,
    intervals: _Int = 600,
    relaunch_perturbation: _Float = 0.001,
    seed: _Int = 1,
    chatter: ChatterCut | None = None,
    progress: _Progress = None,
) -> SpeedCurve: ...
def transients(
    systems: System | Iterable[System],
    *,
    phases: npt.ArrayLike | None = None,
    seeds: _Int | Iterable[_Int] | None = None,
    duration: _Float = 3.0,
    intervals: _Int = 600,
    relaunch_perturbation: _Float = 0.001,
    chatter: ChatterCut | None = None,
    progress: _Progress = None,
) -> SpeedCurves: ...
def verdicts(
    *,
    axial_forcing: npt.ArrayLike,
    restitution: npt.ArrayLike,
    impact_phase: npt.ArrayLike,
    normalised_speed: npt.ArrayLike,
    transient: _Int = 2000,
    impacts: _Int = 100000,
    longest_period: _Int = 256,
    tolerance: _Float = 1e-07,
    progress: _Progress = None,
) -> Verdicts: ...
def crisis(
    inside: PeriodicOrbit | None = None,
    touched: PeriodicOrbit | None = None,
    *,
    restitution: _Float,
    axial_forcing: _Pair,
    samples: _Int = 64,
    impacts: _Int = 2000000,
    progress: _Progress = None,
) -> Crisis: ...
def elementary_effects(
    motor: Motor,
    *,
    ranges: Mapping[str, _Pair],
    quantity: Literal["steady-speed", "stall-torque"] = "steady-speed",
    rows: _Int = 64,
    sampling_seed: _Int = 1,
    relative_error: _Float = 0.01,
    members: _Int = 16,
    most_impacts: _Int = 20000000,
    relaunch_perturbation: _Float = 0.001,
    seed: _Int = 1,
    progress: _Progress = None,
) -> ElementaryEffects: ...
def local_sensitivities(
    motor: Motor,
    *,
    parameters: Iterable[str] | None = None,
    quantity: Literal["steady-speed", "stall-torque"] = "steady-speed",
    half_range: _Float = 0.2,
    points: _Int = 24,
    relative_error: _Float = 0.01,
    members: _Int = 16,
    most_impacts: _Int = 20000000,
    relaunch_perturbation: _Float = 0.001,
    seed: _Int = 1,
    progress: _Progress = None,
) -> LocalSensitivities: ...
def lyapunov_spectra(
    *,
    axial_forcing: npt.ArrayLike,
    restitution: npt.ArrayLike,
    impact_phase: npt.ArrayLike,
    normalised_speed: npt.ArrayLike,
    transient: _Int = 1000,
    impacts: _Int = 10000,
    progress: _Progress = None,
) -> LyapunovSpectra: ...
def manifold(
    impact_map: ImpactMap,
    orbit: PeriodicOrbit,
    *,
    kind: Literal["unstable", "stable"] = "unstable",
    arclength: _Float,
    max_points: _Int = 100000,
    chord: _Float = 0.05,
    turn: _Float = 0.2,
    max_generations: _Int = 200,
    launch_speed: _Float | None = None,
    progress: _Progress = None,
) -> Manifold: ...
def motor_map(
    motor: Motor,
    *,
    axes: Mapping[str, npt.ArrayLike],
    relative_error: _Float = 0.01,
    members: _Int = 16,
    most_impacts: _Int = 20000000,
    relaunch_perturbation: _Float = 0.001,
    seed: _Int = 1,
    progress: _Progress = None,
) -> MotorMap: ...
def sobol_indices(
    motor: Motor,
    *,
    ranges: Mapping[str, _Pair],
    quantity: Literal["steady-speed", "stall-torque"] = "steady-speed",
    rows: _Int = 256,
    sampling_seed: _Int = 1,
    relative_error: _Float = 0.01,
    members: _Int = 16,
    most_impacts: _Int = 20000000,
    relaunch_perturbation: _Float = 0.001,
    seed: _Int = 1,
    progress: _Progress = None,
) -> SobolIndices: ...
def basin_entropy(basins: Basins, *, box_side: _Int = 5) -> BasinEntropy: ...
def basin_fractions_over(
    *,
    restitution: _Float,
    axial_forcing: npt.ArrayLike,
    reach: _Float = 0.3,
    starts: _Int = 1024,
    transient: _Int = 2000,
    impacts: _Int = 100000,
    longest_period: _Int = 256,
    cells: _Int = 256,
    progress: _Progress = None,
) -> BasinFractions: ...
def boundary_scaling(
    basins: Basins,
    *,
    distances: Iterable[_Int] = (1, 2, 4, 8),
    progress: _Progress = None,
) -> BoundaryScaling: ...
def low_period_traps(
    motor: Motor,
    *,
    preload_accelerations: npt.ArrayLike,
    progress: _Progress = None,
) -> LowPeriodTraps: ...
def nearest_trap(
    motor: Motor,
    *,
    relative_range: _Float = 0.1,
    progress: _Progress = None,
) -> NearestTrap | None: ...
def rotary_response(system: System, orbit: PeriodicOrbit) -> RotaryResponse: ...
