"""A quick legal call of everything that takes arguments, which tests then spoil."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

import bouncing_disk as bd

STARTS: dict[str, Any] = {"restitution": 0.5, "impact_phase": 1.2, "normalised_speed": 1.3}
MAP = bd.ImpactMap(axial_forcing=0.45, restitution=0.5)
OTHER = MAP.replace(drive=bd.Drive.fourier([(1.0, 0.0), (0.1, 0.3)]), contact_periods=0.1)
TOSS = bd.System.pizza_toss()
MOTOR = bd.Motor(
    drive_frequency=70e3,
    amplitude=1e-8,
    peak_angular_speed=30.0,
    mass=1e-3,
    contact_radius=1.25e-3,
    gyration_radius=6.3e-3,
    preload_acceleration=9.8,
    friction=0.1,
    restitution=0.5,
)


def saddle_of(bouncing: bd.ImpactMap = MAP) -> bd.PeriodicOrbit:
    """The saddle of one impact a period."""
    orbits = bd.periodic_orbits(bouncing, max_impacts=1, max_platform_periods=1)
    return next(orbit for orbit in orbits if abs(orbit.multipliers[0]) > 1.0)


def good() -> list[tuple[Callable[..., Any], list[Any], dict[str, Any]]]:
    """Calls that are quick, of everything that takes arguments."""
    orbit = MAP.settled_orbit(impact_phase=1.2, normalised_speed=1.3)
    assert orbit is not None
    branch = bd.continued(MAP, orbit, parameter_range=(0.4, 0.5), max_points=20)
    found = bd.attractors(MAP, starts=4, impacts=64)
    rows = found.basins(phases=9, speeds=9)
    search: dict[str, Any] = {
        "reach": 0.3,
        "starts": 4,
        "transient": 10,
        "impacts": 64,
        "longest_period": 8,
        "cells": 8,
        "progress": None,
    }
    crisis = bd.crisis(restitution=0.5, axial_forcing=(0.559, 0.562), impacts=400_000)
    trajectory = bd.toss_trajectory(TOSS)
    toss_orbit = bd.periodic_orbits(bd.ImpactMap.of_system(TOSS), max_impacts=1, max_platform_periods=1)[0]
    impact = {"impact_phase": 1.0, "axial_impact_velocity": -4.0}
    quick: dict[str, Any] = {"relative_error": 0.5, "members": 4, "most_impacts": 100}
    run: dict[str, Any] = {"duration": 1e-4, "intervals": 3, "relaunch_perturbation": 1e-3}
    toss: dict[str, Any] = {"phase": 4.7, "angular_speed": 0.0, "gap": 0.1, "relative_velocity": 0.0}
    starts: dict[str, Any] = {"axial_forcing": 0.5, **STARTS, "progress": None}
    grid: dict[str, Any] = {
        "phases": 3,
        "phase_range": (0.0, 1.0),
        "speeds": 3,
        "speed_range": (0.0, 2.0),
        "max_impacts": 10,
        "chatter": None,
        "progress": None,
    }
    times = np.linspace(0.01, 5.0, 60)
    speeds = 30.0 * (1.0 - np.exp(-times))
    return [
        (bd.System, [], TOSS.to_dict()["platform"] | TOSS.to_dict()["disk"]),
        (TOSS.replace, [], {"friction": 0.5}),
        (bd.System.from_dict, [TOSS.to_dict()], {}),
        (bd.System.from_json, [TOSS.to_json()], {}),
        (bd.ImpactMap, [], {"axial_forcing": 0.5, "restitution": 0.5}),
        (bd.ImpactMap, [], {"peak_acceleration": 0.5, "restitution": 0.5, "drive": OTHER.drive, "contact_periods": 0.1}),
        (bd.ImpactMap.of_system, [TOSS], {}),
        (bd.ImpactMap.from_json, [MAP.to_json()], {}),
        (bd.Motor, [], MOTOR.to_dict()),
        (bd.Motor.from_json, [MOTOR.to_json()], {}),
        (bd.Motor.from_toml, ["\n".join(f"{key} = {value!r}" for key, value in MOTOR.to_dict().items())], {}),
        (bd.Motor.paper_70_khz, [], {}),
        (bd.Motor.paper_184_khz, [], {}),
        (bd.ChatterCut, [], bd.ChatterCut.paper().to_dict()),
        (MAP.step, [], impact),
        (MAP.derivative, [], impact),
        (OTHER.step, [], impact),
        (OTHER.derivative, [], impact),
        (OTHER.iterate, [], impact | {"impacts": 10, "progress": None}),
        (MAP.iterate, [], impact | {"impacts": 10, "progress": None}),
        (MAP.period_one, [], {"platform_periods": 1}),
        (MAP.refine, [], {"impact_phase": [0.7], "axial_impact_velocity": [-4.2]}),
        (
            MAP.settled_orbit,
            [],
            {"impact_phase": 1.0, "normalised_speed": 1.0, "transient": 10, "tolerance": 1e-7},
        ),
        (orbit.trapping_radius, [MAP], {"samples": 4}),
        (bd.PeriodicOrbit.from_json, [orbit.to_json()], {}),
        (bd.orbit_diagram, [], starts | {"transient": 10, "recorded": 3, "chatter": None}),
        (bd.lyapunov_exponents, [], starts | {"transient": 10, "impacts": 10}),
        (bd.verdicts, [], starts | {"transient": 10, "impacts": 64, "longest_period": 8, "tolerance": 1e-7}),
        (bd.basins, [MAP], grid | {"known_orbits": [orbit, (orbit, 0.1)]}),
        (bd.periodic_orbits, [MAP], {"max_impacts": 1, "max_platform_periods": 1, "phases": 3, "speeds": 3}),
        (
            bd.attractors,
            [MAP],
            {"starts": 4, "transient": 10, "impacts": 64, "longest_period": 8, "cells": 8},
        ),
        (found.basins, [], grid),
        (bd.basin_entropy, [rows], {"box_side": 3}),
        (bd.boundary_scaling, [rows], {"distances": [1, 2, 3], "progress": None}),
        (bd.basin_fractions_over, [], search | {"restitution": 0.5, "axial_forcing": [0.34, 0.36]}),
        (
            bd.continued,
            [MAP, orbit],
            {"parameter": "axial_forcing", "parameter_range": (0.4, 0.5), "max_points": 5},
        ),
        (branch.switched, [], {"index": 0, "parameter_range": (0.4, 0.5), "max_points": 5}),
        (branch.orbit, [0], {}),
        (bd.crises, [], {"restitution": [0.5], "axial_forcing": (0.559, 0.562), "impacts": 200_000}),
        (
            bd.curves,
            [MAP, branch],
            {"parameter": "restitution", "parameter_range": (0.4, 0.6), "branch_range": (0.1, 1.0), "max_points": 5},
        ),
        (bd.doubling_cascade, [], {"restitution": 0.5, "count": 1}),
        (bd.single_toss, [TOSS], {"initial_spin": "with-hand"}),
        (bd.toss_trajectory, [TOSS], {"initial_spin": "with-hand"}),
        (trajectory.samples, [], {"count": 5}),
        (trajectory.events, [], {}),
        (bd.simulate, [TOSS], toss | {"events": 5, "duration": 1.0, "chatter": None, "progress": None}),
        (bd.ensemble, [TOSS], run | {"members": 3, "seed": 1, "chatter": None}),
        (bd.torque_speed_curve, [MOTOR], quick | {"load_torques": [0.0, 1e-9]}),
        (bd.stall_load, [MOTOR], quick),
        (bd.input_spreads, [MOTOR], quick | {"load_torques": [0.0], "tolerance": 0.01, "draws": 8}),
        (bd.best, [MOTOR], quick | {"of": "speed", "over": {"phase_lag": (-1.0, 1.0)}, "where": ["power >= 0"]}),
        (bd.low_period_traps, [MOTOR], {"preload_accelerations": [9.8, 10.0], "progress": None}),
        (bd.nearest_trap, [bd.Motor.paper_70_khz()], {"relative_range": 0.01, "progress": None}),
        (bd.rotary_response, [TOSS, toss_orbit], {}),
        (bd.fit_transients, [], {"times": times, "speeds": speeds, "resamples": 200, "seed": 1}),
        (
            bd.fit_rated_points,
            [MOTOR],
            {"points": [{"speed": 20.0, "speed_error": 9.0, "load_torque": 0.0}], "ranges": {"friction": (0.1, 0.3)}}
            | {"most_evaluations": 8, "most_impacts": 2000, "seed": 1},
        ),
        (bd.set_threads, [], {"count": 2}),
        (MOTOR.replace, [], {"friction": 0.2}),
        (MOTOR.report, [], {}),
        (crisis.lives, [], {"beyond": [1e-3], "orbits": 2, "impacts": 10, "progress": None}),
        (bd.lyapunov_spectra, [], starts | {"transient": 10, "impacts": 16}),
        (
            bd.manifold,
            [MAP, saddle_of()],
            {
                "arclength": 0.5,
                "max_points": 50,
                "chord": 0.05,
                "turn": 0.2,
                "max_generations": 20,
                "launch_speed": 1.0,
                "kind": "stable",
                "progress": None,
            },
        ),
        (
            bd.crisis,
            [saddle_of(), saddle_of()],
            {
                "restitution": 0.5,
                "axial_forcing": (0.4, 0.5),
                "event": "growth",
                "bands": 1,
                "samples": 16,
                "impacts": 10_000,
                "progress": None,
            },
        ),
        (
            bd.motor_map,
            [MOTOR],
            quick | {"over": {"friction": [0.1, 0.2], "amplitude": [1e-8]}, "progress": None},
        ),
        (
            bd.local_sensitivities,
            [MOTOR],
            quick | {"parameters": ["friction"], "half_range": 0.2, "points": 5, "quantity": "steady-speed"},
        ),
    ]
