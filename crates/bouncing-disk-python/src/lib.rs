//! The compiled module `bouncing_disk._native` of the Python package `bouncing_disk`.
//!
//! It has no physics and no numerics of its own: arguments are checked and turned into those of the Rust
//! library, results into NumPy arrays and plain Python objects.
#![cfg(feature = "extension-module")]

mod arguments;
mod attractors;
mod basin_fractions;
mod basin_measures;
mod basins;
mod braking;
mod branch;
mod chatter;
mod crisis;
mod design;
mod diagram;
mod errors;
mod fits;
mod impact_map;
mod impact_state;
mod long_call;
mod manifold;
mod motor;
mod motor_sweep;
mod names;
mod operation;
mod orbit_batch;
mod parameter_fit;
mod periodic_orbit;
mod real;
mod regime;
mod results;
mod rotary;
mod sensitivity;
mod spectra;
mod start;
mod system;
mod system_dict;
mod system_names;
mod text;
mod threads;
mod toss;
mod trajectory;
mod transients;
mod traps;
mod verdicts;

use pyo3::prelude::*;

/// What `bouncing_disk` exports.
#[pymodule]
mod _native {
    #[pymodule_export]
    use crate::attractors::{Attractors, attractors};
    #[pymodule_export]
    use crate::basin_fractions::{BasinFractions, basin_fractions_over};
    #[pymodule_export]
    use crate::basin_measures::{basin_entropy, boundary_scaling};
    #[pymodule_export]
    use crate::basins::basins;
    #[pymodule_export]
    use crate::braking::fit_braking;
    #[pymodule_export]
    use crate::branch::{Branch, continued, doubling_cascade};
    #[pymodule_export]
    use crate::chatter::ChatterCut;
    #[pymodule_export]
    use crate::crisis::{Crisis, crisis};
    #[pymodule_export]
    use crate::design::best_toss;
    #[pymodule_export]
    use crate::diagram::{lyapunov_exponents, orbit_diagram, survival_times};
    #[pymodule_export]
    use crate::fits::{fit_exponential, fit_transients, read_speeds};
    #[pymodule_export]
    use crate::impact_map::ImpactMap;
    #[pymodule_export]
    use crate::manifold::manifold;
    #[pymodule_export]
    use crate::motor::Motor;
    #[pymodule_export]
    use crate::motor_sweep::motor_map;
    #[pymodule_export]
    use crate::operation::{best_phase_lag, input_spreads, operating_point, stall_load, torque_speed_curve};
    #[pymodule_export]
    use crate::orbit_batch::iterate_orbits;
    #[pymodule_export]
    use crate::parameter_fit::fit_parameters;
    #[pymodule_export]
    use crate::periodic_orbit::{PeriodicOrbit, periodic_orbits};
    #[pymodule_export]
    use crate::rotary::rotary_response;
    #[pymodule_export]
    use crate::sensitivity::{elementary_effects, local_sensitivities, sobol_indices};
    #[pymodule_export]
    use crate::spectra::lyapunov_spectra;
    #[pymodule_export]
    use crate::system::System;
    #[pymodule_export]
    use crate::threads::{set_threads, threads};
    #[pymodule_export]
    use crate::toss::{multi_toss, single_toss};
    #[pymodule_export]
    use crate::trajectory::{Trajectory, simulate, toss_trajectory};
    #[pymodule_export]
    use crate::transients::{ensemble, transient, transients};
    #[pymodule_export]
    use crate::traps::{low_period_traps, nearest_trap};
    #[pymodule_export]
    use crate::verdicts::verdicts;
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
