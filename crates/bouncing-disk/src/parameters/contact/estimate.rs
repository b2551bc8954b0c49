//! Estimates the duration of an impact and the indentation under the weight, to judge whether rigid impacts are
//! a valid model (docs/numerics-dynamics.md, "Estimates of the contact time").

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};
use std::fmt::{self, Display, Formatter};

use bouncing_disk_core::numerics::elementary::{ln, pow};
use bouncing_disk_drives::compliance::Compliance;

use crate::display::rough;
use crate::parameters::contact::{Contact, Geometry, Material};
use crate::parameters::system::System;

/// Contact time times speed over maximal indentation in Hertz's impact: (4/5) sqrt(pi)
/// Gamma(2/5)/Gamma(9/10).
const HERTZ: f64 = 2.943_275_184_324_704_7;

/// The longest contact time, in periods, for which rigid impacts are a good model.
const LONGEST: f64 = 0.1;

/// The thickness of a rough layer in root mean squares of its heights; a thousandth of the surface is higher.
const LAYER: f64 = 3.0;

/// Compliance of a 90 degree wedge loaded along one of its faces, relative to a half space.
const WEDGE: f64 = 0.5 * FRAC_PI_2 * (1.0 / (FRAC_PI_4 + 0.5) + 1.0 / (FRAC_PI_4 - 0.5));

/// The sharpest edge of a ring (m).
const SHARPEST: f64 = 1.0e-6;

/// Whether a disk that rests on the vibrating platform can leave it in spite of the contact's compliance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum LiftOff {
    /// The disk can leave, whatever the unknown values.
    Yes,
    /// This depends on the unknown values.
    Unknown,
    /// The disk stays, whatever the unknown values.
    No,
}

/// Estimated duration of impacts, and its consequences for the rigid model ([`System::contact_statement`]).
/// The ranges cover everything that the table `[contact]` leaves unknown.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct ContactStatement {
    /// Contact time of an impact over the period of the platform; `None` if there are no impacts.
    pub time_over_period: Option<[f64; 2]>,
    /// m g/(k A): the indentation under the weight over the amplitude A. Infinite if the amplitude is 0.
    pub indentation_over_amplitude: [f64; 2],
    /// Whether the disk leaves the platform; `None` if not even a rigid disk does.
    pub lift_off: Option<LiftOff>,
    /// Whether contacts are compliant in computations; `None` for a time that is too short.
    pub takes_time: Option<bool>,
}

/// Why the rigid model may mislead.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum ContactWarning {
    /// Impacts last longer than a tenth of a period, at the upper end of the range.
    LongContact {
        /// The range of the contact time over the period.
        periods: [f64; 2],
    },
    /// In a contact this soft the disk stays, or may stay, on the platform.
    StaysInContact {
        /// Whether it stays at both ends of the range.
        certain: bool,
    },
    /// The contact is too stiff to be computed, so impacts are rigid.
    Stiff,
}

impl Display for ContactWarning {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::LongContact { periods } => {
                let valid = if periods[0] > LONGEST { "are not valid" } else { "may not be valid" };
                write!(f, "rigid impacts {valid}: an impact lasts {} periods", range(*periods))
            }
            Self::StaysInContact { certain } => {
                let never = if *certain { "never leaves" } else { "may never leave" };
                write!(f, "a disk at rest {never} the platform with a contact this soft")
            }
            Self::Stiff => f.write_str(
                "contact.time is below 1e-6 rad of the vibration, so impacts are computed as rigid",
            ),
        }
    }
}

/// The two ends of a range in words.
fn range(ends: [f64; 2]) -> String {
    let [low, high] = ends.map(|end| rough(end).to_string());
    if low == high { low } else { format!("{low} to {high}") }
}

impl ContactStatement {
    /// The rows of a report (name and value), even without a table `[contact]`.
    #[must_use]
    pub fn rows(statement: Option<&Self>) -> [(&'static str, String); 2] {
        let unknown = || "unknown: give time or materials in [contact]".to_owned();
        let time = statement.map_or_else(unknown, |own| {
            let time = own.time_over_period.map_or_else(|| "there are no impacts".to_owned(), range);
            let model = match own.takes_time {
                Some(true) => "contacts are compliant",
                Some(false) => {
                    "impacts are rigid; to make contacts compliant, give contact.time instead of materials"
                }
                None => "too short, so impacts are rigid",
            };
            format!("{time} ({model})")
        });
        let depth = statement.map_or_else(unknown, |own| range(own.indentation_over_amplitude));
        [("contact_time_over_period", time), ("static_indentation_over_amplitude", depth)]
    }

    /// Why the rigid model may mislead.
    #[must_use]
    pub fn warnings(&self) -> Vec<ContactWarning> {
        let long = self.time_over_period.filter(|range| range[1] > LONGEST && self.takes_time == Some(false));
        let stays = self.lift_off.filter(|lift_off| *lift_off != LiftOff::Yes);
        let stays = stays.map(|own| ContactWarning::StaysInContact { certain: own == LiftOff::No });
        let long = long.map(|periods| ContactWarning::LongContact { periods });
        let stiff = self.takes_time.is_none().then_some(ContactWarning::Stiff);
        long.into_iter().chain(stays).chain(stiff).collect()
    }
}

/// One end of the unknown range: contact time (s) at a speed, indentation under the weight (m), stiffness for
/// small motions about it (N/m).
#[derive(Debug, Clone, Copy)]
struct End {
    time: Option<f64>,
    indentation: f64,
    stiffness: f64,
}

impl End {
    /// A linear spring, with the contact time of a lossless impact.
    fn linear(stiffness: f64, mass: f64, weight: f64) -> Self {
        let time = PI * (mass / stiffness).sqrt();
        Self { time: Some(time), indentation: weight / stiffness, stiffness }
    }
}

/// Contact time (s) of Hertz's lossless impact: 2.87 (m^2/(R E*^2 v))^(1/5).
fn hertz_time(mass: f64, radius: f64, modulus: f64, speed: f64) -> f64 {
    let share = 15.0 * mass * speed * speed / (16.0 * radius.sqrt() * modulus);
    HERTZ * pow(share, 0.4) / speed
}

/// A ball on a plane under its weight, and in an impact.
fn plane(mass: f64, weight: f64, radius: f64, modulus: f64, speed: Option<f64>) -> End {
    let indentation = pow(9.0 * weight * weight / (16.0 * radius * modulus * modulus), 1.0 / 3.0);
    let time = speed.map(|speed| hertz_time(mass, radius, modulus, speed));
    End { time, indentation, stiffness: 1.5 * weight / indentation }
}

/// A ball on the edge of a ring.
#[derive(Debug, Clone, Copy)]
struct RingContact {
    /// Radii of the ball, the circle of contact and the edge (m).
    ball: f64,
    ring: f64,
    edge: f64,
    /// 1/E' of ball and ring (1/Pa), E' = E/(1 - nu^2).
    compliances: [f64; 2],
    /// Compliance of the ring relative to a half space.
    softer: f64,
}

impl RingContact {
    /// Secant stiffness along the axis (N/m) under this force, and ln(16 a/b) + 1/2.
    fn stiffness(&self, force: f64) -> (f64, f64) {
        let [ball, ring] = self.compliances;
        let sine = self.ring / self.ball;
        let cosine = (1.0 - sine * sine).sqrt();
        let per_length = TAU * self.ring * cosine;
        let radius = 1.0 / (1.0 / self.ball + 1.0 / self.edge);
        let width = (4.0 * force / per_length * radius * (ball + ring) / PI).sqrt().min(self.ring);
        let logarithm = ln(16.0 * self.ring / width) + 0.5;
        let approach = 2.0 / PI * (ball + self.softer * ring) * logarithm;
        (per_length * cosine / approach, logarithm)
    }

    fn end(&self, mass: f64, weight: f64, speed: Option<f64>) -> End {
        let (secant, logarithm) = self.stiffness(weight);
        let time = speed.map(|speed| {
            // The logarithm hardly changes: each iteration reduces the error tenfold.
            let last = (0..20).fold(secant, |k, _| self.stiffness(speed * (mass * k).sqrt()).0);
            PI * (mass / last).sqrt()
        });
        End { time, indentation: weight / secant, stiffness: secant * logarithm / (logarithm - 0.5) }
    }
}

/// The soft and the stiff end for a contact whose materials are given.
fn ends(contact: &Contact, [disk, platform]: [Material; 2], weight: f64, speed: Option<f64>) -> [End; 2] {
    // A checked table has the sizes that its geometry needs.
    let given = |size: Option<f64>| size.unwrap_or(f64::NAN);
    let (mass, ball) = (given(contact.mass), given(contact.ball_radius));
    let reduced = |material: Material, end: usize| {
        let ratio = material.poissons_ratio();
        (1.0 - ratio * ratio) / material.youngs_modulus()[end]
    };
    [0, 1].map(|end| {
        let compliances = [disk, platform].map(|material| reduced(material, end));
        let mut own = match contact.geometry.unwrap_or(Geometry::Plane) {
            Geometry::Plane => plane(mass, weight, ball, 1.0 / (compliances[0] + compliances[1]), speed),
            Geometry::Ring => {
                let ring = given(contact.ring_radius);
                let (edge, softer) = [(SHARPEST.min(ring), WEDGE), (ring, 1.0)][end];
                RingContact { ball, ring, edge, compliances, softer }.end(mass, weight, speed)
            }
            Geometry::Layer => {
                let softest = |one: &Material, other: &Material| {
                    one.youngs_modulus()[0].total_cmp(&other.youngs_modulus()[0])
                };
                let layer = [disk, platform].into_iter().min_by(softest).unwrap_or(disk);
                let ratio = layer.poissons_ratio();
                // The sides of the layer are either free or confined.
                let confined = (1.0 - ratio) / ((1.0 + ratio) * (1.0 - 2.0 * ratio));
                let modulus = layer.youngs_modulus()[end] * [1.0, confined][end];
                End::linear(modulus * given(contact.area) / given(contact.thickness), mass, weight)
            }
        };
        if let (0, Some(height)) = (end, contact.roughness) {
            own.time = own.time.zip(speed).map(|(time, speed)| time + 2.0 * LAYER * height / speed);
            own.indentation += LAYER * height;
            // A rough surface with an exponential tail of heights has the stiffness F/sigma.
            own.stiffness = 1.0 / (1.0 / own.stiffness + height / weight);
        }
        own
    })
}

/// The largest and the least ratio of the disk's acceleration to the platform's, for a damping ratio and a
/// range of squared frequencies in units of the contact's own.
fn transmissibility(squares: [f64; 2], damping: f64) -> [f64; 2] {
    let four = 4.0 * damping * damping;
    let at = |square: f64| {
        let detuning = 1.0 - square;
        ((1.0 + four * square) / (detuning * detuning + four * square)).sqrt()
    };
    let peak = if four > 0.0 { ((1.0 + 2.0 * four).sqrt() - 1.0) / four } else { 1.0 };
    let [low, high] = squares.map(at);
    [low.min(high), at(peak.clamp(squares[0], squares[1]))]
}

impl System {
    /// The estimated duration of impacts at this `speed` (m/s), from the table `[contact]`; `None` without a
    /// table. The speed is the one of the motion under study; a speed in the table overrides it. If `speed` is
    /// `None`, there are no impacts.
    ///
    /// ```
    /// use bouncing_disk::System;
    /// use bouncing_disk::parameters::Contact;
    ///
    /// // The paper's ball of 32.9 g on its ring, at an impact speed of 5.8 mm/s.
    /// let contact = Contact { mass: Some(0.0329), ..Contact::PAPER };
    /// let motor = System::motor().with_contact(Some(contact))?;
    /// let statement = motor.contact_statement(Some(5.8e-3)).expect("a contact");
    /// let periods = statement.time_over_period.expect("impacts");
    /// assert!(periods[0] > 4.0 && periods[1] < 10.0);
    /// let warning = statement.warnings()[0].to_string();
    /// assert!(warning.starts_with("rigid impacts are not valid: an impact lasts 4."));
    /// # Ok::<(), bouncing_disk::Error>(())
    /// ```
    #[must_use]
    pub fn contact_statement(&self, speed: Option<f64>) -> Option<ContactStatement> {
        let contact = self.contact()?;
        let (omega, disk) = (self.platform().angular_frequency(), self.disk());
        let peak = self.peak_acceleration();
        let damped = |law: fn(f64, f64) -> Result<Compliance, bouncing_disk_core::Error>| {
            let [least, most] = Compliance::RESTITUTIONS;
            law(1.0, disk.restitution().clamp(least, most)).ok()
        };
        let damper = damped(Compliance::new)?;
        // In units of m, 1/omega and g/omega^2 both ways to specify a contact coincide.
        let (time, indentation, stiffness) = match (contact.time, contact.materials) {
            (Some(time), _) => {
                let length = time * omega;
                let stiffness = [Some(damper), damped(Compliance::hysteretic)]
                    .map(|law| law.map_or(f64::NAN, |own| own.stiffness() / (length * length)));
                (Some([length; 2]), stiffness.map(f64::recip), stiffness)
            }
            (None, Some(materials)) => {
                let weight = contact.mass? * disk.preload_acceleration();
                let ends = ends(contact, materials, weight, contact.speed.or(speed));
                let time = match ends.map(|own| own.time) {
                    [Some(soft), Some(stiff)] if contact.speed.or(speed).is_some() => {
                        Some([stiff * omega, soft * omega])
                    }
                    _ => None,
                };
                let length = self.scales().length;
                let per_mass = contact.mass? * omega * omega;
                (time, ends.map(|own| own.indentation / length), ends.map(|own| own.stiffness / per_mass))
            }
            (None, None) => return None,
        };
        let sorted = |[one, other]: [f64; 2]| if one <= other { [one, other] } else { [other, one] };
        let [soft, stiff] = sorted(stiffness);
        let squares = [1.0 / stiff, 1.0 / soft];
        let ratio = damper.damping() / (2.0 * damper.stiffness().sqrt());
        let [free, damped] = [0.0, ratio].map(|ratio| transmissibility(squares, ratio).map(|own| own * peak));
        let lift_off = (peak > 1.0).then(|| match (free[0].min(damped[0]), free[1].max(damped[1])) {
            (least, _) if least > 1.0 => LiftOff::Yes,
            (_, most) if most < 1.0 => LiftOff::No,
            _ => LiftOff::Unknown,
        });
        Some(ContactStatement {
            time_over_period: time.map(|time| time.map(|time| time / TAU)),
            indentation_over_amplitude: sorted(indentation).map(|own| own / peak),
            lift_off,
            takes_time: match (contact.time, self.soft_contact()) {
                (Some(_), None) => None,
                (_, soft) => Some(soft.is_some()),
            },
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parameters::contact::ContactLaw;
    use crate::{Error, Motor};

    const MASS: f64 = 0.0329;

    /// Contact time and largest force of a mass that hits a spring, by Runge-Kutta steps.
    fn integrated(mass: f64, speed: f64, step: f64, force: impl Fn(f64) -> f64) -> f64 {
        let slope = |(depth, rate): (f64, f64)| (rate, -force(depth) / mass);
        let moved = |(x, v): (f64, f64), (dx, dv): (f64, f64), h: f64| (x + h * dx, v + h * dv);
        let (mut now, mut time) = ((0.0, speed), 0.0);
        loop {
            let a = slope(now);
            let b = slope(moved(now, a, 0.5 * step));
            let c = slope(moved(now, b, 0.5 * step));
            let d = slope(moved(now, c, step));
            let mean = |a: f64, b: f64, c: f64, d: f64| (a + 2.0 * (b + c) + d) / 6.0;
            let next = moved(now, (mean(a.0, b.0, c.0, d.0), mean(a.1, b.1, c.1, d.1)), step);
            if next.0 <= 0.0 {
                return time + step * now.0 / (now.0 - next.0);
            }
            (now, time) = (next, time + step);
        }
    }

    #[test]
    fn hertz_agrees_with_the_integrated_impact() {
        for (mass, radius, modulus, speed) in [(MASS, 0.01, 59e9, 5.8e-3), (1e-3, 2e-3, 3e9, 1.0)] {
            let time = hertz_time(mass, radius, modulus, speed);
            let stiffness = 4.0 / 3.0 * modulus * f64::sqrt(radius);
            let force = |depth: f64| stiffness * depth.max(0.0) * depth.max(0.0).sqrt();
            let other = integrated(mass, speed, time / 4_000.0, force);
            assert!((time / other - 1.0).abs() < 1e-6, "{time} {other}");
            assert!(
                (time / (2.87 * pow(mass * mass / (radius * modulus * modulus * speed), 0.2)) - 1.0).abs()
                    < 1e-3
            );
        }
        // The static indentation corresponds to the same force.
        let ball = plane(MASS, 0.3224, 0.01, 59e9, None);
        let force = 4.0 / 3.0 * 59e9 * 0.1 * ball.indentation * ball.indentation.sqrt();
        assert!((force / 0.3224 - 1.0).abs() < 1e-12);
    }

    /// A steel ball of 20 mm on aluminium.
    #[test]
    fn the_paper_s_ball_on_a_plane_stays_in_contact_for_a_quarter_of_a_millisecond() {
        let time = hertz_time(MASS, 0.01, 59e9, 5.8e-3);
        assert!((time - 0.25e-3).abs() < 0.01e-3, "{time}");
        let ball = plane(MASS, MASS * 9.8, 0.01, 59e9, None);
        assert!((ball.stiffness / 4e6 - 1.0).abs() < 0.05 && (ball.indentation / 12e-8 - 1.0).abs() < 0.05);
    }

    #[test]
    fn the_ring_is_a_line_load_along_a_circle() {
        // The potential of a circle of radius 1 at the distance d from it.
        for d in [1e-3, 1e-4] {
            let n = 4_000_000;
            let near = |k: u32| {
                let half =
                    bouncing_disk_core::numerics::elementary::sin(PI * (f64::from(k) + 0.5) / f64::from(n));
                1.0 / (d * d + 4.0 * (1.0 + d) * half * half).sqrt()
            };
            let potential = (0..n).map(near).sum::<f64>() * TAU / f64::from(n);
            assert!((potential / (2.0 * ln(8.0 / d)) - 1.0).abs() < d, "{potential}");
        }
        // Compares the linearised impact with one that includes the logarithm.
        let ring = RingContact {
            ball: 0.01,
            ring: 1.25e-3,
            edge: 1e-4,
            compliances: [4.3e-12, 1.27e-11],
            softer: 1.0,
        };
        let time = ring.end(MASS, 0.3224, Some(5.8e-3)).time.unwrap();
        let force = |depth: f64| {
            // Solves x = F/k(F).
            let depth = depth.max(1e-30);
            (0..12).fold(depth * ring.stiffness(1.0).0, |force, _| depth * ring.stiffness(force).0)
        };
        let other = integrated(MASS, 5.8e-3, time / 1_000.0, force);
        assert!((time / other - 1.0).abs() < 0.03, "{time} {other}");
    }

    fn with(change: impl FnOnce(&mut Contact)) -> Result<Motor, Error> {
        let mut contact = Contact::PAPER;
        change(&mut contact);
        Motor::paper_70_khz().with(|sheet| sheet.contact = Some(contact))
    }

    #[test]
    fn unknowns_widen_the_ranges() {
        let statement = |change: fn(&mut Contact)| {
            with(change).unwrap().system().contact_statement(Some(5.8e-3)).unwrap()
        };
        let ring = statement(|_| {});
        let [low, high] = ring.time_over_period.unwrap();
        assert!(4.0 < low && low < 5.0 && 7.0 < high && high < 10.0, "{ring:?}");
        let rough = statement(|own| own.roughness = Some(1e-7));
        let added = rough.time_over_period.unwrap()[1] - high;
        assert!((added - 6e-7 / 5.8e-3 * 70e3).abs() < 1e-9, "{rough:?}");
        assert!((rough.time_over_period.unwrap()[0] / low - 1.0).abs() < 1e-15);
        let plane = statement(|own| (own.geometry, own.ring_radius) = (Some(Geometry::Plane), None));
        let [low, high] = plane.time_over_period.unwrap();
        assert!(17.0 < low && high < 19.0, "{plane:?}");
        assert_eq!(plane.lift_off, Some(LiftOff::Unknown), "undamped it stays, with a damper it leaves");
        let layer = |own: &mut Contact, thickness: f64| {
            let materials = Some([Material::Steel, Material::Polyimide]);
            *own = Contact { materials, geometry: Some(Geometry::Layer), ..Contact::default() };
            (own.area, own.thickness) = (Some(2e-6), Some(thickness));
        };
        let thin = with(|own| layer(own, 1e-5)).unwrap().system().contact_statement(Some(1.0)).unwrap();
        let stiffness = 2.5e9 * 2e-6 / 1e-5;
        let time = PI * (Motor::paper_70_khz().mass() / stiffness).sqrt() * 70e3;
        assert!((thin.time_over_period.unwrap()[1] / time - 1.0).abs() < 1e-12, "{thin:?}");
        assert!((thin.indentation_over_amplitude[1] / (0.3224 / stiffness / 1e-8) - 1.0).abs() < 1e-3);
    }

    /// The response of a linear contact decides on lift-off; the core's contact agrees.
    #[test]
    fn a_contact_that_is_soft_enough_is_never_left() {
        let of = |periods: f64| {
            let contact = Contact { time: Some(periods / 70e3), ..Contact::default() };
            Motor::paper_70_khz()
                .system()
                .with_contact(Some(contact))
                .unwrap()
                .contact_statement(None)
                .unwrap()
        };
        for (periods, lift_off) in [(1e-3, LiftOff::Yes), (18.0, LiftOff::Unknown), (1e3, LiftOff::No)] {
            let statement = of(periods);
            assert_eq!(statement.lift_off, Some(lift_off), "{statement:?}");
            let [low, high] = statement.time_over_period.unwrap();
            assert!((low / periods - 1.0).abs() < 1e-12 && (high / periods - 1.0).abs() < 1e-12);
            assert_eq!(statement.warnings().is_empty(), periods < 0.1);
        }
        // Beyond the core's restitutions, the damping of materials is the nearest legal one.
        let elastic = Motor::paper_70_khz().with(|sheet| {
            (sheet.restitution, sheet.contact) = (1.0 - 1e-9, Some(Contact::PAPER));
        });
        assert!(elastic.unwrap().system().contact_statement(None).is_some());
        let peak = Motor::paper_70_khz().system().peak_acceleration();
        let stiffness = Compliance::new(18.0 * TAU, 0.5).unwrap().stiffness();
        let high = of(18.0).indentation_over_amplitude[1];
        assert!((high * stiffness * peak - 1.0).abs() < 1e-12);
    }

    #[test]
    fn tables_that_lack_something_or_say_too_much_are_refused() {
        type Change = fn(&mut Contact);
        let cases: [(Change, &str); 12] = [
            (|own| own.time = Some(1e-4), "both contact.time and contact.materials"),
            (|own| *own = Contact { time: Some(0.0), ..Contact::default() }, "contact.time = 0"),
            (|own| *own = Contact { time: Some(-1.0), ..Contact::default() }, "contact.time = -1"),
            (|own| *own = Contact { time: Some(f64::NAN), ..Contact::default() }, "contact.time = NaN"),
            (|own| *own = Contact::lasting(1.0), "contact time = 439822.97"),
            (|own| own.law = Some(ContactLaw::Damper), "contact.time is not given"),
            (|own| *own = Contact::default(), "neither contact.time nor contact.materials"),
            (|own| own.geometry = None, "contact.geometry is not given"),
            (|own| own.ring_radius = None, "contact.ring_radius is not given"),
            (|own| own.ring_radius = Some(0.02), "contact.ring_radius = 0.02 is not legal"),
            (|own| own.area = Some(1e-6), "both another geometry and contact.area"),
            (|own| own.mass = Some(0.03), "both mass and contact.mass"),
        ];
        for (change, words) in cases {
            let error = with(change).unwrap_err().to_string();
            assert!(error.contains(words), "{error}");
        }
        let error = System::motor().with_contact(Some(Contact::PAPER)).unwrap_err();
        assert_eq!(error, Error::NotGiven { field: "contact.mass" });
    }
}
