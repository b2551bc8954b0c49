//! The cut with which the paper ends a chatter (Sec. IV A).

use bouncing_disk_core::{ChatterCut, ChatterPolicy};

/// Impacts slower than |w_A Gamma/(omega A)| = 1e-6, or 20 consecutive flights shorter than 1e-4 of a period.
pub(crate) const PAPER_POLICY: ChatterPolicy = match ChatterCut::new(1.0e-6, 1.0e-4, 20) {
    Ok(cut) => ChatterPolicy::Cut(cut),
    Err(_) => panic!("legal"),
};
