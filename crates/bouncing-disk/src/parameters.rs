//! The parameters in SI units, and the groups without units that decide the motion.

pub(crate) mod dimensionless;
pub(crate) mod disk;
pub(crate) mod platform;
pub(crate) mod presets;
pub(crate) mod scales;
pub(crate) mod stroke;
pub(crate) mod system;
