//! The compiled module `bouncing_disk._native` of the Python package `bouncing_disk`.
//!
//! It has no physics, no numerics and no signatures of its own: Python hands over the arguments of a call by
//! their names; they are checked and turned into those of the Rust library, results into NumPy arrays and the
//! classes of the Python package.
#![cfg(feature = "extension-module")]

mod arguments;
mod attractors;
mod chaos;
mod errors;
mod estimate;
mod long_call;
mod motor;
mod orbits;
mod parameters;
mod results;
mod threads;
mod toss;

use pyo3::prelude::*;

/// The functions that the Python package calls.
#[pymodule]
mod _native {
    #[pymodule_export]
    use crate::attractors::{
        Attractors, BasinFractions, attractors, basin_entropy, basin_fractions_over, basins, basins_of,
        boundary_scaling, extended,
    };
    #[pymodule_export]
    use crate::chaos::{
        Crisis, crisis, lives, lyapunov_exponents, lyapunov_spectra, manifold, orbit_diagram, survival_times,
        verdicts,
    };
    #[pymodule_export]
    use crate::estimate::{
        ensemble, fit_braking, fit_exponential, fit_parameters, fit_transients, read_speeds, transient,
        transients,
    };
    #[pymodule_export]
    use crate::motor::{
        best_phase_lag, elementary_effects, input_spreads, local_sensitivities, low_period_traps, motor_map,
        nearest_trap, operating_point, report, sobol_indices, stall_load, torque_speed_curve,
    };
    #[pymodule_export]
    use crate::orbits::{
        Branch, PeriodicOrbit, branch_orbit, continued, doubling_cascade, iterate, iterate_orbits,
        periodic_orbits, proven_radius, refine, settled_orbit, switched, trapping_radius,
    };
    #[pymodule_export]
    use crate::parameters::{
        amplitudes_of_stroke, chatter_cut, excluded_by, impact_map, known_motor, known_system,
        load_acceleration, motor, paper_cut, platform_motion, system,
    };
    #[pymodule_export]
    use crate::threads::{set_threads, threads};
    #[pymodule_export]
    use crate::toss::{
        Trajectory, best_toss, events, multi_toss, rotary_response, samples, simulate, single_toss,
        toss_trajectory,
    };
    /// Label of a start that was neither at rest nor near a known orbit after the impacts that were allowed.
    #[pymodule_export]
    const UNDECIDED: u8 = bouncing_disk::core::attractors::UNDECIDED;
    /// Label of a start that comes to rest.
    #[pymodule_export]
    const ATTACHED: u8 = bouncing_disk::core::attractors::ATTACHED;
    /// Label of the first known orbit; the next ones count up from here.
    #[pymodule_export]
    const FIRST_ORBIT: u8 = bouncing_disk::core::attractors::FIRST_ORBIT;
}
