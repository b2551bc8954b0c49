//! The first impact of a disk on a platform of arbitrary motion.
//!
//! While the disk's parabola is above the highest point of the platform, no search is needed. That leaves two
//! windows: before the disk rises above that height, and after it returns there. In each window the gap is
//! computed from its value and slope at the start of the window, so a brief flight keeps its relative
//! accuracy (docs/numerics-impacts.md).

use core::f64::consts::TAU;

use bouncing_disk_core::flight::MAX_FLIGHT_DURATION;
use bouncing_disk_core::numerics::elementary::{nearest_periods, nearest_whole, wrapped_angle};
use bouncing_disk_core::parts::{finite, not_negative, within};
use bouncing_disk_core::{Error, Impact, Launch, Phase};

use super::{Drive, DriveBounds, Fourier, ROUNDING, Shape};
use crate::quasi_polynomial::{DampedSine, FirstRoot, QuasiPolynomial, Root};

/// If the parabola returns to the platform's highest point within this time (rad), the flight is searched as
/// a whole: this avoids the initial errors of a second window and costs few more steps.
const BRIEF: f64 = 2.0;

/// The first impact on a [`Drive`].
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct DrivenImpact {
    /// The impact.
    pub impact: Impact,
    /// Bound on the error of the duration (rad) due to rounding.
    pub error: f64,
    /// Whether the impact is on a kink of the drive, within its error; the map then has no derivative there.
    pub on_kink: bool,
    /// An earlier touch or near miss of the platform that rounding cannot decide.
    pub doubt: Option<Doubt>,
}

/// A graze that rounding cannot decide: the evaluated sign counts.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Doubt {
    /// The time in radians after the start.
    pub at: f64,
    /// Bound on the magnitude of the gap at this time, in units of g/omega^2.
    pub bound: f64,
}

/// The state of a disk: time, gap above the platform, and velocity relative to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Start {
    pub(crate) time: f64,
    pub(crate) gap: f64,
    pub(crate) velocity: f64,
    /// Whether the contact ends here: any remaining push by the platform is rounding.
    pub(crate) separates: bool,
}

impl Start {
    /// A start from a user's numbers, which are checked.
    pub(crate) fn new(time: f64, gap: f64, velocity: f64) -> Result<Self, Error> {
        finite("time", time)?;
        within("gap", gap, 0.0, 1.0e17, "[0, 1e17] (units of g/omega^2)")?;
        within("relative_velocity", velocity, -1.0e9, 1.0e9, "[-1e9, 1e9] (units of g/omega)")?;
        if gap == 0.0 {
            not_negative("relative velocity of a launch", velocity)?;
        }
        Ok(Self { time, gap, velocity, separates: false })
    }

    /// The second derivative of the gap: at the end of a contact, a push within rounding counts as zero.
    pub(super) fn bend(&self, bend: f64, bounds: &DriveBounds) -> f64 {
        if self.separates && bend < 0.0 && bend >= -bounds.doubtful_pull(self.time) { 0.0 } else { bend }
    }
}

/// The result of a search in a window.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Found {
    pub(crate) root: Option<Root>,
    pub(super) on_kink: bool,
    pub(super) doubt: Option<Doubt>,
    pub(super) evaluations: u32,
    /// Start and end of the piece that contains the root.
    pub(super) piece: Option<(f64, f64)>,
}

impl Drive {
    /// The first impact after `launch`.
    ///
    /// # Errors
    /// [`Error::NoLiftOff`] for a launch from rest while the platform does not fall away;
    /// [`Error::FlightTooLong`] beyond [`MAX_FLIGHT_DURATION`]; [`Error::NoConvergence`] after 100,000
    /// evaluations.
    pub fn first_impact(&self, launch: Launch) -> Result<DrivenImpact, Error> {
        self.first_impact_from(launch.phase().angle(), 0.0, launch.relative_speed())
    }

    /// The first impact of a disk that is `gap` >= 0 above the platform at `time`, with this velocity
    /// relative to it. On the platform (`gap` = 0) the disk leaves with this velocity, which must be >= 0.
    ///
    /// # Errors
    /// Errors of [`Self::first_impact`]; [`Error::OutOfRange`] for numbers outside their range.
    pub fn first_impact_from(
        &self,
        time: f64,
        gap: f64,
        relative_velocity: f64,
    ) -> Result<DrivenImpact, Error> {
        self.first_impact_within(time, gap, relative_velocity, f64::INFINITY)?.ok_or(Error::FlightTooLong {
            relative_speed: relative_velocity,
            duration: f64::INFINITY,
            limit: MAX_FLIGHT_DURATION,
        })
    }

    /// [`Self::first_impact_from`] if it comes within `limit` radians; `None` if the disk is still in flight
    /// then.
    ///
    /// # Errors
    /// Errors of [`Self::first_impact_from`].
    pub fn first_impact_within(
        &self,
        time: f64,
        gap: f64,
        relative_velocity: f64,
        limit: f64,
    ) -> Result<Option<DrivenImpact>, Error> {
        self.land(Start::new(time, gap, relative_velocity)?, limit)
    }

    /// The impact of a disk that leaves a contact at `time` because the force falls to zero there, within
    /// rounding ([`Self::contact_end`]), if it comes within `limit` radians; `None` if the disk is still in
    /// flight then.
    ///
    /// # Errors
    /// Errors of [`Self::first_impact_from`].
    pub fn impact_after_separation_within(
        &self,
        time: f64,
        limit: f64,
    ) -> Result<Option<DrivenImpact>, Error> {
        self.land(Start { time: finite("time", time)?, gap: 0.0, velocity: 0.0, separates: true }, limit)
    }

    /// The first impact within `limit` after a start that is known to be legal.
    pub(crate) fn land(&self, mut start: Start, limit: f64) -> Result<Option<DrivenImpact>, Error> {
        start.time = wrapped_angle(start.time);
        // NaN counts as no limit.
        let limit = limit.min(f64::INFINITY);
        let (here, terms) = self.at_with_terms(start.time, 0, -1.0);
        let bounds = self.bounds();
        if start.gap == 0.0 && start.velocity == 0.0 && !start.separates && here.acceleration >= -1.0 {
            return Err(Error::NoLiftOff { phase: start.time, peak_acceleration: bounds.acceleration });
        }
        let speed = here.velocity + start.velocity;
        let height = here.height + start.gap;
        let depth = bounds.highest - height;
        let radicand = speed * speed - 2.0 * depth;
        let fall = if radicand > 0.0 { radicand.sqrt() } else { 0.0 };
        // The times at which the disk rises above all heights of the platform and returns.
        let (mut up, down) = if depth <= 0.0 {
            (0.0, if speed >= 0.0 { speed + fall } else { -2.0 * depth / (fall - speed) })
        } else if speed > 0.0 && radicand > 0.0 {
            (2.0 * depth / (speed + fall), speed + fall)
        } else {
            (f64::INFINITY, f64::INFINITY)
        };
        if down.is_finite() && down > MAX_FLIGHT_DURATION {
            return Err(Error::FlightTooLong {
                relative_speed: start.velocity,
                duration: down,
                limit: MAX_FLIGHT_DURATION,
            });
        }
        if start.gap == 0.0 && down < BRIEF {
            // Counted from the start it keeps its relative accuracy.
            up = f64::INFINITY;
        }
        let mut found = Found::default();
        if up > 0.0 {
            found = self.window(start, [0.0; 2], terms, up.min(limit))?;
            if found.root.is_some() || limit <= up {
                return Ok(found.root.map(|root| self.landed(start.time, (0.0, 0.0), root, &found)));
            }
        }
        if limit <= down {
            return Ok(None);
        }
        let (periods, rest) = if down > TAU { nearest_periods(down) } else { (0.0, down) };
        let time = start.time + rest;
        let (there, terms) = self.at_with_terms(time, 0, -1.0);
        // Time and speed of the return are rounded, and so were height and speed before.
        let height_error = ROUNDING * (height.abs() + bounds.highest.abs() + bounds.highest - bounds.lowest);
        let radicand_error = ROUNDING * (speed * speed + depth.abs()) + height_error;
        let fall_error = (radicand_error / fall).min((2.0 * radicand_error).sqrt());
        let [joint_height, joint_speed] = match &self.shape {
            Shape::Fourier(_) => [0.0; 2],
            Shape::Pieces(pieces) => pieces.joint_rounding,
        };
        let error = [
            joint_height
                + joint_speed * down.min(TAU)
                + height_error
                + ROUNDING * ((fall + bounds.speed) * (1.0 + down) + speed.abs() * down),
            joint_speed + fall_error + ROUNDING * (fall + bounds.speed + bounds.acceleration),
        ];
        let descent = Start {
            time,
            gap: bounds.highest - there.height,
            velocity: -fall - there.velocity,
            separates: false,
        };
        let (before, doubt) = (found.evaluations, found.doubt);
        found = self.window(descent, error, terms, limit - down)?;
        found.evaluations += before;
        found.doubt = doubt.or(found.doubt.map(|doubt| Doubt { at: doubt.at + down, ..doubt }));
        Ok(found.root.map(|root| self.landed(start.time, (periods, rest), root, &found)))
    }

    /// The first root of the gap within `to`; the gap and its slope at the start have these errors, and
    /// `terms` are the drive's terms there.
    fn window(&self, start: Start, error: [f64; 2], terms: Vec<DampedSine>, to: f64) -> Result<Found, Error> {
        match &self.shape {
            Shape::Fourier(fourier) => fourier.window(start, error, terms, to),
            Shape::Pieces(pieces) => pieces.window(start, error, to),
        }
    }

    /// The impact at `root`, after whole periods and a remainder.
    fn landed(&self, from: f64, (periods, rest): (f64, f64), root: Root, found: &Found) -> DrivenImpact {
        let after = rest + root.at;
        let angle = from + after;
        let mut wrapped = wrapped_angle(angle);
        if let Some((begin, end)) = found.piece
            && !(begin..end).contains(&wrapped)
        {
            // Rounding must not put the impact on another piece.
            let apart = |joint: f64| (wrapped - joint).abs().min(TAU - (wrapped - joint).abs());
            wrapped = if apart(begin) <= apart(end) { begin } else { end.next_down() };
        }
        let turns = periods + nearest_whole((angle - wrapped) / TAU);
        let (mut whole, mut remainder) = (periods, after);
        if remainder < 0.0 {
            (whole, remainder) = (whole - 1.0, remainder + TAU);
        } else if remainder >= TAU {
            let more = libm::floor(remainder / TAU);
            (whole, remainder) = (whole + more, wrapped_angle(remainder));
        }
        DrivenImpact {
            impact: Impact {
                periods: whole as u64,
                remainder,
                turns: turns as u64,
                phase: Phase::of_angle(wrapped),
                velocity: root.slope.min(0.0),
                evaluations: found.evaluations,
            },
            error: root.error + ROUNDING * (periods * TAU + rest.abs() + root.at),
            on_kink: found.on_kink,
            doubt: found.doubt,
        }
    }
}

impl Fourier {
    fn window(&self, start: Start, error: [f64; 2], terms: Vec<DampedSine>, to: f64) -> Result<Found, Error> {
        let mut gap = QuasiPolynomial::known([start.gap, start.velocity], error, [-0.5, 0.0], terms);
        if start.separates {
            let bend = gap.at(0.0, 0.0).bend;
            gap = gap.bent_by(start.bend(bend, &self.bounds) - bend);
        }
        decided(&gap, if to.is_finite() { to } else { 2.0 * MAX_FLIGHT_DURATION })
    }
}

impl Found {
    /// Records the impact, with a doubt if it may also be a graze.
    pub(super) fn take(&mut self, root: Root) {
        if root.doubt > 0.0 {
            self.doubt = self.doubt.or(Some(Doubt { at: root.at, bound: root.doubt }));
        }
        self.root = Some(root);
    }
}

/// The first root of a gap up to `to`; if rounding hides a touch, the evaluated sign counts.
pub(crate) fn decided(gap: &QuasiPolynomial, to: f64) -> Result<Found, Error> {
    let mut found = Found::default();
    let mut from = 0.0;
    loop {
        match gap.first_root(from, to)? {
            FirstRoot::Root(root) => {
                found.evaluations += root.evaluations;
                found.take(root);
                return Ok(found);
            }
            FirstRoot::None { evaluations } => {
                found.evaluations += evaluations;
                return Ok(found);
            }
            FirstRoot::Undecided { at, value, bound, until, evaluations } => {
                found.evaluations += evaluations;
                found.doubt = found.doubt.or(Some(Doubt { at, bound }));
                if value <= 0.0 {
                    let jet = gap.at(at, to);
                    let (error, doubt) = jet.root_error();
                    found.root = Some(Root { at, error, slope: jet.slope, doubt, evaluations });
                    return Ok(found);
                }
                if until >= to {
                    return Ok(found);
                }
                from = until;
            }
        }
    }
}
