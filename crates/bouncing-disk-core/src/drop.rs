//! The first impact of a disk that starts in the air.

use core::f64::consts::TAU;

use crate::elementary::{CREST, sin_cos_bounded};
use crate::error::{Error, within};
use crate::flight::{Impact, landed_within_a_turn};
use crate::gap::{Bracket, CrestForm, GapForm};
use crate::phase::Phase;
use crate::vibration::Vibration;

impl Vibration {
    /// The first impact of a disk that at `phase` is `gap` > 0 above the platform (units of g/omega^2) and moves
    /// with `relative_velocity` (disk minus platform, units of g/omega, of either sign).
    ///
    /// The guarantee is that of [`Self::first_impact`]; here the first piece may be convex and entered falling.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a gap outside (0, 1e17] or a velocity that is not finite;
    /// [`Error::FlightTooLong`] beyond [`crate::MAX_FLIGHT_DURATION`].
    pub fn first_impact_of_drop(
        &self,
        phase: Phase,
        gap: f64,
        relative_velocity: f64,
    ) -> Result<Impact, Error> {
        within("gap", gap, f64::MIN_POSITIVE, 1.0e17, "(0, 1e17] (units of g/omega^2)")?;
        within("relative_velocity", relative_velocity, -1.0e9, 1.0e9, "[-1e9, 1e9] (units of g/omega)")?;
        let p = self.peak_acceleration();
        let angle = phase.angle();
        let arc = CrestForm {
            peak: p,
            angle,
            speed: relative_velocity + p * phase.cos(),
            depth: (p - p * phase.sin()) - gap,
        };
        let mut evaluations = 0;
        if arc.depth > 0.0
            && let Some(bracket) = self.bracket_before_crest(&arc, relative_velocity, &mut evaluations)
        {
            let root = arc.root(bracket, bracket.lo, evaluations)?;
            return Ok(landed_within_a_turn(angle, root));
        }
        self.impact_from_above(angle, arc.speed, arc.depth, relative_velocity, evaluations)
    }

    /// The window of the first root before the next crest, for an arc that starts above the platform and below
    /// the crest's height; `None` if it clears that crest.
    fn bracket_before_crest(&self, arc: &CrestForm, slope: f64, evaluations: &mut u32) -> Option<Bracket> {
        let crest = if arc.angle < CREST { CREST - arc.angle } else { CREST + TAU - arc.angle };
        // Phases in the pieces' order: away (convex) until retention, concave until separation, convex.
        let mut lo = 0.0;
        let mut slope = slope;
        if self.falls_away_at(arc.angle) {
            let retention = self.retention_angle - arc.angle;
            if arc.angle < CREST {
                return self.bracket_in_convex(arc, 0.0, crest, slope, arc.gap_over(0.0, crest), evaluations);
            }
            let gap = arc.gap_over(self.separation_depth, retention);
            let found = self.bracket_in_convex(arc, 0.0, retention, slope, gap, evaluations);
            if found.is_some() {
                return found;
            }
            lo = retention;
        }
        let separation = crest - (CREST - self.separation_angle);
        if arc.gap_over(self.separation_depth, separation) <= 0.0 {
            return Some(Bracket { lo, hi: separation });
        }
        slope = (arc.speed - separation) - self.separation_speed;
        self.bracket_in_convex(arc, separation, crest, slope, arc.gap_over(0.0, crest), evaluations)
    }

    /// The first root in a convex piece that starts above the platform with `slope` and ends with `gap`.
    fn bracket_in_convex(
        &self,
        arc: &CrestForm,
        lo: f64,
        hi: f64,
        slope: f64,
        gap: f64,
        evaluations: &mut u32,
    ) -> Option<Bracket> {
        if gap <= 0.0 {
            return Some(Bracket { lo, hi });
        }
        let (_, cos) = sin_cos_bounded(arc.angle + hi);
        if slope < 0.0 && arc.speed - hi > self.peak_acceleration() * cos {
            return arc.dip(lo, hi, evaluations).map(|hi| Bracket { lo, hi });
        }
        None
    }
}
