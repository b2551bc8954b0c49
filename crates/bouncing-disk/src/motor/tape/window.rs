//! The motion of rotors in a window of time, in dimensionless form.

use crate::stator::StatorLedger;

/// Number of times in a window at which the speed is sampled.
pub(crate) const SAMPLES: usize = 4;

/// The known speeds of a rotor in a window.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) enum Speeds {
    /// Nothing, as for a rotor that acts back.
    #[default]
    Unknown,
    /// The speeds at times spread evenly over the window, in their order; NaN if there is no sample.
    Samples([f64; SAMPLES]),
    /// The least and the largest speed of a cycle.
    Within([f64; 2]),
}

impl Speeds {
    /// The available samples.
    pub(crate) fn samples(&self) -> impl Iterator<Item = f64> + use<> {
        let all = if let Self::Samples(all) = *self { all } else { [f64::NAN; SAMPLES] };
        all.into_iter().filter(|speed| speed.is_finite())
    }

    /// The speeds of this window and the next one: every second sample of both.
    fn with(self, next: Self) -> Self {
        match (self, next) {
            (Self::Samples(own), Self::Samples(next)) => Self::Samples([own[0], own[2], next[0], next[2]]),
            (Self::Unknown, known) => known,
            (known, _) => known,
        }
    }
}

/// The motion of a rotor in a window of time, in dimensionless form.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct RotorWindow {
    /// Angle turned.
    pub(crate) angle: f64,
    /// Integral of the square of the speed.
    pub(crate) square: f64,
    /// Impulse of friction, divided by its coefficient, on a rotor held at rest; NaN for a rotor that acts
    /// back.
    pub(crate) held: f64,
    /// Work of the platform by friction, and loss in friction.
    pub(crate) friction_work: f64,
    pub(crate) friction_loss: f64,
    /// Work done against the load.
    pub(crate) load_work: f64,
    /// Integral of the load torque over time.
    pub(crate) load_impulse: f64,
    /// Change of the kinetic energy.
    pub(crate) kinetic_change: f64,
    pub(crate) speeds: Speeds,
    /// The energies of a compliant stator, and the rotor's own vertical motion. Boxed because there are many
    /// windows and most stators are rigid.
    pub(crate) stator: Option<Box<(StatorLedger, AxialWindow)>>,
}

/// The vertical motion that all rotors share in a window of time, in dimensionless form.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct AxialWindow {
    /// Duration (rad).
    pub(crate) duration: f64,
    /// Work of the platform by normal forces.
    pub(crate) normal_work: f64,
    /// The work of the perturbations of the relaunches.
    pub(crate) perturbation_work: f64,
    pub(crate) restitution_loss: f64,
    /// Change of the kinetic and potential energy.
    pub(crate) energy_change: f64,
    /// Time (rad) in contact.
    pub(crate) pressed: f64,
    /// Number of impacts; for rotors that never bounce, of periods.
    pub(crate) impacts: u64,
}

/// A window of time.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Window {
    pub(crate) axial: AxialWindow,
    pub(crate) rotors: Vec<RotorWindow>,
}

impl RotorWindow {
    pub(crate) fn add(&mut self, next: &Self) {
        self.angle += next.angle;
        self.square += next.square;
        self.held += next.held;
        self.friction_work += next.friction_work;
        self.friction_loss += next.friction_loss;
        self.load_work += next.load_work;
        self.load_impulse += next.load_impulse;
        self.kinetic_change += next.kinetic_change;
        self.speeds = self.speeds.with(next.speeds);
        if let Some(next) = &next.stator {
            let own = self.stator.get_or_insert_default();
            own.0 += next.0;
            own.1.add(&next.1);
        }
    }
}

impl AxialWindow {
    /// Loss and impacts per radian.
    pub(crate) fn rates(&self) -> [f64; 2] {
        [self.restitution_loss / self.duration, self.impacts as f64 / self.duration]
    }

    /// Whether the rates of this window agree with these, within the drift of a motion on its way to them.
    pub(crate) fn is_like(&self, rates: [f64; 2]) -> bool {
        self.rates().into_iter().zip(rates).all(|(own, other)| (own - other).abs() <= 0.02 * other.abs())
    }

    pub(crate) fn add(&mut self, next: &Self) {
        self.duration += next.duration;
        self.normal_work += next.normal_work;
        self.perturbation_work += next.perturbation_work;
        self.restitution_loss += next.restitution_loss;
        self.energy_change += next.energy_change;
        self.pressed += next.pressed;
        self.impacts += next.impacts;
    }
}

/// Cycles whose rates and speeds differ by less than this share are the same.
const ALIKE: f64 = 1.0e-5;

impl Window {
    /// Whether a cycle has the loss per radian of another cycle and moves the rotors, whose speeds lie within
    /// these limits, in the same way.
    pub(crate) fn is_like(&self, other: &Self, largest: &[f64]) -> bool {
        let loses = |window: &Self| window.axial.restitution_loss / window.axial.duration;
        let speed = |window: &Self, rotor: usize| window.rotors[rotor].angle / window.axial.duration;
        let is_alike = |rotor: usize| {
            let scale = largest.get(rotor).map_or_else(|| speed(self, rotor).abs(), |size| *size);
            (speed(self, rotor) - speed(other, rotor)).abs() <= ALIKE * scale
        };
        (loses(self) - loses(other)).abs() <= ALIKE * loses(other).abs()
            && (0..self.rotors.len().min(other.rotors.len())).all(is_alike)
    }

    /// Merges this window with the next one.
    pub(crate) fn add(&mut self, next: &Self) {
        self.axial.add(&next.axial);
        for (rotor, next) in self.rotors.iter_mut().zip(&next.rotors) {
            rotor.add(next);
        }
    }
}
