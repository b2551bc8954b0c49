//! Items shared with the crate of drives only; they may change.

pub use crate::chatter::policy::Surface;
pub use crate::numerics::block_cyclic::solve_block_cyclic;
pub use crate::numerics::bordered_cyclic::{Border, CyclicEquations};
pub use crate::numerics::error::{finite, not_negative, within};
pub use crate::orbits::closing::{Closed, Flight, Scale};
pub use crate::orbits::periodic::belonging::check;
pub use crate::orbits::periodic::catalogue::Catalogue;
pub use crate::orbits::periodic::margin::{SAME, next_to_margin};
pub use crate::orbits::periodic::newton::{Shooting, moved, prime_period, same_orbit, settled, speed_scale};
pub use crate::orbits::periodic::{MAX_NEWTON_STEPS, phase_difference};
