//! The table `[load]` of a data sheet: a load torque over speed and time.

use crate::error::{Error, check, finite, not_negative, positive};

/// Largest number of nodes of each table of a load.
pub const MAX_LOAD_NODES: usize = 16;

/// Rising abscissas with their values.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Nodes {
    nodes: [(f64, f64); MAX_LOAD_NODES],
    count: usize,
}

impl Nodes {
    /// `names` are the names of the abscissas, of the values and of their number.
    fn new(names: [&'static str; 3], places: &[f64], values: &[f64], least: usize) -> Result<Self, Error> {
        let (count, mut nodes) = (places.len(), [(0.0, 0.0); MAX_LOAD_NODES]);
        if values.len() != count {
            let [one, other, _] = names;
            return Err(Error::Lengths { one, count, other, other_count: values.len() });
        }
        let legal = (least..=MAX_LOAD_NODES).contains(&count);
        check(legal, names[2], count as f64, if least == 0 { "[0, 16]" } else { "[1, 16]" })?;
        let mut last = f64::NEG_INFINITY;
        for (node, (&place, &value)) in nodes.iter_mut().zip(places.iter().zip(values)) {
            finite(names[1], value)?;
            check(
                place > last && place.is_finite(),
                names[0],
                place,
                "finite and greater than the value before it",
            )?;
            (*node, last) = ((place, value), place);
        }
        Ok(Self { nodes, count })
    }

    fn get(&self) -> &[(f64, f64)] {
        &self.nodes[..self.count]
    }
}

/// A linear piece of a load's torque: `torque` + `slope` times the speed, from one speed to another.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct LoadSegment {
    /// The lower speed (rad/s), or minus infinity.
    pub from: f64,
    /// The upper speed (rad/s), or infinity.
    pub to: f64,
    /// The torque extrapolated to speed 0 (N m), even if the piece does not reach that speed.
    pub torque: f64,
    /// Its slope (N m s/rad).
    pub slope: f64,
}

/// A load law and a schedule of the drive: a torque over the speed, a factor over the time, an inertia, and the
/// time for which the drive is on. A positive torque decelerates a positive rotation. Times count from the
/// start of a run-up.
///
/// ```
/// use bouncing_disk::parameters::LoadLaw;
///
/// // A fan that takes 1 mN m at 20 rad/s, and stops after 2 s; its torque is accurate to 5 uN m.
/// let fan = LoadLaw::fan(20.0, 1e-3, 7)?.with_factors(&[2.0], &[0.0])?;
/// assert!((fan.torque_at(8.0, 1.0) - 0.16e-3).abs() <= 1e-3 / (4.0 * 49.0));
/// assert_eq!((fan.torque_at(8.0, 3.0), fan.next_change_after(0.0)), (0.0, Some(2.0)));
/// # Ok::<(), bouncing_disk::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "LoadTable", into = "LoadTable"))]
pub struct LoadLaw {
    torques: Nodes,
    factors: Nodes,
    inertia: f64,
    drive: [f64; 2],
}

impl LoadLaw {
    /// A load whose torque (N m) is interpolated linearly between these speeds (rad/s) and extrapolated
    /// beyond both ends. A single speed means a constant torque.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for speeds that do not rise, for numbers or slopes that are not finite, for no
    /// speed and for more than [`MAX_LOAD_NODES`]; [`Error::Lengths`] if the number of torques differs.
    pub fn new(speeds: &[f64], torques: &[f64]) -> Result<Self, Error> {
        let names = ["load.speeds", "load.torques", "number of load.speeds"];
        let torques = Nodes::new(names, speeds, torques, 1)?;
        let factors = Nodes { nodes: [(0.0, 0.0); MAX_LOAD_NODES], count: 0 };
        let law = Self { torques, factors, inertia: 0.0, drive: [f64::NEG_INFINITY, f64::INFINITY] };
        for (speed, _) in law.torques.get() {
            let line = law.segment_at(*speed);
            finite("slope of load.torques", line.slope)?;
            finite("load.torques at speed 0", line.torque)?;
        }
        Ok(law)
    }

    /// A torque (N m) at all speeds, which also drives a rotor that turns backwards.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a torque that is not finite.
    pub fn constant(torque: f64) -> Result<Self, Error> {
        Self::new(&[0.0], &[torque])
    }

    /// A fan, T |w| w/w_r^2 with the torque T (N m) at the rated speed w_r (rad/s), as `pieces` linear pieces
    /// in each direction. Up to the rated speed the pieces exceed the exact torque by up to T/(4 `pieces`^2); above
    /// it, the last line is extrapolated.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a speed or a torque that is not positive, and for 0 or more than seven
    /// pieces.
    pub fn fan(rated_speed: f64, rated_torque: f64, pieces: usize) -> Result<Self, Error> {
        positive("rated_speed", rated_speed)?;
        positive("rated_torque", rated_torque)?;
        check((1..=7).contains(&pieces), "pieces", pieces as f64, "[1, 7]")?;
        let shares = (0..=2 * pieces).map(|index| (index as f64 - pieces as f64) / pieces as f64);
        let node = |share: f64| (rated_speed * share, rated_torque * (share * share.abs()));
        let (speeds, torques): (Vec<f64>, Vec<f64>) = shares.map(node).unzip();
        Self::new(&speeds, &torques)
    }

    /// Multiplies the torque by a factor from each of these times (s) on; the factor is 1 before the first.
    ///
    /// # Errors
    /// The errors of [`Self::new`]; two empty lists are legal.
    pub fn with_factors(self, times: &[f64], factors: &[f64]) -> Result<Self, Error> {
        let names = ["load.times", "load.factors", "number of load.times"];
        Ok(Self { factors: Nodes::new(names, times, factors, 0)?, ..self })
    }

    /// Adds an inertia on the shaft (kg m^2) to the rotor's.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if the inertia is negative or not finite.
    pub fn with_inertia(self, inertia: f64) -> Result<Self, Error> {
        Ok(Self { inertia: not_negative("load.inertia", inertia)?, ..self })
    }

    /// Limits the drive to the time from `on` to `off` (s); both may be infinite.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] unless `on` comes before `off`.
    pub fn with_drive(self, on: f64, off: f64) -> Result<Self, Error> {
        check(on < f64::INFINITY, "load.on", on, "[-inf, inf) (s)")?;
        check(on < off, "load.off", off, "after load.on (s)")?;
        Ok(Self { drive: [on, off], ..self })
    }

    /// The piece that contains a speed (rad/s); at a node, the upper one.
    #[must_use]
    pub fn segment_at(&self, speed: f64) -> LoadSegment {
        let nodes = self.torques.get();
        let Some(last) = nodes.len().checked_sub(2) else {
            let (from, to) = (f64::NEG_INFINITY, f64::INFINITY);
            return LoadSegment { from, to, torque: nodes[0].1, slope: 0.0 };
        };
        let index = nodes.partition_point(|node| node.0 <= speed).saturating_sub(1).min(last);
        let (one, other) = (nodes[index], nodes[index + 1]);
        let slope = (other.1 - one.1) / (other.0 - one.0);
        LoadSegment {
            from: if index == 0 { f64::NEG_INFINITY } else { one.0 },
            to: if index == last { f64::INFINITY } else { other.0 },
            torque: one.1 - slope * one.0,
            slope,
        }
    }

    /// The factor of the torque at a time (s).
    #[must_use]
    pub fn factor_at(&self, time: f64) -> f64 {
        let begun = self.factors.get().iter().rev().find(|(from, _)| *from <= time);
        begun.map_or(1.0, |(_, factor)| *factor)
    }

    /// The torque (N m) at a speed (rad/s) and a time (s).
    #[must_use]
    pub fn torque_at(&self, speed: f64, time: f64) -> f64 {
        let line = self.segment_at(speed);
        self.factor_at(time) * (line.torque + line.slope * speed)
    }

    /// The next time (s) after this one at which the factor may change, or the drive is switched.
    #[must_use]
    pub fn next_change_after(&self, time: f64) -> Option<f64> {
        let times = self.factors.get().iter().map(|(from, _)| *from).chain(self.drive);
        times.filter(|change| *change > time && change.is_finite()).min_by(f64::total_cmp)
    }

    /// Whether the drive is on at a time (s).
    #[must_use]
    pub fn drives_at(&self, time: f64) -> bool {
        (self.drive[0]..self.drive[1]).contains(&time)
    }

    /// The inertia on the shaft (kg m^2).
    #[must_use]
    pub const fn inertia(&self) -> f64 {
        self.inertia
    }
}

/// The table `[load]` of a file.
#[cfg(feature = "serde")]
#[derive(Debug, Clone, Default, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields, default, expecting = "the table load")]
struct LoadTable {
    speeds: Vec<f64>,
    torques: Vec<f64>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    times: Vec<f64>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    factors: Vec<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    inertia: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    on: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    off: Option<f64>,
}

#[cfg(feature = "serde")]
impl TryFrom<LoadTable> for LoadLaw {
    type Error = Error;

    fn try_from(table: LoadTable) -> Result<Self, Error> {
        let LoadTable { speeds, torques, times, factors, inertia, on, off } = table;
        let law = Self::new(&speeds, &torques)?.with_factors(&times, &factors)?;
        let (on, off) = (on.unwrap_or(f64::NEG_INFINITY), off.unwrap_or(f64::INFINITY));
        law.with_inertia(inertia.unwrap_or_default())?.with_drive(on, off)
    }
}

#[cfg(feature = "serde")]
impl From<LoadLaw> for LoadTable {
    fn from(law: LoadLaw) -> Self {
        let lists = |nodes: &Nodes| nodes.get().iter().copied().unzip();
        let ((speeds, torques), (times, factors)) = (lists(&law.torques), lists(&law.factors));
        let inertia = Some(law.inertia).filter(|inertia| *inertia != 0.0);
        let [on, off] = law.drive.map(|time| Some(time).filter(|time| time.is_finite()));
        Self { speeds, torques, times, factors, inertia, on, off }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::refused;

    /// Nodes at 1 and 3 rad/s: lines meet at the nodes and are extrapolated outside.
    #[test]
    fn a_torque_is_a_line_between_its_speeds() {
        let law = LoadLaw::new(&[1.0, 2.0, 3.0], &[10.0, 30.0, 20.0]).expect("legal");
        let all = f64::INFINITY;
        for (speed, from, to, torque, slope) in [
            (-1.0, -all, 2.0, -10.0, 20.0),
            (1.0, -all, 2.0, -10.0, 20.0),
            (2.0_f64.next_down(), -all, 2.0, -10.0, 20.0),
            (2.0, 2.0, all, 50.0, -10.0),
            (9.0, 2.0, all, 50.0, -10.0),
        ] {
            assert_eq!(law.segment_at(speed), LoadSegment { from, to, torque, slope }, "{speed}");
        }
        let constant = LoadLaw::constant(4.0).expect("legal");
        let whole = LoadSegment { from: -all, to: all, torque: 4.0, slope: 0.0 };
        assert!([-1.0, 0.0, 1.0].iter().all(|speed| constant.segment_at(*speed) == whole));
        let pair = LoadLaw::new(&[1.0, 2.0], &[1.0, 2.0]).expect("legal");
        let whole = LoadSegment { from: -all, to: all, torque: 0.0, slope: 1.0 };
        assert!([0.0, 1.0, 1.5, 2.0, 3.0].iter().all(|speed| pair.segment_at(*speed) == whole));
    }

    /// The error is as stated, and no smaller.
    #[test]
    fn a_fan_takes_its_torque_within_the_stated_error() {
        for pieces in 1..=7 {
            let fan = LoadLaw::fan(20.0, 3.0, pieces).expect("legal");
            let most = 3.0 / (4.0 * (pieces * pieces) as f64);
            let over = |index: i32| {
                let share = f64::from(index) / 1400.0;
                let exact = 3.0 * share * share.abs();
                (fan.torque_at(20.0 * share, 0.0) - exact) * share.signum()
            };
            let errors: Vec<f64> = (-1400..=1400).map(over).collect();
            assert!(errors.iter().all(|error| (-1e-14..=most + 1e-14).contains(error)), "{pieces}");
            assert!(errors.iter().any(|error| *error > most - 1e-5), "{pieces}");
        }
    }

    #[test]
    fn times_switch_the_factor_and_the_drive() {
        let law = LoadLaw::constant(2.0).and_then(|law| law.with_factors(&[1.0, 3.0], &[0.5, 0.0]));
        let law = law.and_then(|law| law.with_drive(0.0, 4.0)?.with_inertia(1e-5)).expect("legal");
        let torques = [0.0, 1.0, 2.9, 3.0, 9.0].map(|time| law.torque_at(7.0, time));
        assert_eq!((torques, law.inertia()), ([2.0, 1.0, 1.0, 0.0, 0.0], 1e-5));
        let changes = [-1.0, 0.0, 1.0, 3.5, 4.0].map(|time| law.next_change_after(time));
        assert_eq!(changes, [Some(0.0), Some(1.0), Some(3.0), Some(4.0), None]);
        assert_eq!([-1.0, 0.0, 3.9, 4.0].map(|time| law.drives_at(time)), [false, true, true, false]);
        assert_eq!(LoadLaw::constant(2.0).expect("legal").next_change_after(0.0), None);
    }

    #[test]
    fn what_is_wrong_is_told_by_its_field() {
        let law = LoadLaw::constant(1.0).expect("legal");
        let many: Vec<f64> = (0..17).map(f64::from).collect();
        for (result, field) in [
            (LoadLaw::new(&[], &[]), "number of load.speeds"),
            (LoadLaw::new(&many, &many), "number of load.speeds"),
            (LoadLaw::new(&[1.0, 1.0], &[1.0, 2.0]), "load.speeds"),
            (LoadLaw::new(&[f64::NAN], &[1.0]), "load.speeds"),
            (LoadLaw::new(&[1.0], &[f64::INFINITY]), "load.torques"),
            (LoadLaw::new(&[0.0, 1e-300], &[0.0, 1e300]), "slope of load.torques"),
            (LoadLaw::new(&[1e300, 1.1e300], &[0.0, 1.7e308]), "load.torques at speed 0"),
            (law.with_factors(&[0.0, -1.0], &[1.0, 1.0]), "load.times"),
            (law.with_factors(&[0.0], &[f64::NAN]), "load.factors"),
            (law.with_inertia(-1.0), "load.inertia"),
            (law.with_drive(1.0, 1.0), "load.off"),
            (law.with_drive(1.0, f64::NAN), "load.off"),
            (law.with_drive(f64::NAN, 1.0), "load.on"),
            (LoadLaw::fan(0.0, 1.0, 3), "rated_speed"),
            (LoadLaw::fan(1.0, f64::NAN, 3), "rated_torque"),
            (LoadLaw::fan(1.0, 1.0, 8), "pieces"),
        ] {
            refused(field, [result], |result| result);
        }
    }
}
