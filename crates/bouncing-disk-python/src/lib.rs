//! The compiled module `bouncing_disk._native` of the Python package `bouncing_disk`.
//!
//! It contains no physics, numerics or signatures. Python hands over the arguments of a call by
//! name. They are checked and converted for the Rust library; results become NumPy arrays and
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
    use crate::arguments::default_settings;
    #[pymodule_export]
    use crate::attractors::{
        Attractors, attractors, basin_entropy, basin_fractions_over, basins, basins_of, boundary_scaling,
    };
    #[pymodule_export]
    use crate::chaos::{
        Crisis, crises, crisis, lives, lyapunov_exponents, lyapunov_spectra, manifold, orbit_diagram,
        verdicts,
    };
    #[pymodule_export]
    use crate::estimate::{ensemble, fit_rated_points, fit_transients, read_speeds};
    #[pymodule_export]
    use crate::motor::{
        best, input_spreads, local_sensitivities, low_period_traps, motor_map, nearest_trap, report,
        stall_load, stator_report, torque_speed_curve,
    };
    #[pymodule_export]
    use crate::orbits::{
        Branch, PeriodicOrbit, branch_orbit, continued, curves, doubling_cascade, iterate, periodic_orbits,
        refine, settled_orbit, switched, trapping_radius,
    };
    #[pymodule_export]
    use crate::parameters::{
        chatter_cut, drive, excluded_by, impact_map, known_motor, known_system, map_of_system, motor,
        paper_cut, system,
    };
    #[pymodule_export]
    use crate::threads::{set_threads, threads};
    #[pymodule_export]
    use crate::toss::{Trajectory, events, rotary_response, samples, simulate, single_toss, toss_trajectory};
    /// The version of the package.
    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");
    /// Label of a start that was neither at rest nor near a known orbit after the allowed impacts.
    #[pymodule_export]
    const UNDECIDED: u8 = bouncing_disk::core::attractors::UNDECIDED;
    /// Label of a start that comes to rest.
    #[pymodule_export]
    const ATTACHED: u8 = bouncing_disk::core::attractors::ATTACHED;
    /// Label of the first known orbit; the others follow it.
    #[pymodule_export]
    const FIRST_ORBIT: u8 = bouncing_disk::core::attractors::FIRST_ORBIT;
}
