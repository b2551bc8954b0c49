//! The energy balance of a stator: sources and losses.

use std::ops::{AddAssign, Sub};

/// Largest number of modes of a stator.
pub const MODES: usize = 2;

/// The energy balance of the modes of a stator in an interval, in units of m (g/omega)^2. Every entry is
/// computed separately.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct StatorLedger {
    /// Work of the drive on the modes.
    pub drive_work: f64,
    /// Loss in the damping of each mode.
    pub damping_loss: [f64; MODES],
    /// Work of the modes on the disk, by normal forces and by friction.
    pub disk_work: f64,
    /// Change of the energy of the modes.
    pub energy_change: f64,
    /// Sum of the magnitudes of all terms, including energy levels.
    pub magnitude: f64,
    /// Angular impulse that the load took from the disk, per moment of inertia: the mean load torque times
    /// the time.
    pub load_impulse: f64,
}

impl StatorLedger {
    /// Change of the energy minus the inflow: zero up to rounding.
    #[must_use]
    pub fn closure(&self) -> f64 {
        self.energy_change - (self.drive_work - self.damping_loss.iter().sum::<f64>() - self.disk_work)
    }

    pub(crate) fn record(&mut self, mode: usize, drive: f64, loss: f64, disk: f64) {
        self.drive_work += drive;
        self.damping_loss[mode] += loss;
        self.disk_work += disk;
        self.magnitude += drive.abs() + loss.abs() + disk.abs();
    }
}

impl AddAssign for StatorLedger {
    fn add_assign(&mut self, other: Self) {
        self.drive_work += other.drive_work;
        for (own, other) in self.damping_loss.iter_mut().zip(other.damping_loss) {
            *own += other;
        }
        self.disk_work += other.disk_work;
        self.energy_change += other.energy_change;
        self.magnitude += other.magnitude;
        self.load_impulse += other.load_impulse;
    }
}

impl Sub for StatorLedger {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self {
            drive_work: self.drive_work - other.drive_work,
            damping_loss: std::array::from_fn(|mode| self.damping_loss[mode] - other.damping_loss[mode]),
            disk_work: self.disk_work - other.disk_work,
            energy_change: self.energy_change - other.energy_change,
            magnitude: self.magnitude - other.magnitude,
            load_impulse: self.load_impulse - other.load_impulse,
        }
    }
}
