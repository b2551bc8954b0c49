//! How far the rotors on one vertical motion turn: what their curves are made of.

use bouncing_disk_core::LaneLoop;

use crate::motor::batch::rotor_rows::{RotorRows, Row, SharedImpact, WIDTH};

/// Angles turned by the rotors of a row.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Turned {
    /// In the last flight.
    pub(crate) last: Row,
    /// In the present interval of the curve.
    pub(crate) sum: Row,
}

/// Carries all rotors through a flight and the impact that ends it.
pub(crate) struct CarryAll<'a> {
    pub(crate) impact: SharedImpact,
    /// Whether the flight ends in the present interval of the curve, so that its angle belongs to it.
    pub(crate) is_within: bool,
    pub(crate) rows: &'a mut [RotorRows<Turned>],
}

impl LaneLoop for CarryAll<'_> {
    #[inline(always)]
    fn run(self) {
        let Self { impact, is_within, rows } = self;
        for rotors in rows {
            for own in 0..WIDTH {
                let (speed, turned) = rotors.bounce(own, &impact).after(rotors.speed[own]);
                rotors.speed[own] = speed;
                let tally = &mut rotors.tally;
                tally.last[own] = turned;
                tally.sum[own] = if is_within { tally.sum[own] + turned } else { tally.sum[own] };
            }
        }
    }
}
