//! What is done with orbits: periodic ones, bifurcations, basins, many at a time.

pub(crate) mod attraction;
pub(crate) mod attractors;
pub(crate) mod basin;
pub(crate) mod cascade;
pub(crate) mod closing;
pub(crate) mod continuation;
pub(crate) mod crisis;
pub(crate) mod follow_attractor;
pub(crate) mod lyapunov;
pub(crate) mod manifold;
pub(crate) mod orbit_batch;
pub(crate) mod periodic;
pub(crate) mod sweep;
pub(crate) mod trapping_region;
pub(crate) mod verdict;
