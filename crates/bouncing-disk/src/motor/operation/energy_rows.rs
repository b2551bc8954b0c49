//! The energies of the rotors on one vertical motion.

use bouncing_disk_core::sweep::LaneLoop;

use crate::motor::batch::rotor_rows::{RotorRows, Row, SharedImpact, WIDTH};

/// The angles, gains and losses of the rotors of a row since the window began.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Energies {
    /// Angle turned in flights.
    pub(crate) angle: Row,
    /// Work of the platform by friction, and loss in it, in impacts.
    pub(crate) work: Row,
    pub(crate) loss: Row,
}

/// Carries all rotors through a flight and the impact that ends it.
pub(crate) struct CarryAll<'a> {
    pub(crate) impact: SharedImpact,
    pub(crate) rows: &'a mut [RotorRows<Energies>],
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
