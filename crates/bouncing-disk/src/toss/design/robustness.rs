//! How much of the objective remains if the inputs are off (docs/numerics/design.md, "Robustness").

use crate::error::{Error, check};
use crate::parameters::disk::DiskParameters;
use crate::parameters::stroke::Stroke;
use crate::toss::design::TossDesign;
use crate::toss::design::constraints::TossConstraints;
use crate::toss::design::hand::{Evaluation, Hand, flight_height, over_frictions, toss, value_of};

/// Number of coefficients of friction at which the range is evaluated; odd.
const FRICTIONS: usize = 129;

/// Inputs whose last digit may be in doubt.
const INPUTS: usize = 7;

/// Golden sections along one input, and how often all inputs are gone through.
const SECTIONS: u32 = 12;
const ROUNDS: usize = 2;

/// An input of a toss.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum TossInput {
    /// Stroke c.
    Stroke,
    /// Angular frequency omega.
    AngularFrequency,
    /// Amplitude angle phi_L.
    AmplitudeAngle,
    /// Phase lag theta.
    PhaseLag,
    /// Contact radius a_e.
    ContactRadius,
    /// Radius of gyration a_g.
    GyrationRadius,
    /// Acceleration of gravity g.
    PreloadAcceleration,
    /// Coefficient of friction mu.
    Friction,
}

/// In the order of the fields of [`TossHalfUnits`].
const ALL: [TossInput; INPUTS] = [
    TossInput::Stroke,
    TossInput::AngularFrequency,
    TossInput::AmplitudeAngle,
    TossInput::PhaseLag,
    TossInput::ContactRadius,
    TossInput::GyrationRadius,
    TossInput::PreloadAcceleration,
];

/// Half a unit in the last digit to which each input is known or kept, not negative: 0.005 m for a stroke of
/// 0.25 m. The default is zero: all inputs are exact. Friction has its range in
/// [`TossConstraints::friction`].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct TossHalfUnits {
    /// Of the stroke c (m).
    pub stroke: f64,
    /// Of the angular frequency omega (rad/s).
    pub angular_frequency: f64,
    /// Of the amplitude angle phi_L (rad).
    pub amplitude_angle: f64,
    /// Of the phase lag theta (rad).
    pub phase_lag: f64,
    /// Of the contact radius a_e (m).
    pub contact_radius: f64,
    /// Of the radius of gyration a_g (m).
    pub gyration_radius: f64,
    /// Of the acceleration of gravity g (m/s^2).
    pub preload_acceleration: f64,
}

impl TossHalfUnits {
    const fn all(&self) -> [f64; INPUTS] {
        [
            self.stroke,
            self.angular_frequency,
            self.amplitude_angle,
            self.phase_lag,
            self.contact_radius,
            self.gyration_radius,
            self.preload_acceleration,
        ]
    }
}

/// The spread of an objective about its nominal value.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Robustness {
    /// At the inputs as given.
    pub nominal: f64,
    /// The least that was found.
    pub least: f64,
    /// The most.
    pub most: f64,
    /// The input that alone reduces the objective most; `None` if no input does.
    pub worst_input: Option<TossInput>,
    /// The reduction, not negative.
    pub worst_loss: f64,
}

/// The robustness of a toss whose hand and dough are not quite those of the design.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TossRobustness {
    /// Over everything that rounds to the same digits; the objective is taken over the range of friction, as
    /// in the design. For a dough that never leaves it is zero.
    pub digits: Robustness,
    /// Over the range of friction, the other inputs as given; nominal is its middle.
    pub friction: Robustness,
    /// The highest flight (m) over everything that rounds to the same digits: the limit of the design holds
    /// for the inputs as given.
    pub highest_flight: f64,
}

/// A hand motion with its dough as a row of inputs.
struct Inputs<'a> {
    constraints: &'a TossConstraints,
    nominal: [f64; INPUTS],
    half_units: [f64; INPUTS],
}

impl<'a> Inputs<'a> {
    fn new(design: &'a TossDesign, half_units: &TossHalfUnits) -> Result<Self, Error> {
        let (hand, dough) = (&design.hand, &design.constraints.dough);
        let inputs = Self {
            constraints: &design.constraints,
            nominal: [
                hand.stroke,
                hand.angular_frequency,
                hand.amplitude_angle,
                hand.phase_lag,
                dough.contact_radius,
                dough.gyration_radius,
                dough.preload_acceleration,
            ],
            half_units: half_units.all(),
        };
        const NAMES: [&str; INPUTS] = [
            "half unit of stroke",
            "half unit of angular_frequency",
            "half unit of amplitude_angle",
            "half unit of phase_lag",
            "half unit of contact_radius",
            "half unit of gyration_radius",
            "half unit of preload_acceleration",
        ];
        for (index, half) in inputs.half_units.into_iter().enumerate() {
            check(half >= 0.0 && half.is_finite(), NAMES[index], half, "[0, inf)")?;
            // An angle may be off by more than itself, a length may not.
            let is_angle = matches!(ALL[index], TossInput::AmplitudeAngle | TossInput::PhaseLag);
            let legal = is_angle || half < inputs.nominal[index];
            check(legal, NAMES[index], half, "[0, the input itself)")?;
        }
        Ok(inputs)
    }

    fn parts(&self, shifts: &[f64; INPUTS]) -> (Stroke, DiskParameters) {
        let [
            stroke,
            angular_frequency,
            angle,
            phase_lag,
            contact_radius,
            gyration_radius,
            preload_acceleration,
        ] = std::array::from_fn(|index| self.nominal[index] + shifts[index] * self.half_units[index]);
        let amplitude_angle = angle.clamp(0.0, std::f64::consts::FRAC_PI_2);
        let hand = Stroke { stroke, amplitude_angle, contact_radius, angular_frequency, phase_lag };
        let dough = DiskParameters {
            contact_radius,
            gyration_radius,
            preload_acceleration,
            ..self.constraints.dough
        };
        (hand, dough)
    }

    fn value(&self, shifts: &[f64; INPUTS]) -> Result<f64, Error> {
        let (hand, dough) = self.parts(shifts);
        value_of(self.constraints, hand, dough)
    }

    /// How high the dough flies; the friction does not matter.
    fn height(&self, shifts: &[f64; INPUTS]) -> Result<f64, Error> {
        let (hand, dough) = self.parts(shifts);
        let toss = toss(hand, dough, self.constraints.friction[0], self.constraints.initial)?;
        Ok(toss.map_or(0.0, |toss| flight_height(&toss, dough.preload_acceleration)))
    }

    /// The inputs that are in doubt.
    fn doubtful(&self) -> Vec<usize> {
        (0..INPUTS).filter(|&index| self.half_units[index] > 0.0).collect()
    }

    /// The largest value of a function of the shifts: at the corners, faces and centre of the box first, from
    /// the best of these by golden sections along one input after the other.
    fn largest(&self, of: &dyn Fn(&[f64; INPUTS]) -> Result<f64, Error>) -> Result<f64, Error> {
        let doubtful = self.doubtful();
        let (mut best, mut at) = (of(&[0.0; INPUTS])?, [0.0; INPUTS]);
        for code in 0..3_usize.pow(doubtful.len() as u32) {
            let (mut shifts, mut rest) = ([0.0; INPUTS], code);
            for &input in &doubtful {
                shifts[input] = (rest % 3) as f64 - 1.0;
                rest /= 3;
            }
            let value = of(&shifts)?;
            if value > best {
                (best, at) = (value, shifts);
            }
        }
        for _ in 0..ROUNDS {
            for &input in &doubtful {
                let (low, high): (f64, f64) = ((at[input] - 1.0).max(-1.0), (at[input] + 1.0).min(1.0));
                let mut along = |shift: f64| {
                    let mut shifts = at;
                    shifts[input] = shift;
                    of(&shifts).map(|value| -value)
                };
                let middle =
                    bouncing_disk_core::numerics::roots::golden_section(low, high, SECTIONS, &mut along)?;
                let value = -along(middle)?;
                if value > best {
                    best = value;
                    at[input] = middle;
                }
            }
        }
        Ok(best)
    }
}

impl TossDesign {
    /// How much of the objective remains if hand and dough are not quite those of the design: over
    /// everything that rounds to the same digits, and over the range of friction.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a half unit that is negative or not finite, or one that leaves nothing of
    /// its input; those of [`best_toss`](crate::toss::best_toss).
    pub fn robustness(&self, half_units: &TossHalfUnits) -> Result<TossRobustness, Error> {
        robustness(self, half_units)
    }
}

/// The robustness of a design.
pub(super) fn robustness(design: &TossDesign, half_units: &TossHalfUnits) -> Result<TossRobustness, Error> {
    let inputs = Inputs::new(design, half_units)?;
    let nominal = inputs.value(&[0.0; INPUTS])?;
    let most = inputs.largest(&|shifts| inputs.value(shifts))?;
    let least = -inputs.largest(&|shifts| inputs.value(shifts).map(|value| -value))?;
    let (mut worst_input, mut worst_loss) = (None, 0.0);
    for input in inputs.doubtful() {
        for sign in [-1.0, 1.0] {
            let mut shifts = [0.0; INPUTS];
            shifts[input] = sign;
            let loss = nominal - inputs.value(&shifts)?;
            if loss > worst_loss {
                (worst_input, worst_loss) = (Some(ALL[input]), loss);
            }
        }
    }
    Ok(TossRobustness {
        digits: Robustness { nominal, least, most, worst_input, worst_loss },
        friction: over_friction(design)?,
        highest_flight: inputs.largest(&|shifts| inputs.height(shifts))?,
    })
}

fn over_friction(design: &TossDesign) -> Result<Robustness, Error> {
    let constraints = &design.constraints;
    let (hand, dough) = (design.hand, constraints.dough);
    let middle_only = {
        let [least, most] = constraints.friction;
        TossConstraints { friction: [0.5 * (least + most); 2], ..*constraints }
    };
    let own = Hand {
        angular_frequency: hand.angular_frequency,
        phase_lag: hand.phase_lag,
        amplitude_angle: hand.amplitude_angle,
    };
    let nominal = Evaluation::new(&middle_only, own)?.value;
    let (mut least, mut most) = (nominal, nominal);
    over_frictions(constraints, hand, dough, FRICTIONS, |_, value| {
        least = least.min(value);
        most = most.max(value);
    })?;
    let worst_loss = nominal - least;
    let worst_input = (worst_loss > 0.0).then_some(TossInput::Friction);
    Ok(Robustness { nominal, least, most, worst_input, worst_loss })
}
