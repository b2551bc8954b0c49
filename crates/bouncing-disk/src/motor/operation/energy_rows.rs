//! The energies of the rotors on one vertical motion.

use bouncing_disk_core::sweep::LaneLoop;

use crate::motor::rotor_rows::{RotorRows, Row, SharedImpact, WIDTH};

/// What the rotors of a row have turned, got and lost since the window began.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Energies {
    /// Angle turned in flights.
    pub(super) angle: Row,
    /// Work of the platform by friction, and loss in it, in impacts.
    pub(super) work: Row,
    pub(super) loss: Row,
}

/// Carries all rotors through a flight and the impact that ends it.
pub(super) struct CarryAll<'a> {
    pub(super) impact: SharedImpact,
    pub(super) rows: &'a mut [RotorRows<Energies>],
}

impl LaneLoop for CarryAll<'_> {
    #[inline(always)]
    fn run(self) {
        let Self { impact, rows } = self;
        for rotors in rows {
            for own in 0..WIDTH {
                let bounce = rotors.bounce(own, &impact);
                let flight = bounce.flight(rotors.speed[own]);
                let slip = flight.speed - bounce.platform_speed;
                let rotary = bounce.friction_impact(slip);
                rotors.speed[own] = rotary.speed_after(flight.speed, bounce.platform_speed);
                let tally = &mut rotors.tally;
                tally.angle[own] += flight.angle;
                tally.work[own] += rotary.impulse * bounce.platform_speed;
                // The friction impulse acts at the mean of the slip speeds before and after.
                tally.loss[own] -= rotary.impulse * (slip + 0.5 * rotary.impulse);
            }
        }
    }
}
