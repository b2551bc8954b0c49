//! The paper's rule to end a chatter.

use bouncing_disk_core::{ChatterCut, ChatterPolicy};

/// The cut of the paper (Sec. IV A): the disk attaches as soon as the impact speed |w_A Gamma/(omega A)|
/// falls below 1e-6, or after 20 consecutive flights shorter than 1e-4 of a period.
pub const PAPER_CUT: ChatterCut = match ChatterCut::new(1.0e-6, 1.0e-4, 20) {
    Ok(cut) => cut,
    // Unreachable: evaluated at compile time.
    Err(_) => panic!("the paper's numbers are legal"),
};

/// [`PAPER_CUT`] as the policy of an orbit, an [`Engine`](crate::Engine) or a transient.
pub const PAPER_CHATTER: ChatterPolicy = ChatterPolicy::Cut(PAPER_CUT);
